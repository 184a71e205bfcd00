// SPDX-License-Identifier: Apache-2.0
#include "encoder/selection/selection_notes.hpp"

#include "encoder/heights/heights_notes.hpp"
#include "encoder/textures/texture_notes.hpp"
#include "ratecontrol/needs/packet_budget.hpp"

namespace tetrakis::inline selection {

void noteTaken(const EncodeInputs& inputs, const Selection& taken, uint64_t payload_bytes) {
  const auto sent = payloadWithin(taken.packets, payload_bytes);
  if (taken.heights) note(inputs, *taken.heights, Verdict::kTaken, sent[0]);
  if (taken.texture) note(inputs, *taken.texture, Verdict::kTaken, sent[1]);
}

void noteOthers(const EncodeInputs& inputs, const Selection& better, const Selection& lost) {
  if (lost.heights && lost.heights != better.heights)
    note(inputs, *lost.heights, Verdict::kWorseInBudget);
  if (lost.texture && lost.texture != better.texture)
    note(inputs, *lost.texture, Verdict::kWorseInBudget);
}

}  // namespace tetrakis::inline selection

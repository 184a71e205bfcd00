// SPDX-License-Identifier: Apache-2.0
#include "encoder/selection/selection_notes.hpp"

#include "encoder/heights/heights_notes.hpp"
#include "encoder/textures/texture_notes.hpp"

namespace tetrakis::inline selection {

namespace {

/// Bytes of the packets that belong to the component.
uint64_t sentOf(const Selection& selection, Component component) {
  uint64_t bytes = 0;
  for (const Packet& packet : selection.packets)
    if (packet.component == component) bytes += packet.length();
  return bytes;
}

}  // namespace

void noteTaken(const EncodeInputs& inputs, const Selection& taken) {
  if (taken.heights)
    note(inputs, *taken.heights, Verdict::kTaken, sentOf(taken, Component::kGeometry));
  if (taken.texture)
    note(inputs, *taken.texture, Verdict::kTaken, sentOf(taken, Component::kTexture));
}

void noteOthers(const EncodeInputs& inputs, const Selection& better, const Selection& lost) {
  if (lost.heights && lost.heights != better.heights)
    note(inputs, *lost.heights, Verdict::kWorseInBudget);
  if (lost.texture && lost.texture != better.texture)
    note(inputs, *lost.texture, Verdict::kWorseInBudget);
}

}  // namespace tetrakis::inline selection

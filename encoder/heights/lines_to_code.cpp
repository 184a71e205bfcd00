// SPDX-License-Identifier: Apache-2.0
#include "encoder/heights/lines_to_code.hpp"

#include "codec/geometry/quantiser/voids.hpp"
#include "encoder/inputs/repeated_lines.hpp"

namespace tetrakis::inline heights {

/// Beside a texture cameras look at the coded heights: two lines have an area, one has none.
CodedLines linesToCode(const EncodeInputs& inputs) {
  const tks_encode_options& options = inputs.options;
  if (inputs.heights == nullptr || options.picture_error != nullptr) return {};
  const tks_heights& heights = *inputs.heights;
  CodedLines lines = findRepeatedLines(
      {heights.data, {heights.width, heights.height}, tks_sample_bytes(heights.sample)},
      inputs.image == nullptr ? 1 : 2);
  if (lines.repeats.none()) return lines;
  const Result<std::vector<uint8_t>> valid = findVoids(heights);
  const bool has_voids = !valid.ok() || !valid->empty();
  if (options.psnr > 0 && (has_voids || lines.heaviest > 1.1)) return {};
  if (inputs.budgeted() && lines.codeIsLongFor(options.bytes)) return {};
  return lines;
}

}  // namespace tetrakis::inline heights

// SPDX-License-Identifier: Apache-2.0
#include "encoder/heights/height_lines.hpp"

#include "codec/geometry/quantiser/voids.hpp"
#include "encoder/inputs/repeated_lines.hpp"

namespace tetrakis::inline heights {

namespace {

bool hasVoids(const tks_heights& heights) {
  const Result<std::vector<uint8_t>> valid = findVoids(heights);
  return !valid.ok() || !valid->empty();
}

}  // namespace

CodedLines heightLines(const EncodeInputs& inputs) {
  if (inputs.heights == nullptr) return {};
  const tks_heights& heights = *inputs.heights;
  // Beside a texture cameras look at the coded heights: two lines have an area, one has none.
  const uint32_t least = inputs.image == nullptr ? 1 : 2;
  CodedLines lines = linesThatPay(
      inputs.options,
      {heights.data, {heights.width, heights.height}, tks_sample_bytes(heights.sample)}, least);
  if (lines.repeats.none() || inputs.options.psnr == 0) return lines;
  const bool alike = lines.heaviest <= CodedLines::kNearlyAlike && !hasVoids(heights);
  return alike ? lines : CodedLines();
}

}  // namespace tetrakis::inline heights

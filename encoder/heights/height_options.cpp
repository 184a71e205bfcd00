// SPDX-License-Identifier: Apache-2.0
// heightOptions() and heightLines() settle, from the options of an encoding, how the coefficients
// of its heights are coded and which of their lines: both come before the heights are quantised.
#include "encoder/heights/quantised_heights.hpp"

#include <cassert>

#include "codec/geometry/quantiser/height_steps.hpp"
#include "encoder/inputs/encode_inputs.hpp"

namespace tetrakis::inline heights {

CoefficientOptions heightOptions(const EncodeInputs& inputs) {
  assert(inputs.heights != nullptr);
  const tks_encode_options& options = inputs.options;
  const Extent extent = extentOf(*inputs.heights);
  const bool large = extent.samples() > kOneRegionHeights;
  const RegionChoice regions = chooseRegions(options, extent, large, patchesOf(*inputs.heights));
  const Priorities* const priorities = inputs.priorities;
  const bool some_first = priorities != nullptr && !priorities->heights.empty();
  return {.limit = limitOf(inputs),
          .region_log2 = regions.side_log2,
          .threads = options.threads,
          .windows = regions.windows,
          .priorities = some_first ? &priorities->heights : nullptr};
}

namespace {

bool hasVoids(const tks_heights& heights) {
  const Result<std::vector<uint8_t>> valid = findVoids(heights);
  return !valid.ok() || !valid->empty();
}

}  // namespace

CodedLines heightLines(const EncodeInputs& inputs) {
  if (inputs.heights == nullptr || inputs.heights->domain == TKS_DOMAIN_FOREST) return {};
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

// SPDX-License-Identifier: Apache-2.0
#include "encoder/heights/height_options.hpp"

#include <cassert>

#include "codec/geometry/quantiser/height_steps.hpp"
#include "encoder/inputs/region_choice.hpp"

namespace tetrakis::inline heights {

CoefficientOptions heightOptions(const EncodeInputs& inputs) {
  assert(inputs.heights != nullptr);
  const tks_encode_options& options = inputs.options;
  const Extent extent = extentOf(*inputs.heights);
  const bool large = extent.samples() > kOneRegionHeights;
  const RegionChoice regions = chooseRegions(options, extent, large);
  const ViewPriorities* const priorities = inputs.priorities;
  const bool some_first = priorities != nullptr && !priorities->heights.empty();
  return {.limit = limitOf(inputs),
          .region_log2 = regions.side_log2,
          .threads = options.threads,
          .windows = regions.windows,
          .priorities = some_first ? &priorities->heights : nullptr};
}

}  // namespace tetrakis::inline heights

// SPDX-License-Identifier: Apache-2.0
#include "encoder/inputs/region_choice.hpp"

#include <bit>

#include "bitstream/track/regions.hpp"

namespace tetrakis::inline inputs {

namespace {

/// Sides of regions: they cost 1 to 3 % of the bytes (docs/MEASUREMENTS.md, "Windows"). Smaller
/// regions cost more bytes, and windows need fewer.
constexpr int kRegionLog2 = 9;
/// Sides of regions in streams made for windows: they cost as much again, and a window of 512 takes
/// a third less.
constexpr int kWindowRegionLog2 = 8;

/// 0: one region.
int wantedLog2(const tks_encode_options& options, bool large) {
  if (options.regions > 1) return std::countr_zero(options.regions);
  if (options.index == TKS_INDEX_WINDOWS) return kWindowRegionLog2;
  return options.regions == 1 || !large ? 0 : kRegionLog2;
}

}  // namespace

RegionChoice chooseRegions(const tks_encode_options& options, Extent plane, bool large) {
  const int log2 = wantedLog2(options, large);
  if (regionCount(plane.width, plane.height, log2) <= 1) return {};
  return {log2, options.index == TKS_INDEX_WINDOWS};
}

}  // namespace tetrakis::inline inputs

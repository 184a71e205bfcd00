// SPDX-License-Identifier: Apache-2.0
#include "encoder/inputs/encode_inputs.hpp"

#include <bit>
#include <cmath>

#include "base/portable_math.hpp"
#include "bitstream/track/track.hpp"

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

RegionChoice chooseRegions(const tks_encode_options& options, Extent plane, bool large,
                           uint32_t patches) {
  const int log2 = wantedLog2(options, large);
  if (regionCount(plane.width, plane.height, log2, patches) <= 1) return {};
  return {log2, options.index == TKS_INDEX_WINDOWS};
}

namespace {

/// Bytes that each component codes behind the budget, or behind its part of it. More bytes show the
/// slopes behind the end of small budgets, and take time.
constexpr uint64_t kMargin = 4096;
/// The part of a budget that two components code beyond it; one component codes twice the budget. A
/// larger part takes time; with a smaller one the order of packets depends more on the budget.
constexpr uint64_t kSharedPart = 4;

}  // namespace

Purpose purposeOf(const EncodeInputs& inputs) {
  return inputs.options.lossless != 0 ? Purpose::kLossless : Purpose::kLossy;
}

uint64_t limitOf(const EncodeInputs& inputs) {
  const uint64_t budget = inputs.options.bytes;
  if (!inputs.budgeted() || budget >= UINT64_MAX / 4) return UINT64_MAX;
  const bool shared = inputs.heights != nullptr && inputs.image != nullptr;
  return budget + (shared ? budget / kSharedPart : budget) + kMargin;
}

double worstMeanSquare(double peak, double psnr) {
  return peak * peak / portable::pow(10, psnr / 10);
}

}  // namespace tetrakis::inline inputs

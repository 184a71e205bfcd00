// SPDX-License-Identifier: Apache-2.0
#include "encoder/inputs/encode_inputs.hpp"

#include <bit>
#include <cassert>
#include <cmath>

#include "bitstream/track/regions.hpp"

namespace tetrakis::inline inputs {

namespace {

/// Sides of regions, chosen so that they cost about 1 % of the bytes (docs/ARCHITECTURE.md).
constexpr int kRegionLog2 = 9;
/// Sides of regions in streams made for windows: they cost as much again, and a window of 512 takes
/// a third less.
constexpr int kWindowRegionLog2 = 8;
constexpr uint64_t kOneRegionTexels = 2048 * 2048;

/// 0: one region.
int regionLog2(uint32_t width, uint32_t height, const tks_encode_options& options, bool automatic) {
  const int chosen = options.index == TKS_INDEX_WINDOWS ? kWindowRegionLog2 : kRegionLog2;
  const int log2 = options.regions > 1                 ? std::countr_zero(options.regions)
                   : options.regions == 0 && automatic ? chosen
                                                       : 0;
  return regionCount(width, height, log2) > 1 ? log2 : 0;
}

bool readByWindows(const tks_encode_options& options, int region_log2) {
  return options.index == TKS_INDEX_WINDOWS && region_log2 > 0;
}

/// Bytes worth coding: beyond the budget, because the slopes of the last packets within it depend
/// on the points that follow, and the order should hardly depend on the budget. Two components
/// share it: either gets less, and has as much more behind it.
uint64_t limitOf(const EncodeInputs& inputs) {
  constexpr uint64_t kMargin = 4096;
  const uint64_t budget = inputs.options.bytes;
  if (!inputs.budgeted() || budget >= UINT64_MAX / 4) return UINT64_MAX;
  const bool shared = inputs.heights != nullptr && inputs.image != nullptr;
  return budget + (shared ? budget / 4 : budget) + kMargin;
}

}  // namespace

Purpose purposeOf(const EncodeInputs& inputs) {
  return inputs.options.lossless != 0 ? Purpose::kLossless : Purpose::kLossy;
}

/// Corrections to a largest error lie behind all coefficients: no window of them can be decoded
/// alone.
CoefficientOptions heightOptions(const EncodeInputs& inputs) {
  assert(inputs.heights != nullptr);
  const tks_heights* const heights = inputs.heights;
  const tks_encode_options& options = inputs.options;
  const ViewPriorities* const priorities = inputs.priorities;
  const bool large = uint64_t{heights->width} * heights->height > kOneRegionHeights;
  CoefficientOptions coefficients{
      limitOf(inputs),
      regionLog2(heights->width, heights->height, options, large && options.max_error == 0),
      options.threads};
  coefficients.windows = readByWindows(options, coefficients.region_log2);
  if (priorities != nullptr && !priorities->heights.empty())
    coefficients.priorities = &priorities->heights;
  return coefficients;
}

TextureOptions textureOptions(const EncodeInputs& inputs, const Texels& texels) {
  const tks_encode_options& options = inputs.options;
  const bool large = uint64_t{texels.width} * texels.height > kOneRegionTexels;
  TextureOptions texture;
  texture.limit = limitOf(inputs);
  texture.region_log2 = regionLog2(texels.width, texels.height, options, large);
  texture.threads = options.threads;
  texture.windows = readByWindows(options, texture.region_log2);
  texture.visual = options.weights == TKS_WEIGHTS_VISUAL;
  if (inputs.budgeted()) texture.room = options.bytes;
  if (inputs.priorities != nullptr && !inputs.priorities->texture.empty())
    texture.priorities = &inputs.priorities->texture;
  if (options.psnr > 0) texture.mean_square = worstMeanSquare(texels.most(), options.psnr);
  return texture;
}

double worstMeanSquare(double peak, double psnr) {
  return peak * peak / std::pow(10, psnr / 10);
}

Status reportProgress(const tks_encode_options& options, double done) {
  assert(done >= 0 && done <= 1);
  if (options.progress == nullptr || options.progress(options.user, done) == 0) return {};
  return {TKS_USAGE, "Encoding was stopped by the caller."};
}

}  // namespace tetrakis::inline inputs

// SPDX-License-Identifier: Apache-2.0
#include "wavelet/mip_level.hpp"

#include <algorithm>
#include <cassert>

namespace tetrakis {

MipLevel::MipLevel(uint32_t width, uint32_t height, int level) : level_(level) {
  const std::vector<Extent> extents = lowExtents(width, height);
  assert(level >= 0 && static_cast<size_t>(level) < extents.size());
  low_ = extents[static_cast<size_t>(level)];
  for (size_t l = 1; l <= static_cast<size_t>(level); ++l) {
    splits_x_ += extents[l].width < extents[l - 1].width;
    splits_y_ += extents[l].height < extents[l - 1].height;
  }
  size_ = {((width - 1) >> level) + 1, ((height - 1) >> level) + 1};
}

int MipLevel::coarsestLevel(uint32_t width, uint32_t height) {
  return static_cast<int>(lowExtents(width, height).size()) - 1;
}

WaveletSpec MipLevel::transform(const WaveletSpec& whole) const {
  WaveletSpec spec = whole;
  spec.finer_levels += level_;
  return spec;
}

void MipLevel::dropFiner(std::span<const BandPart> parts, std::span<BandPlan> bands) const {
  const size_t kept = subbandsOf(low_.width, low_.height).size();
  for (size_t i = 0; i < bands.size(); ++i) bands[i].needed = parts[i].subband < kept;
}

std::vector<uint8_t> MipLevel::maskOf(Validity valid, uint32_t width) const {
  std::vector<uint8_t> mask;
  if (splits_x_ == 0 && splits_y_ == 0) return {valid.begin(), valid.end()};
  if (valid.empty()) return mask;
  assert(valid.size() % width == 0);
  mask.reserve(size_t{low_.width} * low_.height);
  for (uint32_t y = 0; y < low_.height; ++y) {
    const uint8_t* row = valid.data() + (size_t{y} << splits_y_) * width;
    for (uint32_t x = 0; x < low_.width; ++x) mask.push_back(row[size_t{x} << splits_x_]);
  }
  return mask;
}

void MipLevel::normalise(const WaveletSpec& whole, std::span<int32_t> low) const {
  constexpr int kShift = 30;
  int64_t weight = int64_t{1} << kShift;
  int halvings = 0;
  for (int l = 1; l <= level_; ++l) {
    const int splits = (l <= splits_x_) + (l <= splits_y_);
    for (int i = 0; i < splits; ++i) {
      weight = (weight * inverseGain(whole.filter(l)) + (int64_t{1} << (kShift - 1))) >> kShift;
    }
    halvings += whole.doubles(l);
  }
  const int shift = kShift + halvings;
  if (weight == int64_t{1} << shift) return;
  const int64_t half = int64_t{1} << (shift - 1);
  for (int32_t& v : low) v = static_cast<int32_t>((v * weight + half) >> shift);
}

}  // namespace tetrakis

// SPDX-License-Identifier: Apache-2.0
// The order of the levels.
#include "wavelet/wavelet.hpp"

#include <algorithm>
#include <cassert>

#include "wavelet/lifting.hpp"

namespace tetrakis {

namespace {

bool isDoubled(const WaveletSpec& spec, size_t level) {
  return spec.doubled && std::find(kDoubledLevels.begin(), kDoubledLevels.end(),
                                   static_cast<int>(level)) != kDoubledLevels.end();
}

/// The low band that a level starts from, in place: rows 2^splits_y apart, columns together.
struct LowBand {
  int32_t* plane;
  size_t stride;
  Extent extent;
  int splits_y;

  RowSet rows() const { return {plane, stride << splits_y, extent.height, extent.width}; }
  std::span<int32_t> row(uint32_t y) const {
    return {plane + (size_t{y} << splits_y) * stride, extent.width};
  }
};

void doubleValues(const LowBand& low) {
  for (uint32_t y = 0; y < low.extent.height; ++y) {
    for (int32_t& v : low.row(y)) v = static_cast<int32_t>(static_cast<uint32_t>(v) << 1);
  }
}

void halveValues(const LowBand& low) {
  for (uint32_t y = 0; y < low.extent.height; ++y) {
    for (int32_t& v : low.row(y)) v = static_cast<int32_t>(static_cast<uint32_t>(v) + 1) >> 1;
  }
}

/// [l]: the low band after l levels.
std::vector<LowBand> lowBands(std::span<int32_t> plane, uint32_t width, uint32_t height) {
  std::vector<LowBand> bands;
  int splits_y = 0;
  for (const Extent& extent : lowExtents(width, height)) {
    splits_y += !bands.empty() && extent.height < bands.back().extent.height;
    bands.push_back({plane.data(), width, extent, splits_y});
  }
  return bands;
}

}  // namespace

void forwardWavelet(const WaveletSpec& spec, std::span<int32_t> plane, uint32_t width,
                    uint32_t height) {
  assert(plane.size() == size_t{width} * height && width > 0 && height > 0);
  const std::vector<LowBand> bands = lowBands(plane, width, height);
  RowLifting lifting(width);
  for (size_t l = 1; l < bands.size(); ++l) {
    const LowBand &whole = bands[l - 1], &low = bands[l];
    const FilterId filter = spec.filter(static_cast<int>(l));
    const bool wide = spec.wide(static_cast<int>(l));
    if (low.extent.width < whole.extent.width) {
      for (uint32_t y = 0; y < whole.extent.height; ++y)
        lifting.analyse(whole.row(y).data(), whole.extent.width, filter, wide);
    }
    if (low.extent.height < whole.extent.height)
      liftColumns(whole.rows(), filter, Direction::kAnalysis, wide);
    if (isDoubled(spec, l)) doubleValues(low);
  }
}

void inverseWavelet(const WaveletSpec& spec, std::span<int32_t> plane, uint32_t width,
                    uint32_t height) {
  assert(plane.size() == size_t{width} * height && width > 0 && height > 0);
  const std::vector<LowBand> bands = lowBands(plane, width, height);
  RowLifting lifting(width);
  for (size_t l = bands.size() - 1; l >= 1; --l) {
    const LowBand &whole = bands[l - 1], &low = bands[l];
    const FilterId filter = spec.filter(static_cast<int>(l));
    const bool wide = spec.wide(static_cast<int>(l));
    if (isDoubled(spec, l)) halveValues(low);
    if (low.extent.height < whole.extent.height)
      liftColumns(whole.rows(), filter, Direction::kSynthesis, wide);
    if (low.extent.width < whole.extent.width) {
      for (uint32_t y = 0; y < whole.extent.height; ++y)
        lifting.synthesise(whole.row(y).data(), whole.extent.width, filter, wide);
    }
  }
}

}  // namespace tetrakis

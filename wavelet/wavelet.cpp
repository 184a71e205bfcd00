// SPDX-License-Identifier: Apache-2.0
// The order of the levels.
#include "wavelet/wavelet.hpp"

#include <cassert>

#include "wavelet/lifting.hpp"

namespace tetrakis {

namespace {

/// The low band that a level starts from, in place: rows 2^splits_y apart, columns together.
struct LowBand {
  int32_t* plane;
  size_t stride;
  Extent extent;
  int splits_x, splits_y;

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
  int splits_x = 0, splits_y = 0;
  for (const Extent& extent : lowExtents(width, height)) {
    splits_x += !bands.empty() && extent.width < bands.back().extent.width;
    splits_y += !bands.empty() && extent.height < bands.back().extent.height;
    bands.push_back({plane.data(), width, extent, splits_x, splits_y});
  }
  return bands;
}

/// One level of the transform: rows, then columns; backwards the other way round.
class LevelTransform {
 public:
  LevelTransform(const WaveletSpec& spec, Validity valid, uint32_t plane_width)
      : spec_(spec), valid_(valid), plane_width_(plane_width), row_(plane_width) {}

  void run(int level, const LowBand& whole, const LowBand& low, Direction direction) {
    const FilterId id = spec_.filter(level);
    const bool wide = spec_.wide(level), analysis = direction == Direction::kAnalysis;
    const bool rows = low.extent.width < whole.extent.width;
    const bool columns = low.extent.height < whole.extent.height;
    if (rows && analysis) liftRows(whole, id, direction, wide);
    if (columns) {
      if (valid_.empty()) {
        liftColumns(whole.rows(), id, direction, wide);
      } else {
        masked(whole).liftColumns(id, direction, wide, rows);
      }
    }
    if (rows && !analysis) liftRows(whole, id, direction, wide);
  }

 private:
  void liftRows(const LowBand& whole, FilterId id, Direction direction, bool wide) {
    if (!valid_.empty()) return masked(whole).liftRows(row_, id, direction, wide);
    for (uint32_t y = 0; y < whole.extent.height; ++y) {
      const std::span<int32_t> row = whole.row(y);
      direction == Direction::kAnalysis ? row_.analyse(row.data(), whole.extent.width, id, wide)
                                        : row_.synthesise(row.data(), whole.extent.width, id, wide);
    }
  }
  MaskedLifting masked(const LowBand& whole) const {
    return {valid_, plane_width_, whole.rows(), whole.splits_x, whole.splits_y};
  }

  const WaveletSpec& spec_;
  Validity valid_;
  uint32_t plane_width_;
  RowLifting row_;
};

}  // namespace

void forwardWavelet(const WaveletSpec& spec, std::span<int32_t> plane, uint32_t width,
                    uint32_t height, Validity valid) {
  assert(plane.size() == size_t{width} * height && width > 0 && height > 0);
  const std::vector<LowBand> bands = lowBands(plane, width, height);
  LevelTransform transform(spec, valid, width);
  for (size_t l = 1; l < bands.size(); ++l) {
    transform.run(static_cast<int>(l), bands[l - 1], bands[l], Direction::kAnalysis);
    if (spec.doubles(static_cast<int>(l))) doubleValues(bands[l]);
  }
}

void inverseWavelet(const WaveletSpec& spec, std::span<int32_t> plane, uint32_t width,
                    uint32_t height, Validity valid) {
  assert(plane.size() == size_t{width} * height && width > 0 && height > 0);
  const std::vector<LowBand> bands = lowBands(plane, width, height);
  LevelTransform transform(spec, valid, width);
  for (size_t l = bands.size() - 1; l >= 1; --l) {
    if (spec.doubles(static_cast<int>(l))) halveValues(bands[l]);
    transform.run(static_cast<int>(l), bands[l - 1], bands[l], Direction::kSynthesis);
  }
}

}  // namespace tetrakis

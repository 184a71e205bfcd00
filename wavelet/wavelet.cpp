// SPDX-License-Identifier: Apache-2.0
// The order of the levels.
#include "wavelet/wavelet.hpp"

#include <cassert>
#include <functional>
#include <optional>
#include <vector>

#include "base/parallel.hpp"
#include "wavelet/lifting.hpp"
#include "wavelet/masked_lifting.hpp"

namespace tetrakis {

namespace {

/// The low band that a level starts from, in place: rows 2^splits_y apart, columns together.
struct LowBand {
  int32_t* plane;
  size_t stride;
  Extent extent;
  int splits_x, splits_y;

  Rows<int32_t> rows() const { return {plane, stride << splits_y, extent.height, extent.width}; }
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
    for (int32_t& v : low.row(y)) v = halved(v);
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

/// Which samples of a low band exist, where their values lie: of rows that are split, those of the
/// low half come first.
class LevelMask {
 public:
  /// valid: of the whole plane.
  LevelMask(Validity valid, uint32_t plane_width, const LowBand& band, bool split_rows)
      : width_(band.extent.width), height_(band.extent.height), mask_(size_t{width_} * height_) {
    const uint32_t lows = split_rows ? width_ - width_ / 2 : width_;
    const uint32_t pitch = (split_rows ? 2u : 1u) << band.splits_x;
    uint8_t* to = mask_.data();
    for (uint32_t y = 0; y < height_; ++y) {
      const uint8_t* row = valid.data() + (size_t{y} << band.splits_y) * plane_width;
      for (uint32_t x = 0; x < lows; ++x) *to++ = row[size_t{x} * pitch];
      for (uint32_t x = 0; x < width_ - lows; ++x) *to++ = row[size_t{x} * pitch + pitch / 2];
    }
  }

  const uint8_t* row(uint32_t y) const { return mask_.data() + size_t{y} * width_; }
  Rows<const uint8_t> columns(uint32_t begin, uint32_t end) const {
    return {mask_.data() + begin, width_, height_, end - begin};
  }

 private:
  uint32_t width_, height_;
  std::vector<uint8_t> mask_;
};

/// One level of the transform: rows, then columns; backwards the other way round.
class LevelTransform {
 public:
  LevelTransform(const WaveletSpec& spec, Validity valid, uint32_t plane_width, uint32_t threads)
      : spec_(spec), valid_(valid), plane_width_(plane_width), threads_(threads) {}

  void run(int level, const LowBand& whole, const LowBand& low, Direction direction) {
    const bool rows = low.extent.width < whole.extent.width;
    const bool columns = low.extent.height < whole.extent.height;
    std::optional<LevelMask> mask;
    if (!valid_.empty()) mask.emplace(valid_, plane_width_, whole, rows);
    const Lifting lifting{spec_.filter(level), direction, spec_.wide(level), mask};
    const bool analysis = direction == Direction::kAnalysis;
    if (rows && analysis) liftRows(whole, lifting);
    if (columns) liftColumns(whole, lifting);
    if (rows && !analysis) liftRows(whole, lifting);
  }

 private:
  /// Rows or columns that a thread takes at a time.
  static constexpr uint32_t kChunk = 256;

  struct Lifting {
    FilterId id;
    Direction direction;
    bool wide;
    const std::optional<LevelMask>& mask;
  };

  void liftRows(const LowBand& whole, const Lifting& lifting) {
    const uint32_t width = whole.extent.width;
    const bool analysis = lifting.direction == Direction::kAnalysis;
    inChunks(whole.extent.height, [&](uint32_t begin, uint32_t end) {
      if (lifting.mask) {
        MaskedRowLifting masked(width);
        for (uint32_t y = begin; y < end; ++y) {
          int32_t* row = whole.row(y).data();
          const uint8_t* valid = lifting.mask->row(y);
          analysis ? masked.analyse(row, valid, width, lifting.id)
                   : masked.synthesise(row, valid, width, lifting.id);
        }
        return;
      }
      RowLifting plain(width);
      for (uint32_t y = begin; y < end; ++y) {
        int32_t* row = whole.row(y).data();
        analysis ? plain.analyse(row, width, lifting.id, lifting.wide)
                 : plain.synthesise(row, width, lifting.id, lifting.wide);
      }
    });
  }
  void liftColumns(const LowBand& whole, const Lifting& lifting) {
    const Rows<int32_t> rows = whole.rows();
    inChunks(rows.width, [&](uint32_t begin, uint32_t end) {
      const Rows<int32_t> part{rows.first + begin, rows.pitch, rows.count, end - begin};
      if (lifting.mask) {
        liftMaskedColumns(part, lifting.mask->columns(begin, end), lifting.id, lifting.direction);
      } else {
        tetrakis::liftColumns(part, lifting.id, lifting.direction, lifting.wide);
      }
    });
  }
  void inChunks(uint32_t count, const std::function<void(uint32_t, uint32_t)>& lift) {
    const uint32_t chunk = threads_ > 1 ? kChunk : count;
    parallelFor(threads_, (count + chunk - 1) / chunk, [&](size_t i) {
      const auto begin = static_cast<uint32_t>(i) * chunk;
      lift(begin, std::min(count, begin + chunk));
    });
  }

  const WaveletSpec& spec_;
  Validity valid_;
  uint32_t plane_width_, threads_;
};

}  // namespace

int32_t halved(int32_t value) {
  return static_cast<int32_t>(static_cast<uint32_t>(value) + 1) >> 1;
}

void inverseLevel(const WaveletSpec& spec, int level, std::span<int32_t> block, Extent whole,
                  Extent low, Validity valid) {
  const LowBand whole_band{block.data(), whole.width, whole, 0, 0};
  const LowBand low_band{block.data(), whole.width, low, low.width < whole.width,
                         low.height < whole.height};
  LevelTransform(spec, valid, whole.width, 1)
      .run(level, whole_band, low_band, Direction::kSynthesis);
}

void forwardWavelet(const WaveletSpec& spec, std::span<int32_t> plane, uint32_t width,
                    uint32_t height, Validity valid, uint32_t threads) {
  assert(plane.size() == size_t{width} * height && width > 0 && height > 0);
  const std::vector<LowBand> bands = lowBands(plane, width, height);
  LevelTransform transform(spec, valid, width, threads);
  for (size_t l = 1; l < bands.size(); ++l) {
    transform.run(static_cast<int>(l), bands[l - 1], bands[l], Direction::kAnalysis);
    if (spec.doubles(static_cast<int>(l))) doubleValues(bands[l]);
  }
}

void inverseWavelet(const WaveletSpec& spec, std::span<int32_t> plane, uint32_t width,
                    uint32_t height, Validity valid, uint32_t threads) {
  assert(plane.size() == size_t{width} * height && width > 0 && height > 0);
  const std::vector<LowBand> bands = lowBands(plane, width, height);
  LevelTransform transform(spec, valid, width, threads);
  for (size_t l = bands.size() - 1; l >= 1; --l) {
    if (spec.doubles(static_cast<int>(l))) halveValues(bands[l]);
    transform.run(static_cast<int>(l), bands[l - 1], bands[l], Direction::kSynthesis);
  }
}

}  // namespace tetrakis

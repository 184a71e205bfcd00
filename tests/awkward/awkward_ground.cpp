// SPDX-License-Identifier: Apache-2.0
#include "tests/awkward/awkward_ground.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

#include "conformance/samples/facets.hpp"
#include "conformance/samples/offset_heights.hpp"

namespace tetrakis::test {

double scaled(tks_sample sample, double ground) {
  switch (sample) {
    case TKS_U8:
      return std::floor(ground / 256);
    case TKS_I8:
      return std::floor(ground / 256) - 128;
    case TKS_I16:
      return std::floor(ground / 16) - 500;
    case TKS_I32:
    case TKS_U32:
      return ground * 11;
    case TKS_U16:
    case TKS_F32:
      break;
  }
  return std::floor(ground / 8);
}

Bounds boundsOf(tks_sample sample) {
  switch (sample) {
    case TKS_U8:
      return {0, 255};
    case TKS_I8:
      return {-128, 127};
    case TKS_U16:
      return {0, 65535};
    case TKS_I16:
      return {-32768, 32767};
    case TKS_U32:
      return {0, 4294967295.0};
    case TKS_I32:
      return {-2147483648.0, 2147483647.0};
    case TKS_F32:
      break;
  }
  return {-double{std::numeric_limits<float>::max()}, double{std::numeric_limits<float>::max()}};
}

namespace {

/// The heights of one kind, as doubles that the type holds exactly.
class Ground {
 public:
  Ground(Dice& dice, Kind kind, tks_sample sample, uint32_t width, uint32_t height)
      : kind_(kind),
        sample_(sample),
        width_(width),
        seed_(static_cast<uint32_t>(dice.next())),
        level_(dice.below(40000)),
        period_(1 + dice.below(40)),
        odd_(dice.below(width * height)),
        odd_value_(oddValue(dice)) {}

  double at(uint32_t x, uint32_t y) const {
    const double ground = samples::ridges(x, y, seed_);
    switch (kind_) {
      case Kind::kHalfFlat:
        return scaled(sample_, 2 * x > width_ + period_ ? level_ : ground);
      case Kind::kLakes:
        return scaled(sample_, std::max<double>(level_, ground));
      case Kind::kStripes:
        return scaled(sample_, (x / period_ + y / (2 * period_)) % 2 == 0 ? level_ : ground);
      case Kind::kTwoValues:
        return samples::valueNoise(x, y, 4, seed_) < level_ ? boundsOf(sample_).low
                                                            : scaled(sample_, level_);
      case Kind::kChecker:
        return (x ^ y) & 1 ? boundsOf(sample_).high : boundsOf(sample_).low;
      case Kind::kConstant:
        return scaled(sample_, level_);
      case Kind::kOutlier:
        return y * width_ + x == odd_ ? odd_value_ : scaled(sample_, ground);
      case Kind::kNoise:
        return noise(x, y);
      case Kind::kSparse:
        return scaled(sample_, std::floor(ground / 2560) * 2560);
      case Kind::kFeet:
        return sample_ == TKS_F32
                   ? static_cast<double>(static_cast<float>(std::floor(ground / 64) * 0.3048))
                   : scaled(sample_, std::floor(ground / 780) * 780);
      case Kind::kNegativeZeros:
        return sample_ == TKS_F32 && ground < level_ ? -0.0 : scaled(sample_, ground);
      case Kind::kGeoid:
        return above(samples::OffsetKind::kGeoid, x, y, ground);
      case Kind::kSquares:
        return above(samples::OffsetKind::kSquares, x, y, ground);
      case Kind::kMosaic:
        return mosaic(x / 24 + y / 24, ground);
      case Kind::kTurned: {
        const uint32_t u = (5 * x + 2 * y + period_) / 9, v = (5 * y + 2 * (4096 - x)) / 9;
        return scaled(sample_, samples::ridges(u, v, seed_));
      }
      case Kind::kTens: {
        const double whole = scaled(sample_, ground);
        return (x / 32 + y / 32) % 2 == 0 ? whole : std::floor(whole / 10) * 10;
      }
      case Kind::kBands:
        return scaled(sample_, level_ / 2) + std::floor(ground / 13200) * (1 + period_ % 9);
      case Kind::kNarrow:
        return std::floor(ground / 65536 * (1 + period_ % 9));
      case Kind::kFacets:
        return facets(x, y, ground);
      default:
        return scaled(sample_, ground);
    }
  }

 private:
  /// Linear between points, but for a few samples.
  double facets(uint32_t x, uint32_t y, double ground) const {
    const double linear = samples::facetAt(x, y, 3.7 + period_ % 40, seed_);
    if (sample_ != TKS_F32 || ground < 2000) return scaled(sample_, ground);
    return static_cast<double>(static_cast<float>(linear - 128));
  }
  /// Whole numbers beside others.
  double mosaic(uint32_t patch, double ground) const {
    const double whole = scaled(sample_, ground);
    if (sample_ != TKS_F32 || (patch & 1) == 0) return whole;
    return static_cast<double>(static_cast<float>(std::sqrt(ground + 1) * 17));
  }
  double oddValue(Dice& dice) const {
    const Bounds bounds = boundsOf(sample_);
    if (sample_ != TKS_F32) return dice.once(2) ? bounds.low : bounds.high;
    constexpr std::array<double, 5> kValues = {1e-42, 0.37, -3e10, 1e30, -0.0};
    const uint32_t which = dice.below(7);
    return which < 5    ? static_cast<double>(static_cast<float>(kValues[which]))
           : which == 5 ? bounds.low
                        : bounds.high;
  }

  /// Whole steps above an offset that is none.
  double above(samples::OffsetKind kind, uint32_t x, uint32_t y, double ground) const {
    if (sample_ != TKS_F32) return scaled(sample_, ground);
    const double steps = std::floor(ground / (1 + level_ % 64));
    return static_cast<float>(samples::offsetAt(kind, x, y, width_) +
                              samples::stepOf(kind) * steps);
  }

  double noise(uint32_t x, uint32_t y) const {
    const uint32_t bits = samples::hash(x, y, seed_);
    if (sample_ != TKS_F32)
      return boundsOf(sample_).low +
             std::fmod(bits, boundsOf(sample_).high - boundsOf(sample_).low + 1);
    const auto value = std::bit_cast<float>(bits);
    return std::isfinite(value) ? static_cast<double>(value) : 1.0;
  }

  Kind kind_;
  tks_sample sample_;
  uint32_t width_, seed_, level_, period_, odd_;
  double odd_value_;
};

template <class T>
void store(std::vector<std::byte>& data, size_t i, double value) {
  const T sample = static_cast<T>(value);
  std::memcpy(data.data() + i * sizeof sample, &sample, sizeof sample);
}

}  // namespace

void storeSample(samples::Raster& raster, size_t i, double value) {
  switch (raster.sample) {
    case TKS_U8:
      return store<uint8_t>(raster.data, i, value);
    case TKS_I8:
      return store<int8_t>(raster.data, i, value);
    case TKS_U16:
      return store<uint16_t>(raster.data, i, value);
    case TKS_I16:
      return store<int16_t>(raster.data, i, value);
    case TKS_U32:
      return store<uint32_t>(raster.data, i, value);
    case TKS_I32:
      return store<int32_t>(raster.data, i, value);
    case TKS_F32:
      return store<float>(raster.data, i, value);
  }
}

samples::Raster groundOf(Dice& dice, Kind kind, uint32_t width, uint32_t height) {
  constexpr std::array<tks_sample, 9> kTypes = {TKS_U8,  TKS_I8,  TKS_U16, TKS_I16, TKS_I16,
                                                TKS_U32, TKS_I32, TKS_F32, TKS_F32};
  samples::Raster raster{width, height, 1, dice.of(kTypes), {}};
  raster.data.resize(size_t{width} * height * tks_sample_bytes(raster.sample));
  const Ground ground(dice, kind, raster.sample, width, height);
  for (uint32_t y = 0; y < height; ++y) {
    for (uint32_t x = 0; x < width; ++x)
      storeSample(raster, size_t{y} * width + x, ground.at(x, y));
  }
  return raster;
}

}  // namespace tetrakis::test

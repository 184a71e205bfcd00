// SPDX-License-Identifier: Apache-2.0
#include "tests/awkward/awkward_case.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <vector>

#include "conformance/samples/facets.hpp"
#include "conformance/samples/offset_heights.hpp"

namespace tetrakis::test {

namespace {

/// SplitMix64 (G. L. Steele, D. Lea, C. H. Flood 2014).
class Dice {
 public:
  explicit Dice(uint64_t seed) : state_(seed * 0x9e3779b97f4a7c15u) {}
  uint64_t next() {
    uint64_t z = state_ += 0x9e3779b97f4a7c15u;
    z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
    z = (z ^ z >> 27) * 0x94d049bb133111ebu;
    return z ^ z >> 31;
  }
  uint32_t below(uint32_t n) { return static_cast<uint32_t>(next() % n); }
  bool once(uint32_t in) { return below(in) == 0; }
  template <class T, size_t N>
  T of(const std::array<T, N>& choices) {
    return choices[below(N)];
  }

 private:
  uint64_t state_;
};

/// Around multiples of region sides, tiny, or anything.
uint32_t awkwardSide(Dice& dice, uint32_t most) {
  if (most <= 2) return 2;
  switch (dice.below(4)) {
    case 0:
      return std::min(most, 2 + dice.below(8));
    case 1:
      return 2 + dice.below(most - 1);
    default: {
      const uint32_t border = (1 + dice.below(5)) << (4 + dice.below(5));
      return std::clamp(border + dice.below(4) - 2, 2u, most);
    }
  }
}

enum class Kind {
  kGround,
  kHalfFlat,
  kLakes,
  kStripes,
  kTwoValues,
  kChecker,
  kConstant,
  kOutlier,
  kNoise,
  kSparse,
  kFeet,
  kNegativeZeros,
  kGeoid,
  kSquares,
  kMosaic,
  kTurned,
  kTens,
  kBands,
  kNarrow,
  kFacets,
  kCount
};

constexpr std::array<const char*, static_cast<size_t>(Kind::kCount)> kKindNames = {
    "ground",  "half flat", "lakes",  "stripes", "two values",     "checker", "constant",
    "outlier", "noise",     "sparse", "feet",    "negative zeros", "geoid",   "squares",
    "mosaic",  "turned",    "tens",   "bands",   "narrow",         "facets"};

/// What a sample type makes of ground whose values are from 0 to 65535.
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

struct Bounds {
  double low, high;
};

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

/// Polygons, single samples or everything become nodata or NaN.
void punch(Dice& dice, AwkwardCase& c) {
  samples::Raster& raster = c.heights;
  if (dice.once(2)) {
    const Bounds bounds = boundsOf(raster.sample);
    // The last one no integer type holds: it meets no sample.
    const std::array<double, 4> values = {scaled(raster.sample, dice.below(65536)), bounds.low,
                                          raster.sample == TKS_U8 ? 0.0 : bounds.high, -9999.5};
    c.nodata = dice.of(values);
  }
  const bool nan = raster.sample == TKS_F32 && dice.once(2);
  if (!c.nodata && !nan) return;
  const uint32_t seed = static_cast<uint32_t>(dice.next()), share = dice.below(6);
  for (uint32_t y = 0; y < raster.height; ++y) {
    for (uint32_t x = 0; x < raster.width; ++x) {
      const bool hole = share < 3    ? samples::valueNoise(x, y, 3 + share, seed) < 20000 * share
                        : share == 3 ? samples::hash(x, y, seed) % 10 != 0
                                     : samples::hash(x, y, seed) % 64 == 0;
      const bool held = raster.sample == TKS_F32 || *c.nodata != -9999.5;
      if (!hole || !held) continue;
      storeSample(raster, size_t{y} * raster.width + x,
                  nan ? std::numeric_limits<double>::quiet_NaN() : *c.nodata);
    }
  }
}

std::string aim(Dice& dice, AwkwardCase& c) {
  tks_encode_options& o = c.options;
  o.size = sizeof o;
  const uint32_t target = dice.below(5);
  if (target <= 1) {
    o.lossless = 1;
    return "lossless";
  }
  if (target == 2) {
    o.bytes = 100 + dice.below(static_cast<uint32_t>(c.heights.data.size()) + 400);
    return "bytes " + std::to_string(o.bytes);
  }
  if (target == 3) {
    o.psnr = 5 + dice.below(120);
    return "psnr " + std::to_string(o.psnr);
  }
  constexpr std::array<double, 8> kBounds = {1e-5, 0.001, 0.3, 0.5, 1, 1.6, 21, 700};
  o.max_error = dice.of(kBounds);
  return "max_error " + std::to_string(o.max_error);
}

void addTexture(Dice& dice, AwkwardCase& c, uint32_t most_samples) {
  samples::Recipe recipe;
  recipe.pattern = static_cast<samples::Pattern>(dice.below(6));
  recipe.width = awkwardSide(dice, 130);
  recipe.height = awkwardSide(dice, std::max(2u, std::min(130u, most_samples / recipe.width)));
  recipe.channels = 1 + dice.below(4);
  recipe.sample = dice.once(4) ? TKS_U16 : TKS_U8;
  recipe.seed = static_cast<uint32_t>(dice.next());
  c.texture = samples::make(recipe);
}

}  // namespace

tks_heights AwkwardCase::input() const {
  tks_heights h = heights.heights();
  h.has_nodata = nodata.has_value();
  h.nodata = nodata.value_or(0);
  h.domain = domain;
  return h;
}

AwkwardCase awkwardCase(uint64_t seed, uint32_t most_samples) {
  Dice dice(seed);
  AwkwardCase c;
  const uint32_t width = awkwardSide(dice, std::min(most_samples / 2, 1500u));
  const uint32_t rows = awkwardSide(dice, std::max(2u, std::min(most_samples / width, 1500u)));
  const uint32_t height = dice.once(12) ? 1 : rows;
  const auto kind = static_cast<Kind>(dice.below(static_cast<uint32_t>(Kind::kCount)));
  c.heights =
      dice.once(2) ? groundOf(dice, kind, width, height) : groundOf(dice, kind, height, width);
  if (dice.once(3)) punch(dice, c);
  const std::string target = aim(dice, c);
  constexpr std::array<uint32_t, 6> kRegions = {0, 1, 16, 16, 32, 64};
  c.options.regions = dice.of(kRegions);
  c.options.threads = 1 + dice.below(2);
  c.options.index = dice.once(4);
  c.options.triangles = dice.once(8) ? 1 + dice.below(500) : 0;
  if (dice.once(4)) addTexture(dice, c, most_samples);
  if (dice.once(4)) c.domain = TKS_DOMAIN_CYLINDER;
  c.description = std::string(kKindNames[static_cast<size_t>(kind)]) + ", type " +
                  std::to_string(c.heights.sample) + ", " + std::to_string(c.heights.width) +
                  " x " + std::to_string(c.heights.height) + ", " + target + ", regions " +
                  std::to_string(c.options.regions) +
                  (c.nodata ? ", nodata " + std::to_string(*c.nodata) : "") +
                  (c.texture ? ", texture " + std::to_string(c.texture->width) + " x " +
                                   std::to_string(c.texture->height)
                             : "") +
                  (c.domain == TKS_DOMAIN_CYLINDER ? ", cylinder" : "");
  return c;
}

}  // namespace tetrakis::test

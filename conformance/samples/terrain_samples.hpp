// SPDX-License-Identifier: Apache-2.0
// make() makes small deterministic surfaces and images for tests and conformance vectors. It
// computes with integers only, so that every compiler and machine makes the same samples.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

#include "tetrakis/tetrakis.h"

namespace tetrakis::samples {

enum class Pattern {
  kFlat,     ///< one value
  kRamp,     ///< a tilted plane
  kRidges,   ///< ridged multifractal: terrain, or the luma of an aerial photograph
  kHills,    ///< smooth hills: cubics of 32 samples
  kSteps,    ///< terraces with vertical walls
  kChecker,  ///< the highest frequency, full range
  kExtreme,  ///< noise over the whole range, half of it at the type's two ends
  kNoise     ///< every value is as likely as any other
};

/// width * height * channels samples, row by row, interleaved, tightly packed, host byte order.
struct Raster {
  uint32_t width = 0, height = 0, channels = 1;
  tks_sample sample = TKS_U8;
  std::vector<std::byte> data;
  bool opaque = false;  ///< of an image

  tks_heights heights() const {
    tks_heights h = {};
    h.size = sizeof h;
    h.width = width;
    h.height = height;
    h.sample = sample;
    h.data = data.data();
    h.scale = 1;
    return h;
  }
  tks_image image() const {
    tks_image i = {};
    i.size = sizeof i;
    i.width = width;
    i.height = height;
    i.channels = channels;
    i.sample = sample;
    i.data = data.data();
    i.opaque = opaque;
    return i;
  }
};

/// What to make. Heights have one channel; the channels of an image are correlated, as colours are.
struct Recipe {
  Pattern pattern = Pattern::kRidges;
  uint32_t width = 0, height = 0, channels = 1;
  tks_sample sample = TKS_U8;
  uint32_t seed = 1;
};

/// Avalanche hash of three words (finaliser of MurmurHash3).
inline uint32_t hash(uint32_t x, uint32_t y, uint32_t seed) {
  uint32_t h = seed * 0x9e3779b1u ^ x * 0x85ebca6bu ^ y * 0xc2b2ae35u;
  h = (h ^ h >> 16) * 0x85ebca6bu;
  h = (h ^ h >> 13) * 0xc2b2ae35u;
  return h ^ h >> 16;
}

/// Value noise in 0...65535 on a lattice of 2^shift samples, bilinear with smoothstep weights.
inline uint32_t valueNoise(uint32_t x, uint32_t y, uint32_t shift, uint32_t seed) {
  const auto smooth = [shift](uint32_t v) {
    const uint64_t t = (uint64_t{v} & ((1u << shift) - 1)) << (16 - shift);  // 16-bit fraction
    return t * t / 65536 * (3 * 65536 - 2 * t) / 65536;
  };
  const uint64_t u = smooth(x), v = smooth(y);
  const auto corner = [&](uint32_t dx, uint32_t dy) {
    return uint64_t{hash((x >> shift) + dx, (y >> shift) + dy, seed + shift) >> 16};
  };
  const uint64_t top = (corner(0, 0) * (65536 - u) + corner(1, 0) * u) >> 16;
  const uint64_t bottom = (corner(0, 1) * (65536 - u) + corner(1, 1) * u) >> 16;
  return static_cast<uint32_t>((top * (65536 - v) + bottom * v) >> 16);
}

/// Ridged multifractal in 0...65535: folded noise whose amplitude halves from octave to octave.
inline uint32_t ridges(uint32_t x, uint32_t y, uint32_t seed) {
  uint32_t sum = 0;
  for (uint32_t octave = 0; octave < 6; ++octave) {
    const uint32_t n = valueNoise(x, y, 6 - octave, seed);
    const uint32_t folded = n < 32768 ? 2 * n : 2 * (65535 - n);
    sum += folded >> (octave + 1);
  }
  return sum;
}

/// The pattern's value in 0...65535.
inline uint32_t patternValue(const Recipe& r, uint32_t x, uint32_t y, uint32_t channel) {
  const uint32_t extent = r.width + r.height;
  switch (r.pattern) {
    case Pattern::kFlat:
      return 20000 + 7000 * channel;
    case Pattern::kRamp:
      return (2 * x + y) * (20000 / extent) + 5000 * channel;
    case Pattern::kRidges:
      return (7 * ridges(x, y, r.seed) + valueNoise(x, y, 3, r.seed + 101 + channel)) / 8;
    case Pattern::kHills:
      return valueNoise(x, y, 5, r.seed + channel);
    case Pattern::kSteps:
      return (valueNoise(x, y, 4, r.seed + channel) >> 13) * 8191;
    case Pattern::kChecker:
      return ((x ^ y ^ channel) & 1u) * 65535;
    case Pattern::kExtreme: {
      const uint32_t h = hash(x, y, r.seed + channel);
      return h & 1u ? (h >> 1 & 1u) * 65535 : h >> 16;
    }
    case Pattern::kNoise:
      return hash(x, y, r.seed + channel) >> 16;
  }
  return 0;
}

namespace detail {

template <class T>
void append(std::vector<std::byte>& data, T value) {
  const size_t at = data.size();
  data.resize(at + sizeof value);
  std::memcpy(data.data() + at, &value, sizeof value);
}

/// v in 0...65535 spans 8- and 16-bit types. 32-bit types get it times 16 about zero (kExtreme: the
/// whole range), floats get metres in steps of 1/16 about zero: all of them exact.
inline void appendSample(std::vector<std::byte>& data, const Recipe& recipe, uint32_t v) {
  const bool whole = recipe.pattern == Pattern::kExtreme;
  const int32_t centred = static_cast<int32_t>(v) - 32768;
  switch (recipe.sample) {
    case TKS_U8:
      return append(data, static_cast<uint8_t>(v >> 8));
    case TKS_I8:
      return append(data, static_cast<int8_t>(centred >> 8));
    case TKS_U16:
      return append(data, static_cast<uint16_t>(v));
    case TKS_I16:
      return append(data, static_cast<int16_t>(centred));
    case TKS_U32:
      return append(data, whole ? v * 65537u : v * 16u);
    case TKS_I32:
      return append(data, whole ? static_cast<int32_t>(v * 65537u ^ 0x80000000u) : centred * 16);
    case TKS_F32:
      return append(data, static_cast<float>(centred) / 16.0f);
  }
}

}  // namespace detail

inline Raster make(const Recipe& recipe) {
  Raster raster{recipe.width, recipe.height, recipe.channels, recipe.sample, {}};
  for (uint32_t y = 0; y < recipe.height; ++y) {
    for (uint32_t x = 0; x < recipe.width; ++x) {
      for (uint32_t c = 0; c < recipe.channels; ++c) {
        detail::appendSample(raster.data, recipe, patternValue(recipe, x, y, c));
      }
    }
  }
  return raster;
}

}  // namespace tetrakis::samples

// SPDX-License-Identifier: Apache-2.0
// validity() makes deterministic masks of valid samples for tests.
#pragma once

#include <algorithm>
#include <cstdint>
#include <ostream>
#include <vector>

#include "conformance/samples/terrain_samples.hpp"

namespace tetrakis::samples {

enum class VoidShape {
  kCoast,     ///< below a level of smooth noise: bays and islands
  kSpeckle,   ///< a quarter of the samples at random
  kChecker,   ///< every other sample
  kFrame,     ///< a margin of three samples
  kOneValid,  ///< one sample is valid
  kOneVoid,   ///< one sample is void
  kHalf,      ///< the right half
  kHoles,     ///< a coast, and single holes on land
  kLines,     ///< lines of one sample along rows and columns
  kAll        ///< nothing is valid
};

inline constexpr VoidShape kVoidShapes[] = {
    VoidShape::kCoast,    VoidShape::kSpeckle, VoidShape::kChecker, VoidShape::kFrame,
    VoidShape::kOneValid, VoidShape::kOneVoid, VoidShape::kHoles,   VoidShape::kAll};

inline std::ostream& operator<<(std::ostream& out, VoidShape shape) {
  constexpr const char* kNames[] = {"Coast",   "Speckle", "Checker", "Frame", "OneValid",
                                    "OneVoid", "Half",    "Holes",   "Lines", "All"};
  return out << kNames[static_cast<size_t>(shape)];
}

inline bool isVoid(VoidShape shape, uint32_t width, uint32_t height, uint32_t x, uint32_t y) {
  const bool middle = x == width / 2 && y == height / 2;
  switch (shape) {
    case VoidShape::kCoast:
      return valueNoise(x, y, 4, 7) < 28000;
    case VoidShape::kSpeckle:
      return hash(x, y, 5) % 4 == 0;
    case VoidShape::kChecker:
      return (x ^ y) & 1;
    case VoidShape::kFrame:
      return x < 3 || y < 3 || x + 3 >= width || y + 3 >= height;
    case VoidShape::kOneValid:
      return !middle;
    case VoidShape::kOneVoid:
      return middle;
    case VoidShape::kHalf:
      return 2 * x >= width;
    case VoidShape::kHoles:
      return isVoid(VoidShape::kCoast, width, height, x, y) || hash(x, y, 6) % 12 == 0;
    case VoidShape::kLines:
      return x % 17 == 5 || y % 13 == 8;
    case VoidShape::kAll:
      return true;
  }
  return false;
}

/// 1 valid, 0 void, row by row.
inline std::vector<uint8_t> validity(VoidShape shape, uint32_t width, uint32_t height) {
  std::vector<uint8_t> valid;
  for (uint32_t y = 0; y < height; ++y) {
    for (uint32_t x = 0; x < width; ++x) valid.push_back(!isVoid(shape, width, height, x, y));
  }
  return valid;
}

/// Gives the last channel, alpha, its largest value where `seen` is 1, and 0 elsewhere.
inline void cutOut(Raster& image, const std::vector<uint8_t>& seen) {
  const size_t bytes = tks_sample_bytes(image.sample);
  for (size_t i = 0; i < seen.size(); ++i) {
    std::byte* alpha = image.data.data() + ((i + 1) * image.channels - 1) * bytes;
    std::fill_n(alpha, bytes, seen[i] ? std::byte{0xff} : std::byte{0});
  }
}

/// Draws over the texels where `photograph` is 0: stripes of two colours, 24 texels wide.
inline void drawOver(Raster& image, const std::vector<uint8_t>& photograph) {
  const size_t bytes = tks_sample_bytes(image.sample) * image.channels;
  for (size_t i = 0; i < photograph.size(); ++i) {
    const bool even = i % image.width / 24 % 2 == 0;
    if (!photograph[i]) {
      std::fill_n(image.data.data() + i * bytes, bytes, even ? std::byte{0xff} : std::byte{0x20});
    }
  }
}

}  // namespace tetrakis::samples

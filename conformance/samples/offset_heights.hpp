// SPDX-License-Identifier: Apache-2.0
// withOffsets() makes heights that are whole steps above a level which is no whole number of steps:
// a geoid, an offset for each square of a compressed file, the datum of one of two surveys. The
// heights are floats and rounded as such.
#pragma once

#include <cstdint>
#include <cstring>

#include "conformance/samples/terrain_samples.hpp"

namespace tetrakis::samples {

enum class OffsetKind : uint8_t {
  kGeoid,    ///< whole metres above a smooth surface
  kSquares,  ///< steps of 0.2 m; each square of 8 x 8 samples has an offset, as after LERC
  kSurveys   ///< whole feet in metres, of two surveys side by side
};
inline constexpr OffsetKind kOffsetKinds[] = {OffsetKind::kGeoid, OffsetKind::kSquares,
                                              OffsetKind::kSurveys};

/// What the steps are, in metres.
inline double stepOf(OffsetKind kind) {
  return kind == OffsetKind::kGeoid ? 1 : kind == OffsetKind::kSquares ? 0.2 : 0.3048;
}

/// The offset of a sample, in metres.
inline double offsetAt(OffsetKind kind, uint32_t x, uint32_t y, uint32_t width) {
  if (kind == OffsetKind::kGeoid) return 31.0417 + 0.00173 * x - 0.00091 * y + 1.3e-6 * x * y;
  if (kind == OffsetKind::kSurveys) return 2 * x < width ? 17.1234567 : 17.3110011;
  const double part = hash(x / 8, y / 8, 71) * 0x1p-32;
  return static_cast<double>(static_cast<float>(100 + part));
}

/// heights: u16, whole steps.
inline Raster withOffsets(const Raster& heights, OffsetKind kind) {
  Raster out = heights;
  out.sample = TKS_F32;
  out.data.resize(size_t{heights.width} * heights.height * sizeof(float));
  for (uint32_t y = 0; y < heights.height; ++y) {
    for (uint32_t x = 0; x < heights.width; ++x) {
      const size_t i = size_t{y} * heights.width + x;
      uint16_t steps = 0;
      std::memcpy(&steps, heights.data.data() + 2 * i, sizeof steps);
      const auto sample =
          static_cast<float>(offsetAt(kind, x, y, heights.width) + stepOf(kind) * steps);
      std::memcpy(out.data.data() + 4 * i, &sample, sizeof sample);
    }
  }
  return out;
}

}  // namespace tetrakis::samples

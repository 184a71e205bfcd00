// SPDX-License-Identifier: Apache-2.0
// withFewValues() turns heights into heights of few values, which lie on no grid of their type,
// like heights in files that were rescaled, converted or interpolated.
#pragma once

#include <cmath>
#include <cstdint>
#include <cstring>

#include "conformance/samples/terrain_samples.hpp"

namespace tetrakis::samples {

enum class FewValues : uint8_t {
  kFeet,      ///< f32: whole feet written as metres
  kRescaled,  ///< f32: 8 bits stretched by 2.09, in decimal fractions that no float holds
  kRare,      ///< f32: whole feet in metres, of which one in a hundred was interpolated
  kStretched  ///< u16: the square roots of the heights, over the whole range
};
inline constexpr FewValues kFewValues[] = {FewValues::kFeet, FewValues::kRescaled, FewValues::kRare,
                                           FewValues::kStretched};

inline float floatOf(FewValues kind, uint8_t v, uint32_t sample) {
  constexpr float kFoot = 0.3048f, kTenth = 0.1f;
  if (kind == FewValues::kFeet) return static_cast<float>(v) * kFoot;
  if (kind == FewValues::kRescaled) return std::floor(static_cast<float>(v) * 20.9f) * kTenth;
  const uint32_t random = hash(sample, 7, 51);
  const bool rare = random % 100 == 0;
  return static_cast<float>(v) * kFoot + (rare ? static_cast<float>(random >> 16) / 65536 : 0);
}

/// heights: u8.
inline Raster withFewValues(const Raster& heights, FewValues kind) {
  Raster out = heights;
  const size_t count = size_t{heights.width} * heights.height;
  const bool stretched = kind == FewValues::kStretched;
  out.sample = stretched ? TKS_U16 : TKS_F32;
  out.data.resize(count * tks_sample_bytes(out.sample));
  for (size_t i = 0; i < count; ++i) {
    const auto v = std::to_integer<uint8_t>(heights.data[i]);
    const auto root = static_cast<uint16_t>(std::sqrt(static_cast<float>(v) / 255) * 65535);
    const float sample = floatOf(kind, v, static_cast<uint32_t>(i));
    if (stretched)
      std::memcpy(out.data.data() + 2 * i, &root, sizeof root);
    else
      std::memcpy(out.data.data() + 4 * i, &sample, sizeof sample);
  }
  return out;
}

}  // namespace tetrakis::samples

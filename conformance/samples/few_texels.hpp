// SPDX-License-Identifier: Apache-2.0
// withFewTexels() turns an image into one of few, unevenly spaced values, like images in files that
// were stretched over their type.
#pragma once

#include <cmath>
#include <cstdint>
#include <cstring>

#include "conformance/samples/terrain_samples.hpp"

namespace tetrakis::samples {

/// image: u8. Each channel gets so many levels at most, the square roots of which lie over all of
/// the type `sample`, u8 or u16.
inline Raster withFewTexels(const Raster& image, uint32_t levels, tks_sample sample) {
  Raster out = image;
  out.sample = sample;
  out.data.resize(image.data.size() * tks_sample_bytes(sample));
  const double most = sample == TKS_U8 ? 255 : 65535;
  for (size_t i = 0; i < image.data.size(); ++i) {
    const uint32_t level = std::to_integer<uint32_t>(image.data[i]) * levels / 256;
    const auto value = static_cast<uint16_t>(std::lround(most * std::sqrt(level / (levels - 1.))));
    if (sample == TKS_U8)
      out.data[i] = static_cast<std::byte>(value);
    else
      std::memcpy(out.data.data() + 2 * i, &value, sizeof value);
  }
  return out;
}

}  // namespace tetrakis::samples

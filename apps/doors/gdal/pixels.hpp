// SPDX-License-Identifier: Apache-2.0
// Rectangles of interleaved pixels.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

namespace tetrakis::gdal {

/// Part of an array: the distances between its rows and pixels, in bytes.
struct Pixels {
  const std::byte* first;
  size_t row_bytes, pixel_bytes;
  uint32_t width, height;
};

/// The first sample_bytes of each pixel, tightly packed in rows that lie to_row_bytes apart.
inline void copySamples(const Pixels& from, size_t sample_bytes, std::byte* to,
                        size_t to_row_bytes) {
  for (uint32_t y = 0; y < from.height; ++y) {
    const std::byte* in = from.first + y * from.row_bytes;
    std::byte* out = to + y * to_row_bytes;
    if (from.pixel_bytes == sample_bytes) {
      std::memcpy(out, in, from.width * sample_bytes);
      continue;
    }
    for (uint32_t x = 0; x < from.width; ++x, in += from.pixel_bytes, out += sample_bytes)
      std::memcpy(out, in, sample_bytes);
  }
}

}  // namespace tetrakis::gdal

// SPDX-License-Identifier: Apache-2.0
// unpackRow() unpacks a row of samples from the bits in which a TIFF stores it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "apps/tools/files/pictures/picture_formats.hpp"

namespace tetrakis::tools {

/// By the tags SampleFormat and BitsPerSample.
struct TiffSample {
  uint16_t format = 0, bits = 0;
  bool swapped = false;  ///< libtiff has turned the bytes of each around
};

/// The smallest type that holds all values; kOther: there is none.
PictureSample typeOf(TiffSample stored);

/// Fills `samples`, of type typeOf(stored), from a row as libtiff hands it over: words of 16, 32
/// and 64 bits in the order of the host. Integers of 24 bits begin with the highest byte in any
/// file, as GDAL has it.
void unpackRow(std::span<const std::byte> packed, TiffSample stored, std::span<std::byte> samples);

/// The value in all `samples` of the type, the nearest one where the type does not hold it, and 0
/// for NaN in integers: what GDAL has in blocks that a file leaves out.
void fillSamples(double value, PictureSample type, std::span<std::byte> samples);

}  // namespace tetrakis::tools

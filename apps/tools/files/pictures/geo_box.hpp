// SPDX-License-Identifier: Apache-2.0
// geoBoxOf() reads the place of a JPEG 2000 file (JP2, JPX) from a box of its own: a TIFF of one
// pixel with the tags of a GeoTIFF ("GeoJP2"). Some files describe their place in GML, which is not
// read.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace tetrakis::tools {

struct GeoBox {
  std::vector<std::byte> tiff;  ///< empty: there is none
  bool gml = false;             ///< there is a description in GML
};

/// bytes: of a JPEG 2000 file, or a bare codestream, which has no boxes; may be damaged.
GeoBox geoBoxOf(std::span<const std::byte> bytes);

}  // namespace tetrakis::tools

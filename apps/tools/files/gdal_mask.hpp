// SPDX-License-Identifier: Apache-2.0
// readMaskPage() and readMaskBeside() read masks of valid samples where GDAL keeps them: in a page
// of the TIFF itself, or in a TIFF beside the file.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tetrakis/result.hpp"

namespace tetrakis::tools {

struct GdalMask {
  std::vector<uint8_t> shown{};  ///< 0 where a sample is left out: by all bands; empty: no mask
  bool differs = false;          ///< the bands of the picture have masks of their own
};

/// Of the mask page of this TIFF, if it has one of this size. TKS_USAGE if its samples are neither
/// of 1 nor of 8 bits.
Result<GdalMask> readMaskPage(const std::string& path, uint32_t width, uint32_t height);

/// The same of "path.msk", a TIFF of one band, or one for each of the picture.
Result<GdalMask> readMaskBeside(const std::string& path, uint32_t width, uint32_t height);

/// 0 in the strips and tiles that the first page leaves out, 255 elsewhere.
Result<std::vector<uint8_t>> maskOfMissing(const std::string& path, uint32_t width,
                                           uint32_t height);

}  // namespace tetrakis::tools

// SPDX-License-Identifier: Apache-2.0
// Masks as GDAL keeps them: a page of the TIFF itself, or a TIFF beside the file.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/status.hpp"

namespace tetrakis::tools {

/// width * height bytes, 0 where a sample is left out: of the mask page of this TIFF. Empty if it
/// has none of this size. TKS_USAGE if its samples are neither of 1 nor of 8 bits.
Result<std::vector<uint8_t>> readMaskPage(const std::string& path, uint32_t width, uint32_t height);

/// The same of "path.msk", a TIFF of one band; empty if there is no such file.
Result<std::vector<uint8_t>> readMaskBeside(const std::string& path, uint32_t width,
                                            uint32_t height);

/// 0 in the strips and tiles that the first page leaves out, 255 elsewhere.
Result<std::vector<uint8_t>> maskOfMissing(const std::string& path, uint32_t width,
                                           uint32_t height);

}  // namespace tetrakis::tools

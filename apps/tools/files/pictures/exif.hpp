// SPDX-License-Identifier: Apache-2.0
// exifOrientation() reads the orientation in EXIF data of files in which OpenImageIO does not look
// for it.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>

namespace tetrakis::tools {

/// 1 to 8 as TIFF counts; 1 (upright) where there is none.
int exifOrientation(std::span<const std::byte> exif);

/// The content of the first chunk of this name in a WebP file (RFC 9649, section 2); empty if it
/// has none.
std::span<const std::byte> webpChunk(std::span<const std::byte> file, std::string_view name);

}  // namespace tetrakis::tools

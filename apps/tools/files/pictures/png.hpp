// SPDX-License-Identifier: Apache-2.0
// decodePng() and encodePng() read and write PNG in memory by libspng. The PNG reader of
// OpenImageIO prints on standard error and hides the stored bit depth.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "apps/tools/files/files.hpp"
#include "tetrakis/result.hpp"

namespace tetrakis::tools {

struct DecodedPng {
  ImageFile image;
  int stored_bits = 0;    ///< 1, 2, 4, 8, 16; fewer than 8 were widened to full range
  bool palette = false;   ///< expanded to RGB or RGBA
  bool profile = false;   ///< an ICC profile, not applied
  bool animated = false;  ///< further frames are not read
  int orientation = 1;    ///< of the EXIF data, not applied
};

/// name: for the message.
Result<DecodedPng> decodePng(std::span<const std::byte> bytes, const std::string& name);

Result<std::vector<std::byte>> encodePng(const ImageFile& image);

}  // namespace tetrakis::tools

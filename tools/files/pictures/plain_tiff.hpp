// SPDX-License-Identifier: Apache-2.0
// TIFFs whose samples lie there as the tools want them, by libtiff alone: most of those that people
// encode. OpenImageIO reads the others.
#pragma once

#include <memory>
#include <string>

#include "base/status.hpp"
#include "tools/files/pictures/picture_formats.hpp"

namespace tetrakis::tools {

/// Null if the file is no TIFF, or has other samples than black-is-zero greys, or RGB, with or
/// without alpha, interleaved, integers of 8, 16 or 32 bits or floats of 32 or 64.
std::unique_ptr<PictureReader> openPlainTiff(const std::string& path);

/// The same with greys that store white as 0 as well, of which the samples stay as they are.
std::unique_ptr<PictureReader> openStoredTiff(const std::string& path);

}  // namespace tetrakis::tools

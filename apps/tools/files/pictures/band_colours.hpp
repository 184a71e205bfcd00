// SPDX-License-Identifier: Apache-2.0
// bandColours() tells which colour each band of a TIFF is, by the rules of GDAL.
#pragma once

#include <tiffio.h>

#include <cstdint>
#include <string_view>
#include <vector>

#include "apps/tools/files/files.hpp"

namespace tetrakis::tools {

/// In the order that textures have. kOther: grey, near infrared, or not told.
enum class BandColour { kRed, kGreen, kBlue, kOther, kAlpha };

/// By GDAL's name of it ("Blue", "Undefined", ...).
BandColour bandColour(std::string_view name);

/// As the tags of the samples say, or else GDAL's metadata, which go before. One for each sample.
std::vector<BandColour> bandColours(TIFF* tiff);

/// The places of bands in the order of a texture, bands of one kind as they come: of blue, green,
/// red and another one 2, 1, 0, 3.
std::vector<uint32_t> textureOrder(const std::vector<BandColour>& colours);

/// Puts the channels into this order.
void reorderChannels(ImageFile& image, const std::vector<uint32_t>& order);

}  // namespace tetrakis::tools

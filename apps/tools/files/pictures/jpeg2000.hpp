// SPDX-License-Identifier: Apache-2.0
// The functions here read JPEG 2000 by OpenJPEG, with the samples as they are coded. OpenImageIO
// 2.4 shifts samples that are signed, or of other than 8 or 16 bits.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "apps/tools/files/pictures/band_colours.hpp"
#include "apps/tools/files/pictures/picture_formats.hpp"
#include "tetrakis/result.hpp"

namespace tetrakis::tools {

/// What the codestream and the boxes around it say.
struct Jpeg2000Form {
  bool boxed = false;  ///< a file, no bare codestream
  uint64_t width = 0, height = 0;
  int bits = 0;  ///< of a sample
  bool is_signed = false;
  std::vector<BandColour> colours{};  ///< of each component
  bool associated_alpha = false;
};

/// Whether it begins as a JPEG 2000 file (JP2, JPX) or as a bare codestream.
bool isJpeg2000(std::span<const std::byte> file);

/// TKS_USAGE for components that differ in size or depth, for palettes, and for colours that are
/// neither greys nor RGB; TKS_IO for what is no codestream. name: for messages.
Result<Jpeg2000Form> jpeg2000Form(std::span<const std::byte> file, const std::string& name);

/// The sides have been judged.
std::unique_ptr<PictureReader> openJpeg2000(const std::string& path, const Jpeg2000Form& form);

}  // namespace tetrakis::tools

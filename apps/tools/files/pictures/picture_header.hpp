// SPDX-License-Identifier: Apache-2.0
// readPictureHeader() reads the size and form of a picture from its first bytes, without the
// library that reads the samples. checkShape() then compares the result of that library with it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "apps/tools/files/pictures/picture_formats.hpp"
#include "tetrakis/result.hpp"

namespace tetrakis::tools {

/// Of rows and columns, as streams take them.
inline constexpr uint64_t kMostHeights = uint64_t{1} << 20, kMostTexels = 32768;

struct PictureHeader {
  std::string format{};  ///< OpenImageIO's name; "": none that is known
  uint64_t width = 0, height = 0;
  int channels = 0;              ///< that reading gives; 0: the header does not tell
  bool fourth_reserved = false;  ///< reading takes for alpha what is none
  std::string refused{};         ///< why it is not read; "": it is
};

/// TKS_IO where the header ends early. file: all of it; name: for messages.
Result<PictureHeader> readPictureHeader(std::span<const std::byte> file, const std::string& name);

/// TKS_USAGE for pictures without rows or columns, or with more than `most` of them: before
/// anything is read, as a few bytes can claim any size.
Status checkSides(const std::string& name, uint64_t width, uint64_t height, uint64_t most);

/// TKS_IO unless reading would give what the header says.
Status checkShape(const std::string& name, const PictureHeader& header, const PictureShape& shape);

}  // namespace tetrakis::tools

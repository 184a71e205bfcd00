// SPDX-License-Identifier: Apache-2.0
// The functions here read portable greymaps and pixmaps (pgm(5) and ppm(5) of Netpbm) of 16 bits.
// OpenImageIO reads files of 8 bits exactly; its version 2.4 multiplies samples of 16 bits in
// signed 32 bits, so that all above 32768 come out one too low.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tetrakis/result.hpp"

namespace tetrakis::tools {

struct PnmHeader {
  bool text = false;   ///< samples are decimal numbers, not bytes
  uint64_t white = 0;  ///< the largest sample that there may be
  size_t end = 0;      ///< where the samples begin
};

/// Columns and rows of any portable picture, which begins with two letters; nothing where they are
/// no numbers.
std::optional<std::array<uint64_t, 2>> readPnmSides(std::string_view file);

/// Nothing for other files: bitmaps have no white, floats another header.
std::optional<PnmHeader> readPnmHeader(std::span<const std::byte> file);

/// So many samples, in 16 bits and host byte order. TKS_IO if the file holds fewer, or one above
/// white. name: for messages.
Result<std::vector<std::byte>> readWidePnm(std::span<const std::byte> file, const PnmHeader& header,
                                           size_t samples, const std::string& name);

}  // namespace tetrakis::tools

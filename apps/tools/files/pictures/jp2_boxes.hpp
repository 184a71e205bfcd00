// SPDX-License-Identifier: Apache-2.0
// firstBox() and boxContent() find boxes of JPEG 2000 files: ISO/IEC 15444-1, annex I.4: u32
// length, type, and for the length 1 a u64 length; 0 means up to the end. Big endian.
#pragma once

#include <cstdint>
#include <string_view>

namespace tetrakis::tools {

inline constexpr std::string_view kJp2Signature("\0\0\0\x0cjP  \r\n\x87\n", 12);

/// The number that all these bytes are.
uint64_t bigEndian(std::string_view bytes);

/// The first box, and what lies behind it.
struct Jp2Box {
  std::string_view type, content, behind;
};

/// Without a type: there is no whole box.
Jp2Box firstBox(std::string_view bytes);

/// The content of the first box of a type; empty if there is none.
std::string_view boxContent(std::string_view bytes, std::string_view type);

}  // namespace tetrakis::tools

// SPDX-License-Identifier: Apache-2.0
#include "apps/tools/files/pictures/jp2_boxes.hpp"

namespace tetrakis::tools {

uint64_t bigEndian(std::string_view bytes) {
  uint64_t value = 0;
  for (const char byte : bytes) value = value << 8U | static_cast<unsigned char>(byte);
  return value;
}

Jp2Box firstBox(std::string_view bytes) {
  constexpr size_t kShort = 8, kLong = 16;
  if (bytes.size() < kShort) return {};
  size_t head = kShort;
  uint64_t length = bigEndian(bytes.substr(0, 4));
  if (length == 0) length = bytes.size();
  if (length == 1 && bytes.size() >= kLong) {
    head = kLong;
    length = bigEndian(bytes.substr(kShort, kShort));
  }
  if (length < head || length > bytes.size()) return {};
  return {bytes.substr(4, 4), bytes.substr(head, length - head), bytes.substr(length)};
}

std::string_view boxContent(std::string_view bytes, std::string_view type) {
  Jp2Box box = firstBox(bytes);
  while (!box.type.empty() && box.type != type) box = firstBox(box.behind);
  return box.content;
}

}  // namespace tetrakis::tools

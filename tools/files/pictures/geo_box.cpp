// SPDX-License-Identifier: Apache-2.0
// Boxes: ISO/IEC 15444-1, annex I.4: u32 length, type, and for the length 1 a u64 length; 0 means
// up to the end. Big endian.
#include "tools/files/pictures/geo_box.hpp"

#include <cstdint>
#include <cstring>
#include <string_view>

namespace tetrakis::tools {
namespace {

constexpr std::string_view kJp2Signature("\0\0\0\x0cjP  \r\n\x87\n", 12);
/// b14bf8bd-083d-4b43-a5ae-8cd7d5a6ce03
constexpr std::string_view kGeoJp2(
    "\xb1\x4b\xf8\xbd\x08\x3d\x4b\x43\xa5\xae\x8c\xd7\xd5\xa6\xce\x03", 16);
/// In the label of an association box (OGC GMLJP2, 05-047r3 and 08-085r8).
constexpr std::string_view kGml = "gml.data";

uint64_t number(std::string_view bytes) {
  uint64_t value = 0;
  for (const char byte : bytes) value = value << 8U | static_cast<unsigned char>(byte);
  return value;
}

/// The first box, and what lies behind it.
struct Box {
  std::string_view type, content, behind;
};

/// Without a type: there is no whole box.
Box firstBox(std::string_view bytes) {
  constexpr size_t kShort = 8, kLong = 16;
  if (bytes.size() < kShort) return {};
  size_t head = kShort;
  uint64_t length = number(bytes.substr(0, 4));
  if (length == 0) length = bytes.size();
  if (length == 1 && bytes.size() >= kLong) {
    head = kLong;
    length = number(bytes.substr(kShort, kShort));
  }
  if (length < head || length > bytes.size()) return {};
  return {bytes.substr(4, 4), bytes.substr(head, length - head), bytes.substr(length)};
}

}  // namespace

GeoBox geoBoxOf(std::span<const std::byte> bytes) {
  std::string_view rest(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  GeoBox found;
  if (!rest.starts_with(kJp2Signature)) return found;
  for (Box box = firstBox(rest); !box.type.empty(); box = firstBox(box.behind)) {
    if (box.type == "asoc" && box.content.find(kGml) != std::string_view::npos) found.gml = true;
    if (box.type != "uuid" || !box.content.starts_with(kGeoJp2) || !found.tiff.empty()) continue;
    const std::string_view tiff = box.content.substr(kGeoJp2.size());
    found.tiff.resize(tiff.size());
    std::memcpy(found.tiff.data(), tiff.data(), tiff.size());
  }
  return found;
}

}  // namespace tetrakis::tools

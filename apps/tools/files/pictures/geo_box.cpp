// SPDX-License-Identifier: Apache-2.0
#include "apps/tools/files/pictures/geo_box.hpp"

#include <cstdint>
#include <cstring>
#include <string_view>

#include "apps/tools/files/pictures/jp2_boxes.hpp"

namespace tetrakis::tools {
namespace {

/// b14bf8bd-083d-4b43-a5ae-8cd7d5a6ce03
constexpr std::string_view kGeoJp2(
    "\xb1\x4b\xf8\xbd\x08\x3d\x4b\x43\xa5\xae\x8c\xd7\xd5\xa6\xce\x03", 16);
/// In the label of an association box (OGC GMLJP2, 05-047r3 and 08-085r8).
constexpr std::string_view kGml = "gml.data";

}  // namespace

GeoBox geoBoxOf(std::span<const std::byte> bytes) {
  std::string_view rest(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  GeoBox found;
  if (!rest.starts_with(kJp2Signature)) return found;
  for (Jp2Box box = firstBox(rest); !box.type.empty(); box = firstBox(box.behind)) {
    if (box.type == "asoc" && box.content.find(kGml) != std::string_view::npos) found.gml = true;
    if (box.type != "uuid" || !box.content.starts_with(kGeoJp2) || !found.tiff.empty()) continue;
    const std::string_view tiff = box.content.substr(kGeoJp2.size());
    found.tiff.resize(tiff.size());
    std::memcpy(found.tiff.data(), tiff.data(), tiff.size());
  }
  return found;
}

}  // namespace tetrakis::tools

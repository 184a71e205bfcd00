// SPDX-License-Identifier: Apache-2.0
#include "apps/doors/gdal/subdataset_name.hpp"

#include <algorithm>
#include <charconv>
#include <string_view>

#include <cpl_port.h>
#include "apps/doors/gdal/source.hpp"
#include "base/shown_text.hpp"

namespace tetrakis::gdal {
namespace {

constexpr std::string_view kPrefix = "TKS:", kFrame = "frame=", kComponent = "component=";

std::string withoutQuotes(const std::string& text) {
  const bool quoted = text.size() >= 2 && text.front() == '"' && text.back() == '"';
  return quoted ? text.substr(1, text.size() - 2) : text;
}

/// Takes what follows the last colon; nothing if there is no colon.
std::optional<std::string> takeLast(std::string& rest) {
  const size_t colon = rest.rfind(':');
  if (colon == std::string::npos) return std::nullopt;
  std::string last = rest.substr(colon + 1);
  rest.resize(colon);
  return last;
}

std::optional<tks_part> partOf(const std::string& word) {
  for (const tks_part part : {TKS_PART_HEIGHTS, TKS_PART_TEXTURE})
    if (EQUAL(word.c_str(), partName(part))) return part;
  return std::nullopt;
}

tks_part partOf(tks_component_kind kind) {
  return kind == TKS_COMPONENT_TEXTURE ? TKS_PART_TEXTURE : TKS_PART_HEIGHTS;
}

std::optional<uint64_t> frameOf(const std::string& word) {
  if (!STARTS_WITH_CI(word.c_str(), kFrame.data())) return std::nullopt;
  uint64_t frame = 0;
  const char* const end = word.data() + word.size();
  const auto [stop, error] = std::from_chars(word.data() + kFrame.size(), end, frame);
  return error == std::errc() && stop == end ? std::optional(frame) : std::nullopt;
}

std::string componentOf(const std::string& word) {
  if (!STARTS_WITH_CI(word.c_str(), kComponent.data())) return "";
  return word.substr(kComponent.size());
}

/// Names and descriptions, each with the next number.
void addTo(CPLStringList& list, const SubdatasetName& name, const std::string& description) {
  const int number = list.size() / 2 + 1;
  list.SetNameValue(CPLSPrintf("SUBDATASET_%d_NAME", number), nameOf(name).c_str());
  list.SetNameValue(CPLSPrintf("SUBDATASET_%d_DESC", number), description.c_str());
}

}  // namespace

bool isSubdatasetName(const char* text) {
  return STARTS_WITH_CI(text, kPrefix.data());
}

std::optional<SubdatasetName> subdatasetName(const char* text) {
  SubdatasetName name;
  std::string rest = text + kPrefix.size();
  std::string before = rest;
  if (std::optional<std::string> word = takeLast(before)) {
    name.part = partOf(*word);
    if (name.part) {
      rest = before;
      word = takeLast(before);
    }
    if (word) name.frame = frameOf(*word);
    if (word && !name.frame) name.component = componentOf(*word);
    if (name.frame || !name.component.empty()) rest = before;
    name.file = withoutQuotes(rest);
  }
  if (name.part || name.frame || !name.component.empty()) return name;
  reportFailure(TKS_USAGE, text,
                "The name of a subdataset is TKS:\"FILE\":heights or TKS:\"FILE\":texture, of "
                "another component TKS:\"FILE\":component=NUMBER, or of a frame "
                "TKS:\"FILE\":frame=NUMBER, with :heights or :texture behind it.");
  return std::nullopt;
}

std::string selectionOf(const SubdatasetName& subdataset) {
  std::string place;
  if (subdataset.frame) place = std::string(kFrame) + std::to_string(*subdataset.frame);
  if (!subdataset.component.empty()) place = std::string(kComponent) + subdataset.component;
  if (!place.empty() && subdataset.part) place += ':';
  if (subdataset.part) place += partName(*subdataset.part);
  return place;
}

std::string nameOf(const SubdatasetName& subdataset) {
  return std::string(kPrefix) + '"' + subdataset.file + "\":" + selectionOf(subdataset);
}

CPLStringList subdatasetsOf(const std::string& file, const tks_info& info, uint64_t first,
                            uint64_t end) {
  constexpr uint64_t kMost = 1000;
  CPLStringList list;
  const bool moves = end - first > 1;
  if (info.has_heights) {
    const bool on_grid = info.grid_width > 0;
    std::string bands = moves ? std::to_string(end - first) + "x" : "";
    addTo(list, {file, TKS_PART_HEIGHTS},
          CPLSPrintf("[%s%ux%u] heights", bands.c_str(), on_grid ? info.grid_height : info.height,
                     on_grid ? info.grid_width : info.width));
  }
  if (!info.has_texture) return list;
  const std::string size = CPLSPrintf("[%ux%ux%u] texture", info.texture_channels,
                                      info.texture_height, info.texture_width);
  for (uint64_t frame = first; frame < std::min(end, first + kMost); ++frame) {
    const std::string of = moves ? " of frame " + std::to_string(frame) : "";
    addTo(list, {file, TKS_PART_TEXTURE, moves ? std::optional(frame) : std::nullopt}, size + of);
  }
  return list;
}

void addComponents(const Source& source, CPLStringList& list) {
  const std::vector<StreamComponent>& components = source.components();
  for (uint32_t i = 0; i < components.size(); ++i) {
    const StreamComponent& one = components[i];
    if (source.isFirst(i) || one.kind == TKS_COMPONENT_UNKNOWN) continue;
    const char* const kind = partName(partOf(one.kind));
    const std::string description = CPLSPrintf("[%ux%u] %s ", one.height, one.width, kind);
    addTo(list, {source.name(), std::nullopt, std::nullopt, std::to_string(i)},
          description + shownText(one.name.empty() ? std::to_string(i) : one.name));
  }
}

const char* partName(tks_part part) {
  return part == TKS_PART_TEXTURE ? "texture" : "heights";
}

}  // namespace tetrakis::gdal

// SPDX-License-Identifier: Apache-2.0
#include "apps/doors/gdal/subdataset_name.hpp"

#include <string_view>

#include <cpl_port.h>
#include "apps/doors/gdal/source.hpp"

namespace tetrakis::gdal {
namespace {

constexpr std::string_view kPrefix = "TKS:";

std::string withoutQuotes(const std::string& text) {
  const bool quoted = text.size() >= 2 && text.front() == '"' && text.back() == '"';
  return quoted ? text.substr(1, text.size() - 2) : text;
}

}  // namespace

bool isSubdatasetName(const char* text) {
  return STARTS_WITH_CI(text, kPrefix.data());
}

std::optional<SubdatasetName> subdatasetName(const char* text) {
  const std::string rest = text + kPrefix.size();
  const size_t colon = rest.rfind(':');
  if (colon != std::string::npos) {
    const std::string file = withoutQuotes(rest.substr(0, colon));
    for (const tks_part part : {TKS_PART_HEIGHTS, TKS_PART_TEXTURE})
      if (EQUAL(rest.c_str() + colon + 1, partName(part))) return SubdatasetName{file, part};
  }
  reportFailure(TKS_USAGE, text,
                "The name of a subdataset is TKS:\"FILE\":heights or TKS:\"FILE\":texture.");
  return std::nullopt;
}

std::string nameOf(const SubdatasetName& subdataset) {
  return std::string(kPrefix) + '"' + subdataset.file + "\":" + partName(subdataset.part);
}

const char* partName(tks_part part) {
  return part == TKS_PART_TEXTURE ? "texture" : "heights";
}

}  // namespace tetrakis::gdal

// SPDX-License-Identifier: Apache-2.0
// What the metadata domain TKS says of a stream: how much of it is there, what it promises, and
// what it states of errors.
#include <string>
#include <vector>

#include <cpl_string.h>
#include "apps/doors/gdal/dataset.hpp"
#include "base/shown_text.hpp"

namespace tetrakis::gdal {
namespace {

constexpr char kDomain[] = "TKS";

bool isOwn(const char* domain) {
  return domain != nullptr && EQUAL(domain, kDomain);
}

const char* wordOf(tks_index index) {
  if (index == TKS_INDEX_WINDOWS) return "WINDOWS";
  if (index == TKS_INDEX_PAGES) return "PAGES";
  return index == TKS_INDEX_PACKETS ? "YES" : "NO";
}

const char* wordOf(tks_component_kind kind) {
  if (kind == TKS_COMPONENT_UNKNOWN) return "UNKNOWN";
  return kind == TKS_COMPONENT_TEXTURE ? "TEXTURE" : "HEIGHTS";
}

}  // namespace

void Dataset::tellStream() {
  const tks_info& info = source_->info();
  const auto tell = [this](const char* name, const std::string& value) {
    GDALDataset::SetMetadataItem(name, value.c_str(), kDomain);
  };
  tell("COMPLETE", source_->complete() ? "YES" : "NO");
  tell("BYTES", std::to_string(source_->bytes()));
  tell("BYTES_ANNOUNCED", std::to_string(info.stream_bytes));
  const uint32_t cube_depth = source_->cubeDepth();
  // What is kept of a cube says nothing of the grid's samples.
  const bool promises_error = info.max_error >= 0 && cube_depth == 0;
  if (info.lossless && cube_depth == 0) {
    tell("TARGET", "LOSSLESS");
  } else if (promises_error) {
    tell("TARGET", CPLSPrintf("MAX_ERROR=%.17g", info.max_error));
  }
  if (info.triangles > 0) tell("TRIANGLES", std::to_string(info.triangles));
  tell("INDEX", wordOf(info.index));
  if (source_->regionSide() != 0) tell("BLOCKSIZE", std::to_string(source_->regionSide()));
  if ((isHeights() ? info.domain : info.texture_domain) == TKS_DOMAIN_CYLINDER)
    tell("DOMAIN", "CYLINDER");
  if (cube_depth > 0) {
    tell("DOMAIN", "CUBE");
    tell("DEPTH", std::to_string(cube_depth));
  }
  tellComponents();
  if (!isHeights()) {
    if (info.texture_white_level < UINT16_MAX && info.texture_sample == TKS_U16)
      tell("WHITE_LEVEL", std::to_string(info.texture_white_level));
    return;
  }
  if (*info.vertical_datum != '\0') tell("VERTICAL_DATUM", info.vertical_datum);
  if (promises_error && source_->complete()) tell("MAX_ERROR", CPLSPrintf("%.17g", info.max_error));
}

void Dataset::tellComponents() {
  const auto tell = [this](const std::string& name, const std::string& value) {
    GDALDataset::SetMetadataItem(name.c_str(), value.c_str(), kDomain);
  };
  if (!source_->hasFurtherComponents()) return;
  const std::vector<StreamComponent>& components = source_->components();
  tell("COMPONENTS", std::to_string(components.size()));
  tell("COMPONENT", std::to_string(source_->takenFor(source_->part()).value_or(0)));
  for (size_t i = 0; i < components.size(); ++i) {
    const std::string item = "COMPONENT_" + std::to_string(i);
    tell(item + "_KIND", wordOf(components[i].kind));
    if (!components[i].name.empty()) tell(item + "_NAME", shownText(components[i].name));
  }
}

void Dataset::tellQuality() {
  if (quality_told_) return;
  quality_told_ = true;
  const StatedQuality quality = source_->statedQuality();
  const auto tell = [this](const char* name, double value) {
    if (value >= 0) GDALDataset::SetMetadataItem(name, CPLSPrintf("%.6g", value), kDomain);
  };
  if (isHeights()) tell("RMSE", quality.heights_rmse);
  if (!isHeights() || source_->info().has_texture) tell("TEXTURE_PSNR", quality.texture_psnr);
}

char** Dataset::GetMetadata(const char* domain) {
  if (isOwn(domain) && raster_ == nullptr) tellQuality();
  return GDALPamDataset::GetMetadata(domain);
}

const char* Dataset::GetMetadataItem(const char* name, const char* domain) {
  const bool quality = name != nullptr && (EQUAL(name, "RMSE") || EQUAL(name, "TEXTURE_PSNR"));
  if (quality && isOwn(domain) && raster_ == nullptr) tellQuality();
  return GDALPamDataset::GetMetadataItem(name, domain);
}

}  // namespace tetrakis::gdal

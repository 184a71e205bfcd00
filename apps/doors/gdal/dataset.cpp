// SPDX-License-Identifier: Apache-2.0
#include "apps/doors/gdal/dataset.hpp"

#include <algorithm>
#include <cstring>
#include <limits>
#include <utility>

#include "apps/doors/gdal/band.hpp"
#include "apps/doors/gdal/cube.hpp"
#include "apps/doors/gdal/subdataset_name.hpp"

namespace tetrakis::gdal {

namespace {

constexpr uint32_t kOverviewEnds = 256;  ///< no overview where both sides are at most this

GDALColorInterp colourOf(uint32_t channels, uint32_t channel, bool has_alpha) {
  if (channels % 2 == 0 && channel + 1 == channels)
    return has_alpha ? GCI_AlphaBand : GCI_Undefined;
  if (channels <= 2) return GCI_GrayIndex;
  constexpr GDALColorInterp kColours[] = {GCI_RedBand, GCI_GreenBand, GCI_BlueBand};
  return kColours[channel];
}

/// Heights that are void come back as this, which need not be declared.
std::optional<double> voidValueOf(const tks_info& info) {
  if (info.has_nodata) return info.nodata;
  if (info.has_voids) return std::numeric_limits<double>::quiet_NaN();
  return std::nullopt;
}

/// A sentence that says why a component is no raster; "" if it is one.
std::string whyNoRaster(tks_part part, const tks_info& info) {
  const bool heights = part == TKS_PART_HEIGHTS;
  const bool there = heights ? info.has_heights != 0 : info.has_texture != 0;
  if (!there) return std::string("The stream has no ") + partName(part) + ".";
  if ((heights ? info.domain : info.texture_domain) != TKS_DOMAIN_FOREST) return "";
  if (!heights) return "The texture lies on square patches, which GDAL cannot show as one raster.";
  if (isGridOnCube(info)) return "";
  return "The heights lie on square patches that were not made of a geographic grid, and GDAL "
         "cannot show them as one raster.";
}

struct Size {
  uint32_t width, height;
};

/// Of the raster that the georeference of the heights is about.
Size placedSize(const tks_info& info) {
  return info.grid_width > 0 ? Size{info.grid_width, info.grid_height}
                             : Size{info.width, info.height};
}

/// Of a texture that has none: it reaches from the middle of the first sample of the heights to
/// that of the last, as on all meshes.
std::array<double, 6> drapedTransform(const tks_info& info) {
  const auto& [x0, a, b, y0, c, d] = info.geotransform;
  const auto [width, height] = placedSize(info);
  const double across = std::max(width - 1.0, 1.0) / info.texture_width;
  const double down = std::max(height - 1.0, 1.0) / info.texture_height;
  return {x0 + (a + b) / 2, a * across, b * down, y0 + (c + d) / 2, c * across, d * down};
}

}  // namespace

std::unique_ptr<Dataset> Dataset::of(std::shared_ptr<Source> source, tks_part part,
                                     std::optional<uint32_t> frame) {
  const tks_info& facts = source->info();
  const std::string why = whyNoRaster(part, facts);
  if (!why.empty()) {
    const bool there = part == TKS_PART_HEIGHTS ? facts.has_heights != 0 : facts.has_texture != 0;
    reportFailure(there ? TKS_UNSUPPORTED : TKS_USAGE, source->name(), why);
    return nullptr;
  }
  source->choose(part, frame);
  const bool heights = part == TKS_PART_HEIGHTS;
  const bool may_be_void = heights && source->cubeDepth() == 0;
  const std::optional<double> voids = may_be_void ? voidValueOf(facts) : std::nullopt;
  std::unique_ptr<Dataset> dataset(new Dataset(std::move(source), voids));
  dataset->takeFacts();
  if (!dataset->takePlace(facts, heights)) return nullptr;
  dataset->addOverviews();
  return dataset;
}

void Dataset::beFile(char** siblings) {
  tks_info facts = source_->info();
  if (!whyNoRaster(TKS_PART_TEXTURE, facts).empty()) facts.has_texture = 0;
  if ((facts.has_heights && facts.has_texture) || source_->hasFurtherComponents()) {
    CPLStringList list = subdatasetsOf(source_->name(), facts, 0, facts.frames);
    addComponents(*source_, list);
    GDALDataset::SetMetadata(list.List(), "SUBDATASETS");
  }
  SetDescription(source_->name().c_str());
  loadBeside(siblings);
}

void Dataset::beSubdataset(const char* description, const std::string& selection, char** siblings) {
  SetDescription(description);
  SetPhysicalFilename(source_->name().c_str());
  if (!selection.empty()) SetSubdatasetName(selection.c_str());
  loadBeside(siblings);
}

Dataset::Dataset(std::shared_ptr<Source> source, std::optional<double> void_value)
    : source_(std::move(source)), void_value_(void_value) {
  addBands();
}

Dataset::Dataset(Dataset& raster, uint32_t level)
    : source_(raster.source_), void_value_(raster.void_value_), level_(level), raster_(&raster) {
  nPamFlags |= GPF_NOSAVE;
  addBands();
}

void Dataset::addBands() {
  nRasterXSize = static_cast<int>(source_->width(level_));
  nRasterYSize = static_cast<int>(source_->height(level_));
  const tks_info& info = source_->info();
  for (uint32_t channel = 0; channel < source_->channels(); ++channel) {
    BandFacts facts;
    if (!isHeights()) facts.colour = colourOf(source_->channels(), channel, source_->hasAlpha());
    if (isHeights()) {
      if (source_->frames() > 1) facts.colour = GCI_Undefined;
      // A cube has no voids, and what is interpolated may be any number.
      if (info.has_nodata && source_->cubeDepth() == 0) facts.nodata = info.nodata;
      facts.scaling = {info.scale, info.offset};
      facts.unit = info.unit;
    }
    SetBand(static_cast<int>(channel) + 1,
            makeBand(*this, static_cast<int>(channel) + 1, std::move(facts)));
  }
  if (source_->channels() > 1)
    GDALDataset::SetMetadataItem("INTERLEAVE", "PIXEL", "IMAGE_STRUCTURE");
}

void Dataset::takeFacts() {
  const tks_info& info = source_->info();
  const bool exact = info.lossless && source_->complete() && source_->cubeDepth() == 0;
  GDALDataset::SetMetadataItem("COMPRESSION_REVERSIBILITY", exact ? "LOSSLESS" : "LOSSY",
                               "IMAGE_STRUCTURE");
  const auto registration = isHeights() ? info.registration : info.texture_registration;
  if (registration == TKS_REGISTRATION_AREA) texts_.registration = GDALMD_AOP_AREA;
  if (registration == TKS_REGISTRATION_POINT) texts_.registration = GDALMD_AOP_POINT;
  if (!texts_.registration.empty())
    GDALDataset::SetMetadataItem(GDALMD_AREA_OR_POINT, texts_.registration.c_str());
  tellStream();
  if (!isHeights()) return;
  texts_.description = info.description;
  for (auto&& band : GetBands()) band->GDALRasterBand::SetDescription(info.description);
}

bool Dataset::takePlace(const tks_info& info, bool heights) {
  const auto take = [this](const double(&transform)[6]) {
    transform_.emplace();
    std::copy_n(transform, 6, transform_->begin());
  };
  const std::string& file = source_->name();
  if (heights) {
    if (info.has_geotransform) take(info.geotransform);
    crs_ = readCrs({info.crs, info.vertical_datum, info.geo_keys}, file);
    // Where nothing is known of the CRS, the grid of a cube is in degrees.
    return source_->cubeDepth() == 0 || source_->placeGrid(crs_ ? degreesOf(crs_.get()) : 1);
  }
  const bool own = *info.texture_crs != '\0' || *info.texture_geo_keys != '\0';
  if (info.texture_has_geotransform) {
    take(info.texture_geotransform);
  } else if (info.has_geotransform && !own) {
    transform_ = drapedTransform(info);
  }
  crs_ = own ? readCrs({info.texture_crs, "", info.texture_geo_keys}, file)
             : readCrs({info.crs, "", info.geo_keys}, file);
  if (crs_ && !own) crs_->StripVertical();
  return true;
}

void Dataset::addOverviews() {
  // An overview is made of the level below, but on a cube it is that level.
  const uint32_t last = source_->coarsestLevel() + (source_->cubeDepth() > 0 ? 0 : 1);
  for (uint32_t level = 1; level <= last && level < 31; ++level) {
    if (std::max(source_->width(level - 1), source_->height(level - 1)) <= kOverviewEnds) return;
    overviews_.emplace_back(new Dataset(*this, level));
  }
}

CPLErr Dataset::GetGeoTransform(double* transform) {
  if (GDALPamDataset::GetGeoTransform(transform) == CE_None) return CE_None;
  if (!transform_) return CE_Failure;
  std::copy(transform_->begin(), transform_->end(), transform);
  return CE_None;
}

const OGRSpatialReference* Dataset::GetSpatialRef() const {
  const OGRSpatialReference* const pam = GDALPamDataset::GetSpatialRef();
  return pam != nullptr ? pam : crs_.get();
}

char** Dataset::GetFileList() {
  char** files = GDALPamDataset::GetFileList();
  if (CSLFindString(files, source_->name().c_str()) < 0)
    files = CSLInsertString(files, 0, source_->name().c_str());
  return files;
}

CPLErr Dataset::IBuildOverviews(const char*, int, const int*, int, const int*, GDALProgressFunc,
                                void*, CSLConstList) {
  return refuseOverviews(source_->name());
}

CPLErr refuseOverviews(const std::string& name) {
  CPLError(CE_Failure, CPLE_NotSupported,
           "%s: A stream is its own overviews; none can be added or removed.", name.c_str());
  return CE_Failure;
}

}  // namespace tetrakis::gdal

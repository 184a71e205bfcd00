// SPDX-License-Identifier: Apache-2.0
// A band of GDAL as heights.
#include <algorithm>
#include <array>
#include <cmath>

#include "apps/doors/gdal/copied_raster.hpp"
#include "apps/doors/gdal/copied_samples.hpp"
#include "apps/doors/gdal/copied_voids.hpp"
#include "apps/doors/gdal/ground_spacing.hpp"
#include "apps/doors/gdal/source.hpp"
#include "base/coordinates.hpp"

namespace tetrakis::gdal {
namespace {

/// A scale of 0 would make all heights one.
double scaleOf(const std::string& name, GDALRasterBand& band) {
  const double scale = band.GetScale();
  if (scale != 0 && std::isfinite(scale)) return scale;
  CPLError(CE_Warning, CPLE_AppDefined, "%s: A scale of %g is none and is left out.", name.c_str(),
           scale);
  return 1;
}

/// Of the rows of a geographic grid, so that errors count by area as those of the command line do.
void takeLatitudes(const Place& place, const OGRSpatialReference* system, tks_heights& heights) {
  if (!place.has_geotransform) return;
  const std::array<double, 2> latitudes =
      edgeLatitudes({1, heights.height, place.geotransform}, degreesOf(system));
  heights.first_latitude = latitudes[0];
  heights.last_latitude = latitudes[1];
}

/// What the dataset says of its band, but for voids.
void takeFacts(const std::string& name, GDALRasterBand& band, CopiedHeights& copy) {
  GDALDataset& dataset = *band.GetDataset();
  tks_heights& heights = copy.heights;
  heights.scale = scaleOf(name, band);
  heights.offset = band.GetOffset();
  copy.unit = band.GetUnitType() != nullptr ? canonicalUnit(asUtf8(band.GetUnitType())) : "";
  copy.description = asUtf8(band.GetDescription());
  if (const OGRSpatialReference* const system = dataset.GetSpatialRef()) {
    copy.crs = crsTexts(*system);
    if (copy.unit.empty()) copy.unit = heightUnitOf(*system);
  }
  const Place place = placeOf(dataset);
  std::copy_n(place.geotransform, 6, heights.geotransform);
  heights.has_geotransform = place.has_geotransform;
  heights.registration = place.registration;
  heights.domain = domainOf(place, dataset.GetSpatialRef(), heights.width);
  takeLatitudes(place, dataset.GetSpatialRef(), heights);
  setGroundSpacing(dataset.GetSpatialRef(), heights);
  copy.ground = WebGround::of(dataset, copy.crs.crs);
  heights.unit = copy.unit.c_str();
  heights.description = copy.description.c_str();
  heights.crs = copy.crs.crs.c_str();
  heights.vertical_datum = copy.crs.vertical_datum.c_str();
}

}  // namespace

Place placeOf(GDALDataset& dataset) {
  Place place{};
  place.has_geotransform = dataset.GetGeoTransform(place.geotransform) == CE_None;
  if (const char* const text = dataset.GetMetadataItem(GDALMD_AREA_OR_POINT)) {
    if (EQUAL(text, GDALMD_AOP_AREA)) place.registration = TKS_REGISTRATION_AREA;
    if (EQUAL(text, GDALMD_AOP_POINT)) place.registration = TKS_REGISTRATION_POINT;
  }
  return place;
}

tks_domain domainOf(const Place& place, const OGRSpatialReference* system, uint32_t width) {
  if (!place.has_geotransform) return TKS_DOMAIN_PLANE;
  return columnsRound({width, 1, place.geotransform}, degreesOf(system)) == ColumnsRound::kOnce
             ? TKS_DOMAIN_CYLINDER
             : TKS_DOMAIN_PLANE;
}

std::unique_ptr<CopiedHeights> describeHeights(const std::string& name, GDALDataset& dataset) {
  if (dataset.GetRasterCount() != 1) {
    const std::string why = whyNoTexture(dataset);
    reportFailure(TKS_USAGE, name,
                  "Heights have one band, and the source has " +
                      std::to_string(dataset.GetRasterCount()) +
                      "; choose one (gdal_translate -b 1), and give an image as TEXTURE=." +
                      (why.empty() ? why : " " + why));
    return nullptr;
  }
  return describeBand(name, *dataset.GetRasterBand(1));
}

std::unique_ptr<CopiedHeights> describeBand(const std::string& name, GDALRasterBand& band) {
  const std::optional<tks_sample> sample = sampleOf(band);
  if (!sample) {
    reportFailure(TKS_UNSUPPORTED, name,
                  std::string("Samples of type ") + GDALGetDataTypeName(band.GetRasterDataType()) +
                      " are not supported; convert them to Int32 or Float32 (gdal_translate -ot).");
    return nullptr;
  }
  auto copy = std::make_unique<CopiedHeights>();
  tks_heights& heights = copy->heights;
  heights.size = sizeof heights;
  heights.width = static_cast<uint32_t>(band.GetXSize());
  heights.height = static_cast<uint32_t>(band.GetYSize());
  heights.sample = *sample;
  takeFacts(name, band, *copy);
  return copy;
}

bool readHeights(const std::string& name, GDALRasterBand& band, bool strict, CopiedHeights& copy,
                 const ProgressPart& progress) {
  if (!readSamples(name, band, strict, copy, progress)) return false;
  takeNodata(name, band, copy);
  if (!applyMask(name, band, copy)) return false;
  copy.heights.data = copy.samples.data();
  return true;
}

std::unique_ptr<CopiedHeights> copyHeights(const std::string& name, GDALDataset& dataset,
                                           bool strict, const ProgressPart& progress) {
  std::unique_ptr<CopiedHeights> copy = describeHeights(name, dataset);
  if (!copy) return nullptr;
  if (!readHeights(name, *dataset.GetRasterBand(1), strict, *copy, progress)) return nullptr;
  takeFill(name, strict, *copy);
  return copy;
}

}  // namespace tetrakis::gdal

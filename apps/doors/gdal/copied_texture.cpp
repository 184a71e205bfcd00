// SPDX-License-Identifier: Apache-2.0
// A dataset of GDAL as the texture of a stream.
#include <algorithm>
#include <cstdlib>
#include <functional>
#include <memory>
#include <numeric>
#include <optional>
#include <vector>

#include "apps/doors/gdal/copied_raster.hpp"
#include "apps/doors/gdal/source.hpp"
#include "apps/doors/gdal/texture_place.hpp"

namespace tetrakis::gdal {
namespace {

bool hasAlpha(GDALDataset& dataset) {
  const int last = textureBands(dataset).back();
  return dataset.GetRasterBand(last)->GetColorInterpretation() == GCI_AlphaBand;
}

/// A mask of the dataset's, or of the band's own.
bool isMasked(GDALRasterBand& band) {
  return (band.GetMaskFlags() & (GMF_ALL_VALID | GMF_NODATA | GMF_ALPHA)) == 0;
}

bool isMasked(GDALDataset& dataset) {
  for (GDALRasterBand* const band : dataset.GetBands())
    if (isMasked(*band)) return true;
  return false;
}

/// A value that GDAL hides.
bool hasNodata(GDALDataset& dataset) {
  for (GDALRasterBand* const band : dataset.GetBands())
    if ((band->GetMaskFlags() & GMF_NODATA) != 0) return true;
  return false;
}

/// Which texels any band shows: not 0.
struct Shown {
  std::vector<uint8_t> texels;
  bool differs = false;  ///< from band to band
};

/// Nothing after a reported error.
std::optional<Shown> readShown(GDALDataset& dataset) {
  const int width = dataset.GetRasterXSize(), height = dataset.GetRasterYSize();
  Shown shown;
  std::vector<uint8_t> of_band(size_t(width) * height);
  for (GDALRasterBand* const band : dataset.GetBands()) {
    if (band->GetMaskBand()->RasterIO(GF_Read, 0, 0, width, height, of_band.data(), width, height,
                                      GDT_Byte, 0, 0, nullptr) != CE_None)
      return std::nullopt;
    if (shown.texels.empty()) shown.texels = of_band;
    for (size_t i = 0; i < of_band.size(); ++i) {
      shown.differs = shown.differs || (of_band[i] != 0) != (shown.texels[i] != 0);
      shown.texels[i] |= of_band[i];
    }
  }
  return shown;
}

/// What becomes of a nodata value, of which a texture has none.
enum class Nodata { kKeptBeside, kAsAlpha };

/// The texels that are not hidden, where an alpha will say so; empty: it will not. A mask always
/// does; a nodata value does where some texels have it in all bands and others do not.
std::optional<std::vector<uint8_t>> readAlpha(const std::string& name, GDALDataset& dataset,
                                              Nodata nodata) {
  const bool masked = isMasked(dataset);
  const bool cut = masked || (nodata == Nodata::kAsAlpha && hasNodata(dataset));
  if (dataset.GetRasterCount() % 2 == 0 || !cut) {
    if (masked)
      CPLError(CE_Warning, CPLE_AppDefined,
               "%s: The mask beside the last band of the texture is not applied and not kept.",
               name.c_str());
    return std::vector<uint8_t>();
  }
  std::optional<Shown> shown = readShown(dataset);
  if (!shown) return std::nullopt;
  if (masked && shown->differs)
    CPLError(CE_Warning, CPLE_AppDefined,
             "%s: The masks of the bands of the texture differ: texels that all of them hide have "
             "alpha 0.",
             name.c_str());
  std::vector<uint8_t>& texels = shown->texels;
  const size_t hidden = std::count(texels.begin(), texels.end(), 0);
  if (hidden == 0 || (!masked && hidden == texels.size())) texels.clear();
  return std::move(texels);
}

struct DatasetCloser {
  void operator()(GDALDataset* dataset) const { GDALClose(dataset); }
};

bool readTexels(GDALDataset& dataset, const std::vector<uint8_t>& shown, CopiedTexture& copy) {
  const tks_image& image = copy.image;
  const int width = dataset.GetRasterXSize(), height = dataset.GetRasterYSize();
  const auto sample = static_cast<GSpacing>(tks_sample_bytes(image.sample));
  const GDALDataType type = dataset.GetRasterBand(1)->GetRasterDataType();
  const GSpacing pixel = sample * image.channels, line = pixel * width;
  copy.texels.resize(static_cast<size_t>(line) * height);
  const int bands = dataset.GetRasterCount();
  if (dataset.RasterIO(GF_Read, 0, 0, width, height, copy.texels.data(), width, height, type, bands,
                       textureBands(dataset).data(), pixel, line, sample, nullptr) != CE_None)
    return false;
  std::byte* alpha = copy.texels.data() + (bands * sample);
  for (const uint8_t texel : shown) {
    std::fill_n(alpha, sample, texel != 0 ? std::byte{255} : std::byte{0});
    alpha += pixel;
  }
  return true;
}

std::unique_ptr<CopiedTexture> copyTexels(const std::string& name, GDALDataset& dataset,
                                          Nodata nodata) {
  const std::optional<std::vector<uint8_t>> shown = readAlpha(name, dataset, nodata);
  if (!shown) return nullptr;
  auto copy = std::make_unique<CopiedTexture>();
  tks_image& image = copy->image;
  image.size = sizeof image;
  image.width = static_cast<uint32_t>(dataset.GetRasterXSize());
  image.height = static_cast<uint32_t>(dataset.GetRasterYSize());
  image.channels = static_cast<uint32_t>(dataset.GetRasterCount() + !shown->empty());
  image.sample = dataset.GetRasterBand(1)->GetRasterDataType() == GDT_Byte ? TKS_U8 : TKS_U16;
  image.opaque = shown->empty() && !hasAlpha(dataset);
  if (const char* const white = dataset.GetMetadataItem("WHITE_LEVEL", "TKS"))
    image.white_level = static_cast<uint32_t>(std::strtoul(white, nullptr, 10));
  if (!readTexels(dataset, *shown, *copy)) return nullptr;
  if (const OGRSpatialReference* const system = dataset.GetSpatialRef())
    copy->crs = crsTexts(*system);
  const Place place = placeOf(dataset);
  std::copy_n(place.geotransform, 6, image.geotransform);
  image.has_geotransform = place.has_geotransform;
  image.registration = place.registration;
  image.domain = domainOf(place, dataset.GetSpatialRef(), image.width);
  image.crs = copy->crs.crs.c_str();
  copy->ground = WebGround::of(dataset, copy->crs.crs);
  image.data = copy->texels.data();
  return copy;
}

}  // namespace

std::string whyNoTexture(GDALDataset& dataset) {
  const int bands = dataset.GetRasterCount();
  if (bands < 1 || bands > 4)
    return "A texture has 1 to 4 bands, and this has " + std::to_string(bands) + ".";
  const GDALDataType type = dataset.GetRasterBand(1)->GetRasterDataType();
  for (int band = 1; band <= bands; ++band) {
    GDALRasterBand& each = *dataset.GetRasterBand(band);
    if (each.GetRasterDataType() != type || (type != GDT_Byte && type != GDT_UInt16))
      return "A texture has bands of Byte, or all of UInt16 (gdal_translate -ot).";
    if (each.GetColorTable() != nullptr)
      return "A texture has no colour table (gdal_translate -expand rgb).";
  }
  if (bands % 2 != 0 && hasAlpha(dataset)) {
    return "The bands of a texture are grey or RGB, then alpha or a further colour "
           "(gdal_translate -b, -colorinterp).";
  }
  return "";
}

std::vector<int> textureBands(GDALDataset& dataset) {
  const auto rank = [&](int band) {
    switch (dataset.GetRasterBand(band)->GetColorInterpretation()) {
      case GCI_RedBand:
        return 0;
      case GCI_GreenBand:
        return 1;
      case GCI_BlueBand:
        return 2;
      case GCI_AlphaBand:
        return 4;
      default:
        return 3;
    }
  };
  std::vector<int> bands(static_cast<size_t>(dataset.GetRasterCount()));
  std::iota(bands.begin(), bands.end(), 1);
  std::stable_sort(bands.begin(), bands.end(), [&](int a, int b) { return rank(a) < rank(b); });
  return bands;
}

bool isPicture(GDALDataset& dataset) {
  return dataset.GetRasterCount() > 1 && whyNoTexture(dataset).empty();
}

std::unique_ptr<CopiedTexture> copyTexture(const std::string& name, const std::string& file,
                                           GDALDataset& heights) {
  const std::unique_ptr<GDALDataset, DatasetCloser> dataset(
      GDALDataset::Open(file.c_str(), GDAL_OF_RASTER | GDAL_OF_VERBOSE_ERROR));
  if (!dataset) return nullptr;
  if (const std::string why = whyNoTexture(*dataset); !why.empty()) {
    reportFailure(TKS_USAGE, name, "TEXTURE=" + file + ": " + why);
    return nullptr;
  }
  const auto warn = [&](const char* what) {
    CPLError(CE_Warning, CPLE_AppDefined, "%s: TEXTURE=%s %s.", name.c_str(), file.c_str(), what);
  };
  if (dataset->GetRasterCount() % 2 == 0 && hasNodata(*dataset))
    warn("has a nodata value beside its last band, which is not applied and not kept");
  if (liesBeside(*dataset, heights))
    warn("lies beside the ground of the heights, which get its border");
  std::unique_ptr<CopiedTexture> copy = copyTexels(name, *dataset, Nodata::kAsAlpha);
  if (copy && dataset->GetSpatialRef() == nullptr)  // its place is in the CRS of the heights
    copy->image.domain = domainOf(placeOf(*dataset), heights.GetSpatialRef(), copy->image.width);
  return copy;
}

std::unique_ptr<CopiedTexture> copyPicture(const std::string& name, GDALDataset& dataset) {
  if (dataset.GetRasterCount() == 2 && !hasAlpha(dataset)) {
    CPLError(CE_Warning, CPLE_AppDefined,
             "%s: The two bands were taken for a texture, grey and a further colour; for heights "
             "choose one (gdal_translate -b 1).",
             name.c_str());
  }
  return copyTexels(name, dataset, Nodata::kKeptBeside);
}

}  // namespace tetrakis::gdal

// SPDX-License-Identifier: Apache-2.0
#include "apps/doors/gdal/create_copy.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <new>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <gdal_pam.h>
#include "apps/doors/gdal/copied_raster.hpp"
#include "apps/doors/gdal/copied_samples.hpp"
#include "apps/doors/gdal/cube.hpp"
#include "apps/doors/gdal/dataset.hpp"
#include "apps/doors/gdal/ground_positions.hpp"
#include "apps/doors/gdal/mosaic_copy.hpp"
#include "apps/doors/gdal/output_file.hpp"

namespace tetrakis::gdal {
namespace {

constexpr double kReadShare = 0.1;  ///< of the progress; encoding has the rest

struct Stream {
  tks_buffer buffer{};
  Stream() = default;
  ~Stream() { tks_free_buffer(&buffer); }
  Stream(const Stream&) = delete;
  Stream& operator=(const Stream&) = delete;

  std::span<const uint8_t> bytes() const { return {buffer.data, buffer.size}; }
};

/// The progress function of an encoder, which notes whether it was stopped.
struct Watch {
  ProgressPart part;
  bool stopped = false;

  static int call(void* user, double done) {
    auto& watch = *static_cast<Watch*>(user);
    // 1 is for the complete file.
    watch.stopped = watch.stopped || !watch.part.report(0.999 * done);
    return watch.stopped ? 1 : 0;
  }
};

/// What goes into the stream: at least one of the two.
struct Parts {
  std::unique_ptr<CopiedHeights> heights;
  std::unique_ptr<CopiedTexture> texture;

  const tks_heights* heightsOrNull() const { return heights ? &heights->heights : nullptr; }
  const tks_image* textureOrNull() const { return texture ? &texture->image : nullptr; }
  /// Of the heights before they came here, in their unit.
  double rounding() const {
    return heights ? heights->rounding * std::abs(heights->heights.scale) : 0;
  }
};

/// Whether a plane lies in several regions (docs/FORMAT.md, section 5.1). `most`: samples of those
/// that do not unless a side is given.
bool isInRegions(uint32_t width, uint32_t height, uint32_t side, uint64_t most) {
  if (side == 0) return uint64_t{width} * height > most;
  return uint64_t{std::max(width, height)} + side / 2 >= 2 * uint64_t{side};
}

/// Lossless streams all of which lies in regions are laid out for windows: this takes about 1 % of
/// the bytes, and a window a tenth of the time. They are hardly ever cut.
tks_index indexOf(const Parts& parts, const CopySettings& settings) {
  constexpr uint64_t kOneRegion = 1025 * 1025, kOneRegionOfTexels = 2048 * 2048;
  const tks_encode_options& options = settings.encode;
  if (settings.index) return *settings.index;
  const tks_heights* const heights = parts.heightsOrNull();
  const tks_image* const image = parts.textureOrNull();
  const bool whole = (heights != nullptr &&
                      !isInRegions(heights->width, heights->height, options.regions, kOneRegion)) ||
                     (image != nullptr && !isInRegions(image->width, image->height, options.regions,
                                                       kOneRegionOfTexels));
  return options.lossless && options.regions != 1 && !whole ? TKS_INDEX_WINDOWS : TKS_INDEX_NONE;
}

/// Longitudes and latitudes for web pages.
void addPlaces(const std::string& name, Parts& parts, const tks_encode_options& options) {
  const uint64_t most = positionBytes(parts.heightsOrNull(), parts.textureOrNull(), options);
  addPositions(name, parts.heights.get(), parts.texture.get(), most);
}

/// With the level that was asked for. Nothing after a reported error.
std::optional<Parts> withWhiteLevel(Parts parts, const std::string& name,
                                    const CopySettings& settings) {
  if (settings.white_level == 0) return parts;
  if (!parts.texture) {
    reportFailure(TKS_USAGE, name, "WHITE_LEVEL is of a texture, and there is none.");
    return std::nullopt;
  }
  parts.texture->image.white_level = settings.white_level;
  return parts;
}

/// On the domain that was asked for, or else on that of their columns, a texture without a place on
/// that of the heights. What goes to a cube lies on a grid here.
Parts onDomain(Parts parts, const CopySettings& settings) {
  if (settings.domain == TKS_DOMAIN_FOREST) return parts;
  if (parts.heights) {
    tks_heights& heights = parts.heights->heights;
    heights.domain = settings.domain.value_or(heights.domain);
  }
  if (parts.texture) {
    tks_image& image = parts.texture->image;
    if (parts.heights && !image.has_geotransform) image.domain = parts.heights->heights.domain;
    image.domain = settings.domain.value_or(image.domain);
  }
  return parts;
}

/// A picture alone. Nothing after a reported error.
std::optional<Parts> readPicture(const std::string& name, GDALDataset& source,
                                 const CopySettings& settings) {
  const bool cube = settings.domain == TKS_DOMAIN_FOREST;
  if (settings.max_z_error > 0 || cube) {
    reportFailure(TKS_USAGE, name,
                  CPLSPrintf("%s needs heights, and the source was taken for a texture, since it "
                             "has %d bands; for heights choose one (gdal_translate -b 1).",
                             cube ? "DOMAIN=CUBE" : "MAX_Z_ERROR", source.GetRasterCount()));
    return std::nullopt;
  }
  Parts parts;
  parts.texture = copyPicture(name, source);
  if (!parts.texture) return std::nullopt;
  return withWhiteLevel(onDomain(std::move(parts), settings), name, settings);
}

/// Nothing after a reported error.
std::optional<Parts> readParts(const std::string& name, GDALDataset& source, bool strict,
                               const CopySettings& settings, const ProgressPart& progress) {
  if (settings.texture.empty() && isPicture(source)) return readPicture(name, source, settings);
  Parts parts;
  parts.heights = copyHeights(name, source, strict, progress);
  if (!parts.heights) return std::nullopt;
  if (!settings.texture.empty()) parts.texture = copyTexture(name, settings.texture, source);
  if (!settings.texture.empty() && !parts.texture) return std::nullopt;
  return withWhiteLevel(onDomain(std::move(parts), settings), name, settings);
}

/// A texture without a place of its own has that of the grid, edge to edge, before this goes to a
/// cube.
void placeOver(const CopiedHeights& grid, CopiedTexture& texture) {
  tks_image& image = texture.image;
  if (image.has_geotransform || !grid.heights.has_geotransform) return;
  const double across = static_cast<double>(grid.heights.width) / image.width,
               down = static_cast<double>(grid.heights.height) / image.height;
  const double* const t = grid.heights.geotransform;
  const std::array transform = {t[0], t[1] * across, t[2] * down, t[3], t[4] * across, t[5] * down};
  std::copy(transform.begin(), transform.end(), image.geotransform);
  image.has_geotransform = 1;
  image.domain = grid.heights.domain;
  texture.crs = grid.crs;
  image.crs = texture.crs.crs.c_str();
}

/// On a cube, if one is asked for. False after a reported error.
bool resampled(const std::string& name, GDALDataset& source, const CopySettings& settings,
               Parts& parts) {
  if (settings.domain != TKS_DOMAIN_FOREST) return true;
  if (parts.texture) placeOver(*parts.heights, *parts.texture);
  const double degrees = degreesOf(source.GetSpatialRef());
  return resampleOnCube(name, {settings.depth, settings.encode.threads, degrees}, *parts.heights);
}

bool encode(const std::string& name, const Parts& parts, CopySettings settings, Watch watch,
            Stream& out) {
  tks_encode_options& options = settings.encode;
  const std::optional<double> bound = boundOf(name, parts.heights.get(), settings.max_z_error);
  if (!bound) return false;
  options.max_error = *bound;
  options.index = indexOf(parts, settings);
  options.progress = Watch::call;
  options.user = &watch;
  char sentence[512] = "";
  const tks_status status = tks_encode(parts.heightsOrNull(), parts.textureOrNull(), &options,
                                       &out.buffer, sentence, sizeof sentence);
  if (status == TKS_OK) return true;
  if (watch.stopped) {
    CPLError(CE_Failure, CPLE_UserInterrupt, "%s: Stopped by the user.", name.c_str());
  } else {
    reportFailure(status, name, sentence);
  }
  return false;
}

/// What the stream has no room for of the dataset and its bands, masks being nodata values by now.
void cloneInfo(GDALPamDataset& copy, GDALDataset& source, bool heights) {
  copy.CloneInfo(&source, GCIF_METADATA | GCIF_GCPS | GCIF_ONLY_IF_MISSING);
  int flags = GCIF_PAM_DEFAULT & ~GCIF_MASK;
  // The stream has these of heights, and says which band of a texture has which colour. The nodata
  // value of heights is what their samples hold by now.
  flags &= heights ? ~(GCIF_SCALEOFFSET | GCIF_UNITTYPE | GCIF_NODATA) : ~GCIF_COLORINTERP;
  int number = 1;
  for (const int band : textureBands(source)) {
    auto* const of_copy = static_cast<GDALPamRasterBand*>(copy.GetRasterBand(number++));
    of_copy->CloneInfo(source.GetRasterBand(band), flags);
  }
}

/// What the stream has no room for goes into name.aux.xml; so does a reference system that comes
/// back as another (one with an epoch). `rounding`: of the heights, in their unit.
GDALDataset* openCopy(const std::string& name, GDALDataset& source, double rounding) {
  VSIUnlink((name + ".aux.xml").c_str());  // of a file that was there before
  GDALOpenInfo info(name.c_str(), GA_ReadOnly);
  auto* const copy = static_cast<Dataset*>(Dataset::Open(&info));
  if (copy == nullptr) return nullptr;
  cloneInfo(*copy, source, copy->isHeights());
  const OGRSpatialReference* const wanted = source.GetSpatialRef();
  const OGRSpatialReference* const got = copy->GetSpatialRef();
  const char* const options[] = {"IGNORE_DATA_AXIS_TO_SRS_AXIS_MAPPING=YES", "CRITERION=EQUIVALENT",
                                 nullptr};
  if (wanted != nullptr && (got == nullptr || !got->IsSame(wanted, options)))
    copy->GDALPamDataset::SetSpatialRef(wanted);
  if (rounding > 0) copy->tellRounding(rounding);
  return copy;
}

/// A stream that has gone where it cannot be read again, out of memory. Nothing goes beside it.
GDALDataset* openPassedOn(const Stream& stream) {
  const std::string name =
      CPLSPrintf("/vsimem/tetrakis-%p.tks", static_cast<void*>(stream.buffer.data));
  if (!writeFile(name, stream.bytes())) return nullptr;
  GDALOpenInfo info(name.c_str(), GA_ReadOnly);
  GDALDataset* const copy = Dataset::Open(&info);
  VSIUnlink(name.c_str());  // it stays as long as it is open
  return copy;
}

/// False, and no file, if the user stops.
bool reportEnd(const std::string& name, const Progress& progress) {
  if (ProgressPart(progress, 0, 1).report(1)) return true;
  discard(name);
  CPLError(CE_Failure, CPLE_UserInterrupt, "%s: Stopped by the user.", name.c_str());
  return false;
}

GDALDataset* copyInMemory(const std::string& name, GDALDataset& source, bool strict,
                          const CopySettings& settings, const Progress& progress) {
  Stream stream;
  double rounding = 0;
  {
    std::optional<Parts> parts =
        readParts(name, source, strict, settings, {progress, 0, kReadShare});
    if (parts) addPlaces(name, *parts, settings.encode);
    if (!parts || !resampled(name, source, settings, *parts) ||
        !encode(name, *parts, settings, {{progress, kReadShare, 1}}, stream))
      return nullptr;
    rounding = parts->rounding();
  }
  if (!writeFile(name, stream.bytes()) || !reportEnd(name, progress)) return nullptr;
  return isFile(name) ? openCopy(name, source, rounding) : openPassedOn(stream);
}

GDALDataset* copyTo(const std::string& name, GDALDataset& source, bool strict,
                    const CopySettings& settings, const Progress& progress) {
  if (settings.frames) {
    if (!writeFrames(name, source, strict, settings, progress) || !reportEnd(name, progress))
      return nullptr;
    VSIUnlink((name + ".aux.xml").c_str());  // of a file that was there before
    GDALOpenInfo info(name.c_str(), GA_ReadOnly);
    return Dataset::Open(&info);
  }
  if (!wantsMosaic(source, settings)) return copyInMemory(name, source, strict, settings, progress);
  const MosaicCopy mosaic = writeMosaic(name, source, strict, settings, progress);
  if (mosaic.written)
    return reportEnd(name, progress) ? openCopy(name, source, mosaic.rounding) : nullptr;
  if (mosaic.why_not.empty()) return nullptr;
  if (settings.tiles) {
    reportFailure(TKS_USAGE, name, "TILES does not go with the rest: " + mosaic.why_not);
    return nullptr;
  }
  CPLError(CE_Warning, CPLE_AppDefined, "%s: All heights are held in memory: %s", name.c_str(),
           mosaic.why_not.c_str());
  return copyInMemory(name, source, strict, settings, progress);
}

}  // namespace

GDALDataset* writeCopy(const std::string& name, GDALDataset& source, bool strict,
                       const CopySettings& settings, const Progress& progress) {
  try {
    return copyTo(name, source, strict, settings, progress);
  } catch (const std::bad_alloc&) {
    reportFailure(TKS_NO_MEMORY, name, "");
    return nullptr;
  }
}

GDALDataset* createCopy(const char* name, GDALDataset* source, int strict, char** options,
                        GDALProgressFunc progress, void* user) {
  const std::optional<CopySettings> settings = copySettings(name, options);
  if (!settings) return nullptr;
  return writeCopy(name, *source, strict != FALSE, *settings, {progress, user});
}

}  // namespace tetrakis::gdal

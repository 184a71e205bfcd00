// SPDX-License-Identifier: Apache-2.0
#include "doors/gdal/create_copy.hpp"

#include <cmath>
#include <memory>
#include <new>
#include <optional>
#include <string>
#include <utility>

#include <cpl_vsi_error.h>
#include <gdal_pam.h>
#include "doors/gdal/copied_raster.hpp"
#include "doors/gdal/dataset.hpp"
#include "doors/gdal/settings.hpp"

namespace tetrakis::gdal {
namespace {

constexpr double kReadShare = 0.1;  ///< of the progress; encoding has the rest

struct Stream {
  tks_buffer buffer{};
  Stream() = default;
  ~Stream() { tks_free_buffer(&buffer); }
  Stream(const Stream&) = delete;
  Stream& operator=(const Stream&) = delete;
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
};

/// Nothing after a reported error.
std::optional<Parts> readParts(const std::string& name, GDALDataset& source, bool strict,
                               const CopySettings& settings, const ProgressPart& progress) {
  Parts parts;
  if (settings.texture.empty() && isPicture(source)) {
    parts.texture = copyTexture(source);
    return parts.texture ? std::optional(std::move(parts)) : std::nullopt;
  }
  parts.heights = copyHeights(name, source, strict, progress);
  if (!parts.heights) return std::nullopt;
  if (settings.texture.empty()) return parts;
  parts.texture = copyTexture(name, settings.texture);
  return parts.texture ? std::optional(std::move(parts)) : std::nullopt;
}

bool encode(const std::string& name, const Parts& parts, CopySettings settings, Watch watch,
            Stream& out) {
  tks_encode_options& options = settings.encode;
  const tks_heights* const heights = parts.heightsOrNull();
  // The library counts errors in the unit of the heights, GDAL in samples.
  options.max_error = settings.max_z_error * (heights != nullptr ? std::abs(heights->scale) : 1);
  options.progress = Watch::call;
  options.user = &watch;
  char sentence[512] = "";
  const tks_status status =
      tks_encode(heights, parts.textureOrNull(), &options, &out.buffer, sentence, sizeof sentence);
  if (status == TKS_OK) return true;
  if (watch.stopped) {
    CPLError(CE_Failure, CPLE_UserInterrupt, "%s: Stopped by the user.", name.c_str());
  } else {
    reportFailure(status, name, sentence);
  }
  return false;
}

/// What was written of a stream; what is no file of its own, such as /dev/full, stays.
void discard(const std::string& name) {
  VSIStatBufL stat;
  if (VSIStatL(name.c_str(), &stat) == 0 && VSI_ISREG(stat.st_mode)) VSIUnlink(name.c_str());
}

bool write(const std::string& name, const tks_buffer& stream) {
  VSILFILE* const file = VSIFOpenExL(name.c_str(), "wb", TRUE);
  if (file == nullptr) {
    reportFailure(TKS_IO, name,
                  std::string("The file cannot be written (") + VSIGetLastErrorMsg() + ").");
    return false;
  }
  const bool written = VSIFWriteL(stream.data, 1, stream.size, file) == stream.size;
  if (VSIFCloseL(file) == 0 && written) return true;
  discard(name);
  reportFailure(TKS_IO, name, "The file cannot be written whole: is the disk full?");
  return false;
}

/// What the stream has no room for goes into name.aux.xml; so does a reference system that comes
/// back as another (one with an epoch).
GDALDataset* openCopy(const std::string& name, GDALDataset& source) {
  GDALOpenInfo info(name.c_str(), GA_ReadOnly);
  auto* const copy = static_cast<GDALPamDataset*>(Dataset::Open(&info));
  if (copy == nullptr) return nullptr;
  // Masks are nodata values by now.
  copy->CloneInfo(&source, GCIF_PAM_DEFAULT & ~(GCIF_GEOTRANSFORM | GCIF_PROJECTION | GCIF_MASK));
  const OGRSpatialReference* const wanted = source.GetSpatialRef();
  const OGRSpatialReference* const got = copy->GetSpatialRef();
  const char* const options[] = {"IGNORE_DATA_AXIS_TO_SRS_AXIS_MAPPING=YES", "CRITERION=EQUIVALENT",
                                 nullptr};
  if (wanted != nullptr && (got == nullptr || !got->IsSame(wanted, options)))
    copy->GDALPamDataset::SetSpatialRef(wanted);
  return copy;
}

GDALDataset* copyTo(const std::string& name, GDALDataset& source, bool strict,
                    const CopySettings& settings, const Progress& progress) {
  Stream stream;
  {
    const std::optional<Parts> parts =
        readParts(name, source, strict, settings, {progress, 0, kReadShare});
    if (!parts || !encode(name, *parts, settings, {{progress, kReadShare, 1}}, stream))
      return nullptr;
  }
  if (!write(name, stream.buffer)) return nullptr;
  if (!ProgressPart(progress, 0, 1).report(1)) {
    discard(name);
    CPLError(CE_Failure, CPLE_UserInterrupt, "%s: Stopped by the user.", name.c_str());
    return nullptr;
  }
  return openCopy(name, source);
}

}  // namespace

GDALDataset* createCopy(const char* name, GDALDataset* source, int strict, char** options,
                        GDALProgressFunc progress, void* user) {
  const std::optional<CopySettings> settings = copySettings(name, options);
  if (!settings) return nullptr;
  try {
    return copyTo(name, *source, strict != FALSE, *settings, {progress, user});
  } catch (const std::bad_alloc&) {
    reportFailure(TKS_NO_MEMORY, name, "");
    return nullptr;
  }
}

}  // namespace tetrakis::gdal

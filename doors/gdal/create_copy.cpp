// SPDX-License-Identifier: Apache-2.0
#include "doors/gdal/create_copy.hpp"

#include <cmath>
#include <memory>
#include <new>
#include <string>

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

bool encode(const std::string& name, const CopiedHeights& heights, const CopiedTexture* texture,
            CopySettings settings, Watch watch, Stream& out) {
  tks_encode_options& options = settings.encode;
  // The library counts errors in the unit of the heights, GDAL in samples.
  options.max_error = settings.max_z_error * std::abs(heights.heights.scale);
  options.progress = Watch::call;
  options.user = &watch;
  char sentence[512] = "";
  const tks_status status =
      tks_encode(&heights.heights, texture != nullptr ? &texture->image : nullptr, &options,
                 &out.buffer, sentence, sizeof sentence);
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
    const auto heights = copyHeights(name, source, strict, {progress, 0, kReadShare});
    if (!heights) return nullptr;
    std::unique_ptr<CopiedTexture> texture;
    if (!settings.texture.empty()) {
      texture = copyTexture(name, settings.texture);
      if (!texture) return nullptr;
    }
    if (!encode(name, *heights, texture.get(), settings, {{progress, kReadShare, 1}}, stream))
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

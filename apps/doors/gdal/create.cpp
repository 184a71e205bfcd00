// SPDX-License-Identifier: Apache-2.0
#include "apps/doors/gdal/create.hpp"

#include <memory>
#include <optional>
#include <string>
#include <utility>

#include <cpl_conv.h>
#include <cpl_string.h>
#include <cpl_vsi.h>
#include <gdal_proxy.h>
#include "apps/doors/gdal/copied_raster.hpp"
#include "apps/doors/gdal/copied_samples.hpp"
#include "apps/doors/gdal/create_copy.hpp"
#include "apps/doors/gdal/dataset.hpp"
#include "apps/doors/gdal/output_file.hpp"
#include "apps/doors/gdal/settings.hpp"

namespace tetrakis::gdal {
namespace {

struct DatasetDeleter {
  void operator()(GDALDataset* dataset) const { GDALClose(dataset); }
};
using OwnedDataset = std::unique_ptr<GDALDataset, DatasetDeleter>;

/// A GeoTIFF that takes whatever GDAL may set. It loses its name at once where the system allows
/// that, so that it goes with the process, however that ends.
class TemporaryRaster {
 public:
  TemporaryRaster(std::string name, OwnedDataset dataset)
      : name_(std::move(name)), dataset_(std::move(dataset)) {
    VSIUnlink(name_.c_str());
  }
  ~TemporaryRaster() {
    dataset_.reset();
    discard(name_);
    discard(name_ + ".aux.xml");
  }
  TemporaryRaster(const TemporaryRaster&) = delete;
  TemporaryRaster& operator=(const TemporaryRaster&) = delete;

  GDALDataset& dataset() const { return *dataset_; }

 private:
  std::string name_;
  OwnedDataset dataset_;
};

/// A band of a dataset that is being made.
class CreatedBand final : public GDALProxyRasterBand {
 public:
  CreatedBand(GDALDataset& created, GDALRasterBand& kept, bool& failed)
      : kept_(kept), failed_(failed) {
    poDS = &created;
    nBand = kept.GetBand();
    eAccess = GA_Update;
    eDataType = kept.GetRasterDataType();
    nRasterXSize = kept.GetXSize();
    nRasterYSize = kept.GetYSize();
    kept.GetBlockSize(&nBlockXSize, &nBlockYSize);
  }

  void SetDescription(const char* description) override {
    GDALProxyRasterBand::SetDescription(description);
    kept_.SetDescription(description);
  }
  CPLErr CreateMaskBand(int flags) override {
    // One band has but one mask.
    return poDS->CreateMaskBand(poDS->GetRasterCount() == 1 ? flags | GMF_PER_DATASET : flags);
  }

 protected:
  GDALRasterBand* RefUnderlyingRasterBand() const override { return &kept_; }
  CPLErr IWriteBlock(int x, int y, void* data) override {
    return noting(GDALProxyRasterBand::IWriteBlock(x, y, data), GF_Write);
  }
  CPLErr IRasterIO(GDALRWFlag flag, int x, int y, int width, int height, void* data, int columns,
                   int rows, GDALDataType type, GSpacing pixel, GSpacing line,
                   GDALRasterIOExtraArg* extra) override {
    return noting(GDALProxyRasterBand::IRasterIO(flag, x, y, width, height, data, columns, rows,
                                                 type, pixel, line, extra),
                  flag);
  }

 private:
  CPLErr noting(CPLErr error, GDALRWFlag flag) {
    failed_ = failed_ || (flag == GF_Write && error != CE_None);
    return error;
  }

  GDALRasterBand& kept_;
  bool& failed_;
};

class CreatedDataset final : public GDALProxyDataset {
 public:
  CreatedDataset(std::string name, CopySettings settings, std::unique_ptr<TemporaryRaster> raster)
      : name_(std::move(name)), settings_(std::move(settings)), raster_(std::move(raster)) {
    GDALDataset& kept = raster_->dataset();
    eAccess = GA_Update;
    nRasterXSize = kept.GetRasterXSize();
    nRasterYSize = kept.GetRasterYSize();
    for (int band = 1; band <= kept.GetRasterCount(); ++band)
      SetBand(band, new CreatedBand(*this, *kept.GetRasterBand(band), failed_));
  }
  ~CreatedDataset() override { finish(); }

  GDALDriver* GetDriver() override { return poDriver; }
  /// There is none yet.
  char** GetFileList() override { return nullptr; }
  CPLErr CreateMaskBand(int flags) override {
    if ((flags & GMF_PER_DATASET) == 0) {
      CPLError(CE_Failure, CPLE_NotSupported,
               "%s: A texture has one mask for all bands (GMF_PER_DATASET).", name_.c_str());
      return CE_Failure;
    }
    const CPLConfigOptionSetter inside("GDAL_TIFF_INTERNAL_MASK", "YES", false);
    return raster_->dataset().CreateMaskBand(GMF_PER_DATASET);
  }

 protected:
  GDALDataset* RefUnderlyingDataset() const override { return &raster_->dataset(); }
  CPLErr IBuildOverviews(const char*, int, const int*, int, const int*, GDALProgressFunc, void*,
                         CSLConstList) override {
    return refuseOverviews(name_);
  }
  CPLErr IRasterIO(GDALRWFlag flag, int x, int y, int width, int height, void* data, int columns,
                   int rows, GDALDataType type, int bands, BandMap map, GSpacing pixel,
                   GSpacing line, GSpacing band, GDALRasterIOExtraArg* extra) override {
    const CPLErr error = GDALProxyDataset::IRasterIO(flag, x, y, width, height, data, columns, rows,
                                                     type, bands, map, pixel, line, band, extra);
    failed_ = failed_ || (flag == GF_Write && error != CE_None);
    return error;
  }

 private:
  /// All that was written becomes the file.
  void finish() {
    if (!failed_) {
      CPLErrorReset();
      raster_->dataset().FlushCache(false);
      failed_ = CPLGetLastErrorType() >= CE_Failure;
    }
    if (failed_) {
      reportFailure(TKS_IO, name_,
                    "There is no such file, because what goes into it could not be kept.");
      return;
    }
    OwnedDataset(writeCopy(name_, raster_->dataset(), false, settings_, {}));
  }

  std::string name_;
  CopySettings settings_;
  std::unique_ptr<TemporaryRaster> raster_;
  bool failed_ = false;
};

/// Null after a reported error.
std::unique_ptr<TemporaryRaster> makeRaster(const std::string& name, int width, int height,
                                            int bands, GDALDataType type) {
  GDALDriver* const driver = GetGDALDriverManager()->GetDriverByName("GTiff");
  if (driver == nullptr) {
    reportFailure(TKS_UNSUPPORTED, name, "GDAL's driver GTiff is missing, which Create() needs.");
    return nullptr;
  }
  const std::string file = temporaryNameFor(name) + ".tif";
  const char* const options[] = {"SPARSE_OK=YES", "BIGTIFF=IF_SAFER", "TILED=YES",
                                 "INTERLEAVE=BAND", nullptr};
  std::string why;
  {
    const CPLErrorStateBackuper errors;
    const CPLErrorHandlerPusher quiet(CPLQuietErrorHandler);
    OwnedDataset raster(
        driver->Create(file.c_str(), width, height, bands, type, const_cast<char**>(options)));
    if (raster) return std::make_unique<TemporaryRaster>(file, std::move(raster));
    why = CPLGetLastErrorMsg();
  }
  reportFailure(TKS_IO, name,
                "The file cannot be written (a temporary one beside it: " + why + ").");
  return nullptr;
}

/// Why no stream will hold this; "": one may.
std::string whyNone(GDALDataset& raster, const CopySettings& settings) {
  if (raster.GetRasterCount() == 1) {
    if (sampleOf(*raster.GetRasterBand(1))) return "";
    return std::string("Samples of type ") +
           GDALGetDataTypeName(raster.GetRasterBand(1)->GetRasterDataType()) +
           " are not supported; write Int32 or Float32 (-ot).";
  }
  const bool cube = settings.domain == TKS_DOMAIN_FOREST;
  if (settings.max_z_error > 0 || !settings.texture.empty() || cube) {
    return "MAX_Z_ERROR, TEXTURE and DOMAIN=CUBE need heights, which have one band, and there "
           "are " +
           std::to_string(raster.GetRasterCount()) + ".";
  }
  return whyNoTexture(raster);
}

}  // namespace

GDALDataset* create(const char* name, int width, int height, int bands, GDALDataType type,
                    char** options) {
  std::optional<CopySettings> settings = copySettings(name, options);
  if (!settings) return nullptr;
  if (bands == 0) {
    reportFailure(TKS_USAGE, name, "A stream has one band or more.");
    return nullptr;
  }
  std::unique_ptr<TemporaryRaster> raster = makeRaster(name, width, height, bands, type);
  if (!raster) return nullptr;
  if (const std::string why = whyNone(raster->dataset(), *settings); !why.empty()) {
    reportFailure(TKS_USAGE, name, why);
    return nullptr;
  }
  return new CreatedDataset(name, *std::move(settings), std::move(raster));
}

}  // namespace tetrakis::gdal

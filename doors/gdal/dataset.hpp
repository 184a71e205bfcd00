// SPDX-License-Identifier: Apache-2.0
// Heights or texture of a stream as a dataset of GDAL.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <gdal_pam.h>
#include "doors/gdal/crs.hpp"
#include "doors/gdal/source.hpp"

namespace tetrakis::gdal {

class Dataset final : public GDALPamDataset {
 public:
  /// What `name` is: a file, or TKS:"file":heights or :texture. Null after a reported error.
  static GDALDataset* Open(GDALOpenInfo* info);
  static int Identify(GDALOpenInfo* info);

  CPLErr GetGeoTransform(double* transform) override;
  const OGRSpatialReference* GetSpatialRef() const override;
  char** GetFileList() override;

  /// Pixels of this raster, channels interleaved. False after a reported error.
  bool read(const tks_window& window, std::vector<std::byte>& out);
  /// Whether small parts take much less time than all.
  bool readsWindows() const { return level_ <= 1 && source_->regionSide() != 0; }
  uint32_t level() const { return level_; }
  const Source& source() const { return *source_; }
  const std::vector<std::unique_ptr<Dataset>>& overviews() const { return overviews_; }

 protected:
  CPLErr IBuildOverviews(const char* resampling, int count, const int* factors, int bands,
                         const int* band_list, GDALProgressFunc progress, void* user,
                         CSLConstList options) override;

 private:
  Dataset(std::shared_ptr<Source> source, std::optional<double> void_value, uint32_t level);

  void takePlace(const tks_info& info, bool heights);
  void takeFacts(const tks_info& info, bool heights);
  void addOverviews();
  void listSubdatasets();

  std::shared_ptr<Source> source_;
  std::optional<double> void_value_;
  uint32_t level_;  ///< 0: the raster itself; else its overview of that number
  std::optional<std::array<double, 6>> transform_;
  SpatialReference crs_;
  std::vector<std::unique_ptr<Dataset>> overviews_;
};

}  // namespace tetrakis::gdal

// SPDX-License-Identifier: Apache-2.0
// Heights or texture of a stream as a dataset of GDAL.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <gdal_pam.h>
#include "apps/doors/gdal/aux_xml.hpp"
#include "apps/doors/gdal/block_cache.hpp"
#include "apps/doors/gdal/crs.hpp"
#include "apps/doors/gdal/overview.hpp"
#include "apps/doors/gdal/source.hpp"

namespace tetrakis::gdal {

/// What newer headers of GDAL call the numbers of bands.
#ifdef BANDMAP_TYPE
using BandMap = BANDMAP_TYPE;
#else
using BandMap = int*;
#endif

/// A rectangle of samples, as GDAL counts them.
struct SampleWindow {
  int x, y, width, height;
};

class Dataset final : public GDALPamDataset {
 public:
  /// What is kept beside is written while SerializeToXML is still this class's.
  ~Dataset() override { FlushCache(true); }

  /// What a name opens: a stream, a sequence of frames, or a part of either. Null after a reported
  /// error, or where Identify() is 0.
  static GDALDataset* Open(GDALOpenInfo* info);
  static int Identify(GDALOpenInfo* info);

  /// A component of a stream, and one of its frames; without a number all frames of heights, as
  /// bands, and the first one of a texture. Null after a reported error.
  static std::unique_ptr<Dataset> of(std::shared_ptr<Source> source, tks_part part,
                                     std::optional<uint32_t> frame = std::nullopt);
  /// It is what the name of the file opens, and takes what is beside; siblings: files in its
  /// folder, or null.
  void beFile(char** siblings);
  /// It is what another name opens, or an option. selection: what it has beside is kept by this
  /// name; "": it is what the file's own name opens. siblings: as of beFile().
  void beSubdataset(const char* description, const std::string& selection, char** siblings);
  /// What is beside the file is not about this, and nothing of it is kept there.
  void keepNothing() { nPamFlags |= GPF_NOSAVE; }

  CPLErr GetGeoTransform(double* transform) override;
  const OGRSpatialReference* GetSpatialRef() const override;
  char** GetFileList() override;
  char** GetMetadata(const char* domain) override;
  const char* GetMetadataItem(const char* name, const char* domain) override;

  /// Rounding has taken so much of the heights before they came into this stream, in their unit:
  /// the stream does not know, so it is kept beside.
  void tellRounding(double rounding);

  /// Pixels of this raster, channels interleaved. False after a reported error.
  bool read(const tks_window& window, std::vector<std::byte>& out);
  /// Whether small parts take much less time than all.
  bool readsWindows() const { return source_->readsWindows(finerLevel()); }
  BlockCache& blocks() { return blocks_; }
  /// Reads rows [top, bottom) with GDAL's own means; the last one says how to report progress.
  using ReadStrip = std::function<CPLErr(int, int, GDALRasterIOExtraArg*)>;
  /// Reads a window of bands strip by strip, the blocks of each of which are decoded before.
  CPLErr readStrips(const SampleWindow& window, std::span<const int> bands,
                    const GDALRasterIOExtraArg& extra, const ReadStrip& read);
  uint32_t level() const { return level_; }
  /// Of an overview: the raster that it is of.
  Dataset* raster() const { return raster_; }
  const Source& source() const { return *source_; }
  /// Gives up what was decoded, until it is asked for again.
  void rest() { source_->rest(); }
  bool isHeights() const { return source_->part() == TKS_PART_HEIGHTS; }
  const std::vector<std::unique_ptr<Dataset>>& overviews() const { return overviews_; }

 protected:
  CPLErr IRasterIO(GDALRWFlag flag, int x, int y, int width, int height, void* data, int columns,
                   int rows, GDALDataType type, int bands, BandMap map, GSpacing pixel,
                   GSpacing line, GSpacing band, GDALRasterIOExtraArg* extra) override;
  CPLXMLNode* SerializeToXML(const char* path) override;
  CPLErr IBuildOverviews(const char* resampling, int count, const int* factors, int bands,
                         const int* band_list, GDALProgressFunc progress, void* user,
                         CSLConstList options) override;

 private:
  Dataset(std::shared_ptr<Source> source, std::optional<double> void_value);
  /// An overview.
  Dataset(Dataset& raster, uint32_t level);

  void addBands();

  /// False after a reported error.
  bool takePlace(const tks_info& info, bool heights);
  void takeFacts();
  /// What the domain TKS says, but for errors.
  void tellStream();
  /// Of a stream with more than heights and a texture.
  void tellComponents();
  /// What the stream states of errors: told when somebody asks, since that may read all of it.
  void tellQuality();
  /// Takes what a file beside the stream says, but for what only the stream can know.
  void loadBeside(char** siblings);
  /// Whether that file was written for another stream, which had this name.
  bool isBesideOfAnother(char** siblings);
  /// Counts in what a copy has kept beside of its rounding.
  void takeRounding();
  void addOverviews();
  /// Of an overview: whether its samples are classes, of which there are no means.
  bool hasClasses() const;
  /// What the pixels are made of.
  uint32_t finerLevel() const;
  bool makeOverview(const tks_window& part, std::byte* out);
  NodataValues nodataValues() const;

  std::shared_ptr<Source> source_;
  BlockCache blocks_{*this};
  std::optional<double> void_value_;
  uint32_t level_ = 0;         ///< 0: the raster itself; else its overview of that number
  Dataset* raster_ = nullptr;  ///< of an overview; it lives longer
  std::optional<std::array<double, 6>> transform_;
  SpatialReference crs_;
  StreamTexts texts_;
  bool quality_told_ = false;
  std::vector<std::unique_ptr<Dataset>> overviews_;
};

/// An error: gdaladdo is for other formats.
CPLErr refuseOverviews(const std::string& name);

}  // namespace tetrakis::gdal

// SPDX-License-Identifier: Apache-2.0
#include "apps/doors/gdal/mosaic_copy.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <cpl_conv.h>
#include "apps/doors/gdal/copied_samples.hpp"
#include "apps/doors/gdal/copied_voids.hpp"
#include "apps/doors/gdal/ground_positions.hpp"
#include "apps/doors/gdal/height_windows.hpp"
#include "apps/doors/gdal/mosaic_parts.hpp"
#include "apps/doors/gdal/output_file.hpp"
#include "apps/doors/gdal/source.hpp"
#include "tetrakis/mosaic.h"

namespace tetrakis::gdal {
namespace {

/// Shares of the progress: doubles that are read to know how they are rounded; the plan; all but
/// the merge.
constexpr double kNarrowed = 0.1, kPlanned = 0.2, kCoded = 0.97;

/// What coding takes for a sample, of a tile or of all heights (docs/MEASUREMENTS.md).
constexpr uint64_t kCodingBytes = 16;

uint64_t usableMemory() {
  return static_cast<uint64_t>(std::max<GIntBig>(0, CPLGetUsablePhysicalRAM()));
}

/// That was given, or else the usual one, or less where memory is short.
uint32_t tileSide(const CopySettings& settings) {
  constexpr uint64_t kUsual = 4096, kLeast = 512, kAround = 2 * 128;
  const uint32_t regions = settings.encode.regions;
  if (settings.tiles) return std::max(*settings.tiles, regions);
  uint64_t side = kUsual;
  while (side > kLeast && kCodingBytes * (side + kAround) * (side + kAround) > usableMemory() / 4)
    side /= 2;
  return std::max(static_cast<uint32_t>(side), regions);
}

/// Of options and heights; "": a mosaic does it all.
std::string whyNoMosaic(const std::string& name, GDALDataset& source,
                        const CopySettings& settings) {
  if (!settings.texture.empty() || isPicture(source) || settings.white_level > 0)
    return "Textures are not coded in tiles.";
  if (settings.encode.regions == 1) return "BLOCKSIZE=NONE needs all heights at once.";
  if (settings.domain.value_or(TKS_DOMAIN_PLANE) != TKS_DOMAIN_PLANE)
    return "What is coded in tiles is a plane.";
  if (!canBeRenamed(name)) return "What is coded in tiles needs a file that can be renamed.";
  return "";
}

/// Of what only the band tells.
std::string whyNoMosaic(GDALRasterBand& band, const tks_heights& heights) {
  if (heights.domain != TKS_DOMAIN_PLANE) {
    return "Its columns go round the Earth, and what is coded in tiles is a plane (DOMAIN=PLANE "
           "leaves a seam between the last one and the first).";
  }
  if (lacksNodata(band, heights)) {
    return "A nodata value for what the mask hides is chosen among all heights (give one with "
           "gdal_translate -a_nodata).";
  }
  return "";
}

/// The three steps of a mosaic; what goes wrong is reported.
class Tiles {
 public:
  Tiles(const std::string& name, HeightWindows& windows, const CopySettings& settings,
        const Progress& progress)
      : name_(name),
        windows_(windows),
        settings_(settings),
        progress_(progress, 0, 1),
        source_{sizeof source_, &windows.heights().heights, read, this} {}
  ~Tiles() { tks_free_buffer(&plan_); }
  Tiles(const Tiles&) = delete;
  Tiles& operator=(const Tiles&) = delete;

  /// The sentence is for what mosaics cannot promise: with TKS_USAGE nothing is reported.
  tks_status plan(bool strict, std::string& sentence);
  bool code(MosaicParts& parts);
  bool merge(MosaicParts& parts);

 private:
  static int read(void* user, const tks_window* window, void* samples);
  bool readPlanned(const tks_window& window, void* samples);
  std::optional<tks_mosaic_options> options();
  tks_layout layout() const;
  bool report(double done);
  bool fail(tks_status status, const char* sentence);

  const std::string& name_;
  HeightWindows& windows_;
  const CopySettings& settings_;
  ProgressPart progress_;
  tks_mosaic_source source_;
  tks_buffer plan_{};
  bool planning_ = false, strict_ = false, stopped_ = false;
  uint64_t read_ = 0;           ///< samples
  std::optional<double> fill_;  ///< what stands for voids, though nothing declares it
};

tks_layout Tiles::layout() const {
  const tks_index usual = settings_.encode.lossless ? TKS_INDEX_WINDOWS : TKS_INDEX_NONE;
  const tks_index index = settings_.index.value_or(usual);
  if (index == TKS_INDEX_NONE) return TKS_LAYOUT_PROGRESSIVE;
  return index == TKS_INDEX_WINDOWS ? TKS_LAYOUT_WINDOWS : TKS_LAYOUT_MIXED;
}

std::optional<tks_mosaic_options> Tiles::options() {
  const std::optional<double> bound = boundOf(name_, &windows_.heights(), settings_.max_z_error);
  if (!bound) return std::nullopt;
  tks_mosaic_options options{};
  options.size = sizeof options;
  options.bytes = settings_.encode.bytes;
  options.psnr = settings_.encode.psnr;
  options.max_error = *bound;
  options.lossless = settings_.encode.lossless;
  options.regions = settings_.encode.regions;
  if (options.regions == 0 && layout() == TKS_LAYOUT_WINDOWS) options.regions = 256;
  options.tile = std::max(tileSide(settings_), options.regions);
  return options;
}

tks_status Tiles::plan(bool strict, std::string& sentence) {
  const std::optional<tks_mosaic_options> wanted = options();
  if (!wanted) return TKS_IO;
  strict_ = strict;
  planning_ = true;
  char message[512] = "";
  tks_status status = tks_mosaic_plan(&source_, &*wanted, &plan_, message, sizeof message);
  if (fill_) declareFill(name_, strict, *fill_, windows_.heights());
  if (fill_ && !strict) {  // which has ended the first plan
    status = tks_mosaic_plan(&source_, &*wanted, &plan_, message, sizeof message);
  }
  planning_ = false;
  sentence = message;
  if (status != TKS_OK && status != TKS_USAGE) fail(status, message);
  return status;
}

int Tiles::read(void* user, const tks_window* window, void* samples) {
  auto& tiles = *static_cast<Tiles*>(user);
  if (!tiles.windows_.read(*window, samples)) return 1;
  return !tiles.planning_ || tiles.readPlanned(*window, samples) ? 0 : 1;
}

/// False: stop.
bool Tiles::readPlanned(const tks_window& window, void* samples) {
  tks_heights part = *source_.heights;
  read_ += uint64_t{window.width} * window.height;
  const double all = double(part.width) * part.height;
  if (!report(kNarrowed + (kPlanned - kNarrowed) * std::min(1.0, double(read_) / all)))
    return false;
  part.width = window.width;
  part.height = window.height;
  part.data = samples;
  if (!fill_) fill_ = fillIn(part);
  return !fill_ || strict_ || part.has_nodata;
}

bool Tiles::code(MosaicParts& parts) {
  size_t count = 0;
  tks_mosaic_tiles(plan_.data, plan_.size, nullptr, 0, &count);
  std::vector<tks_tile> tiles(count);
  tks_mosaic_tiles(plan_.data, plan_.size, tiles.data(), count, &count);
  const tks_mosaic_files files = parts.files();
  char message[512] = "";
  for (size_t i = 0; i < count; ++i) {
    if (!report(kPlanned + (kCoded - kPlanned) * double(i) / double(count)))
      return fail(TKS_IO, message);
    const tks_status status = tks_mosaic_code(plan_.data, plan_.size, tiles[i], &source_, &files,
                                              settings_.encode.threads, message, sizeof message);
    if (status != TKS_OK) return fail(status, message);
  }
  return report(kCoded) || fail(TKS_IO, message);
}

bool Tiles::merge(MosaicParts& parts) {
  StagedFile out(name_);
  if (!out.open()) return false;
  const auto write = [](void* user, uint64_t offset, const void* data, size_t size) {
    const std::span<const uint8_t> bytes(static_cast<const uint8_t*>(data), size);
    return static_cast<StagedFile*>(user)->write(offset, bytes) ? 0 : 1;
  };
  const tks_mosaic_files files = parts.files();
  char message[512] = "";
  const tks_merge_options options{sizeof options, layout(), 0};
  const tks_status status = tks_mosaic_merge(plan_.data, plan_.size, &files, &options, write, &out,
                                             message, sizeof message);
  if (status != TKS_OK) return fail(status, message);
  return out.finish();
}

bool Tiles::report(double done) {
  stopped_ = stopped_ || !progress_.report(done);
  return !stopped_;
}

bool Tiles::fail(tks_status status, const char* sentence) {
  if (stopped_) {
    CPLError(CE_Failure, CPLE_UserInterrupt, "%s: Stopped by the user.", name_.c_str());
  } else {
    reportFailure(status, name_, sentence);
  }
  return false;
}

}  // namespace

bool wantsMosaic(GDALDataset& source, const CopySettings& settings) {
  if (settings.tiles) return *settings.tiles > 0;
  if (source.GetRasterCount() != 1 || isPicture(source)) return false;
  const uint64_t samples = uint64_t(source.GetRasterXSize()) * uint64_t(source.GetRasterYSize());
  const uint64_t usable = usableMemory();
  return usable > 0 && samples > usable / 4 / kCodingBytes;
}

MosaicCopy writeMosaic(const std::string& name, GDALDataset& source, bool strict,
                       const CopySettings& settings, const Progress& progress) {
  MosaicCopy copy;
  copy.why_not = whyNoMosaic(name, source, settings);
  if (!copy.why_not.empty()) return copy;
  const std::unique_ptr<HeightWindows> windows =
      HeightWindows::of(name, source, strict, {progress, 0, kNarrowed});
  if (!windows) return copy;
  CopiedHeights& heights = windows->heights();
  heights.heights.domain = settings.domain.value_or(heights.heights.domain);
  copy.why_not = whyNoMosaic(*source.GetRasterBand(1), heights.heights);
  if (!copy.why_not.empty()) return copy;
  addPositions(name, &heights, nullptr, positionBytes(&heights.heights, nullptr, settings.encode));
  Tiles tiles(name, *windows, settings, progress);
  std::string sentence;
  const tks_status planned = tiles.plan(strict, sentence);
  if (planned == TKS_USAGE) copy.why_not = sentence;
  if (planned != TKS_OK) return copy;
  const std::unique_ptr<MosaicParts> parts = MosaicParts::beside(name);
  copy.written = parts && tiles.code(*parts) && tiles.merge(*parts);
  copy.rounding = heights.rounding * std::abs(heights.heights.scale);
  return copy;
}

}  // namespace tetrakis::gdal

// SPDX-License-Identifier: Apache-2.0
// openTiffWindows() reads windows of a TIFF. Blocks (tiles, or strips) that windows share are kept,
// up to kMostKept bytes.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <limits>
#include <list>
#include <map>
#include <string_view>
#include <utility>

#include "apps/tools/files/file_bytes.hpp"
#include "apps/tools/files/memory_limit.hpp"
#include "apps/tools/files/pictures/tiff.hpp"
#include "apps/tools/files/place/pam.hpp"
#include "apps/tools/files/text.hpp"
#include "apps/tools/files/void_samples.hpp"
#include "apps/tools/mosaic/height_source.hpp"
#include "base/nodata.hpp"
#include "base/samples.hpp"

namespace tetrakis::tools {

namespace {

constexpr size_t kMostKept = size_t{128} << 20;

/// How a TIFF stores heights.
struct StoredHeights {
  tks_sample sample = TKS_U8;
  bool wide = false;  ///< doubles, which become floats
};

Result<StoredHeights> storedHeights(TIFF* tiff, const std::string& path) {
  const uint16_t bits = shortTag(tiff, TIFFTAG_BITSPERSAMPLE);
  const uint16_t format = shortTag(tiff, TIFFTAG_SAMPLEFORMAT);
  const auto refuse = [&](const std::string& why) {
    return Status(TKS_USAGE, quoted(path) + " " + why +
                                 ": gdal_translate can make a TIFF of it that is read by windows");
  };
  if (shortTag(tiff, TIFFTAG_SAMPLESPERPIXEL) != 1) return refuse("has several channels");
  if (photometricOf(tiff) == PHOTOMETRIC_PALETTE) return refuse("has a palette");
  if (!TIFFIsCODECConfigured(shortTag(tiff, TIFFTAG_COMPRESSION)))
    return refuse("has a compression that libtiff does not read here");
  if (format == SAMPLEFORMAT_IEEEFP && bits == 32) return StoredHeights{TKS_F32};
  if (format == SAMPLEFORMAT_IEEEFP && bits == 64) return StoredHeights{TKS_F32, true};
  const bool is_signed = format == SAMPLEFORMAT_INT;
  if (!is_signed && format != SAMPLEFORMAT_UINT) return refuse("has samples of another kind");
  if (bits == 8) return StoredHeights{is_signed ? TKS_I8 : TKS_U8};
  if (bits == 16) return StoredHeights{is_signed ? TKS_I16 : TKS_U16};
  if (bits == 32) return StoredHeights{is_signed ? TKS_I32 : TKS_U32};
  return refuse("has samples of " + std::to_string(bits) + " bits");
}

/// The blocks of a TIFF, as they are stored.
struct BlockGrid {
  uint32_t width = 0, height = 0;  ///< of a block; the last strip has fewer rows
  uint32_t columns = 0;            ///< of blocks
};

BlockGrid blockGrid(TIFF* tiff, uint32_t width, uint32_t height) {
  BlockGrid grid{width, height, 1};
  if (TIFFIsTiled(tiff)) {
    TIFFGetField(tiff, TIFFTAG_TILEWIDTH, &grid.width);
    TIFFGetField(tiff, TIFFTAG_TILELENGTH, &grid.height);
    grid.columns = (width + grid.width - 1) / std::max(1u, grid.width);
  } else {
    TIFFGetFieldDefaulted(tiff, TIFFTAG_ROWSPERSTRIP, &grid.height);
    grid.height = std::min(grid.height, height);
  }
  return grid;
}

/// A block is read whole: some programs write a file as one strip.
Status checkBlocks(TIFF* tiff, const StoredHeights& stored, const HeightFile& described,
                   const std::string& path) {
  constexpr uint32_t kMostBlockSide = 1 << 20;
  const BlockGrid grid = blockGrid(tiff, described.width, described.height);
  if (grid.width == 0 || grid.height == 0 || grid.width > kMostBlockSide ||
      grid.height > kMostBlockSide)
    return {TKS_USAGE, quoted(path) + " has strips or tiles of a size that is not read"};
  const size_t sample = stored.wide ? sizeof(double) : tks_sample_bytes(stored.sample);
  return checkMemoryFor("reading a strip or tile of " + quoted(path),
                        uint64_t{grid.width} * grid.height * sample);
}

class TiffWindows : public HeightSource {
 public:
  TiffWindows(std::string path, TiffFile file, StoredHeights stored, HeightFile described)
      : path_(std::move(path)),
        file_(std::move(file)),
        stored_(stored),
        described_(std::move(described)),
        declared_(described_.nodata),
        grid_(blockGrid(file_.get(), described_.width, described_.height)) {
    if (described_.nodata && stored_.sample == TKS_F32)
      described_.nodata = narrowedNodata(*described_.nodata);
  }

  const HeightFile& described() const override { return described_; }

  Status read(const tks_window& window, std::byte* samples) override {
    const size_t sample = tks_sample_bytes(stored_.sample);
    for (uint32_t by = window.y / grid_.height; by * grid_.height < window.y + window.height;
         ++by) {
      for (uint32_t bx = window.x / grid_.width; bx * grid_.width < window.x + window.width; ++bx) {
        const Result<const Block*> block = blockOf(bx, by);
        if (!block.ok()) return block.status();
        const uint32_t x0 = std::max(window.x, bx * grid_.width),
                       x1 = std::min(window.x + window.width, (bx + 1) * grid_.width);
        const uint32_t y0 = std::max(window.y, by * grid_.height),
                       y1 = std::min(window.y + window.height, (by + 1) * grid_.height);
        for (uint32_t y = y0; y < y1; ++y) {
          const size_t from = size_t{y - by * grid_.height} * grid_.width + (x0 - bx * grid_.width);
          const size_t to = size_t{y - window.y} * window.width + (x0 - window.x);
          std::copy_n((*block)->data() + from * sample, (x1 - x0) * sample, samples + to * sample);
        }
      }
    }
    return {};
  }

  double rounding() const override { return rounding_; }
  std::vector<std::string> filesOf(const tks_window&) const override { return {path_}; }

 private:
  using Block = std::vector<std::byte>;

  Result<const Block*> blockOf(uint32_t column, uint32_t row) {
    const uint32_t number = row * grid_.columns + column;
    const auto found = kept_.find(number);
    if (found != kept_.end()) {
      order_.splice(order_.begin(), order_, found->second.place);
      return &found->second.block;
    }
    Result<Block> block = readBlock(number);
    if (!block.ok()) return block.status();
    const size_t most = std::max<size_t>(2, kMostKept / std::max<size_t>(1, block->size()));
    while (kept_.size() >= most) {
      kept_.erase(order_.back());
      order_.pop_back();
    }
    order_.push_front(number);
    return &kept_.emplace(number, Kept{*std::move(block), order_.begin()}).first->second.block;
  }

  Result<Block> readBlock(uint32_t number) {
    const size_t samples = size_t{grid_.width} * grid_.height;
    const size_t stored = stored_.wide ? sizeof(double) : tks_sample_bytes(stored_.sample);
    Block block(samples * stored);
    TIFF* const tiff = file_.get();
    if (TIFFGetStrileByteCount(tiff, number) == 0) return missing(samples);
    const auto bytes = static_cast<tmsize_t>(block.size());
    const tmsize_t read = TIFFIsTiled(tiff)
                              ? TIFFReadEncodedTile(tiff, number, block.data(), bytes)
                              : TIFFReadEncodedStrip(tiff, number, block.data(), bytes);
    if (read < 0) return file_.failure();
    if (stored_.wide) return narrowed(block);
    if (stored_.sample == TKS_F32) settle(block);
    return block;
  }

  /// What GDAL has in a block that the file leaves out.
  Block missing(size_t samples) const {
    Block block(samples * tks_sample_bytes(stored_.sample));
    withSampleType(stored_.sample, [&](auto type) {
      using T = decltype(type);
      const double value = described_.nodata.value_or(0);
      std::fill_n(reinterpret_cast<T*>(block.data()), samples,
                  std::is_integral_v<T> && std::isnan(value) ? T{} : static_cast<T>(value));
    });
    return block;
  }

  Result<Block> narrowed(const Block& wide) {
    const std::span doubles(reinterpret_cast<const double*>(wide.data()),
                            wide.size() / sizeof(double));
    Block block(doubles.size() * sizeof(float));
    auto* floats = reinterpret_cast<float*>(block.data());
    for (const double value : doubles) {
      const bool is_void = declared_ && meetsNodata(value, *declared_);
      *floats = is_void ? static_cast<float>(*described_.nodata) : toFloat(value);
      if (!is_void && std::isfinite(value) && !std::isfinite(*floats))
        return Status(TKS_USAGE,
                      tools::quoted(path_) + " holds 64-bit floats beyond the range of 32 bits");
      if (!is_void && std::isfinite(value))
        rounding_ = std::max(rounding_, std::abs(value - static_cast<double>(*floats)));
      ++floats;
    }
    return block;
  }

  void settle(Block& block) const {
    if (!declared_ || std::isnan(*declared_)) return;
    const std::span floats(reinterpret_cast<float*>(block.data()), block.size() / sizeof(float));
    for (float& value : floats)
      if (meetsNodata(value, static_cast<float>(*declared_)))
        value = static_cast<float>(*described_.nodata);
  }

  struct Kept {
    Block block;
    std::list<uint32_t>::iterator place;
  };
  std::string path_;
  TiffFile file_;
  StoredHeights stored_;
  HeightFile described_;
  std::optional<double> declared_;  ///< nodata, as the file has it
  BlockGrid grid_;
  double rounding_ = 0;
  std::map<uint32_t, Kept> kept_;
  std::list<uint32_t> order_;  ///< of the kept blocks, the last used one first
};

}  // namespace

Result<OpenSource> openTiffWindows(const std::string& path, Notes& notes) {
  Result<TiffFile> file = TiffFile::open(path, "r");
  if (!file.ok()) return file.status();
  const Result<StoredHeights> stored = storedHeights(file->get(), path);
  if (!stored.ok()) return stored.status();
  const Result<TiffForm> form = tiffForm(path);
  if (!form.ok()) return form.status();
  std::error_code ignored;
  if (form->mask || std::filesystem::exists(path + ".msk", ignored)) {
    return Status(TKS_USAGE, quoted(path) +
                                 " has a mask, in a page or beside it, which is not read by "
                                 "windows: gdal_translate -a_nodata makes voids of it");
  }
  HeightFile described;
  TIFFGetField(file->get(), TIFFTAG_IMAGEWIDTH, &described.width);
  TIFFGetField(file->get(), TIFFTAG_IMAGELENGTH, &described.height);
  described.sample = stored->sample;
  if (Status tags = readGeoTags(path, described, notes); !tags.ok()) return tags;
  takePam(path, described, notes);
  // A value that the samples cannot have is none of their voids.
  if (described.nodata && described.sample != TKS_F32)
    described.nodata = asSample(*described.nodata, described.sample);
  if (Status status = checkBlocks(file->get(), *stored, described, path); !status.ok())
    return status;
  if (stored->wide) notes.push_back({"64-bit floats become the nearest 32-bit floats", ""});
  return OpenSource(
      std::make_unique<TiffWindows>(path, *std::move(file), *stored, std::move(described)));
}

}  // namespace tetrakis::tools

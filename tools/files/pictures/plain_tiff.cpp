// SPDX-License-Identifier: Apache-2.0
// Plain TIFFs (TIFF 6.0, sections 8 and 15; 18 for sample formats).
#include "tools/files/pictures/plain_tiff.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <optional>
#include <string_view>
#include <utility>

#include "tools/files/file_bytes.hpp"
#include "tools/files/memory_limit.hpp"
#include "tools/files/pictures/tiff.hpp"

namespace tetrakis::tools {
namespace {

uint16_t tagOf(TIFF* tiff, uint32_t tag) {
  uint16_t value = 0;
  return TIFFGetFieldDefaulted(tiff, tag, &value) ? value : uint16_t{0};
}

PictureSample sampleOf(uint16_t format, uint16_t bits) {
  struct Known {
    uint16_t format, bits;
    PictureSample sample;
  };
  constexpr std::array kKnown{
      Known{SAMPLEFORMAT_UINT, 8, PictureSample::kU8},
      Known{SAMPLEFORMAT_UINT, 16, PictureSample::kU16},
      Known{SAMPLEFORMAT_UINT, 32, PictureSample::kU32},
      Known{SAMPLEFORMAT_INT, 8, PictureSample::kI8},
      Known{SAMPLEFORMAT_INT, 16, PictureSample::kI16},
      Known{SAMPLEFORMAT_INT, 32, PictureSample::kI32},
      Known{SAMPLEFORMAT_IEEEFP, 32, PictureSample::kFloat},
      Known{SAMPLEFORMAT_IEEEFP, 64, PictureSample::kDouble},
  };
  const auto* known = std::find_if(kKnown.begin(), kKnown.end(), [&](const Known& each) {
    return each.format == format && each.bits == bits;
  });
  return known == kKnown.end() ? PictureSample::kOther : known->sample;
}

/// Nothing if it is not plain. white_is_zero: whether single channels may say so.
std::optional<PictureShape> plainShape(TIFF* tiff, bool white_is_zero) {
  const auto [width, height] = sizeOfPage(tiff);
  const int channels = tagOf(tiff, TIFFTAG_SAMPLESPERPIXEL);
  // This tag has no default: 0 (white is zero) where it is missing.
  const uint16_t colours = tagOf(tiff, TIFFTAG_PHOTOMETRIC);
  const bool grey = (colours == PHOTOMETRIC_MINISBLACK && (channels == 1 || channels == 2)) ||
                    (white_is_zero && colours == PHOTOMETRIC_MINISWHITE && channels == 1);
  const bool rgb = colours == PHOTOMETRIC_RGB && (channels == 3 || channels == 4);
  const bool apart = tagOf(tiff, TIFFTAG_PLANARCONFIG) != PLANARCONFIG_CONTIG && channels > 1;
  const PictureSample sample =
      sampleOf(tagOf(tiff, TIFFTAG_SAMPLEFORMAT), tagOf(tiff, TIFFTAG_BITSPERSAMPLE));
  constexpr uint32_t kMaxSide = 0x7FFFFFFF;
  if (!(grey || rgb) || apart || sample == PictureSample::kOther) return {};
  if (std::min(width, height) == 0 || std::max(width, height) > kMaxSide) return {};
  return PictureShape{static_cast<int>(width), static_cast<int>(height), channels, sample};
}

class PlainTiff final : public PictureReader {
 public:
  PlainTiff(TiffFile file, const PictureShape& shape, std::string path)
      : file_(std::move(file)), shape_(shape), path_(std::move(path)) {}

  PictureShape shape() const override { return shape_; }
  std::string format() const override { return "tiff"; }
  bool has(const char* attribute) const override {
    uint32_t bytes = 0;
    void* profile = nullptr;
    return attribute == std::string_view("ICCProfile") &&
           TIFFGetField(file_.get(), TIFFTAG_ICCPROFILE, &bytes, &profile);
  }
  int number(const char* attribute) const override {
    const std::string_view name = attribute;
    if (name == "Orientation") return tagOf(file_.get(), TIFFTAG_ORIENTATION);
    if (name == "oiio:BitsPerSample") return tagOf(file_.get(), TIFFTAG_BITSPERSAMPLE);
    return 0;
  }
  std::string text(const char*) const override { return {}; }

  Status read(PictureSample type, std::span<std::byte> samples) override {
    if (type != shape_.sample) return converted(type, samples);
    return TIFFIsTiled(file_.get()) ? readTiles(samples) : readRows(samples);
  }

 private:
  Status converted(PictureSample type, std::span<std::byte> samples) const {
    const auto formats = pictureFormats();
    if (!formats.ok()) return formats.status();
    const auto reader = (*formats)->open(path_);
    return reader.ok() ? (*reader)->read(type, samples) : reader.status();
  }

  size_t pixelBytes() const { return size_t{1} * shape_.channels * sizeOf(shape_.sample); }

  Status readRows(std::span<std::byte> samples) const {
    const size_t row_bytes = shape_.width * pixelBytes();
    if (static_cast<size_t>(TIFFScanlineSize64(file_.get())) != row_bytes) return damaged();
    for (int y = 0; y < shape_.height; ++y) {
      const auto row = static_cast<uint32_t>(y);
      if (isMissing(file_.get(), TIFFComputeStrip(file_.get(), row, 0))) continue;
      if (TIFFReadScanline(file_.get(), &samples[y * row_bytes], row, 0) < 0) return file_.reason();
    }
    return {};
  }

  Status readTiles(std::span<std::byte> samples) const {
    uint32_t side_x = 0, side_y = 0;
    TIFFGetField(file_.get(), TIFFTAG_TILEWIDTH, &side_x);
    TIFFGetField(file_.get(), TIFFTAG_TILELENGTH, &side_y);
    const uint64_t bytes = TIFFTileSize64(file_.get());
    if (side_x == 0 || side_y == 0 || bytes != uint64_t{side_x} * side_y * pixelBytes())
      return damaged();
    if (Status memory = checkMemoryFor("reading a tile", bytes); !memory.ok()) return memory;
    std::vector<std::byte> tile(bytes);
    const auto width = static_cast<uint32_t>(shape_.width);
    const auto height = static_cast<uint32_t>(shape_.height);
    for (uint32_t y = 0; y < height; y += std::min(side_y, height - y)) {
      for (uint32_t x = 0; x < width; x += std::min(side_x, width - x)) {
        if (isMissing(file_.get(), TIFFComputeTile(file_.get(), x, y, 0, 0))) continue;
        if (TIFFReadTile(file_.get(), tile.data(), x, y, 0, 0) < 0) return file_.reason();
        const size_t row_bytes = std::min(side_x, width - x) * pixelBytes();
        for (uint32_t row = 0; row < std::min(side_y, height - y); ++row)
          std::memcpy(&samples[(size_t{y + row} * width + x) * pixelBytes()],
                      &tile[size_t{row} * side_x * pixelBytes()], row_bytes);
      }
    }
    return {};
  }

  static Status damaged() { return {TKS_IO, "its rows or tiles have another size than it says"}; }

  TiffFile file_;
  PictureShape shape_;
  std::string path_;
};

std::unique_ptr<PictureReader> openTiff(const std::string& path, bool white_is_zero) {
  auto file = TiffFile::open(path, "r");
  if (!file.ok()) return nullptr;
  const auto shape = plainShape(file->get(), white_is_zero);
  if (!shape) return nullptr;
  return std::make_unique<PlainTiff>(std::move(*file), *shape, path);
}

}  // namespace

std::unique_ptr<PictureReader> openPlainTiff(const std::string& path) {
  return openTiff(path, false);
}

std::unique_ptr<PictureReader> openStoredTiff(const std::string& path) {
  return openTiff(path, true);
}

}  // namespace tetrakis::tools

// SPDX-License-Identifier: Apache-2.0
// Blocks of TIFFs (TIFF 6.0, sections 3 and 15; planes of their own: PlanarConfiguration).
#include "apps/tools/files/pictures/tiff_picture.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <string_view>
#include <utility>

#include "apps/tools/files/file_bytes.hpp"
#include "apps/tools/files/memory_limit.hpp"
#include "apps/tools/files/pictures/picture_header.hpp"
#include "apps/tools/files/pictures/tag_number.hpp"
#include "apps/tools/files/pictures/tiff.hpp"
#include "apps/tools/files/pictures/tiff_samples.hpp"

namespace tetrakis::tools {
namespace {

/// What stands in the first directory.
struct TiffLayout {
  TiffSample stored;
  PictureShape shape;
  bool apart = false;  ///< each channel is a plane of its own
  bool ycbcr = false;  ///< libtiff makes RGB of it
  double absent = 0;   ///< in blocks that are left out
};

/// Part of a row of a block: all channels, or one.
struct RowPart {
  uint32_t x, y, width;
  uint16_t plane;
};

class TiffPicture final : public PictureReader {
 public:
  TiffPicture(TiffFile file, const TiffLayout& layout) : file_(std::move(file)), layout_(layout) {}

  PictureShape shape() const override { return layout_.shape; }
  std::string format() const override { return "tiff"; }
  bool has(const char* attribute) const override {
    uint32_t bytes = 0;
    void* profile = nullptr;
    return attribute == std::string_view("ICCProfile") &&
           TIFFGetField(tiff(), TIFFTAG_ICCPROFILE, &bytes, &profile);
  }
  int number(const char* attribute) const override {
    return attribute == std::string_view("Orientation") ? shortTag(tiff(), TIFFTAG_ORIENTATION) : 0;
  }
  std::string text(const char*) const override { return {}; }

  Status read(PictureSample type, std::span<std::byte> samples) override {
    if (type != layout_.shape.sample) return {TKS_USAGE, "its samples are of another type"};
    if (layout_.ycbcr) return readRgb(samples);
    return TIFFIsTiled(tiff()) ? readTiles(samples) : readRows(samples);
  }

 private:
  TIFF* tiff() const { return file_.get(); }
  uint32_t width() const { return static_cast<uint32_t>(layout_.shape.width); }
  uint32_t height() const { return static_cast<uint32_t>(layout_.shape.height); }
  /// Of a block, and how many blocks lie above each other.
  size_t blockChannels() const { return layout_.apart ? 1 : layout_.shape.channels; }
  uint16_t planes() const {
    return static_cast<uint16_t>(layout_.apart ? layout_.shape.channels : 1);
  }
  size_t packedBytes(size_t pixels) const {
    return (pixels * blockChannels() * layout_.stored.bits + 7) / 8;
  }

  /// packed: empty where the block is left out.
  void place(std::span<const std::byte> packed, const RowPart& part, std::span<std::byte> samples) {
    const size_t sample = sizeOf(layout_.shape.sample), channels = layout_.shape.channels;
    const size_t start = (size_t{part.y} * width() + part.x) * channels * sample;
    line_.resize(part.width * blockChannels() * sample);
    if (packed.empty()) {
      fillSamples(layout_.absent, layout_.shape.sample, line_);
    } else {
      unpackRow(packed, layout_.stored, line_);
    }
    if (!layout_.apart) {
      std::copy(line_.begin(), line_.end(), samples.begin() + start);
      return;
    }
    for (size_t i = 0; i < part.width; ++i)
      std::memcpy(&samples[start + (i * channels + part.plane) * sample], &line_[i * sample],
                  sample);
  }

  Status readRows(std::span<std::byte> samples) {
    std::vector<std::byte> row(packedBytes(width()));
    if (TIFFScanlineSize64(tiff()) != row.size()) return damaged();
    for (uint16_t plane = 0; plane < planes(); ++plane) {
      for (uint32_t y = 0; y < height(); ++y) {
        const bool missing = isMissing(tiff(), TIFFComputeStrip(tiff(), y, plane));
        if (!missing && TIFFReadScanline(tiff(), row.data(), y, plane) < 0) return file_.reason();
        place(missing ? std::span<const std::byte>() : row, {0, y, width(), plane}, samples);
      }
    }
    return {};
  }

  Status readTiles(std::span<std::byte> samples) {
    uint32_t side_x = 0, side_y = 0;
    TIFFGetField(tiff(), TIFFTAG_TILEWIDTH, &side_x);
    TIFFGetField(tiff(), TIFFTAG_TILELENGTH, &side_y);
    const uint64_t bytes = TIFFTileSize64(tiff());
    if (side_x == 0 || side_y == 0 || bytes != packedBytes(side_x) * side_y) return damaged();
    if (Status memory = checkMemoryFor("reading a tile", bytes); !memory.ok()) return memory;
    tile_.resize(bytes);
    for (uint16_t plane = 0; plane < planes(); ++plane) {
      for (uint32_t y = 0; y < height(); y += std::min(side_y, height() - y)) {
        for (uint32_t x = 0; x < width(); x += std::min(side_x, width() - x)) {
          const RowPart first{x, y, std::min(side_x, width() - x), plane};
          if (!readTile(first, packedBytes(side_x), std::min(side_y, height() - y), samples))
            return file_.reason();
        }
      }
    }
    return {};
  }

  bool readTile(RowPart part, size_t row_bytes, uint32_t rows, std::span<std::byte> samples) {
    const uint32_t tile = TIFFComputeTile(tiff(), part.x, part.y, 0, part.plane);
    const bool missing = isMissing(tiff(), tile);
    if (!missing && TIFFReadTile(tiff(), tile_.data(), part.x, part.y, 0, part.plane) < 0)
      return false;
    for (uint32_t row = 0; row < rows; ++row, ++part.y) {
      const auto packed = std::span(tile_).subspan(row * row_bytes, row_bytes);
      place(missing ? std::span<const std::byte>() : packed, part, samples);
    }
    return true;
  }

  /// Luminance and colour differences that may be coarser than it, by libtiff's equations.
  Status readRgb(std::span<std::byte> samples) {
    const size_t pixels = size_t{width()} * height();
    if (Status memory = checkMemoryFor("reading YCbCr", pixels * sizeof(uint32_t)); !memory.ok())
      return memory;
    std::array<char, 1024> reason{};
    TIFFRGBAImage image{};
    if (!TIFFRGBAImageBegin(&image, tiff(), 1, reason.data()))
      return {TKS_USAGE, std::string(reason.data())};
    image.req_orientation = image.orientation;
    std::vector<uint32_t> packed(pixels);
    const bool read = TIFFRGBAImageGet(&image, packed.data(), width(), height()) != 0;
    TIFFRGBAImageEnd(&image);
    if (!read) return file_.reason();
    for (size_t i = 0; i < pixels; ++i) {
      const uint32_t pixel = packed[i];
      samples[3 * i] = static_cast<std::byte>(TIFFGetR(pixel));
      samples[3 * i + 1] = static_cast<std::byte>(TIFFGetG(pixel));
      samples[3 * i + 2] = static_cast<std::byte>(TIFFGetB(pixel));
    }
    return {};
  }

  static Status damaged() { return {TKS_IO, "its rows or tiles have another size than it says"}; }

  TiffFile file_;
  TiffLayout layout_;
  std::vector<std::byte> line_, tile_;
};

constexpr uint16_t kJpegXl = 50002;

/// A way out, as libtiff lacks the codec.
Status cannotDecompress(uint16_t compression, const std::string& name) {
  const TIFFCodec* const codec = TIFFFindCODEC(compression);
  const std::string method = compression == kJpegXl ? "JPEG XL"
                             : codec                ? codec->name
                                                    : "method " + std::to_string(compression);
  return {TKS_USAGE, name + " is compressed by " + method +
                         ", which libtiff does not read here: gdal_translate -co COMPRESS=DEFLATE "
                         "IN OUT.tif makes a file that is read, where `gdalinfo --format GTiff` "
                         "lists the method, as in GDAL of conda-forge"};
}

Status checkCompression(TIFF* tiff, const std::string& name) {
  const uint16_t compression = shortTag(tiff, TIFFTAG_COMPRESSION);
  if (!TIFFIsCODECConfigured(compression)) return cannotDecompress(compression, name);
  if (compression != COMPRESSION_JPEG || shortTag(tiff, TIFFTAG_BITSPERSAMPLE) == 8) return {};
  return {TKS_USAGE, name +
                         " is compressed as JPEG of 12 bits, which libtiff does not read here: "
                         "gdal_translate -co COMPRESS=DEFLATE -co NBITS=12 IN OUT.tif makes a file "
                         "that is read, where GDAL has a libjpeg of 12 bits, as that of "
                         "conda-forge"};
}

Status checkSample(TiffSample stored, const std::string& name) {
  const std::string bits = std::to_string(stored.bits);
  if (stored.format == SAMPLEFORMAT_COMPLEXINT || stored.format == SAMPLEFORMAT_COMPLEXIEEEFP)
    return {TKS_USAGE, name +
                           " holds complex numbers: heights and textures are real ones, which "
                           "gdal_translate -ot Float64 takes of them (the real parts)"};
  if (typeOf(stored) != PictureSample::kOther) return {};
  if (stored.format != SAMPLEFORMAT_IEEEFP && stored.bits == 64)
    return {TKS_USAGE, name +
                           " holds integers of 64 bits: gdal_translate -ot Int32 makes heights of "
                           "those that lie within 2147483647 of 0 (gdalinfo -stats tells), and "
                           "-ot Float64 rounds the others"};
  return {TKS_USAGE, name + " has samples of " + bits +
                         " bits, which GDAL does not read either: write 8, 16 or 32 bits with the "
                         "program that made it"};
}

/// Inks other than cyan, magenta, yellow and black in several channels.
Status checkInks(TIFF* tiff, const std::string& name) {
  const int channels = shortTag(tiff, TIFFTAG_SAMPLESPERPIXEL);
  const bool known = channels >= 4 && shortTag(tiff, TIFFTAG_INKSET) == INKSET_CMYK;
  if (photometricOf(tiff) != PHOTOMETRIC_SEPARATED || channels == 1 || known) return {};
  return {TKS_USAGE, name +
                         " stores inks other than cyan, magenta, yellow and black: gdal_translate "
                         "-b N IN OUT.tif takes one of them as a grey, and the program that made "
                         "the file mixes them"};
}

/// Colours that are neither greys, RGB, inks nor places in a palette.
Status checkColours(uint16_t photometric, const std::string& name) {
  constexpr const char* kByGdal = ": gdal_translate -b 1 -b 2 -b 3 IN OUT.tif converts it to RGB";
  constexpr const char* kByOthers = ": convert IN OUT.png (of ImageMagick) makes RGB of it";
  switch (photometric) {
    case PHOTOMETRIC_CIELAB:
      return {TKS_USAGE, name + " stores its colours as L*a*b*" + kByGdal};
    case PHOTOMETRIC_ICCLAB:
    case PHOTOMETRIC_ITULAB:
      return {TKS_USAGE, name + " stores its colours as L*a*b*" + kByOthers};
    case PHOTOMETRIC_LOGL:
    case PHOTOMETRIC_LOGLUV:
      return {TKS_USAGE, name + " stores logarithms of light" + kByGdal};
    default:
      return {};
  }
}

/// The size is known to be sound.
Result<TiffLayout> layoutOf(TIFF* tiff, const std::string& name) {
  const auto [width, height] = sizeOfPage(tiff);
  const int channels = shortTag(tiff, TIFFTAG_SAMPLESPERPIXEL);
  TiffLayout layout;
  layout.stored = {shortTag(tiff, TIFFTAG_SAMPLEFORMAT), shortTag(tiff, TIFFTAG_BITSPERSAMPLE),
                   TIFFIsByteSwapped(tiff) != 0};
  layout.apart = channels > 1 && shortTag(tiff, TIFFTAG_PLANARCONFIG) == PLANARCONFIG_SEPARATE;
  layout.absent = tagNumber(tagText(tiff, kGdalNodataTag)).value_or(0);
  layout.shape = {static_cast<int>(width), static_cast<int>(height), channels,
                  typeOf(layout.stored)};
  const uint16_t photometric = photometricOf(tiff);
  Status status = checkCompression(tiff, name);
  if (status.ok()) status = checkSample(layout.stored, name);
  if (status.ok()) status = checkColours(photometric, name);
  if (status.ok()) status = checkInks(tiff, name);
  if (!status.ok()) return status;
  if (photometric != PHOTOMETRIC_YCBCR) return layout;
  if (channels != 3 || layout.stored.bits != 8)
    return Status(TKS_USAGE, name +
                                 " stores YCbCr of other than three channels of 8 bits: "
                                 "gdal_translate -co PHOTOMETRIC=RGB IN OUT.tif makes RGB of it");
  const bool jpeg = shortTag(tiff, TIFFTAG_COMPRESSION) == COMPRESSION_JPEG && !layout.apart;
  if (jpeg) TIFFSetField(tiff, TIFFTAG_JPEGCOLORMODE, JPEGCOLORMODE_RGB);
  layout.ycbcr = !jpeg;
  return layout;
}

}  // namespace

Result<std::unique_ptr<PictureReader>> openTiff(const std::string& path, const std::string& name,
                                                uint64_t most_side) {
  auto file = TiffFile::open(path, "r");
  if (!file.ok()) {
    const std::string told = file.status().message();
    return Status(TKS_IO, "cannot read " + name + told.substr(told.rfind(": ")));
  }
  const auto [width, height] = sizeOfPage(file->get());
  if (Status sides = checkSides(name, width, height, most_side); !sides.ok()) return sides;
  const auto layout = layoutOf(file->get(), name);
  if (!layout.ok()) return layout.status();
  return std::unique_ptr<PictureReader>(std::make_unique<TiffPicture>(std::move(*file), *layout));
}

}  // namespace tetrakis::tools

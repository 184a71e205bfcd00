// SPDX-License-Identifier: Apache-2.0
// Writing texture images: which format holds which, and that it does.
#include <algorithm>
#include <array>

#include "apps/tools/files/file_bytes.hpp"
#include "apps/tools/files/files.hpp"
#include "apps/tools/files/pictures/png.hpp"
#include "apps/tools/files/pictures/raster.hpp"
#include "apps/tools/files/pictures/tiff.hpp"
#include "apps/tools/files/place/world_file.hpp"

namespace tetrakis::tools {
namespace {

constexpr int kQuality = 95;  // of JPEG and HEIF

/// Numbers of channels as a set: bit n stands for n channels.
constexpr unsigned kGrey = 1u << 1, kGreyAlpha = 1u << 2, kRgb = 1u << 3, kRgba = 1u << 4;
constexpr unsigned kAll = kGrey | kGreyAlpha | kRgb | kRgba;

/// A format by OpenImageIO's name, and what comes back of it. A table, because the library can be
/// asked neither which depths nor which channels a format takes (it converts, and DPX even aborts).
/// Left out: bitmaps with alpha, which OpenImageIO 2.4 does not call so, formats of floats alone
/// (OpenEXR, HDR, Zfile), which no texture is read from, and FITS, of which OpenImageIO 2.4 makes
/// files that others do not read.
struct Format {
  const char* name;
  unsigned channels8, channels16;
  bool exact = true;
};
constexpr std::array kFormats{
    Format{"png", kAll, kAll},
    Format{"tiff", kAll, kAll},
    Format{"jpeg", kGrey | kRgb, 0, false},
    Format{"bmp", kGrey | kRgb, 0},
    Format{"gif", kRgb, 0, false},
    Format{"heif", kRgb | kRgba, 0, false},
    Format{"ico", kRgba, 0},
    Format{"iff", kRgb | kRgba, kRgb | kRgba},
    Format{"jpeg2000", kGrey | kRgb | kRgba, kGrey | kRgb | kRgba},
    Format{"pnm", kGrey | kRgb, 0},
    Format{"rla", kAll, kAll},
    Format{"sgi", kAll, kAll},
    Format{"targa", kAll, 0},
    Format{"webp", kRgb | kRgba, 0, false},
};

/// OpenImageIO's name of the format with this extension; "": there is none. It need not be loaded
/// for those that are written without it.
Result<std::string> nameOf(const std::string& extension) {
  if (extension == "png") return std::string("png");
  if (extension == "tif" || extension == "tiff") return std::string("tiff");
  if (extension == "jpg" || extension == "jpeg") return std::string("jpeg");
  const auto formats = pictureFormats();
  if (!formats.ok()) return formats.status();
  return (*formats)->named(extension);
}

/// Null if OpenImageIO writes no such format, or none that holds textures.
Result<const Format*> formatNamed(const std::string& extension) {
  const auto name = nameOf(extension);
  if (!name.ok()) return name.status();
  const auto* format = std::find_if(kFormats.begin(), kFormats.end(),
                                    [&name](const Format& known) { return *name == known.name; });
  return format == kFormats.end() ? nullptr : format;
}

std::string wordsFor(const ImageFile& image) {
  return std::to_string(image.channels) + (image.channels == 1 ? " channel of " : " channels of ") +
         std::to_string(8 * tks_sample_bytes(image.sample)) + " bits";
}

Status checkShape(const ImageFile& image) {
  const uint64_t pixels = uint64_t{image.width} * image.height;
  const bool known = image.channels >= 1 && image.channels <= 4 &&
                     (image.sample == TKS_U8 || image.sample == TKS_U16);
  if (known && pixels != 0 &&
      pixels * image.channels * tks_sample_bytes(image.sample) == image.data.size()) {
    return {};
  }
  return {TKS_USAGE, "an image has 1 to 4 channels of 8 or 16 bits, and all its samples"};
}

bool same(const ImageFile& a, const ImageFile& b) {
  return a.width == b.width && a.height == b.height && a.channels == b.channels &&
         a.sample == b.sample && a.hasAlpha() == b.hasAlpha() && a.data == b.data;
}

Status writeOther(const std::string& path, const ImageFile& image, const Format& format) {
  PictureToWrite picture{shapeOf(image), image.data};
  if (format.name == std::string_view("heif"))
    picture.compression = "heic:" + std::to_string(kQuality);
  const auto formats = pictureFormats();
  if (!formats.ok()) return formats.status();
  const Status status = (*formats)->write(path, format.name, picture);
  if (!status.ok())
    return {TKS_IO, "cannot write " + quoted(path) + ": " + firstLine(status.message())};
  if (!format.exact) return {};
  // OpenImageIO 2.4 writes some sizes of RLA, IFF and JPEG 2000 that nobody can read.
  const auto written = readImage(path);
  if (written.ok() && same(*written, image)) return {};
  return {TKS_IO, "cannot write " + quoted(path) +
                      ": it does not come back as it was; write a .png instead"};
}

Status writePixels(const std::string& path, const ImageFile& image, const Format& format) {
  const std::string_view kind = format.name;
  if (kind == "tiff") return writeGeoTiff(path, image);
  if (kind != "png" && kind != "jpeg") return writeOther(path, image, format);
  const auto bytes = kind == "png" ? encodePng(image) : encodeJpeg(image, kQuality);
  return bytes.ok() ? writeBytes(path, *bytes) : bytes.status();
}

}  // namespace

Status checkImageFormat(const std::string& path, const ImageFile& image) {
  const std::string name = formatOf(path, "");
  const auto format = formatNamed(name);
  if (!format.ok()) return format.status();
  if (!*format) {
    return {TKS_USAGE, "cannot tell a format of textures from " + quoted(path) +
                           ": end the name in .png, .tif, .jpg or another of docs/CLI.md"};
  }
  if (image.hasFurtherColour()) {
    if ((*format)->name == std::string_view("tiff")) return {};
    return {TKS_USAGE, "a ." + name + " file has no channel for a colour beside " +
                           (image.channels == 2 ? "grey" : "red, green and blue") +
                           ": write a .tif instead"};
  }
  const unsigned held = image.sample == TKS_U8 ? (*format)->channels8 : (*format)->channels16;
  if (held >> image.channels & 1u) return {};
  return {TKS_USAGE,
          "a ." + name + " file cannot hold " + wordsFor(image) + ": write a .png instead"};
}

Status writeImage(const std::string& path, const ImageFile& image, const std::string& format) {
  if (Status status = checkShape(image); !status.ok()) return status;
  const std::string name = formatOf(path, format);
  if (Status status = checkImageFormat(format.empty() ? path : "x." + name, image); !status.ok())
    return status;
  const Format& chosen = **formatNamed(name);
  if (Status status = writePixels(path, image, chosen); !status.ok()) return status;
  if (chosen.name == std::string_view("tiff")) return {};  // it says so itself
  return image.place.geotransform ? writeWorldFile(path, *image.place.geotransform) : Status();
}

}  // namespace tetrakis::tools

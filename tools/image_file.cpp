// SPDX-License-Identifier: Apache-2.0
// Texture images on disk: 8 or 16 bits, 1 to 4 channels.
#include <algorithm>
#include <utility>

#include "tools/file_bytes.hpp"
#include "tools/files.hpp"
#include "tools/png.hpp"
#include "tools/raster.hpp"

namespace tetrakis::tools {
namespace {

using OIIO::TypeDesc;

TypeDesc typeOf(tks_sample sample) {
  return sample == TKS_U8 ? TypeDesc::UINT8 : TypeDesc::UINT16;
}

OIIO::ImageSpec specOf(const ImageFile& image) {
  return {static_cast<int>(image.width), static_cast<int>(image.height),
          static_cast<int>(image.channels), typeOf(image.sample)};
}

/// The type to read: OpenImageIO widens fewer bits to full range itself.
Result<tks_sample> sampleOf(const Raster& raster) {
  const TypeDesc type = raster.spec.format;
  if (type.is_floating_point()) {
    return Status(TKS_USAGE, raster.name + " holds floats: a texture is 8 or 16 bits");
  }
  if (type.is_signed()) {
    return Status(TKS_USAGE, raster.name + " holds signed samples: a texture is 8 or 16 bits");
  }
  return type == TypeDesc::UINT8 ? TKS_U8 : TKS_U16;
}

std::string noteOn(const Raster& raster, int orientation) {
  std::string note;
  const auto add = [&note](const char* text) {
    note += (note.empty() ? "" : ", ") + std::string(text);
  };
  if (raster.palette) add("palette converted to RGB");
  if (raster.cmyk) add("CMYK converted to RGB");
  if (raster.spec.format == TypeDesc::UINT32) add("32 bits reduced to 16");
  if (orientation != 1) add("turned upright as its orientation tag says");
  return note.empty() ? note : raster.name + ": " + note;
}

/// Applies the orientation tag (TIFF 6.0: where the stored row 0 and column 0 stand in the
/// picture). From 5 on rows and columns change places.
ImageFile turnedUpright(const ImageFile& stored, int orientation) {
  const bool swapped = orientation >= 5;
  const bool flip_column = orientation == 2 || orientation == 3 || orientation >= 7;
  const bool flip_row =
      orientation == 3 || orientation == 4 || orientation == 6 || orientation == 7;
  ImageFile upright = stored;
  if (swapped) std::swap(upright.width, upright.height);
  const size_t pixel_bytes = stored.channels * tks_sample_bytes(stored.sample);
  auto pixel = upright.data.begin();
  for (uint32_t y = 0; y < upright.height; ++y) {
    for (uint32_t x = 0; x < upright.width; ++x) {
      uint32_t column = swapped ? y : x, row = swapped ? x : y;
      if (flip_column) column = stored.width - 1 - column;
      if (flip_row) row = stored.height - 1 - row;
      const size_t from = (size_t{row} * stored.width + column) * pixel_bytes;
      pixel = std::copy_n(stored.data.begin() + from, pixel_bytes, pixel);
    }
  }
  return upright;
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

}  // namespace

Result<ImageFile> readImage(const std::string& path, std::string* note) {
  auto raster = openRaster(path);
  if (!raster.ok()) return raster.status();
  const OIIO::ImageSpec& spec = raster->spec;
  if (spec.nchannels > 4) {
    return Status(TKS_USAGE, raster->name + " has " + std::to_string(spec.nchannels) +
                                 " channels: a texture has 1 to 4");
  }
  const auto sample = sampleOf(*raster);
  if (!sample.ok()) return sample.status();
  auto data = readSamples(*raster, typeOf(*sample));
  if (!data.ok()) return data.status();
  ImageFile image{static_cast<uint32_t>(spec.width), static_cast<uint32_t>(spec.height),
                  static_cast<uint32_t>(spec.nchannels), *sample, std::move(*data)};
  // OpenImageIO can turn images, but its 2.4 takes orientation 5 for 7.
  const int tag = spec.get_int_attribute("Orientation", 1);
  const int orientation = tag >= 1 && tag <= 8 ? tag : 1;
  if (note) *note = noteOn(*raster, orientation);
  if (orientation != 1) return turnedUpright(image, orientation);
  return image;
}

Status writeImage(const std::string& path, const ImageFile& image, const std::string& format) {
  const Status shape = checkShape(image);
  if (!shape.ok()) return shape;
  constexpr int kJpegQuality = 95;
  const std::string name = formatOf(path, format);
  Result<std::vector<std::byte>> bytes =
      Status(TKS_USAGE,
             "cannot tell the format of " + quoted(path) + ": end the name in .png, .tif or .jpg");
  if (name == "png") bytes = encodePng(image);
  if (name == "jpg" || name == "jpeg") bytes = encodeJpeg(image, kJpegQuality);
  if (name == "tif" || name == "tiff") {
    OIIO::ImageSpec spec = specOf(image);
    spec["compression"] = "zip";
    bytes = encodeRaster("tif", spec, image.data);
  }
  return bytes.ok() ? writeBytes(path, *bytes) : bytes.status();
}

}  // namespace tetrakis::tools

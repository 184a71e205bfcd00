// SPDX-License-Identifier: Apache-2.0
// Height fields on disk: which format, which sample type. The samples themselves are never
// converted, but for half floats, which float holds exactly.
#include <algorithm>
#include <array>

#include "tools/file_bytes.hpp"
#include "tools/files.hpp"
#include "tools/plain_heights.hpp"
#include "tools/png.hpp"
#include "tools/raster.hpp"
#include "tools/tiff.hpp"

namespace tetrakis::tools {
namespace {

using OIIO::TypeDesc;

struct SampleType {
  TypeDesc::BASETYPE stored;
  tks_sample sample;
};
constexpr std::array<SampleType, 8> kSampleTypes{{{TypeDesc::UINT8, TKS_U8},
                                                  {TypeDesc::INT8, TKS_I8},
                                                  {TypeDesc::UINT16, TKS_U16},
                                                  {TypeDesc::INT16, TKS_I16},
                                                  {TypeDesc::UINT32, TKS_U32},
                                                  {TypeDesc::INT32, TKS_I32},
                                                  {TypeDesc::FLOAT, TKS_F32},
                                                  {TypeDesc::HALF, TKS_F32}}};

/// What OpenImageIO calls a sample type.
TypeDesc typeOf(tks_sample sample) {
  return std::find_if(kSampleTypes.begin(), kSampleTypes.end(),
                      [sample](const SampleType& type) { return type.sample == sample; })
      ->stored;
}

Result<tks_sample> sampleOf(const Raster& raster) {
  const OIIO::ImageSpec& spec = raster.spec;
  if (spec.nchannels != 1 || raster.palette) {
    const int channels = raster.palette ? 3 : spec.nchannels;
    return Status(TKS_USAGE, raster.name + " has " + std::to_string(channels) +
                                 " channels: heights are one channel");
  }
  if (raster.white_is_zero) {
    return Status(TKS_USAGE, raster.name + " stores white as 0: heights are no shades");
  }
  const int bits = static_cast<int>(8 * spec.format.size());
  const auto* type = std::find_if(kSampleTypes.begin(), kSampleTypes.end(), [&](const auto& known) {
    return known.stored == spec.format.basetype;
  });
  if (type == kSampleTypes.end() || (raster.stored_bits != 0 && raster.stored_bits != bits)) {
    return Status(TKS_USAGE,
                  raster.name + " has samples of " +
                      std::to_string(raster.stored_bits ? raster.stored_bits : bits) +
                      " bits: heights are integers of 8, 16 or 32 bits, or 32-bit floats");
  }
  return type->sample;
}

Result<HeightFile> readRasterHeights(const std::string& path) {
  auto raster = openRaster(path);
  if (!raster.ok()) return raster.status();
  const auto sample = sampleOf(*raster);
  if (!sample.ok()) return sample.status();
  auto data = readSamples(*raster, typeOf(*sample));
  if (!data.ok()) return data.status();
  HeightFile heights;
  heights.width = static_cast<uint32_t>(raster->spec.width);
  heights.height = static_cast<uint32_t>(raster->spec.height);
  heights.sample = *sample;
  heights.data = std::move(*data);
  if (!raster->is_tiff()) return heights;
  const Status tags = readGeoTags(raster->file.path(), heights);
  if (!tags.ok()) return tags;
  return heights;
}

Status cannotHold(const std::string& format) {
  return {TKS_USAGE, "a ." + format + " file cannot hold these samples: write a .tif instead"};
}

Status writePng(const std::string& path, const HeightFile& heights) {
  if (heights.sample != TKS_U8 && heights.sample != TKS_U16) return cannotHold("png");
  const auto bytes = encodePng({heights.width, heights.height, 1, heights.sample, heights.data});
  return bytes.ok() ? writeBytes(path, *bytes) : bytes.status();
}

Status writeExr(const std::string& path, const HeightFile& heights) {
  if (heights.sample != TKS_U32 && heights.sample != TKS_F32) return cannotHold("exr");
  const OIIO::ImageSpec spec(static_cast<int>(heights.width), static_cast<int>(heights.height), 1,
                             typeOf(heights.sample));
  const auto bytes = encodeRaster("exr", spec, heights.data);
  return bytes.ok() ? writeBytes(path, *bytes) : bytes.status();
}

Status checkShape(const HeightFile& heights) {
  const uint64_t bytes =
      uint64_t{heights.width} * heights.height * tks_sample_bytes(heights.sample);
  if (bytes != 0 && bytes == heights.data.size()) return {};
  return {TKS_USAGE, "heights of " + std::to_string(heights.width) + " x " +
                         std::to_string(heights.height) + " samples do not fill " +
                         std::to_string(heights.data.size()) + " bytes"};
}

}  // namespace

Result<HeightFile> readHeights(const std::string& path) {
  if (const auto raw = parseRawName(path)) return readRaw(*raw);
  const std::string format = formatOf(path, "");
  if (format == "hgt") return readHgt(path);
  if (format == "raw") {
    return Status(TKS_USAGE, quoted(path) + " needs its shape: give " + path +
                                 ":WIDTHxHEIGHT:TYPE with type u8, i8, u16, i16, u32, i32 or f32");
  }
  return readRasterHeights(path);
}

Status writeHeights(const std::string& path, const HeightFile& heights, const std::string& format) {
  const Status shape = checkShape(heights);
  if (!shape.ok()) return shape;
  const std::string name = formatOf(path, format);
  if (name == "tif" || name == "tiff") return writeGeoTiff(path, heights);
  if (name == "png") return writePng(path, heights);
  if (name == "exr") return writeExr(path, heights);
  if (name == "hgt") return writeHgt(path, heights);
  if (name == "raw") return writeRaw(path, heights);
  return {TKS_USAGE, "cannot tell the format of " + quoted(path) +
                         ": end the name in .tif, .png, .exr, .hgt or .raw"};
}

}  // namespace tetrakis::tools

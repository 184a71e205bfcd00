// SPDX-License-Identifier: Apache-2.0
// Height fields on disk: which format, which sample type. The samples themselves are never
// converted, but for half floats, which float holds exactly, and doubles, which it rounds.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <limits>

#include "tools/files/file_bytes.hpp"
#include "tools/files/files.hpp"
#include "tools/files/gdal_mask.hpp"
#include "tools/files/pictures/picture_header.hpp"
#include "tools/files/pictures/png.hpp"
#include "tools/files/pictures/raster.hpp"
#include "tools/files/pictures/tiff.hpp"
#include "tools/files/place/pam.hpp"
#include "tools/files/place/world_file.hpp"
#include "tools/files/plain_heights.hpp"
#include "tools/files/void_samples.hpp"

namespace tetrakis::tools {
namespace {

struct SampleType {
  PictureSample stored;
  tks_sample sample;
};
constexpr std::array<SampleType, 9> kSampleTypes{{{PictureSample::kU8, TKS_U8},
                                                  {PictureSample::kI8, TKS_I8},
                                                  {PictureSample::kU16, TKS_U16},
                                                  {PictureSample::kI16, TKS_I16},
                                                  {PictureSample::kU32, TKS_U32},
                                                  {PictureSample::kI32, TKS_I32},
                                                  {PictureSample::kFloat, TKS_F32},
                                                  {PictureSample::kHalf, TKS_F32},
                                                  {PictureSample::kDouble, TKS_F32}}};

PictureSample storedAs(tks_sample sample) {
  return std::find_if(kSampleTypes.begin(), kSampleTypes.end(),
                      [sample](const SampleType& type) { return type.sample == sample; })
      ->stored;
}

Result<tks_sample> heightSampleOf(const Raster& raster) {
  const PictureShape& shape = raster.shape;
  if (raster.palette)
    return Status(TKS_USAGE, raster.name + " has a palette: heights are no colours");
  if (shape.channels != 1) {
    return Status(TKS_USAGE, raster.name + " has " + std::to_string(shape.channels) +
                                 " channels, heights have one: choose it (gdal_translate -b 1); "
                                 "colours that stand for heights have to be decoded first");
  }
  if (raster.white_is_zero) {
    return Status(TKS_USAGE, raster.name + " stores white as 0: heights are no shades");
  }
  if (raster.stretched) {
    return Status(TKS_USAGE, raster.name +
                                 " has samples that reading would stretch to all of 8 or "
                                 "16 bits: gdal_translate IN OUT.tif keeps those of binary files");
  }
  const int bits = static_cast<int>(8 * sizeOf(shape.sample));
  const int stored = raster.stored_bits ? raster.stored_bits : bits;
  const auto* type = std::find_if(kSampleTypes.begin(), kSampleTypes.end(),
                                  [&](const auto& known) { return known.stored == shape.sample; });
  if (type == kSampleTypes.end() || (stored != bits && !raster.as_stored)) {
    const bool png = raster.reader == nullptr;
    return Status(TKS_USAGE, raster.name + " has samples of " + std::to_string(stored) +
                                 " bits, which reading would stretch: " +
                                 (png ? "gdal_translate -co NBITS=8 IN OUT.tif keeps them"
                                      : "write 8 or 16 bits with the program that made it"));
  }
  return type->sample;
}

struct Floats {
  std::vector<std::byte> samples;
  double rounding = 0;
};

/// Doubles as the nearest floats, those that meet the nodata value as its float or NaN. Fails if
/// one is beyond all floats.
Result<Floats> narrowed(const std::vector<std::byte>& doubles, const std::optional<double>& nodata,
                        const std::string& name) {
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  const auto mark = static_cast<float>(nodata ? asSample(*nodata, TKS_F32).value_or(kNaN) : kNaN);
  Floats floats{std::vector<std::byte>(doubles.size() / sizeof(double) * sizeof(float))};
  for (size_t i = 0; i < floats.samples.size() / sizeof(float); ++i) {
    double value = 0;
    std::memcpy(&value, doubles.data() + i * sizeof value, sizeof value);
    const bool is_void = nodata && meetsNodata(value, *nodata);
    const float sample = is_void ? mark : toFloat(value);
    std::memcpy(floats.samples.data() + i * sizeof sample, &sample, sizeof sample);
    if (is_void || !std::isfinite(value)) continue;
    if (!std::isfinite(sample))
      return Status(TKS_USAGE, name + " holds 64-bit floats beyond the range of 32 bits");
    floats.rounding = std::max(floats.rounding, std::abs(value - static_cast<double>(sample)));
  }
  return floats;
}

Note noteOnDoubles(double rounding) {
  if (rounding == 0) return {"64-bit floats become 32-bit floats, which hold them exactly", ""};
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.2g", rounding);
  return {std::string("64-bit floats are rounded to 32 bits, by up to ") + text.data(), ""};
}

/// Heights, and the mask that their file holds (empty: none).
struct Reading {
  HeightFile heights;
  std::vector<uint8_t> mask;
};

/// Of a mask page, or of what is missing; empty: all is there.
Result<std::vector<uint8_t>> maskOf(const Raster& raster, uint32_t width, uint32_t height) {
  std::vector<uint8_t> mask;
  if (raster.mask) {
    auto page = readMaskPage(raster.file.path(), width, height);
    if (!page.ok()) return page;
    mask = std::move(*page);
  }
  // Where all is missing, GDAL's reading is all that there is.
  if (!raster.sparse || raster.empty) return mask;
  auto there = maskOfMissing(raster.file.path(), width, height);
  if (!there.ok()) return there;
  for (size_t i = 0; i < mask.size(); ++i)
    if (mask[i] == 0) (*there)[i] = 0;
  return there;
}

/// The nodata value is as given, else as the file declares it.
Result<Reading> readRasterHeights(const std::string& path, const std::optional<double>& nodata,
                                  Notes& notes) {
  auto raster = openRaster(path, kMostHeights);
  if (!raster.ok()) return raster.status();
  const auto sample = heightSampleOf(*raster);
  if (!sample.ok()) return sample.status();
  Reading reading;
  HeightFile& heights = reading.heights;
  heights.width = static_cast<uint32_t>(raster->shape.width);
  heights.height = static_cast<uint32_t>(raster->shape.height);
  heights.sample = *sample;
  if (const std::string tagged = raster->tagged(); !tagged.empty()) {
    const Status tags = readGeoTags(tagged, heights, notes);
    if (!tags.ok()) return tags;
  }
  if (raster->unread_place)
    notes.push_back({"its place in GML, or in damaged tags, is not read", ""});
  takePam(path, heights);
  if (nodata) heights.nodata = nodata;
  const bool none = nodata && std::isnan(*nodata);  // says that all samples are heights
  if (const auto note = noteOnNodata(heights); note && !none) notes.push_back(*note);
  const bool wide = raster->shape.sample == PictureSample::kDouble;
  auto data = readSamples(*raster, wide ? PictureSample::kDouble : storedAs(*sample));
  if (!data.ok()) return data.status();
  heights.data = std::move(*data);
  if (wide) {
    auto floats = narrowed(heights.data, heights.nodata, raster->name);
    if (!floats.ok()) return floats.status();
    heights.data = std::move(floats->samples);
    heights.rounding = floats->rounding;
    notes.push_back(noteOnDoubles(heights.rounding));
  }
  if (raster->further_pages) notes.push_back({"only the first page is read", ""});
  auto mask = maskOf(*raster, heights.width, heights.height);
  if (!mask.ok()) return mask.status();
  reading.mask = std::move(*mask);
  if (raster->empty) {
    notes.push_back(
        {"the file leaves all its strips or tiles out: they are filled as GDAL does", ""});
  } else if (raster->sparse) {
    notes.push_back({"strips or tiles that the file leaves out are void", ""});
  }
  return reading;
}

Result<Reading> readPlain(Result<HeightFile> heights) {
  if (!heights.ok()) return heights.status();
  return Reading{std::move(*heights), {}};
}

/// The name of a file that has no header, less what is said of its shape; nothing for others.
std::optional<std::string> withoutHeader(const std::string& path) {
  const std::string name = path.substr(0, path.find(':', path.rfind('.')));
  for (const char* format : {"raw", "r16", "r32"})
    if (formatOf(name, "") == format) return name;
  return {};
}

Result<Reading> readAnyHeights(const std::string& path, const std::optional<double>& nodata,
                               Notes& notes) {
  if (const auto raw = parseRawName(path)) return readPlain(readRaw(*raw));
  if (isNamedHgt(path)) return readPlain(readHgt(path));
  const auto shapeless = withoutHeader(path);
  if (!shapeless) return readRasterHeights(path, nodata, notes);
  return Status(TKS_USAGE, quoted(path) + " needs its shape: give " + *shapeless +
                               ":WIDTHxHEIGHT:TYPE with type u8, i8, u16, i16, u32, i32 or f32");
}

/// Tags go before a world file beside.
Status findPlace(const std::string& path, HeightFile& heights) {
  if (heights.geotransform) return {};
  const auto raw = parseRawName(path);
  const auto transform = readWorldFile(raw ? raw->path : path);
  if (!transform.ok()) return transform.status();
  heights.geotransform = *transform;
  return {};
}

/// A mask beside the file goes before the one in it, as GDAL has it.
Status settleVoids(const std::string& path, Reading& reading, Notes& notes) {
  HeightFile& heights = reading.heights;
  if (heights.sample == TKS_F32 && heights.nodata)
    heights.nodata = asSample(*heights.nodata, TKS_F32);
  matchNodata(heights);
  auto beside = readMaskBeside(path, heights.width, heights.height);
  if (!beside.ok()) return beside.status();
  const Status masked = applyMask(heights, beside->empty() ? reading.mask : *beside, notes);
  if (!masked.ok()) return {masked.code(), quoted(path) + ": " + masked.message()};
  if (const auto note = takeOutliers(heights)) notes.push_back(*note);
  return {};
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
  const PictureShape shape{static_cast<int>(heights.width), static_cast<int>(heights.height), 1,
                           storedAs(heights.sample)};
  const auto bytes = encodeRaster("openexr", {shape, heights.data});
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

Result<HeightFile> readHeights(const std::string& path, const std::optional<double>& nodata,
                               Notes* notes) {
  Notes unread;
  Notes& told = notes ? *notes : unread;
  auto reading = readAnyHeights(path, nodata, told);
  if (!reading.ok()) return reading.status();
  if (nodata) reading->heights.nodata = nodata;
  if (Status place = findPlace(path, reading->heights); !place.ok()) return place;
  if (isNamedHgt(path) && !reading->heights.geotransform)
    told.push_back({"its name does not say where it lies, as N46W122.hgt does", ""});
  const Status settled = settleVoids(path, *reading, told);
  if (!settled.ok()) return settled;
  return std::move(reading->heights);
}

Status writeHeights(const std::string& path, const HeightFile& heights, const std::string& format) {
  const Status shape = checkShape(heights);
  if (!shape.ok()) return shape;
  const std::string name = formatOf(path, format);
  if (name == "tif" || name == "tiff") return writeGeoTiff(path, heights);
  if (name == "hgt") return writeHgt(path, heights);
  Status written(TKS_USAGE, "cannot tell the format of " + quoted(path) +
                                ": end the name in .tif, .png, .exr, .hgt or .raw");
  if (name == "png") written = writePng(path, heights);
  if (name == "exr") written = writeExr(path, heights);
  if (name == "raw") written = writeRaw(path, heights);
  return written.ok() && heights.geotransform ? writeWorldFile(path, *heights.geotransform)
                                              : written;
}

}  // namespace tetrakis::tools

// SPDX-License-Identifier: Apache-2.0
// Height fields on disk: which format, which sample type. The samples themselves are never
// converted, but for half floats, which float holds exactly, and doubles, which it rounds.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <limits>
#include <span>
#include <utility>

#include "apps/tools/files/file_bytes.hpp"
#include "apps/tools/files/files.hpp"
#include "apps/tools/files/gdal_mask.hpp"
#include "apps/tools/files/pictures/picture_header.hpp"
#include "apps/tools/files/pictures/png.hpp"
#include "apps/tools/files/pictures/raster.hpp"
#include "apps/tools/files/pictures/tiff.hpp"
#include "apps/tools/files/place/pam.hpp"
#include "apps/tools/files/place/world_file.hpp"
#include "apps/tools/files/plain_heights.hpp"
#include "apps/tools/files/text.hpp"
#include "apps/tools/files/void_samples.hpp"
#include "base/nodata.hpp"

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
  std::vector<float> samples;
  std::optional<double> nodata;  ///< what stands for voids
  double rounding = 0;
};

/// Doubles as the nearest floats, those that meet the nodata value as what stands for them
/// (base/nodata.hpp). Fails if one that is not void, nor left out by the mask (empty: none is), is
/// beyond all floats.
Result<Floats> narrowed(std::span<const double> doubles, const std::optional<double>& nodata,
                        const std::vector<uint8_t>& mask, const std::string& name) {
  constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
  const float mark = nodata ? narrowedNodata(*nodata) : kNaN;
  const auto isVoid = [&nodata](double value) { return nodata && meetsNodata(value, *nodata); };
  Floats floats;
  bool merged = false;
  floats.samples.reserve(doubles.size());
  for (size_t i = 0; i < doubles.size(); ++i) {
    const double value = doubles[i];
    const float sample = toFloat(value);
    floats.samples.push_back(isVoid(value) ? mark : sample);
    if (isVoid(value) || !std::isfinite(value) || (!mask.empty() && mask[i] == 0)) continue;
    if (!std::isfinite(sample))
      return Status(TKS_USAGE, name + " holds 64-bit floats beyond the range of 32 bits");
    merged = merged || meetsNodata(sample, mark);
    floats.rounding = std::max(floats.rounding, std::abs(value - static_cast<double>(sample)));
  }
  if (nodata) floats.nodata = merged ? kNaN : mark;
  for (size_t i = 0; merged && i < doubles.size(); ++i)
    if (isVoid(doubles[i])) floats.samples[i] = kNaN;
  return floats;
}

Note noteOnDoubles(double rounding) {
  if (rounding == 0) return {"64-bit floats become 32-bit floats, which hold them exactly", ""};
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.2g", rounding);
  return {std::string("64-bit floats are rounded to 32 bits, by up to ") + text.data(), ""};
}

/// Where floats of 32 bits declare another nodata value than the file.
std::optional<Note> noteOnNarrowing(double nodata, double kept) {
  if (meetsNodata(nodata, kept)) return {};
  return Note{"floats of 32 bits do not hold its nodata value " + shortest(nodata) +
                  ", for which " + (std::isnan(kept) ? "NaN" : shortest(static_cast<float>(kept))) +
                  " stands",
              ""};
}

/// Takes doubles as floats.
Status narrow(const std::vector<std::byte>& wide, const std::vector<uint8_t>& mask,
              const std::string& name, HeightFile& heights, Notes& notes) {
  const std::span doubles(reinterpret_cast<const double*>(wide.data()),
                          wide.size() / sizeof(double));
  const auto floats = narrowed(doubles, heights.nodata, mask, name);
  if (!floats.ok()) return floats.status();
  const auto bytes = std::as_bytes(std::span(floats->samples));
  heights.data.assign(bytes.begin(), bytes.end());
  heights.rounding = floats->rounding;
  notes.push_back(noteOnDoubles(heights.rounding));
  const std::optional<double> declared = std::exchange(heights.nodata, floats->nodata);
  if (!declared) return {};
  if (const auto note = noteOnNarrowing(*declared, *floats->nodata)) notes.push_back(*note);
  return {};
}

/// Heights, and the mask that their file holds, or that lies beside it (empty: none).
struct Reading {
  HeightFile heights;
  std::vector<uint8_t> mask;
};

/// Of a mask beside the file, which goes before a page of it, as GDAL has it, and of what is
/// missing; empty: all is there.
Result<std::vector<uint8_t>> maskOf(const Raster& raster, const std::string& path, uint32_t width,
                                    uint32_t height) {
  auto mask = readMaskBeside(path, width, height);
  if (mask.ok() && mask->shown.empty() && raster.mask)
    mask = readMaskPage(raster.file.path(), width, height);
  if (!mask.ok()) return mask.status();
  // Where all is missing, GDAL's reading is all that there is.
  if (!raster.sparse || raster.empty) return std::move(mask->shown);
  auto there = maskOfMissing(raster.file.path(), width, height);
  if (!there.ok()) return there;
  for (size_t i = 0; i < mask->shown.size(); ++i)
    if (mask->shown[i] == 0) (*there)[i] = 0;
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
  takePam(path, heights, notes);
  if (nodata) heights.nodata = nodata;
  const bool none = nodata && std::isnan(*nodata);  // says that all samples are heights
  if (const auto note = noteOnNodata(heights); note && !none) notes.push_back(*note);
  auto mask = maskOf(*raster, path, heights.width, heights.height);
  if (!mask.ok()) return mask.status();
  reading.mask = std::move(*mask);
  const bool wide = raster->shape.sample == PictureSample::kDouble;
  auto data = readSamples(*raster, wide ? PictureSample::kDouble : storedAs(*sample));
  if (!data.ok()) return data.status();
  if (wide) {
    const Status narrow_status = narrow(*data, reading.mask, raster->name, heights, notes);
    if (!narrow_status.ok()) return narrow_status;
  } else {
    heights.data = std::move(*data);
  }
  if (raster->further_pages) notes.push_back({"only the first page is read", ""});
  if (raster->empty) {
    notes.push_back(
        {"the file leaves all its strips or tiles out: they are filled as GDAL does", ""});
  } else if (raster->sparse) {
    notes.push_back({"strips or tiles that the file leaves out are void", ""});
  }
  return reading;
}

/// The nodata value is as given, else that of the format.
Result<Reading> readPlain(const std::string& path, Result<HeightFile> heights,
                          const std::optional<double>& nodata) {
  if (!heights.ok()) return heights.status();
  if (nodata) heights->nodata = nodata;
  auto mask = readMaskBeside(path, heights->width, heights->height);
  if (!mask.ok()) return mask.status();
  return Reading{std::move(*heights), std::move(mask->shown)};
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
  if (const auto raw = parseRawName(path)) return readPlain(path, readRaw(*raw), nodata);
  if (isNamedHgt(path)) return readPlain(path, readHgt(path), nodata);
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

Status settleVoids(const std::string& path, Reading& reading, Notes& notes) {
  matchNodata(reading.heights);
  const Status masked = applyMask(reading.heights, reading.mask, notes);
  if (!masked.ok()) return {masked.code(), quoted(path) + ": " + masked.message()};
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
  if (Status place = findPlace(path, reading->heights); !place.ok()) return place;
  if (isNamedHgt(path) && !reading->heights.geotransform)
    told.push_back({"its name does not say where it lies, as N46W122.hgt does", ""});
  const Status settled = settleVoids(path, *reading, told);
  if (!settled.ok()) return settled;
  const bool none = nodata && std::isnan(*nodata);  // says that all samples are heights
  if (const auto note = none ? std::nullopt : takeOutliers(reading->heights)) told.push_back(*note);
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

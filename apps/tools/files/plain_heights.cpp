// SPDX-License-Identifier: Apache-2.0
// Heights without a header. Raw: little-endian rows. SRTM (.hgt): a square of big-endian int16
// metres over EGM96, north first, one degree from the first sample to the last, nodata -32768,
// named after its south-western corner (USGS, SRTM Topography, 2015); .hgts: the same in big-endian
// floats (NASADEM, User Guide, 2020).
#include "apps/tools/files/plain_heights.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <regex>

#include "apps/tools/files/file_bytes.hpp"
#include "apps/tools/files/place/ground_spacing.hpp"

namespace tetrakis::tools {
namespace {

constexpr double kHgtNodata = -32768;

struct NamedSample {
  const char* name;
  tks_sample sample;
};
constexpr std::array<NamedSample, 7> kSampleNames{{{"u8", TKS_U8},
                                                   {"i8", TKS_I8},
                                                   {"u16", TKS_U16},
                                                   {"i16", TKS_I16},
                                                   {"u32", TKS_U32},
                                                   {"i32", TKS_I32},
                                                   {"f32", TKS_F32}}};

/// A corner in whole degrees.
struct Corner {
  int north, east;
};

/// South-western corner of a tile called like "N46W122.hgt" or "NASADEM_HGT_n46w122.hgt"; nothing
/// for other names.
std::optional<Corner> hgtCorner(const std::string& path) {
  static const std::regex pattern("(?:.*_)?([NS])([0-9]{2})([EW])([0-9]{3})([^0-9].*)?",
                                  std::regex::icase);
  std::smatch match;
  const std::string name = std::filesystem::path(path).filename().string();
  if (!std::regex_match(name, match, pattern)) return {};
  Corner corner{std::stoi(match[2]), std::stoi(match[4])};
  if (std::toupper(match.str(1)[0]) == 'S') corner.north = -corner.north;
  if (std::toupper(match.str(3)[0]) == 'W') corner.east = -corner.east;
  const bool on_earth =
      corner.north >= -90 && corner.north < 90 && corner.east >= -180 && corner.east < 180;
  return on_earth ? std::optional(corner) : std::nullopt;
}

/// The first sample lies on the north-western corner, the last on the south-eastern one.
GeoTransform tileAt(const Corner& corner, uint32_t width, uint32_t height) {
  const double across = 1.0 / (width - 1), down = 1.0 / (height - 1);
  return {corner.east - 0.5 * across, across, 0, corner.north + 1 + 0.5 * down, 0, -down};
}

/// Tiles are square, but for those of one arc-second beyond 50 degrees, which have half the
/// columns. Nothing for other numbers of samples.
std::optional<std::array<uint32_t, 2>> tileSides(uint64_t samples) {
  constexpr std::array<uint32_t, 2> kNorthern{1801, 3601};
  if (samples == uint64_t{kNorthern[0]} * kNorthern[1]) return kNorthern;
  const auto side = static_cast<uint32_t>(std::lround(std::sqrt(samples)));
  if (side < 2 || uint64_t{side} * side != samples) return {};
  return std::array{side, side};
}

}  // namespace

std::string sampleName(tks_sample sample) {
  for (const NamedSample& known : kSampleNames)
    if (known.sample == sample) return known.name;
  return "unknown";
}

std::optional<RawName> parseRawName(const std::string& text) {
  // Seven digits: products of sizes stay far below 2^64.
  static const std::regex pattern("(.+):([0-9]{1,7})x([0-9]{1,7}):([a-z0-9]+)");
  std::smatch match;
  if (!std::regex_match(text, match, pattern)) return {};
  RawName name{match[1], static_cast<uint32_t>(std::stoul(match[2])),
               static_cast<uint32_t>(std::stoul(match[3])), TKS_U8};
  for (const NamedSample& known : kSampleNames) {
    if (match[4] != known.name) continue;
    name.sample = known.sample;
    return name;
  }
  return {};
}

Result<HeightFile> readRaw(const RawName& name) {
  if (Status status = checkSize(quoted(name.path), uint64_t{name.width} * name.height,
                                tks_sample_bytes(name.sample));
      !status.ok())
    return status;
  auto bytes = readBytes(name.path);
  if (!bytes.ok()) return bytes.status();
  const uint64_t wanted = uint64_t{name.width} * name.height * tks_sample_bytes(name.sample);
  if (bytes->size() != wanted || wanted == 0) {
    return Status(TKS_USAGE, quoted(name.path) + " holds " + std::to_string(bytes->size()) +
                                 " bytes, " + std::to_string(name.width) + " x " +
                                 std::to_string(name.height) + " samples of this type take " +
                                 std::to_string(wanted));
  }
  HeightFile heights;
  heights.width = name.width;
  heights.height = name.height;
  heights.sample = name.sample;
  heights.data = std::move(*bytes);
  reorderBytes(heights.data, tks_sample_bytes(name.sample), std::endian::little);
  return heights;
}

Status writeRaw(const std::string& path, const HeightFile& heights) {
  std::vector<std::byte> data = heights.data;
  reorderBytes(data, tks_sample_bytes(heights.sample), std::endian::little);
  return writeBytes(path, data);
}

bool isNamedHgt(const std::string& path) {
  const std::string format = formatOf(path, "");
  return format == "hgt" || format == "hgts";
}

Result<HeightFile> readHgt(const std::string& path) {
  auto bytes = readBytes(path);
  if (!bytes.ok()) return bytes.status();
  const tks_sample sample = formatOf(path, "") == "hgts" ? TKS_F32 : TKS_I16;
  const size_t sample_bytes = tks_sample_bytes(sample);
  const auto sides = tileSides(bytes->size() / sample_bytes);
  if (!sides || bytes->size() % sample_bytes != 0) {
    return Status(TKS_IO, quoted(path) + " holds " + std::to_string(bytes->size()) +
                              " bytes, which is no square of " + std::to_string(8 * sample_bytes) +
                              "-bit samples");
  }
  HeightFile heights;
  heights.width = (*sides)[0];
  heights.height = (*sides)[1];
  heights.sample = sample;
  heights.data = std::move(*bytes);
  reorderBytes(heights.data, sample_bytes, std::endian::big);
  heights.nodata = kHgtNodata;
  heights.unit = "m";
  heights.vertical_datum = "EGM96";
  heights.crs = "EPSG:4326";
  heights.registration = TKS_REGISTRATION_POINT;
  const auto corner = hgtCorner(path);
  if (!corner) return heights;
  heights.geotransform = tileAt(*corner, heights.width, heights.height);
  if (const auto spacing = groundSpacing(*heights.geotransform, heights.width, heights.height,
                                         {1, 0}, heights.crs)) {
    heights.spacing_x = (*spacing)[0];
    heights.spacing_y = (*spacing)[1];
  }
  return heights;
}

std::string hgtName(const HeightFile& heights) {
  if (!heights.geotransform || heights.width < 2 || heights.width != heights.height) return "";
  const GeoTransform& t = *heights.geotransform;
  const Corner corner{static_cast<int>(std::lround(std::clamp(t[3] - 1, -90.0, 90.0))),
                      static_cast<int>(std::lround(std::clamp(t[0], -180.0, 180.0)))};
  const GeoTransform tile = tileAt(corner, heights.width, heights.height);
  const double tolerance = 1e-3 * tile[1];
  for (size_t i = 0; i < tile.size(); ++i)
    if (!(std::abs(t[i] - tile[i]) <= (i % 3 == 0 ? tolerance : tolerance / heights.width)))
      return "";
  std::array<char, 40> name{};
  std::snprintf(name.data(), name.size(), "%c%02d%c%03d.hgt", corner.north < 0 ? 'S' : 'N',
                std::abs(corner.north), corner.east < 0 ? 'W' : 'E', std::abs(corner.east));
  return name.data();
}

Status writeHgt(const std::string& path, const HeightFile& heights) {
  if (heights.sample != TKS_I16 || heights.width != heights.height) {
    return {TKS_USAGE,
            "an .hgt file holds a square of signed 16-bit samples: write a .tif instead"};
  }
  std::vector<std::byte> data = heights.data;
  reorderBytes(data, sizeof(int16_t), std::endian::big);
  return writeBytes(path, data);
}

}  // namespace tetrakis::tools

// SPDX-License-Identifier: Apache-2.0
#include "apps/tools/commands/encode_notes.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <optional>

#include "apps/tools/files/file_bytes.hpp"
#include "apps/tools/files/place/crs_units.hpp"
#include "apps/tools/files/place/ground_spacing.hpp"
#include "apps/tools/files/place/texture_place.hpp"
#include "apps/tools/files/text.hpp"
#include "apps/tools/files/void_samples.hpp"
#include "apps/tools/report/scene.hpp"
#include "base/coordinates.hpp"

namespace tetrakis::tools {
namespace {

/// Whether meshes or pictures of the ground count.
bool isSeen(const EncodeArguments& arguments) {
  return !arguments.texture.empty() || !arguments.report.empty() || arguments.triangles > 0 ||
         arguments.engine == "rendered" || !arguments.cameras.isDefault();
}

}  // namespace

std::string voidNote(const HeightFile& heights) {
  const Surface surface = heightsOf(heights);
  const auto count = std::count_if(surface.values.begin(), surface.values.end(),
                                   [](double height) { return std::isnan(height); });
  if (count == 0) return "";
  std::string note = counted(static_cast<uint64_t>(count), "sample is", "samples are") + " void";
  if (const uint64_t nans = nansBesideNodata(heights))
    note += ", of which " + counted(nans, "is", "are") + " NaN and will be " +
            shortest(*heights.nodata) + " as the others";
  return note;
}

Notes guesses(const EncodeArguments& arguments, const HeightFile& heights, const Notes& told) {
  const auto asked = [&told](const char* option) {
    return std::any_of(told.begin(), told.end(),
                       [option](const Note& note) { return note.option == option; });
  };
  const bool converted = !arguments.max_error.empty() &&
                         std::isalpha(static_cast<unsigned char>(arguments.max_error.back()));
  const bool seen = isSeen(arguments);
  Notes notes;
  if (arguments.crs && !arguments.crs->empty() && !isKnownCrs(*arguments.crs))
    notes.push_back({"PROJ does not know the CRS '" + *arguments.crs + "', which is kept", ""});
  if (heights.unit.empty() && (seen || converted) && !asked("--unit"))
    notes.push_back({"the unit of the heights is not known and counts as metres: give --unit", ""});
  if (heights.spacing_x <= 0 && heights.spacing_y <= 0 && seen && !asked("--spacing"))
    notes.push_back({"the spacing of the samples is not known and counts as " +
                         shortest(kUnknownSpacing) + " m: give --spacing",
                     ""});
  return notes;
}

namespace {

/// Degrees that the columns take; nothing where that is not a turn but for a part of a column.
std::optional<double> nearlyATurn(const HeightFile& heights) {
  constexpr double kTurn = 360, kPart = 0.99;  // of a column: without one there is a gap
  if (!heights.geotransform) return {};
  const GeoTransform& t = *heights.geotransform;
  const double column = std::abs(t[1]) * gridUnitOf(heights.geo_keys, heights.crs).degrees;
  const double all = heights.width * column;
  if (t[2] != 0 || t[4] != 0 || !(std::abs(all - kTurn) < kPart * column)) return {};
  return all;
}

}  // namespace

std::string roundNote(const std::string& name, const HeightFile& heights) {
  const ColumnsRound round = columnsRound(heights, heights.width);
  if (round == ColumnsRound::kOnce) return "";
  if (round == ColumnsRound::kNo) {
    const std::optional<double> degrees = nearlyATurn(heights);
    if (!degrees) return "";
    return quoted(name) + " goes round the Earth but for a part of a column: its columns take " +
           shortest(*degrees) +
           " degrees, so it is coded as a plane, with a seam; --domain cylinder closes it";
  }
  return quoted(name) +
         " goes round the Earth to its first column, which is there again as the last one, so it "
         "is coded as a plane, with a seam; without that column (gdal_translate -srcwin 0 0 " +
         std::to_string(heights.width - 1) + " " + std::to_string(heights.height) +
         ") it is a cylinder";
}

std::string cubeNote(const HeightFile& cube, const CubeErrors& errors) {
  const auto rounded = [](double error) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.3g", error);
    return std::string(text.data());
  };
  return "the heights go to a cube of depth " + std::to_string(cube.cube_depth) +
         ", which gives them back within " + rounded(errors.largest) +
         (cube.unit.empty() ? "" : " " + cube.unit) + ", with an RMSE of " + rounded(errors.rmse);
}

std::string whiteNote(const std::string& texture, const ImageFile& image) {
  if (image.white() == largestTexel(image.sample)) return "";
  return quoted(texture) + " uses a part of its 16 bits: " + std::to_string(image.white()) +
         " counts as white: give --white-level";
}

std::string placeNote(const std::string& texture, const HeightFile& heights,
                      const ImageFile& image) {
  PlacedRaster texels(image.width, image.height, image.place);
  if (texels.crs.empty()) texels.crs = heights.crs;
  const TexturePlace place(PlacedRaster(heights.width, heights.height, heights), texels);
  if (!place.texelsOver({0, 0, heights.width, heights.height}))
    return quoted(texture) + " lies beside the ground of the heights, which get its border";
  if (!place.isOwn()) return "";
  const char* const who =
      texels.crs == heights.crs ? "the encoder's cameras see" : "cameras and web pages see";
  if (place.isTurned()) {
    return quoted(texture) +
           " covers the ground of the heights, but begins at another corner: meshes have it where "
           "it lies, but " +
           who + " it turned; gdalwarp writes rasters north-up";
  }
  return quoted(texture) +
         " covers other ground than the heights: meshes have it where it lies, but " + who +
         " it stretched over them; gdalwarp can cut it to their ground";
}

std::string boundNote(const EncodeArguments& arguments, const tks_info& info) {
  return arguments.max_error.empty() || info.lossless == 0
             ? ""
             : "--max-error " + arguments.max_error +
                   ": nothing takes fewer bytes than every bit, which the stream restores";
}

std::string maskNote(const tks_info& info) {
  return info.has_voids == 0 || info.voids_known != 0
             ? ""
             : "the mask of voids does not fit: some voids are shown as ground";
}

std::string summary(const std::string& name, const Decoder& decoder) {
  const tks_info& info = decoder.info();
  uint64_t further = 0;
  for (uint32_t i = 0; i < info.components; ++i) {
    const tks_component one = *decoder.component(i);
    if (one.is_taken == 0) further += one.available_bytes;
  }
  const uint64_t heads =
      info.stream_bytes - info.header_bytes - info.geometry_bytes - info.texture_bytes - further;
  return name + ": " + std::to_string(info.stream_bytes) + " bytes (header " +
         std::to_string(info.header_bytes) + ", heights " + std::to_string(info.geometry_bytes) +
         ", texture " + std::to_string(info.texture_bytes) +
         (further > 0 ? ", other components " + std::to_string(further) : "") +
         ", heads of packets " + std::to_string(heads) + ")";
}

}  // namespace tetrakis::tools

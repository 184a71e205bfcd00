// SPDX-License-Identifier: Apache-2.0
// tetrakis info: what a stream, or a prefix of one, says about itself.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <nlohmann/json.hpp>
#include <vector>

#include "apps/tools/commands/command.hpp"
#include "apps/tools/commands/options.hpp"
#include "apps/tools/files/cube_heights.hpp"
#include "apps/tools/files/plain_heights.hpp"
#include "apps/tools/output/json.hpp"

namespace tetrakis::tools {
namespace {

struct InfoArguments {
  StreamSource source;
  bool json = false;
};

Json stated(double value) {
  return value < 0 ? Json() : Json(value);
}

/// Steps of 0.75 dB say no more than two decimals of dB, or three digits of an error.
Json rounded(double value, const char* format) {
  if (value < 0 || !std::isfinite(value)) return Json();
  char text[400];
  std::snprintf(text, sizeof text, format, value);
  return std::strtod(text, nullptr);
}

/// JSON has numbers that are finite only.
Json nodataJson(const tks_info& info) {
  if (!info.has_nodata) return Json();
  if (std::isnan(info.nodata)) return "nan";
  if (std::isinf(info.nodata)) return info.nodata < 0 ? "-inf" : "inf";
  return info.nodata;
}

Json transformJson(bool known, const double* transform) {
  return known ? Json(std::vector<double>(transform, transform + 6)) : Json();
}

Json registrationJson(tks_registration registration) {
  if (registration == TKS_REGISTRATION_AREA) return "area";
  return registration == TKS_REGISTRATION_POINT ? Json("point") : Json();
}

/// What heights_drawn and texture_drawn stand for.
constexpr std::array<const char*, 4> kCodings = {"wavelet", "drawn", "overlay", "stored"};

/// What tks_domain stands for.
constexpr std::array<const char*, 3> kDomains = {"plane", "cylinder", "forest"};

Json forestJson(const tks_info& info) {
  if (info.forest.patches == 0) return {};
  return {{"depth", info.forest.depth},
          {"patches", info.forest.patches},
          {"cube", isGridOnCube(info)},
          {"grid_width", info.grid_width > 0 ? Json(info.grid_width) : Json()},
          {"grid_height", info.grid_height > 0 ? Json(info.grid_height) : Json()}};
}

/// The box holds the corners of the base mesh, so that the object may reach a little beyond it.
Json objectJson(const tks_info& info) {
  const tks_base_mesh& base = info.base_mesh;
  if (info.object_triangles > 0)
    return {{"kind", "triangles"}, {"triangles", info.object_triangles}};
  if (!isObject(info)) return {};
  std::array<std::vector<double>, 2> box{std::vector<double>(3), std::vector<double>(3)};
  for (size_t axis = 0; axis < 3; ++axis) {
    int32_t least = base.corners[axis], most = least;
    for (size_t i = axis; i < size_t{12} * info.forest.patches; i += 3) {
      least = std::min(least, base.corners[i]);
      most = std::max(most, base.corners[i]);
    }
    box[0][axis] = base.origin[axis] + base.cell * least;
    box[1][axis] = base.origin[axis] + base.cell * most;
  }
  const uint64_t side = (uint64_t{1} << info.forest.depth) + 1;
  return {{"kind", "resampled"},
          {"patches", info.forest.patches},
          {"samples_of_patch", side * side},
          {"position_bits", base.position_bits},
          {"cell", base.cell},
          {"base_from", box[0]},
          {"base_to", box[1]}};
}

/// As it stands in the stream, if it is JSON.
Json materialJson(const tks_info& info) {
  const Json json = Json::parse(info.material, nullptr, false);
  return json.is_object() ? json : Json();
}

Json heightsJson(const tks_info& info) {
  if (!info.has_heights) return {};
  return {{"width", info.width},
          {"height", info.height},
          {"domain", kDomains.at(static_cast<size_t>(info.domain))},
          {"forest", forestJson(info)},
          {"sample", sampleName(info.sample)},
          {"scale", info.scale},
          {"offset", info.offset},
          {"unit", textOrNull(info.unit)},
          {"vertical_datum", textOrNull(info.vertical_datum)},
          {"crs", textOrNull(info.crs)},
          {"geo_keys", textOrNull(info.geo_keys)},
          {"geotransform", transformJson(info.has_geotransform != 0, info.geotransform)},
          {"registration", registrationJson(info.registration)},
          {"position_bytes", info.positions_size > 0 ? Json(info.positions_size) : Json()},
          {"description", textOrNull(info.description)},
          {"spacing_x", info.spacing_x > 0 ? Json(info.spacing_x) : Json()},
          {"spacing_y", info.spacing_y > 0 ? Json(info.spacing_y) : Json()},
          {"step", info.step},
          {"base", info.base},
          {"exact_steps", info.exact_steps != 0},
          {"coding", kCodings.at(static_cast<size_t>(info.heights_drawn))},
          {"voids", info.has_voids != 0},
          {"voids_known", info.voids_known != 0},
          {"nodata", nodataJson(info)},
          {"regions", info.regions > 0 ? Json(info.regions) : Json()},
          {"max_error", stated(info.max_error)},
          {"rmse", rounded(info.heights_rmse, "%.3g")}};
}

Json textureJson(const tks_info& info) {
  if (!info.has_texture) return {};
  return {{"width", info.texture_width},
          {"height", info.texture_height},
          {"domain", kDomains.at(static_cast<size_t>(info.texture_domain))},
          {"channels", info.texture_channels},
          {"alpha", info.texture_opaque == 0},
          {"sample", sampleName(info.texture_sample)},
          {"white_level", info.texture_white_level},
          {"coding", kCodings.at(static_cast<size_t>(info.texture_drawn))},
          {"cutout", info.texture_cutout != 0},
          {"crs", textOrNull(info.texture_crs)},
          {"geo_keys", textOrNull(info.texture_geo_keys)},
          {"geotransform",
           transformJson(info.texture_has_geotransform != 0, info.texture_geotransform)},
          {"registration", registrationJson(info.texture_registration)},
          {"position_bytes",
           info.texture_positions_size > 0 ? Json(info.texture_positions_size) : Json()},
          {"regions", info.texture_regions > 0 ? Json(info.texture_regions) : Json()},
          {"psnr", rounded(info.texture_psnr, "%.2f")},
          {"exact", info.texture_psnr < 0 ? Json() : Json(std::isinf(info.texture_psnr))}};
}

/// What tks_info.index stands for.
constexpr std::array<const char*, 4> kIndexes = {"none", "packets", "windows", "pages"};

/// What tks_component_kind stands for.
constexpr std::array<const char*, 3> kComponents = {"heights", "texture", "unknown"};

Json componentsJson(const Decoder& decoder) {
  Json list = Json::array();
  for (uint32_t i = 0; i < decoder.info().components; ++i) {
    const tks_component one = *decoder.component(i);
    list.push_back({{"number", i},
                    {"name", textOrNull(one.name)},
                    {"kind", kComponents.at(static_cast<size_t>(one.kind))},
                    {"width", one.width},
                    {"height", one.height},
                    {"bytes", one.available_bytes},
                    {"taken", one.is_taken != 0}});
  }
  return list;
}

Json infoJson(const tks_info& info) {
  return {{"format_version", info.format_version},
          {"profile", info.profile},
          {"level", info.level},
          {"stream_bytes", info.stream_bytes},
          {"available_bytes", info.available_bytes},
          {"complete", info.available_bytes >= info.stream_bytes},
          {"header_bytes", info.header_bytes},
          {"least_bytes", info.least_bytes},
          {"shows_sketch", info.shows_sketch != 0},
          {"geometry_bytes", info.geometry_bytes},
          {"texture_bytes", info.texture_bytes},
          {"packets", info.packets},
          {"index", kIndexes.at(static_cast<size_t>(info.index))},
          {"lossless", info.lossless != 0},
          {"frames", info.frames},
          {"frame", info.frame},
          {"triangles", info.triangles > 0 ? Json(info.triangles) : Json()},
          {"object", objectJson(info)},
          {"material", materialJson(info)},
          {"heights", heightsJson(info)},
          {"texture", textureJson(info)}};
}

/// The time counts from the epoch.
Json sequenceJson(const SequencePlace& place) {
  const bool is_timed = place.tick_numerator > 0;
  const auto seconds = [&](int64_t ticks) {
    return is_timed ? Json(secondsOf(ticks, place.tick_numerator, place.tick_denominator)) : Json();
  };
  return {{"frames", place.frames},
          {"groups", place.groups},
          {"bytes", place.bytes},
          {"epoch", textOrNull(place.epoch)},
          {"calendar", textOrNull(place.calendar)},
          {"tick_seconds", seconds(1)},
          {"frame", place.frame},
          {"ticks", place.time},
          {"seconds", seconds(place.time)},
          {"group_first_frame", place.group.first_frame},
          {"group_offset", place.group.offset},
          {"group_bytes", place.group.bytes},
          {"group_depth", place.group.depth},
          {"group_bytes_back", place.group.bytes_back}};
}

Status info(const InfoArguments& arguments) {
  const Result<OpenStream> stream = openStream(arguments.source);
  if (!stream.ok()) return stream.status();
  const tks_info& told = stream->decoder.info();
  Json json = infoJson(told);
  const uint32_t taken = (told.has_heights != 0) + (told.has_texture != 0);
  if (told.components > taken || !arguments.source.components.empty())
    json["components"] = componentsJson(stream->decoder);
  if (stream->sequence) json["sequence"] = sequenceJson(*stream->sequence);
  return print(arguments.json ? dump(json) : table(json));
}

}  // namespace

void addInfo(CLI::App& app, CommandLine& line) {
  const auto arguments = std::make_shared<InfoArguments>();
  CLI::App& verb = *app.add_subcommand("info", "Say what a stream holds");
  addSource(verb, arguments->source);
  addFrame(verb, arguments->source);
  addComponent(verb, arguments->source);
  verb.add_flag("--json", arguments->json, "JSON instead of a table");
  verb.callback([arguments, &line] { line.action = [arguments] { return info(*arguments); }; });
}

}  // namespace tetrakis::tools

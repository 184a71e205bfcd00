// SPDX-License-Identifier: Apache-2.0
#include "apps/tools/report/page_data.hpp"

#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

namespace tetrakis::tools {
namespace {

/// JSON has no infinity.
nlohmann::json finite(std::optional<double> value) {
  return value && std::isfinite(*value) ? nlohmann::json(*value) : nlohmann::json();
}

nlohmann::json jsonOf(const std::vector<SeenPair>& pairs, bool named) {
  nlohmann::json list = nlohmann::json::array();
  for (const SeenPair& pair : pairs) {
    list.push_back({{"heights", pair.split.heights},
                    {"texture", pair.split.texture},
                    {"psnr", finite(pair.psnr)}});
    if (named) list.back()["name"] = std::string(1, static_cast<char>('a' + list.size() - 1));
  }
  return list;
}

nlohmann::json jsonOf(const PairPlane& plane) {
  std::vector<SeenPair> pairs;
  for (size_t h = 0; h < plane.heights.size(); ++h)
    for (size_t t = 0; t < plane.textures.size(); ++t)
      pairs.push_back({{plane.heights[h], plane.textures[t]}, plane.at(h, t)});
  nlohmann::json json = {{"heights", plane.heights},
                         {"textures", plane.textures},
                         {"pairs", jsonOf(pairs, false)},
                         {"hull", jsonOf(plane.hull, false)},
                         {"greedy", jsonOf(plane.greedy, false)},
                         {"equal_psnr", jsonOf(plane.equal_psnr, true)},
                         {"equal_bytes", jsonOf(plane.equal_bytes, true)},
                         {"shipped", nlohmann::json::array()}};
  for (const Split& split : plane.shipped)
    json["shipped"].push_back({{"heights", split.heights}, {"texture", split.texture}});
  return json;
}

}  // namespace

std::string pageData(const Report& report) {
  nlohmann::json json = {{"cameras", nlohmann::json::array()},
                         {"cuts", nlohmann::json::array()},
                         {"meshes", nlohmann::json::array()},
                         {"plane", report.plane ? jsonOf(*report.plane) : nlohmann::json()}};
  for (const Camera& camera : report.cameras) json["cameras"].push_back(camera.name);
  for (const ReportRow& row : report.rows)
    json["cuts"].push_back({{"bytes", row.measurement.bytes},
                            {"geometry", row.measurement.geometry_bytes},
                            {"texture", row.measurement.texture_bytes},
                            {"screen", finite(row.measurement.screen_psnr)}});
  for (const MeshPlan& mesh : report.meshes)
    json["meshes"].push_back(
        {{"width", mesh.width}, {"height", mesh.height}, {"edges", mesh.edges}, {"eye", mesh.eye}});
  std::string text = json.dump(-1, ' ', true, nlohmann::json::error_handler_t::replace);
  for (size_t at = 0; (at = text.find('<', at)) != std::string::npos; at += 6)
    text.replace(at, 1, "\\u003c");  // a name must not end the script
  return text;
}

}  // namespace tetrakis::tools

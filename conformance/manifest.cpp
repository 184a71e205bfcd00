// SPDX-License-Identifier: Apache-2.0
// Manifest as JSON: {"vectors": [{name, file, purpose, cuts: [{bytes, level?, component?,
// status, heights?, texture?, triangles?}]}]}.
#include "conformance/manifest.hpp"

#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

namespace tetrakis::conformance {
namespace {

using Json = nlohmann::ordered_json;

Json toJson(const Cut& cut) {
  Json json{{"bytes", cut.bytes}};
  if (cut.level > 0) json["level"] = cut.level;
  if (cut.component) json["component"] = *cut.component;
  json["status"] = cut.status;
  if (!cut.heights.empty()) json["heights"] = cut.heights;
  if (!cut.texture.empty()) json["texture"] = cut.texture;
  if (!cut.triangles.empty()) json["triangles"] = cut.triangles;
  return json;
}

Json toJson(const Vector& vector) {
  Json cuts = Json::array();
  for (const Cut& cut : vector.cuts) cuts.push_back(toJson(cut));
  return {{"name", vector.name},
          {"file", vector.file},
          {"purpose", vector.purpose},
          {"cuts", std::move(cuts)}};
}

Cut cutOf(const Json& json) {
  Cut cut{json.at("bytes").get<uint64_t>(), json.value("level", 0),    json.at("status").get<int>(),
          json.value("heights", ""),        json.value("texture", ""), json.value("triangles", "")};
  if (json.contains("component")) cut.component = json.at("component").get<uint32_t>();
  return cut;
}

Vector vectorOf(const Json& json) {
  Vector vector{json.at("name"), json.at("file"), json.at("purpose"), {}};
  for (const Json& cut : json.at("cuts")) vector.cuts.push_back(cutOf(cut));
  return vector;
}

}  // namespace

Result<std::vector<uint8_t>> readFile(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  std::vector<uint8_t> bytes{std::istreambuf_iterator<char>(in), {}};
  if (!in.is_open() || in.bad()) return Status(TKS_IO, "Cannot read '" + path + "'.");
  return bytes;
}

Status writeFile(const std::string& path, const std::string& content) {
  std::ofstream out(path, std::ios::binary);
  out << content;
  out.close();
  return out ? Status() : Status(TKS_IO, "Cannot write '" + path + "'.");
}

Result<std::vector<Vector>> readManifest(const std::string& directory) {
  const std::string path = directory + "/" + kManifestName;
  const auto bytes = readFile(path);
  if (!bytes.ok()) return bytes.status();
  try {
    const Json document = Json::parse(*bytes);
    std::vector<Vector> vectors;
    for (const Json& json : document.at("vectors")) vectors.push_back(vectorOf(json));
    return vectors;
  } catch (const nlohmann::json::exception& error) {
    return Status(TKS_CORRUPT, "'" + path + "' is not a manifest: " + error.what() + ".");
  }
}

Status writeManifest(const std::string& directory, const std::vector<Vector>& vectors) {
  Json document;
  for (const Vector& vector : vectors) document["vectors"].push_back(toJson(vector));
  return writeFile(directory + "/" + kManifestName, document.dump(1) + "\n");
}

}  // namespace tetrakis::conformance

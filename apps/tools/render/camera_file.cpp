// SPDX-License-Identifier: Apache-2.0
// Cameras from JSON.
#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "apps/tools/render/render.hpp"
#include "codec/ground/camera.hpp"

namespace tetrakis::tools {
namespace {

using Json = nlohmann::json;

/// Reads fields of one camera; the first that is wrong stays in `problem`.
class FieldReader {
 public:
  explicit FieldReader(const Json& object) : object_(object) {}

  void vector(const char* key, Vec3& out, bool required) {
    const Json* value = find(key, required);
    if (!value) return;
    if (!value->is_array() || value->size() != 3) return complain(key, "must be three numbers");
    for (size_t i = 0; i < 3; ++i) {
      if (!(*value)[i].is_number()) return complain(key, "must be three numbers");
      out[i] = (*value)[i].get<double>();
      if (!std::isfinite(out[i])) return complain(key, "must be finite");
    }
  }

  void angle(const char* key, double& out) {
    const Json* value = find(key, false);
    if (!value) return;
    if (!value->is_number()) return complain(key, "must be a number of degrees");
    out = value->get<double>();
    if (!(out > 0 && out < 180)) complain(key, "must lie between 0 and 180 degrees");
  }

  void weight(const char* key, double& out) {
    const Json* value = find(key, false);
    if (!value) return;
    if (!value->is_number()) return complain(key, "must be a number");
    out = value->get<double>();
    if (!(out >= 0) || !std::isfinite(out)) complain(key, "must not be negative");
  }

  void side(const char* key, uint32_t& out) {
    const Json* value = find(key, false);
    if (!value) return;
    const bool fits = value->is_number_unsigned() && value->get<uint64_t>() >= 1 &&
                      value->get<uint64_t>() <= kLargestPicture;
    if (!fits) return complain(key, "must be a whole number from 1 to 8192");
    out = value->get<uint32_t>();
  }

  void text(const char* key, std::string& out) {
    const Json* value = find(key, false);
    if (!value) return;
    if (!value->is_string()) return complain(key, "must be a string");
    out = value->get<std::string>();
  }

  /// A misspelt field would be left at its default: to be called when all were read.
  void noOthers() {
    for (const auto& [key, value] : object_.items())
      if (std::find(known_.begin(), known_.end(), key) == known_.end())
        return complain(key, "is no field of a camera");
  }

  void complain(const std::string& key, const char* what) {
    if (problem_.empty()) problem_ = "\"" + key + "\" " + what;
  }
  const std::string& problem() const { return problem_; }

 private:
  const Json* find(const char* key, bool required) {
    known_.push_back(key);
    const auto at = object_.find(key);
    if (at != object_.end()) return &*at;
    if (required) complain(key, "is missing");
    return nullptr;
  }

  const Json& object_;
  std::vector<std::string> known_;
  std::string problem_;
};

Result<Camera> readCamera(const Json& object, size_t index) {
  const std::string who = "camera " + std::to_string(index + 1);
  if (!object.is_object()) return Status(TKS_USAGE, who + " must be an object");
  Camera camera;
  camera.name = who;
  FieldReader reader(object);
  reader.text("name", camera.name);
  reader.vector("eye", camera.eye, true);
  reader.vector("target", camera.target, true);
  reader.vector("up", camera.up, false);
  reader.angle("fov_y", camera.fov_y);
  reader.side("width", camera.width);
  reader.side("height", camera.height);
  reader.weight("weight", camera.weight);
  reader.noOthers();
  const Vec3 direction = normalized(subtract(camera.target, camera.eye));
  if (length(direction) == 0) reader.complain("target", "must differ from \"eye\"");
  if (!(length(cross(direction, normalized(camera.up))) > 1e-9))
    reader.complain("up", "must not be parallel to the line of sight");
  if (!reader.problem().empty()) {
    const std::string named = camera.name == who ? who : who + " ('" + camera.name + "')";
    return Status(TKS_USAGE, named + ": " + reader.problem());
  }
  return camera;
}

Status unreadable(const std::string& path) {
  return Status(TKS_IO, "cannot read the cameras '" + path + "': " + std::strerror(errno));
}

Result<std::string> readText(const std::string& path) {
  std::ifstream file(path);
  if (!file) return unreadable(path);
  try {
    return std::string(std::istreambuf_iterator<char>(file), {});
  } catch (const std::ios_base::failure&) {
    return unreadable(path);
  }
}

Result<Json> readJson(const std::string& path) {
  const Result<std::string> text = readText(path);
  if (!text.ok()) return text.status();
  if (text->find_first_not_of(" \t\r\n") == std::string::npos)
    return Status(TKS_USAGE, "'" + path + "' is empty: it must be JSON with a list \"cameras\"");
  try {
    return Json::parse(*text);
  } catch (const Json::parse_error& error) {
    const auto end = text->begin() + static_cast<ptrdiff_t>(std::min(error.byte, text->size()));
    const auto line = 1 + std::count(text->begin(), end, '\n');
    return Status(TKS_USAGE,
                  "'" + path + "' is not JSON from line " + std::to_string(line) + " on");
  } catch (const Json::exception&) {
    return Status(TKS_USAGE, "'" + path + "' holds a number that is too large to be read");
  }
}

}  // namespace

Result<std::vector<Camera>> readCameras(const std::string& path) {
  const Result<Json> json = readJson(path);
  if (!json.ok()) return json.status();
  const bool listed =
      json->is_object() && json->contains("cameras") && json->at("cameras").is_array();
  if (!listed) return Status(TKS_USAGE, "'" + path + "' must be an object with a list \"cameras\"");
  if (json->at("cameras").empty())
    return Status(TKS_USAGE, "'" + path + "' lists no camera: \"cameras\" is empty");
  std::vector<Camera> cameras;
  for (const Json& object : json->at("cameras")) {
    Result<Camera> camera = readCamera(object, cameras.size());
    if (!camera.ok())
      return Status(camera.status().code(), "'" + path + "', " + camera.status().message());
    cameras.push_back(std::move(*camera));
  }
  return cameras;
}

}  // namespace tetrakis::tools

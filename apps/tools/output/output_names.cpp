// SPDX-License-Identifier: Apache-2.0
// Whether the outputs of one command get in each other's way.
#include "apps/tools/output/output_names.hpp"

#include <filesystem>
#include <set>

#include "apps/tools/files/file_bytes.hpp"

namespace tetrakis::tools {
namespace fs = std::filesystem;

fs::path followLinks(fs::path path) {
  constexpr int kMaxLinks = 40;  // as Linux has it
  std::error_code ignored;
  for (int i = 0; i < kMaxLinks && fs::is_symlink(fs::symlink_status(path, ignored)); ++i)
    path = path.parent_path() / fs::read_symlink(path, ignored);
  return path;
}

namespace {

bool isDevice(const std::string& name) {
  std::error_code ignored;
  return name != "-" && fs::exists(name, ignored) && !fs::is_regular_file(name, ignored);
}

/// One path for all names of a file.
fs::path placeOf(const std::string& name) {
  if (name == "-") return name;
  std::error_code ignored;
  const fs::path path = fs::weakly_canonical(fs::absolute(followLinks(name), ignored), ignored);
  return path.empty() ? fs::path(name) : path;
}

}  // namespace

Status checkDistinct(const std::vector<std::string>& names) {
  std::set<fs::path> taken;
  for (const std::string& name : names) {
    if (isDevice(name) || taken.insert(placeOf(name)).second) continue;
    if (name == "-") return {TKS_USAGE, "only one output can be standard output"};
    return {TKS_USAGE, "two outputs would be " + quoted(name) + ": give each a name of its own"};
  }
  return {};
}

Status checkInputsStay(const std::vector<std::string>& inputs, const std::string& output) {
  if (output == "-" || isDevice(output)) return {};
  for (const std::string& input : inputs) {
    if (input.empty() || input == "-" || placeOf(input) != placeOf(output)) continue;
    return {TKS_USAGE, "the output would replace the input " + quoted(input) + ": name another"};
  }
  return {};
}

std::vector<std::string> meshFiles(const std::string& mesh) {
  std::vector<std::string> files{mesh};
  if (formatOf(mesh, "") != "obj") return files;
  const std::string name = fs::path(mesh).replace_extension().string();
  for (const char* side :
       {".mtl", ".png", "_normal.png", "_roughness.png", "_metallic.png", "_emissive.png"}) {
    files.push_back(name + side);
  }
  return files;
}

}  // namespace tetrakis::tools

// SPDX-License-Identifier: Apache-2.0
// Whether the outputs of one command get in each other's way.
#include "tools/commands/output_names.hpp"

#include <filesystem>
#include <set>

#include "tools/files/file_bytes.hpp"

namespace tetrakis::tools {
namespace fs = std::filesystem;

fs::path followLinks(fs::path path) {
  constexpr int kMaxLinks = 40;  // as Linux has it
  std::error_code ignored;
  for (int i = 0; i < kMaxLinks && fs::is_symlink(fs::symlink_status(path, ignored)); ++i)
    path = path.parent_path() / fs::read_symlink(path, ignored);
  return path;
}

Status checkDistinct(const std::vector<std::string>& names) {
  std::set<fs::path> taken;
  for (const std::string& name : names) {
    std::error_code ignored;
    if (name != "-" && fs::exists(name, ignored) && !fs::is_regular_file(name, ignored)) continue;
    const fs::path path =
        name == "-" ? fs::path(name)
                    : fs::weakly_canonical(fs::absolute(followLinks(name), ignored), ignored);
    if (taken.insert(path.empty() ? fs::path(name) : path).second) continue;
    if (name == "-") return {TKS_USAGE, "only one output can be standard output"};
    return {TKS_USAGE, "two outputs would be " + quoted(name) + ": give each a name of its own"};
  }
  return {};
}

std::vector<std::string> meshFiles(const std::string& mesh) {
  std::vector<std::string> files{mesh};
  if (formatOf(mesh, "") != "obj") return files;
  for (const char* side : {".mtl", ".png"}) {
    files.push_back(fs::path(mesh).replace_extension(side).string());
  }
  return files;
}

}  // namespace tetrakis::tools

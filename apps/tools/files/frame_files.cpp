// SPDX-License-Identifier: Apache-2.0
#include "apps/tools/files/frame_files.hpp"

#include <glob.h>

#include <filesystem>

#include "apps/tools/files/file_bytes.hpp"

namespace tetrakis::tools {

bool isPattern(const std::string& path) {
  return path.find_first_of("*?[") != std::string::npos && !std::filesystem::exists(path);
}

Result<std::vector<std::string>> filesOf(const std::string& pattern) {
  if (!isPattern(pattern)) return std::vector<std::string>{pattern};
  glob_t found = {};
  const int failed = glob(pattern.c_str(), 0, nullptr, &found);
  std::vector<std::string> files(found.gl_pathv, found.gl_pathv + found.gl_pathc);
  globfree(&found);
  if (failed == 0 && !files.empty()) return files;
  return Status(TKS_IO, "no file is called as " + quoted(pattern) + " says");
}

Result<FrameNames> frameNames(const std::string& heights, const std::string& textures) {
  FrameNames names;
  if (!heights.empty()) {
    Result<std::vector<std::string>> files = filesOf(heights);
    if (!files.ok()) return files.status();
    names.heights = *std::move(files);
  }
  if (!textures.empty()) {
    Result<std::vector<std::string>> files = filesOf(textures);
    if (!files.ok()) return files.status();
    names.textures = *std::move(files);
  }
  const bool both = !names.heights.empty() && !names.textures.empty();
  if (!both || names.heights.size() == names.textures.size()) return names;
  return Status(TKS_USAGE, std::to_string(names.heights.size()) + " heights and " +
                               std::to_string(names.textures.size()) +
                               " textures: each frame takes one of both");
}

}  // namespace tetrakis::tools

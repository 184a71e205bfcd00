// SPDX-License-Identifier: Apache-2.0
#include "bench/harness/height_files.hpp"

#include <algorithm>
#include <cstdio>

namespace tetrakis::bench {

std::vector<std::filesystem::path> filesBelow(
    const std::vector<std::string>& folders, const std::vector<std::string>& filters,
    const std::function<bool(const std::filesystem::path&)>& wanted) {
  std::vector<std::filesystem::path> files;
  for (const std::string& folder : folders) {
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
      const std::string path = entry.path().string();
      const bool passes = filters.empty() ||
                          std::any_of(filters.begin(), filters.end(), [&](const std::string& text) {
                            return path.find(text) != std::string::npos;
                          });
      if (passes && entry.is_regular_file() && wanted(entry.path())) files.push_back(entry.path());
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

std::vector<std::filesystem::path> heightFilesBelow(const std::string& folder,
                                                    const std::vector<std::string>& filters) {
  return filesBelow({folder}, filters, [](const std::filesystem::path& path) {
    return path.extension() == ".tif" || path.extension() == ".hgt";
  });
}

bool measureHeightFiles(const std::vector<std::string>& folders,
                        const std::vector<std::string>& filters, const MeasureFile& measure) {
  bool all = true;
  for (const std::string& folder : folders) {
    for (const std::filesystem::path& path : heightFilesBelow(folder, filters)) {
      std::filesystem::path item = std::filesystem::relative(path, folder);
      const Status status = measure(path.string(), item.replace_extension().string());
      if (status.ok()) continue;
      std::fprintf(stderr, "%s: %s\n", path.c_str(), status.message().c_str());
      all = false;
    }
  }
  return all;
}

}  // namespace tetrakis::bench

// SPDX-License-Identifier: Apache-2.0
#include "bench/harness/height_files.hpp"

#include <algorithm>

namespace tetrakis::bench {

std::vector<std::filesystem::path> heightFilesBelow(const std::string& folder,
                                                    const std::vector<std::string>& filters) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    const std::string name = entry.path().string(), extension = entry.path().extension().string();
    const bool wanted = filters.empty() ||
                        std::any_of(filters.begin(), filters.end(), [&](const std::string& text) {
                          return name.find(text) != std::string::npos;
                        });
    if (wanted && (extension == ".tif" || extension == ".hgt")) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace tetrakis::bench

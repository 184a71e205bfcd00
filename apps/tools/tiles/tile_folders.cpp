// SPDX-License-Identifier: Apache-2.0
#include "apps/tools/tiles/tile_folders.hpp"

#include "apps/tools/files/file_bytes.hpp"

namespace tetrakis::tools {

Status writeTiles(const std::string& folder, const TileRange& range, const WriteTile& write) {
  for (uint32_t x = range.x0; x <= range.x1; ++x) {
    const auto column =
        std::filesystem::path(folder) / std::to_string(range.level) / std::to_string(x);
    std::error_code error;
    std::filesystem::create_directories(column, error);
    if (error) return {TKS_IO, "cannot create " + quoted(column.string()) + ": " + error.message()};
    for (uint32_t y = range.y0; y <= range.y1; ++y)
      if (Status status = write({range.level, x, y}, column); !status.ok()) return status;
  }
  return {};
}

}  // namespace tetrakis::tools

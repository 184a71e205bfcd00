// SPDX-License-Identifier: Apache-2.0
// writeTiles() writes tiles to disk: FOLDER/LEVEL/X holds the column X of a level, a file for each
// row.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "apps/tools/tiles/geographic_tile.hpp"
#include "tetrakis/result.hpp"

namespace tetrakis::tools {

/// Writes one tile into the folder of its column.
using WriteTile =
    std::function<Status(const GeographicTile& tile, const std::filesystem::path& column)>;

/// Makes the folders of a range of tiles and has each tile written, column by column.
Status writeTiles(const std::string& folder, const TileRange& range, const WriteTile& write);

}  // namespace tetrakis::tools

// SPDX-License-Identifier: Apache-2.0
// Heights of files go to a cube, onCube(), and heights of streams on a cube to the grid that they
// were made of, gridOfCube().
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "apps/tools/files/files.hpp"
#include "tetrakis/result.hpp"
#include "tetrakis/tetrakis.hpp"

namespace tetrakis::tools {

inline constexpr uint32_t kCubePatches = 6;

/// How far heights on a cube, on their grid again, are from those of a file, in its unit: the
/// largest distance, and the root of the mean square over the area of the Earth.
struct CubeErrors {
  double largest = 0, rmse = 0;
};

/// The heights on a cube, as samples of the same type. depth: 0: that of tks_cube_depth. TKS_USAGE:
/// the columns do not go round the Earth, in degrees, or samples are void.
Result<HeightFile> onCube(const HeightFile& grid, uint32_t depth, uint32_t threads,
                          CubeErrors& errors);

/// Whether the heights of a stream lie on a cube and were made of a grid.
bool isGridOnCube(const tks_info& info);

/// The heights of the grid of such a stream. surface: its cube, as heights.
Result<std::vector<float>> gridOfCube(const tks_info& info, std::span<const float> surface);

/// Those of a window of the grid, of which no more is decoded than it needs.
Result<std::vector<float>> gridOfCube(Decoder& decoder, const tks_window& window);

/// Heights as samples of the stream's type.
std::vector<std::byte> samplesOfGrid(const tks_info& info, std::span<const float> heights);

}  // namespace tetrakis::tools

// SPDX-License-Identifier: Apache-2.0
// importMesh() reads a mesh file by libassimp. That library takes milliseconds to load, and crashes
// on some damaged files; so it is a module of its own (assimp_import.cpp) that works in a separate
// process, which hands over this struct of plain values.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "tetrakis/result.hpp"

namespace tetrakis::tools {

/// What there is to know about a mesh beside its arrays. Its parts are the meshes of the file where
/// the nodes of its scene place them.
struct MeshFacts {
  std::array<double, 4> base_colour{1, 1, 1, 1};  ///< RGBA of the material of most triangles
  uint64_t parts = 0;                             ///< that have triangles
  uint64_t other = 0;        ///< of them, parts with another texture than that of most triangles
  uint64_t polygons = 0;     ///< that became several triangles
  uint64_t dropped = 0;      ///< points and lines
  uint64_t unplaced = 0;     ///< texture coordinates that are no numbers, and have become 0
  bool transformed = false;  ///< the material moves the texture, which is not done here
  bool y_is_up = false;      ///< the format says it; else it says nothing
  bool too_large = false;    ///< so it is not read
};

/// All parts, joined.
struct MeshImport {
  MeshFacts facts{};
  std::string failure{};                             ///< why it is not read; "": it is
  std::string name{};                                ///< of the only part; "": there is none
  std::vector<std::array<double, 3>> points{};       ///< each position once, by first use
  std::vector<std::array<uint32_t, 3>> triangles{};  ///< numbers of points
  std::vector<std::array<float, 2>> texcoords{};     ///< 3 a triangle, v upwards; or none
  std::string texture_path{};             ///< of the texture of most triangles, as the file has it
  std::vector<std::byte> texture_file{};  ///< that texture, if it is embedded
};

/// More triangles are refused.
inline constexpr uint64_t kMostTriangles = uint64_t{1} << 26;

/// TKS_USAGE with a reason for a damaged file, TKS_LIMIT for one that takes too much memory or
/// time; they begin with a verb and lack the name of the file. TKS_IO if the module cannot be
/// loaded.
Result<MeshImport> importMesh(const std::string& path);

}  // namespace tetrakis::tools

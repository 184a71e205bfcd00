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

#include "apps/tools/files/meshes/material.hpp"
#include "tetrakis/result.hpp"

namespace tetrakis::tools {

/// What textures of a material beside its colour say. Formats have some of them: glTF has one of
/// metalness and roughness, OBJ one of each, and of bumps that are no normals.
enum class MapSlot : uint8_t {
  kNormal,
  kBump,
  kMetallicRoughness,
  kRoughness,
  kMetallic,
  kOcclusion,
  kEmissive
};
inline constexpr size_t kMapSlots = 7;

/// Why a map cannot lie on the mesh as the file has it.
enum class MapFault : uint8_t { kNone, kOtherTexcoords, kOtherTransform, kSeveralLooks };

/// What there is to know about a mesh beside its arrays. Its parts are the meshes of the file where
/// the nodes of its scene place them.
struct MeshFacts {
  std::array<double, 4> base_colour{1, 1, 1, 1};  ///< RGBA of the material of most triangles
  uint64_t parts = 0;                             ///< that have triangles
  uint64_t polygons = 0;                          ///< that became several triangles
  uint64_t dropped = 0;                           ///< points and lines
  uint64_t unplaced = 0;    ///< texture coordinates that are no numbers, and have become 0
  uint64_t other_maps = 0;  ///< of the parts with that texture, parts with other maps
  MaterialFactors factors{};
  std::array<MapFault, kMapSlots> map_faults{};
  bool transformed = false;  ///< the material moves the texture, which is not done here
  bool y_is_up = false;      ///< the format says it; else it says nothing
  bool too_large = false;    ///< so it is not read
};

/// A texture that a file names.
struct ImportedTexture {
  std::string path{};             ///< as the file has it; "": there is none
  std::vector<std::byte> file{};  ///< of one that is embedded
};

/// What parts have in common that look alike: a texture, else a colour, or one at each corner.
struct LookFacts {
  std::array<double, 4> colour{1, 1, 1, 1};  ///< RGBA, which multiplies what there is
  uint64_t at_corners = 0;                   ///< 1: colours at corners; else there are none
};

/// Triangles in a row that look alike.
struct LookRun {
  uint64_t end = 0;   ///< number behind that of the last triangle
  uint64_t look = 0;  ///< number of the look
};

/// All parts, joined.
struct MeshImport {
  MeshFacts facts{};
  std::string failure{};                             ///< why it is not read; "": it is
  std::string name{};                                ///< of the only part; "": there is none
  std::vector<std::array<double, 3>> points{};       ///< each position once, by first use
  std::vector<std::array<uint32_t, 3>> triangles{};  ///< numbers of points
  std::vector<std::array<float, 2>> texcoords{};     ///< 3 a triangle, v upwards; or none
  ImportedTexture texture{};                         ///< of most triangles
  std::array<ImportedTexture, kMapSlots> maps{};     ///< of the same material, by MapSlot
  // Where parts look different, or have colours at their corners; else these are empty.
  std::vector<LookFacts> looks{};
  std::vector<ImportedTexture> look_textures{};        ///< of each look
  std::vector<LookRun> runs{};                         ///< of all triangles
  std::vector<std::array<float, 4>> corner_colours{};  ///< RGBA, 3 a triangle; or none
};

/// More triangles are refused.
inline constexpr uint64_t kMostTriangles = uint64_t{1} << 26;

/// TKS_USAGE with a reason for a damaged file, TKS_LIMIT for one that takes too much memory or
/// time; they begin with a verb and lack the name of the file. TKS_IO if the module cannot be
/// loaded.
Result<MeshImport> importMesh(const std::string& path);

}  // namespace tetrakis::tools

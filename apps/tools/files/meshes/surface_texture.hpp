// SPDX-License-Identifier: Apache-2.0
// findTexture() finds and reads the texture of a mesh file, wherever its programs put it, and
// readMap() another texture that the file names.
#pragma once

#include <optional>
#include <string>

#include "apps/tools/files/files.hpp"
#include "apps/tools/files/meshes/mesh_import.hpp"

namespace tetrakis::tools {

struct FoundTexture {
  std::optional<ImageFile> image{};  ///< RGB or RGBA of 8 bits
  std::string remark{};              ///< why there is none, or how it was found; "": as usual
};

/// A map of a material, whose values are no colours: a level that shows as white and was only
/// guessed by its colours is not kept. shown: how the remark calls it, as "its normal map".
FoundTexture readMap(const ImportedTexture& map, const std::string& mesh_path,
                     const std::string& shown);

/// A texture that the file names or holds.
FoundTexture readTexture(const ImportedTexture& texture, const std::string& mesh_path);

/// The embedded one; or the file that the mesh names, from the folder of the mesh, or of that name
/// in this folder, as paths are often those of another machine; or if it names none, a picture
/// called like the mesh.
FoundTexture findTexture(const MeshImport& mesh, const std::string& mesh_path);

}  // namespace tetrakis::tools

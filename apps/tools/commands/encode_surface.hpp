// SPDX-License-Identifier: Apache-2.0
// encodeSurface() is `tetrakis encode` of a mesh: a scan or a sculpture becomes an object.
#pragma once

#include <string>
#include <vector>

#include "apps/tools/commands/encode_arguments.hpp"
#include "apps/tools/files/meshes/surface_file.hpp"
#include "tetrakis/tetrakis.hpp"

namespace tetrakis::tools {

/// What lies on a mesh: the image in the file `texture`, without alpha, or if that is "", its own
/// texture; and of the maps of its material those of these names.
struct SurfaceTextures {
  std::string texture;
  std::vector<std::string> maps{};
};

/// Reads a mesh with what its surface shows. Tells what is remarkable about the files.
Result<SurfaceFile> readTexturedSurface(const std::string& path, const SurfaceTextures& textures,
                                        bool quiet);

/// TKS_USAGE if there are options that mean nothing to a mesh.
Status checkSurfaceArguments(const EncodeArguments& arguments);

/// What cleaning has left out of a mesh; "" if that is nothing.
std::string cleaningNote(const tks_object_report& report);

/// How near an object is to its mesh.
std::string objectNote(const tks_object_report& report, const std::string& unit);

/// Reads the mesh that the arguments name, which are checked, and writes its stream.
Status encodeSurface(const EncodeArguments& arguments, bool quiet);

}  // namespace tetrakis::tools

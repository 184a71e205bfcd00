// SPDX-License-Identifier: Apache-2.0
// The functions here are about what lies on a mesh beside its texture: the maps of its material and
// the images of --also, which become further components of a stream of triangles.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "apps/tools/commands/encode_arguments.hpp"
#include "apps/tools/commands/named_files.hpp"
#include "apps/tools/files/meshes/surface_file.hpp"
#include "tetrakis/tetrakis.hpp"

namespace tetrakis::tools {

/// An image that lies on a mesh as its texture does, with the name of its component and what its
/// errors count, as tks_object_map has it.
struct FurtherTexture {
  std::string name;
  ImageFile image;
  double weight = 0;
};

/// The names that --maps stands for: all, none, or some with commas between them. TKS_USAGE.
Result<std::vector<std::string>> wantedMaps(const std::string& text);

/// Leaves out what goes with a number of bytes alone, and tells of it.
void leaveOutTextures(SurfaceFile& mesh, bool quiet);

/// Takes the maps of a surface out of it, and reads what --also names, which replaces maps of the
/// same name. Tells of the images what is remarkable.
Result<std::vector<FurtherTexture>> furtherTextures(const EncodeArguments& arguments,
                                                    SurfaceFile& surface, bool quiet);

/// The textures as the encoder takes them; these and the images outlive that.
struct GivenMaps {
  explicit GivenMaps(const std::vector<FurtherTexture>& textures);
  GivenMaps(const GivenMaps&) = delete;
  GivenMaps& operator=(const GivenMaps&) = delete;

  std::vector<tks_image> images;
  std::vector<tks_object_map> maps;
};

/// Which maps were taken, and which were not; "": the file has none. given: those for the encoder,
/// which leaves normals of a mesh out that is resampled.
std::string mapsNote(const std::vector<FurtherTexture>& given, std::vector<std::string> left_out,
                     bool is_resampled);

}  // namespace tetrakis::tools

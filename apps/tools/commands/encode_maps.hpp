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
/// errors count beside those of the texture.
struct FurtherTexture {
  std::string name;
  ImageFile image;
  double weight = 1;
};

/// The names that --maps stands for: all, none, or some with commas between them. TKS_USAGE.
Result<std::vector<std::string>> wantedMaps(const std::string& text);

/// Leaves out what goes with a number of bytes alone, and tells of it.
void leaveOutTextures(SurfaceFile& mesh, bool quiet);

/// Takes the maps of a surface out of it, and reads what --also names, which replaces maps of the
/// same name. Tells of the images what is remarkable.
Result<std::vector<FurtherTexture>> furtherTextures(const EncodeArguments& arguments,
                                                    SurfaceFile& surface, bool quiet);

/// The longest side of them; 0: there are none.
uint32_t longestSide(const std::vector<FurtherTexture>& textures);

/// A stream of triangles with their texture, and beside it the others, within the bytes that the
/// arguments say.
Result<Buffer> withFurther(const EncodeArguments& arguments, const Buffer& stream,
                           const ImageFile& texture, const std::vector<FurtherTexture>& further,
                           bool quiet);

/// Which maps were taken, and which were not; "": the file has none. taken: those of the stream.
std::string mapsNote(const std::vector<FurtherTexture>& taken,
                     const std::vector<std::string>& left_out);

/// The same of a mesh that was resampled, whose patches have other texture coordinates than those
/// that maps lie on, and that normals count from.
std::string resampledMapsNote(const std::vector<FurtherTexture>& left_out);

}  // namespace tetrakis::tools

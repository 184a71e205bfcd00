// SPDX-License-Identifier: Apache-2.0
// The functions here write a mesh in one file format each. The mesh has been checked: sizes agree,
// indices are in range.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "apps/tools/files/files.hpp"
#include "tetrakis/result.hpp"

namespace tetrakis::tools {

/// Three numbers a vertex: those of the mesh if it has some, else its smooth normals.
std::vector<float> normalsOf(const MeshFile& mesh);

/// Three numbers a vertex: the mean of the normals around it by their triangles' areas, of length
/// 1; straight up where no triangle with an area meets it.
std::vector<float> smoothNormals(const MeshFile& mesh);

/// A picture of 16 bits a channel in 8.
ImageFile reducedTo8Bits(const ImageFile& image);

/// A grey picture of 8 bits in RGB, its alpha kept.
ImageFile greyInColour(const ImageFile& grey);

/// One channel of a picture of 8 bits.
ImageFile channelOf(const ImageFile& image, size_t channel);

struct EncodedTexture {
  const char* mime_type;
  std::vector<std::byte> bytes;
};

/// A picture as a GLB holds it, of 8 bits. TKS_USAGE: the format cannot hold it.
Result<EncodedTexture> encodeTexture(const ImageFile& image, MeshTexture format);

/// A KTX2 file of an image of 8 bits, RGB or RGBA, which goes to sides that are multiples of 4.
/// Runs a program of others: TKS_UNSUPPORTED where none is installed.
Result<std::vector<std::byte>> encodeKtx2(const ImageFile& image);

/// Binary glTF 2.0 in one piece.
Result<std::vector<std::byte>> encodeGlb(const MeshFile& mesh, const MeshOptions& options);

/// Binary little-endian PLY; texture coordinates as s, t with t upwards.
std::vector<std::byte> encodePly(const MeshFile& mesh);

/// Wavefront OBJ, beside its material library and texture: "name.obj",
/// "name.mtl", "name.png".
Status writeObj(const std::string& path, const MeshFile& mesh);

}  // namespace tetrakis::tools

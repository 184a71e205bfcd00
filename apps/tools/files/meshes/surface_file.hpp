// SPDX-License-Identifier: Apache-2.0
// readSurface() reads a textured mesh of triangles of any shape, such as a scan, from the files of
// other programs: glTF (.glb, .gltf, with Draco or without), OBJ with its MTL, PLY and STL.
// shownTexture() makes its image what the surface shows, and plainTexture() an image of a surface
// that has none.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "apps/tools/files/files.hpp"
#include "apps/tools/files/meshes/surface_maps.hpp"
#include "tetrakis/result.hpp"

namespace tetrakis::tools {

/// All meshes of a file, joined, in the file's own unit and axes.
struct SurfaceFile {
  std::vector<std::array<double, 3>> points;       ///< finite, each position once, by first use
  std::vector<std::array<uint32_t, 3>> triangles;  ///< one or more; numbers of points
  /// 3 a triangle, (0, 0) at the image's top left corner; finite, but beyond [0, 1] where the file
  /// has it so. Empty: the file has none. Parts without any lie at (0, 1).
  std::vector<std::array<float, 2>> texcoords;
  std::optional<ImageFile> texture;               ///< RGB or RGBA of 8 bits; its colours alone
  std::array<double, 4> base_colour{1, 1, 1, 1};  ///< RGBA, which multiplies the texture
  bool has_corner_colours = false;                ///< a texture of the file's own has them as cells
  SurfaceMaps maps;
  std::string name;      ///< of the mesh, or of the file
  bool y_is_up = false;  ///< else the format does not say what is up
};

/// What is read of a surface beside its triangles.
struct SurfaceParts {
  bool texture = true;
  std::vector<std::string> maps{};  ///< names of kMapNames
};

/// Whether a path is that of a mesh that readSurface() takes, by its extension or first bytes.
bool isMeshFile(const std::string& path);

/// note: what was joined, cut, left out or not found, in one sentence without the file's name; "":
/// nothing. A texture that is missing is such a thing. Where parts have several textures or
/// colours, or colours at their corners, the texture holds all of them (texture_pages.hpp). Where
/// the file names no texture, that is taken which lies beside it under the same name. TKS_IO: the
/// file cannot be read; TKS_USAGE: it is damaged or no mesh, has no triangles, or coordinates that
/// are not finite; TKS_LIMIT: it has more than 2^26 triangles, or takes more memory or time than it
/// may. What becomes of maps the note does not say.
Result<SurfaceFile> readSurface(const std::string& path, std::string* note = nullptr,
                                const SurfaceParts& parts = {});

/// The image without its alpha: grey or RGB. A further colour is left out as well.
ImageFile withoutAlpha(const ImageFile& image);

/// What a stored value of sRGB shows, and the value that shows it; all from 0 to 1.
double lightOf(double value);
double valueOf(double light);

/// What a mesh shows of the texture that it has: the image without its alpha, multiplied by the
/// mesh's base colour. That is a factor of light where glTF gives it, and of the stored values
/// where others do. Black counts as white: programs write it beside textures, which would leave
/// nothing of them.
ImageFile shownTexture(const SurfaceFile& surface);

/// One texel of the base colour, for a mesh without a texture. Black counts as white but in glTF.
ImageFile plainTexture(const SurfaceFile& surface);

}  // namespace tetrakis::tools

// SPDX-License-Identifier: Apache-2.0
// The functions here read and write heights, images and meshes on disk. Every file of the command
// line passes here.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "apps/tools/files/meshes/material.hpp"
#include "base/samples.hpp"
#include "tetrakis/result.hpp"
#include "tetrakis/tetrakis.h"

namespace tetrakis::tools {

/// Of one file or stream: 32768 x 32768 RGBA.
inline constexpr uint64_t kMaxSamples = uint64_t{1} << 32;
/// Samples of a stream, as many as the format allows: memory bounds what is decoded of it.
inline constexpr uint64_t kMostStreamSamples = uint64_t{1} << 40;

/// TKS_LIMIT for more, and for those that take more memory than there is to read
/// (memory_limit.hpp): before anything is allocated, as a few bytes can declare any size.
Status checkSize(const std::string& name, uint64_t samples, size_t sample_bytes);

/// As GDAL has it: column c and row r, (0, 0) the outer corner of the first sample, lie at
/// x = [0] + c [1] + r [2], y = [3] + c [4] + r [5], in units of the reference system.
using GeoTransform = std::array<double, 6>;

/// Whether a stream takes it: six numbers within +-2^512.
bool isSound(const GeoTransform& transform);

/// That of the part that begins at this column and row.
GeoTransform movedTo(const GeoTransform& transform, uint32_t column, uint32_t row);

/// Where a raster lies on Earth.
struct Georeference {
  std::optional<GeoTransform> geotransform;
  tks_registration registration = TKS_REGISTRATION_UNKNOWN;
  std::string crs;       ///< "EPSG:code", WKT or a name; "" when unknown
  std::string geo_keys;  ///< what a GeoTIFF says beyond `crs` (geo_keys.hpp); "" if nothing
  std::vector<uint8_t> positions;  ///< of tks_fit_positions; empty: none
  tks_domain domain = TKS_DOMAIN_PLANE;
};

/// Heights as a file holds them. data: width * height samples of type `sample`, row by row, host
/// byte order. Height in `unit` = sample * scale + offset.
struct HeightFile : Georeference {
  uint32_t width = 0, height = 0;
  tks_sample sample = TKS_U16;
  std::vector<std::byte> data;
  double scale = 1, offset = 0;
  double rounding = 0;  ///< how far samples lie at most from those of the file, which were doubles
  double spacing_x = 0, spacing_y = 0;            ///< metres per sample; 0: unknown
  std::optional<double> nodata;                   ///< the file's declared nodata value
  std::string unit, vertical_datum, description;  ///< "" when unknown
  uint32_t cube_depth = 0;  ///< of heights on a cube, of which the file does not hold the place,
  uint32_t grid_width = 0, grid_height = 0;  ///< but that of this grid; 0: they are no cube
};

/// Something about a file that is read that its user should know.
struct Note {
  std::string text;    ///< a sentence without the name of the file
  std::string option;  ///< of `encode`, which answers it; "" if none does
};
using Notes = std::vector<Note>;

/// 1 grey, 2 grey+alpha, 3 RGB, 4 RGBA; sample is TKS_U8 or TKS_U16; interleaved, host byte order.
/// opaque: no channel is alpha, the last of 2 or 4 is a further colour, such as near infrared.
/// white_level: what shows as white (tks_image); 0: the largest value of the type.
struct ImageFile {
  uint32_t width = 0, height = 0, channels = 0;
  tks_sample sample = TKS_U8;
  std::vector<std::byte> data{};
  Georeference place{};
  bool opaque = false;
  uint32_t white_level = 0;

  bool hasAlpha() const { return channels % 2 == 0 && !opaque; }
  bool hasFurtherColour() const { return channels % 2 == 0 && opaque; }
  uint32_t white() const { return white_level > 0 ? white_level : largestTexel(sample); }
};

/// The image as pictures show it: grey or RGB of one with a further colour.
ImageFile withoutFurtherColour(const ImageFile& image);

/// What a file holds, its georeference included, as the encoder takes it. The file outlives it.
tks_heights asHeights(const HeightFile& file);
tks_image asImage(const ImageFile& file);

/// What a mesh is made of beside its texture: maps of a material, by MapKind (meshes/material.hpp).
/// Null: there is none. Not owned.
struct MeshMaps {
  std::array<const ImageFile*, kMapKinds> images{};
  Material material{};
  bool is_lit = false;  ///< the material counts, even without maps

  bool none() const { return !hasImages() && !is_lit; }
  bool hasImages() const { return images != decltype(images){}; }
  const ImageFile* at(MapKind kind) const { return images[static_cast<size_t>(kind)]; }
};

/// A mesh ready to be written: positions in metres, x east, y up, z south (glTF axes), texture
/// coordinates with (0, 0) at the image's top left corner (glTF convention).
struct MeshFile {
  std::vector<float> positions;        ///< 3 per vertex
  std::vector<float> texcoords;        ///< 2 per vertex; empty without texture
  std::vector<float> normals;          ///< 3 per vertex, of length 1; empty: smooth ones are made
  std::vector<uint32_t> triangles;     ///< 3 per triangle, counter-clockwise seen from above
  const ImageFile* texture = nullptr;  ///< not owned; may be null
  MeshMaps maps{};                     ///< where there are texture coordinates
  bool texture_repeats = false;        ///< beyond (0, 0) and (1, 1); else its edges go on
  std::array<double, 3> origin{};      ///< of the positions; .glb alone keeps it
};

/// Reads one-channel TIFF (integer or float, with GeoTIFF and GDAL tags), PNG 8/16, EXR, .hgt,
/// headerless .raw given as "file.raw:WIDTHxHEIGHT:u8|i8|u16|i16|u32|i32|f32" (little endian), JPEG
/// 2000, and the other pictures of docs/CLI.md. "-" reads standard input. Samples come as stored,
/// never rescaled; half floats become floats, and doubles the nearest floats. Blocks that a sparse
/// TIFF leaves out are void. What GDAL takes for void is: floats that nearly meet the nodata value
/// become that value, so do samples that a mask (a page, or "path.msk") leaves out. `nodata`
/// replaces the value that the file declares. The place is that of the TIFF's tags, of the tile
/// that an .hgt is called after, or of a world file beside (world_file.hpp). Spacing in degrees is
/// turned into metres at the raster's centre. Fails with TKS_IO if the file cannot be read,
/// TKS_USAGE if it does not hold heights (channels, sample type, size).
Result<HeightFile> readHeights(const std::string& path, const std::optional<double>& nodata = {},
                               Notes* notes = nullptr);

/// Writes the same integer or float type, losslessly, in the format of the extension. .tif holds
/// all types and the tags, .png u8 and u16, .exr u32 and f32, .hgt a square of i16, .raw all types;
/// fails with TKS_USAGE if the format cannot hold them. Formats without tags get a world file
/// beside if the place is known; an .hgt has its name alone. Writes to `path` directly: see Output
/// for renaming and standard output. `format` overrides the extension ("tif", "png", "exr", "hgt",
/// "raw").
Status writeHeights(const std::string& path, const HeightFile& heights,
                    const std::string& format = "");

/// Reads the pictures of docs/CLI.md; "-" reads standard input. Integers of other depths become 8
/// or 16 bits, palette and CMYK files are converted to RGB, an orientation tag is applied, and
/// `note` then says so ("" otherwise). Float or signed images and more than 4 channels are refused
/// with TKS_USAGE. A fourth channel, or a second one, that a TIFF does not call alpha is a further
/// colour. Alpha is as stored; embedded colour profiles are kept out of the samples. The
/// place is that of a TIFF's tags or of a world file beside, unless the picture had to be turned.
Result<ImageFile> readImage(const std::string& path, std::string* note = nullptr);

/// TKS_USAGE if OpenImageIO writes no format of this name, or one that cannot hold such an image,
/// whose data is not looked at. Only a TIFF holds a further colour.
Status checkImageFormat(const std::string& path, const ImageFile& image);

/// Writes what checkImageFormat lets pass. Exact but for .jpg (quality 95, 4:4:4), .webp, .gif and
/// .heic. A known place goes into the tags of a TIFF, or into a world file beside.
Status writeImage(const std::string& path, const ImageFile& image, const std::string& format = "");

/// JPEG by libjpeg-turbo (4:4:4), for the texture inside a GLB. 8-bit grey or RGB; quality 1 to
/// 100.
Result<std::vector<std::byte>> encodeJpeg(const ImageFile& image, int quality);

/// Of the geometry in a .glb: KHR_draco_mesh_compression, EXT_meshopt_compression.
enum class MeshCompression { kNone, kDraco, kMeshopt };

/// Of the texture in a .glb, and of a map of light, reduced to 8 bits. kChosen: JPEG, or PNG when
/// it has alpha or 16 bits. kJpeg refuses alpha; kKtx2 takes a program that may be missing
/// (TKS_UNSUPPORTED). Maps whose values are no colours are PNG.
enum class MeshTexture { kChosen, kJpeg, kPng, kWebp, kKtx2 };

struct MeshOptions {
  MeshCompression compression = MeshCompression::kNone;
  MeshTexture texture = MeshTexture::kChosen;
  bool operator==(const MeshOptions&) const = default;
};

/// TKS_USAGE if the options mean nothing to a mesh of that name.
Status checkMeshOptions(const std::string& path, const MeshOptions& options);

/// .glb (texture and maps embedded), .obj (+ .mtl and .png of its name when textured, and of maps
/// name_normal.png and others; occlusion is left out), .ply (binary, texture coordinates but no
/// texture); all with normals. Coordinates come back bit for bit, of a compressed .glb as
/// meshopt_mesh.hpp and draco_mesh.hpp say. Fails with TKS_USAGE on an empty or inconsistent
/// mesh.
Status writeMesh(const std::string& path, const MeshFile& mesh, const std::string& format = "",
                 const MeshOptions& options = {});

}  // namespace tetrakis::tools

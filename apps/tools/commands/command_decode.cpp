// SPDX-License-Identifier: Apache-2.0
// tetrakis decode: heights, texture and mesh out of a stream or a prefix of one.
#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "apps/tools/commands/command.hpp"
#include "apps/tools/commands/decode_arguments.hpp"
#include "apps/tools/commands/decode_memory.hpp"
#include "apps/tools/commands/decode_outputs.hpp"
#include "apps/tools/commands/decode_windows.hpp"
#include "apps/tools/commands/decoded_maps.hpp"
#include "apps/tools/commands/decoded_texture.hpp"
#include "apps/tools/commands/engine_output.hpp"
#include "apps/tools/commands/notes.hpp"
#include "apps/tools/files/cube_heights.hpp"
#include "apps/tools/files/file_bytes.hpp"
#include "apps/tools/files/place/ground_spacing.hpp"
#include "apps/tools/files/plain_heights.hpp"
#include "apps/tools/files/text.hpp"
#include "apps/tools/files/turned_image.hpp"
#include "apps/tools/output/output.hpp"
#include "apps/tools/report/draped_texture.hpp"
#include "apps/tools/report/globe_mesh.hpp"
#include "apps/tools/report/object_mesh.hpp"
#include "apps/tools/report/surface_normals.hpp"
#include "apps/tools/report/viewed_mesh.hpp"
#include "base/coordinates.hpp"

namespace tetrakis::tools {
namespace {

/// An .hgt holds no place but in its name.
std::string hgtNote(const std::string& name, const HeightFile& heights) {
  if (formatOf(name, "") != "hgt" || !heights.geotransform) return "";
  const std::string tile = hgtName(heights);
  if (tile.empty()) return "an .hgt file cannot say where these heights lie: a .tif can";
  return name == tile ? "" : "an .hgt file says by its name where it lies: call this one " + tile;
}

/// A .raw has no header: what must stand behind its name to read it again.
std::string rawNote(const std::string& name, const HeightFile& heights) {
  if (formatOf(name, "") != "raw") return "";
  return "a .raw file has no header: read this one as " + name + ":" +
         std::to_string(heights.width) + "x" + std::to_string(heights.height) + ":" +
         sampleName(heights.sample);
}

/// What is guessed of the ground, where its proportions count.
void tellGuesses(const tks_info& info, const DecodeOutputs& outputs, bool quiet) {
  const bool of_ground = info.has_heights && !isObject(info);
  if (!of_ground || !(outputs.mesh || outputs.normals || outputs.engine)) return;
  tellNote(guessedUnitNote(info), quiet);
  if (spacingOf(info) == std::array<double, 2>{})
    tellNote("the stream does not tell the spacing of its samples, which counts as " +
                 shortest(kUnknownSpacing) + " m",
             quiet);
}

/// Decodes into the outputs that were planned.
class Decoding {
 public:
  Decoding(const DecodeArguments& arguments, OpenStream& stream, DecodeOutputs outputs, bool quiet)
      : arguments_(arguments),
        stream_(stream),
        decoder_(stream.decoder),
        outputs_(std::move(outputs)),
        quiet_(quiet),
        memory_(arguments, stream),
        image_(arguments, stream) {}

  /// No file appears before all have been written. The texture is decoded beside the heights where
  /// there are threads and memory for both.
  Status run() {
    beside_bytes_ = image_.begin(memory_);
    Status status;
    if (outputs_.height) status = writeHeightField();
    if (status.ok() && outputs_.texture) status = writeTexture();
    if (status.ok() && outputs_.mesh) status = writeSurfaceMesh();
    if (status.ok() && outputs_.normals) status = writeNormals();
    if (status.ok()) status = commit(outputs_);
    return status.ok() && arguments_.json ? print(dump(engine_json_)) : status;
  }

 private:
  Status writeHeightField() {
    if (outputs_.engine) return writeForEngine();
    const Result<HeightFile> heights =
        decodeHeights(decoder_, heightWindow(arguments_), memory_.heights() + beside_bytes_);
    if (!heights.ok()) return heights.status();
    tellNote(hgtNote(outputs_.height->name(), *heights), quiet_);
    tellNote(rawNote(arguments_.height, *heights), quiet_);
    return outputs_.height->stage(
        [&](const std::string& path) { return writeHeights(path, *heights); });
  }

  Status writeNormals() {
    const Result<ImageFile> map = normalMap(decoder_, stream_.bytes.size() + beside_bytes_);
    if (!map.ok()) return map.status();
    return outputs_.normals->stage([&](const std::string& path) { return writeImage(path, *map); });
  }

  Status writeTexture() {
    const Result<ImageFile>& image = picture();
    if (!image.ok()) return image.status();
    const QuarterTurn turn(textureAxes());
    if (outputs_.engine && !turn.none()) {  // as the heights
      return outputs_.texture->stage(
          [&](const std::string& path) { return writeImage(path, turned(*image, turn)); });
    }
    return outputs_.texture->stage(
        [&](const std::string& path) { return writeImage(path, *image); });
  }

  /// The texture as files hold it: of an object as an atlas.
  const Result<ImageFile>& picture() {
    const Result<ImageFile>& image = image_.get(memory_);
    if (!image.ok() || !hasAtlas(decoder_.info())) return image;
    if (!atlas_) atlas_ = atlasOf(decoder_.info()).pictureOf(*image);
    return *atlas_;
  }

  Status writeSurfaceMesh() {
    const tks_info& info = decoder_.info();
    if (!info.has_heights && !isObject(info))
      return Status(TKS_USAGE, "the stream has no heights, so there is no mesh");
    const ImageFile* texture = nullptr;
    if (info.has_texture && (info.base_mesh.position_bits == 0 || hasAtlas(info))) {
      const Result<ImageFile>& image = picture();
      if (!image.ok()) return image.status();
      texture = &*image;
    }
    Result<MeshFile> file = isObject(info)     ? object()
                            : arguments_.globe ? globe()
                                               : surface(texture);
    if (!file.ok()) return file.status();
    tellNote(coarsestNote(static_cast<uint32_t>(file->triangles.size() / 3), arguments_.triangles),
             quiet_ || arguments_.globe);
    if (texture && formatOf(outputs_.mesh->name(), "") == "ply")
      tellNote("a .ply file has no place for the texture: --texture writes it beside", quiet_);
    file->texture = texture;
    const Result<DecodedMaps> maps = mapsBeside();
    if (!maps.ok()) return maps.status();
    file->maps = maps->forMesh();
    tellNote(unwrittenNote(outputs_.mesh->name(), file->maps), quiet_);
    return outputs_.mesh->stage([&](const std::string& path) {
      return writeMesh(path, *file, "", arguments_.mesh_options);
    });
  }

  /// A mesh that shows a component which somebody has chosen shows that alone.
  Result<DecodedMaps> mapsBeside() {
    if (!arguments_.source.components.empty()) return DecodedMaps();
    return DecodedMaps::of(stream_, memory_.texture());
  }

  Result<MeshFile> object() {
    if (Status status = memory_.checkMesh(beside_bytes_); !status.ok()) return status;
    return objectMesh(decoder_, arguments_.coded_mesh ? TKS_MESH_CODED : TKS_MESH_BUDGET,
                      arguments_.triangles);
  }

  Result<MeshFile> globe() {
    if (Status status = memory_.checkMesh(beside_bytes_); !status.ok()) return status;
    return globeMesh(decoder_,
                     {arguments_.coded_mesh, arguments_.triangles, arguments_.exaggeration});
  }

  /// In a local frame: metres east, up and south of the middle.
  Result<MeshFile> surface(const ImageFile* texture) {
    const tks_info& info = decoder_.info();
    const Result<Mesh> mesh = chosenMesh(texture);
    if (!mesh.ok()) return mesh.status();
    if (mesh->triangleCount() == 0) {
      return Status(TKS_USAGE,
                    "the voids leave no mesh: no three neighbouring samples have heights");
    }
    Result<std::vector<float>> normals = surfaceNormals(decoder_, mesh->gridIndices());
    if (!normals.ok()) return normals.status();
    MeshFile file = placeMesh(*mesh, frameOf(info));
    drapeTexture(info, mesh->gridIndices(), file);
    file.normals = std::move(*normals);
    return file;
  }

  Status writeForEngine() {
    const Result<EngineHeights> heights =
        decodeEngineHeights(decoder_, *outputs_.engine, stream_.bytes.size() + beside_bytes_);
    if (!heights.ok()) return heights.status();
    if (heights->voids > 0)
      tellNote(std::to_string(heights->voids) + " void samples have the lowest height", quiet_);
    if (heights->askew)
      tellNote(
          "the raster lies askew: " + outputs_.height->name() + " has north only about at its top",
          quiet_);
    if (arguments_.json) {
      engine_json_ = engineJson(*heights);
    } else if (!quiet_) {
      tellLine(outputs_.height->name() + ": " + engineText(*heights));
    }
    return outputs_.height->stage(
        [&](const std::string& path) { return writeEngineHeights(path, *heights); });
  }

  GroundAxes textureAxes() const {
    const tks_info& info = decoder_.info();
    if (!info.texture_has_geotransform) return frameOf(info).axes;
    return groundAxes(std::to_array(info.texture_geotransform), info.texture_width,
                      info.texture_height, *info.texture_crs ? info.texture_crs : info.crs);
  }

  Result<Mesh> chosenMesh(const ImageFile* texture) {
    if (Status status = memory_.checkMesh(beside_bytes_); !status.ok()) return status;
    const bool coded = arguments_.coded_mesh;
    const bool for_cameras = arguments_.triangles > 0 && !arguments_.camera.isDefault();
    if (for_cameras || arguments_.turn_edges)
      return meshForCameras(decoder_, arguments_.triangles, arguments_.camera, texture);
    if (!arguments_.camera.isDefault()) return viewedMesh(decoder_, coded, arguments_.camera);
    Result<Mesh> mesh = coded ? decoder_.codedMesh() : decoder_.budgetMesh(arguments_.triangles);
    if (!mesh) return mesh.status();
    return std::move(*mesh);
  }

  const DecodeArguments& arguments_;
  const OpenStream& stream_;
  Decoder& decoder_;
  DecodeOutputs outputs_;
  bool quiet_;
  Json engine_json_;
  DecodeMemory memory_;
  DecodedTexture image_;
  std::optional<Result<ImageFile>> atlas_;
  uint64_t beside_bytes_ = 0;  ///< that the texture takes meanwhile
};

/// Flat meshes, normals and terrains of engines are those of a plane, which a cube is not.
Status checkCube(const DecodeArguments& arguments, const tks_info& info) {
  const bool plain = (arguments.mesh.empty() || arguments.globe) && arguments.normal_map.empty() &&
                     arguments.size.empty();
  if (plain || !isGridOnCube(info)) return Status();
  return Status(TKS_USAGE,
                "the heights lie on a cube, which gives --height, its --window and a --mesh with "
                "--globe alone");
}

/// There is no ground below an object, and its patches are whole.
Status checkObject(const DecodeArguments& arguments, const tks_info& info) {
  if (!isObject(info)) return Status();
  const std::pair<const char*, bool> options[] = {{"--globe", arguments.globe},
                                                  {"--cameras", !arguments.camera.file.empty()},
                                                  {"--view", !arguments.camera.view.empty()},
                                                  {"--turn-edges", arguments.turn_edges},
                                                  {"--normal-map", !arguments.normal_map.empty()},
                                                  {"--size", !arguments.size.empty()},
                                                  {"--window", !arguments.window.empty()},
                                                  {"--level", arguments.level > 0}};
  for (const auto& [name, given] : options)
    if (given)
      return Status(TKS_USAGE, std::string(name) + " is about terrain, and the stream holds an " +
                                   "object: --mesh writes it");
  return Status();
}

Status decode(const DecodeArguments& arguments, bool quiet) {
  if (Status status = checkArguments(arguments); !status.ok()) return status;
  Result<OpenStream> stream = openStream(arguments.source);
  if (!stream.ok()) return stream.status();
  stream->decoder.setThreads(arguments.threads);
  if (Status status = checkObject(arguments, stream->decoder.info()); !status.ok()) return status;
  if (Status status = checkWindow(arguments, stream->decoder.info()); !status.ok()) return status;
  if (Status status = checkCube(arguments, stream->decoder.info()); !status.ok()) return status;
  const bool no_heights = arguments.height.empty() && arguments.normal_map.empty();
  const uint32_t heights_level = no_heights ? 0 : arguments.level,
                 texture_level = arguments.texture.empty() ? 0 : arguments.level;
  const Status set = stream->decoder.setLevels(heights_level, texture_level);
  if (!set.ok()) return set;
  const tks_info& info = stream->decoder.info();
  Result<DecodeOutputs> outputs = planOutputs(arguments, info);
  if (!outputs.ok()) return outputs.status();
  if (Status status = DecodeMemory(arguments, *stream).check(); !status.ok()) return status;
  tellGuesses(info, *outputs, quiet);
  return Decoding(arguments, *stream, std::move(*outputs), quiet).run();
}

}  // namespace

void addDecode(CLI::App& app, CommandLine& line) {
  const auto arguments = std::make_shared<DecodeArguments>();
  CLI::App& verb = *app.add_subcommand("decode", "Write heights, texture or mesh of a stream");
  addArguments(verb, *arguments);
  verb.callback([arguments, &line] {
    line.action = [arguments, &line] { return decode(*arguments, line.quiet); };
  });
}

}  // namespace tetrakis::tools

// SPDX-License-Identifier: Apache-2.0
// tetrakis decode: heights, texture and mesh out of a stream or a prefix of one.
#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/length_unit.hpp"
#include "tools/commands/decode_arguments.hpp"
#include "tools/commands/decode_memory.hpp"
#include "tools/commands/decode_windows.hpp"
#include "tools/commands/decoded_texture.hpp"
#include "tools/commands/engine_output.hpp"
#include "tools/files/file_bytes.hpp"
#include "tools/files/place/ground_spacing.hpp"
#include "tools/files/plain_heights.hpp"
#include "tools/files/text.hpp"
#include "tools/files/turned_image.hpp"
#include "tools/output/output.hpp"
#include "tools/report/draped_texture.hpp"
#include "tools/report/surface_normals.hpp"
#include "tools/report/viewed_mesh.hpp"

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

/// Decodes into staged outputs; the caller commits them when all have succeeded.
class Decoding {
 public:
  Decoding(const DecodeArguments& arguments, OpenStream& stream, bool quiet)
      : arguments_(arguments),
        stream_(stream),
        decoder_(stream.decoder),
        quiet_(quiet),
        memory_(arguments, stream),
        image_(arguments, stream) {}

  /// That each of the outputs can be had, before there is any work.
  Status checkMemory() { return memory_.check(); }

  /// Begins the texture beside the heights where there are threads and memory for both.
  void start() { beside_bytes_ = image_.begin(memory_); }

  /// What stands in the way of writing, before there is anything to write.
  Status plan() {
    const tks_info& info = decoder_.info();
    const char* const heights = arguments_.size.empty() ? ".tif" : ".r16";
    if (Status status = plan(arguments_.height, heights, height_); !status.ok()) return status;
    if (Status status = plan(arguments_.texture, ".png", texture_); !status.ok()) return status;
    if (Status status = plan(arguments_.mesh, ".glb", mesh_); !status.ok()) return status;
    if (Status status = plan(arguments_.normal_map, ".png", normals_); !status.ok()) return status;
    if (Status status = planFormats(); !status.ok()) return status;
    if (!texture_ || !info.has_texture) return Status();
    return checkImageFormat(texture_->name(), {.channels = info.texture_channels,
                                               .sample = info.texture_sample,
                                               .opaque = info.texture_opaque != 0});
  }

  /// What is guessed of the ground, where its proportions count.
  void tellGuesses() const {
    const tks_info& info = decoder_.info();
    if (!info.has_heights || !(mesh_ || normals_ || engine_)) return;
    tellNote(guessedUnitNote(info), quiet_);
    if (spacingOf(info) == std::array<double, 2>{})
      tellNote("the stream does not tell the spacing of its samples, which counts as " +
                   shortest(kUnknownSpacing) + " m",
               quiet_);
  }

  Status writeHeightField() {
    if (engine_) return writeForEngine();
    const Result<HeightFile> heights =
        decodeHeights(decoder_, heightWindow(arguments_), memory_.heights() + beside_bytes_);
    if (!heights.ok()) return heights.status();
    tellNote(hgtNote(height_->name(), *heights), quiet_);
    tellNote(rawNote(arguments_.height, *heights), quiet_);
    return height_->stage([&](const std::string& path) { return writeHeights(path, *heights); });
  }

  Status writeNormals() {
    const Result<ImageFile> map = normalMap(decoder_, stream_.bytes.size() + beside_bytes_);
    if (!map.ok()) return map.status();
    return normals_->stage([&](const std::string& path) { return writeImage(path, *map); });
  }

  Status writeTexture() {
    const Result<ImageFile>& image = image_.get(memory_);
    if (!image.ok()) return image.status();
    const QuarterTurn turn(textureAxes());
    if (engine_ && !turn.none()) {  // as the heights
      return texture_->stage(
          [&](const std::string& path) { return writeImage(path, turned(*image, turn)); });
    }
    return texture_->stage([&](const std::string& path) { return writeImage(path, *image); });
  }

  Status writeSurfaceMesh() {
    const tks_info& info = decoder_.info();
    if (!info.has_heights)
      return Status(TKS_USAGE, "the stream has no heights, so there is no mesh");
    const ImageFile* texture = nullptr;
    if (info.has_texture) {
      const Result<ImageFile>& image = image_.get(memory_);
      if (!image.ok()) return image.status();
      texture = &*image;
    }
    const Result<Mesh> mesh = chosenMesh(texture);
    if (!mesh.ok()) return mesh.status();
    if (mesh->triangleCount() == 0) {
      return Status(TKS_USAGE,
                    "the voids leave no mesh: no three neighbouring samples have heights");
    }
    Result<std::vector<float>> normals = surfaceNormals(decoder_, mesh->gridIndices());
    if (!normals.ok()) return normals.status();
    tellNote(coarsestNote(mesh->triangleCount(), arguments_.triangles), quiet_);
    MeshFile file = placeMesh(*mesh, frameOf(info));
    drapeTexture(info, mesh->gridIndices(), file);
    file.texture = texture;
    file.normals = std::move(*normals);
    return mesh_->stage([&](const std::string& path) {
      return writeMesh(path, file, "", arguments_.mesh_options);
    });
  }

  Status commit() {
    std::vector<Output*> outputs;
    for (std::optional<Output>* output : {&height_, &texture_, &mesh_, &normals_})
      if (*output) outputs.push_back(&**output);
    if (Status status = Output::commitAll(std::move(outputs)); !status.ok()) return status;
    return arguments_.json ? print(dump(engine_json_)) : Status();
  }

 private:
  Status plan(const std::string& path, const char* extension, std::optional<Output>& output) const {
    if (path.empty()) return Status();
    Result<Output> planned = Output::plan(path, arguments_.force, extension);
    if (!planned.ok()) return planned.status();
    output.emplace(std::move(*planned));
    return Status();
  }

  /// That what is asked for and the names of files go together.
  Status planFormats() {
    const tks_info& info = decoder_.info();
    if (mesh_) {
      const Status fits = checkMeshOptions(mesh_->name(), arguments_.mesh_options);
      if (!fits.ok()) return fits;
    }
    if (normals_)
      if (Status fits = checkImageFormat(normals_->name(), {.channels = 3}); !fits.ok())
        return fits;
    if (arguments_.size.empty()) {
      if (!height_ || formatOf(height_->name(), "") != "r16") return Status();
      return Status(TKS_USAGE, "an .r16 file is one of an engine: give --size unreal or unity");
    }
    const Result<EngineSize> size =
        parseEngineSize(arguments_.size, std::max(info.width, info.height));
    if (!size.ok()) return size.status();
    engine_ = *size;
    return checkEngineFormat(*engine_, height_->name());
  }

  Status writeForEngine() {
    const Result<EngineHeights> heights =
        decodeEngineHeights(decoder_, *engine_, stream_.bytes.size() + beside_bytes_);
    if (!heights.ok()) return heights.status();
    if (heights->voids > 0)
      tellNote(std::to_string(heights->voids) + " void samples have the lowest height", quiet_);
    if (heights->askew)
      tellNote("the raster lies askew: " + height_->name() + " has north only about at its top",
               quiet_);
    if (arguments_.json) {
      engine_json_ = engineJson(*heights);
    } else if (!quiet_) {
      std::fprintf(stderr, "%s: %s\n", height_->name().c_str(), engineText(*heights).c_str());
    }
    return height_->stage(
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
  bool quiet_;
  std::optional<Output> height_, texture_, mesh_, normals_;
  std::optional<EngineSize> engine_;  ///< of --size
  Json engine_json_;
  DecodeMemory memory_;
  DecodedTexture image_;
  uint64_t beside_bytes_ = 0;  ///< that the texture takes meanwhile
};

Status decode(const DecodeArguments& arguments, bool quiet) {
  if (Status status = checkArguments(arguments); !status.ok()) return status;
  Result<OpenStream> stream = openStream(arguments.source);
  if (!stream.ok()) return stream.status();
  stream->decoder.setThreads(arguments.threads);
  if (Status status = checkWindow(arguments, stream->decoder.info()); !status.ok()) return status;
  const bool no_heights = arguments.height.empty() && arguments.normal_map.empty();
  const uint32_t heights_level = no_heights ? 0 : arguments.level,
                 texture_level = arguments.texture.empty() ? 0 : arguments.level;
  const Status set = stream->decoder.setLevels(heights_level, texture_level);
  if (!set.ok()) return set;
  Decoding decoding(arguments, *stream, quiet);
  if (Status status = decoding.plan(); !status.ok()) return status;
  if (Status status = decoding.checkMemory(); !status.ok()) return status;
  decoding.tellGuesses();
  decoding.start();
  if (!arguments.height.empty())
    if (Status status = decoding.writeHeightField(); !status.ok()) return status;
  if (!arguments.texture.empty())
    if (Status status = decoding.writeTexture(); !status.ok()) return status;
  if (!arguments.mesh.empty())
    if (Status status = decoding.writeSurfaceMesh(); !status.ok()) return status;
  if (!arguments.normal_map.empty())
    if (Status status = decoding.writeNormals(); !status.ok()) return status;
  return decoding.commit();
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

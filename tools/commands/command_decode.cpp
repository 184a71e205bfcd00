// SPDX-License-Identifier: Apache-2.0
// tetrakis decode: heights, texture and mesh out of a stream or a prefix of one.
#include <algorithm>
#include <array>
#include <future>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "base/length_unit.hpp"
#include "tools/commands/decode_arguments.hpp"
#include "tools/commands/engine_output.hpp"
#include "tools/files/file_bytes.hpp"
#include "tools/files/plain_heights.hpp"
#include "tools/files/text.hpp"
#include "tools/files/turned_image.hpp"
#include "tools/output/output.hpp"
#include "tools/report/draped_texture.hpp"
#include "tools/report/surface_normals.hpp"
#include "tools/report/viewed_mesh.hpp"

namespace tetrakis::tools {
namespace {

tks_window windowOf(const DecodeArguments& arguments) {
  const std::vector<uint32_t>& w = arguments.window;
  return {w[0], w[1], w[2], w[3]};
}

/// The texels over a window of samples: the image covers the ground from the first sample to the
/// last. Rounded outwards.
tks_window texelsOver(const tks_window& samples, const tks_info& info) {
  const auto side = [](uint64_t first, uint64_t count, uint64_t all, uint64_t texels) {
    const uint64_t begin = std::min(first * texels / (all - 1), texels - 1);
    const uint64_t end = ((first + count - 1) * texels + all - 2) / (all - 1);
    return std::pair(static_cast<uint32_t>(begin),
                     static_cast<uint32_t>(std::clamp(end, begin + 1, texels) - begin));
  };
  const auto [x, width] = side(samples.x, samples.width, info.width, info.texture_width);
  const auto [y, height] = side(samples.y, samples.height, info.height, info.texture_height);
  return {x, y, width, height};
}

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
      : arguments_(arguments), stream_(stream), decoder_(stream.decoder), quiet_(quiet) {}

  /// That each of the outputs can be had, before there is any work.
  Status checkMemory() {
    const tks_info& info = decoder_.info();
    Status status;
    if (!arguments_.height.empty() && info.has_heights)
      status = check(TKS_PART_HEIGHTS, window(), heightCopies());
    if (status.ok() && wantsTexture() && info.has_texture)
      status = check(TKS_PART_TEXTURE, textureWindow(), textureCopies());
    if (status.ok() && !arguments_.mesh.empty() && info.has_heights)
      status = check(meshPart(), std::nullopt, meshCopies());
    return status;
  }

  /// Begins the texture beside the heights where there are threads and memory for both.
  void start() {
    const bool wants_heights = !arguments_.height.empty() || !arguments_.mesh.empty();
    const tks_info& info = decoder_.info();
    if (arguments_.threads < 2 || !wantsTexture() || !wants_heights || !info.has_texture) return;
    if (!fitsBesideHeights()) return;
    const auto decode = [this]() -> Result<ImageFile> {
      Result<Decoder> decoder = openDecoder(octets(stream_.bytes));
      if (!decoder) return decoder.status();
      decoder->setThreads(arguments_.threads);
      if (const Status set = decoder->setLevels(0, arguments_.level); !set.ok()) return set;
      return decodeImage(*decoder, textureWindow(), textureCopies());
    };
    try {
      beside_ = std::async(std::launch::async, decode);
    } catch (const std::system_error&) {
      beside_ = std::async(std::launch::deferred, decode);  // the system has no thread to give
    }
  }

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
    if (*info.unit == '\0')
      tellNote("the stream does not tell the unit of its heights, which counts as metres", quiet_);
    if (info.spacing_x <= 0 && info.spacing_y <= 0)
      tellNote("the stream does not tell the spacing of its samples, which counts as " +
                   shortest(kUnknownSpacing) + " m",
               quiet_);
  }

  Status writeHeightField() {
    if (engine_) return writeForEngine();
    const Result<HeightFile> heights =
        decodeHeights(decoder_, window(), heightCopies() + beside_bytes_);
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
    const Result<ImageFile>& image = decodedImage();
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
      const Result<ImageFile>& image = decodedImage();
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

  bool wantsTexture() const { return !arguments_.texture.empty() || !arguments_.mesh.empty(); }

  tks_part meshPart() const {
    return arguments_.coded_mesh ? TKS_PART_CODED_MESH : TKS_PART_BUDGET_MESH;
  }

  /// Bytes beside what decoding itself takes: the stream, what comes out, and what writing makes of
  /// that, at most.
  uint64_t heightCopies() const {
    return stream_.bytes.size() + 2 * heightsBytes(decoder_.info(), window());
  }
  uint64_t textureCopies() const {
    const uint64_t in_mesh = arguments_.mesh.empty() ? 0 : 1, turned = engine_ ? 1 : 0;
    return stream_.bytes.size() +
           (3 + in_mesh + turned) * imageBytes(decoder_.info(), textureWindow());
  }
  uint64_t meshCopies() const {
    constexpr uint64_t kTriangle = 64;  // in space with half a vertex, and in the file's order
    constexpr uint64_t kSample = 16;    // of the surface that a camera is placed over
    const tks_info& info = decoder_.info();
    const uint64_t samples = uint64_t{info.width} * info.height;
    const bool all = arguments_.coded_mesh || arguments_.triangles == 0;
    const uint64_t triangles =
        all ? 2 * samples : std::min<uint64_t>(arguments_.triangles, 2 * samples);
    return stream_.bytes.size() + kTriangle * triangles +
           (arguments_.camera.isDefault() ? 0 : kSample * samples) +
           (info.has_texture ? 3 * imageBytes(info) : 0);
  }

  Status check(tks_part part, const std::optional<tks_window>& window, uint64_t copies) {
    const Result<uint64_t> fits =
        decoder_.checkMemory(part, window ? &*window : nullptr, arguments_.triangles, copies);
    return fits.status();
  }

  /// Then beside_bytes_ is what the texture takes meanwhile.
  bool fitsBesideHeights() {
    const std::optional<tks_window> texels = textureWindow();
    const Result<uint64_t> texture =
        decoder_.checkMemory(TKS_PART_TEXTURE, texels ? &*texels : nullptr);
    if (!texture) return false;
    // Its decoder takes the packets apart once more.
    const uint64_t bytes = *texture + textureCopies() + 4 * stream_.bytes.size();
    const bool fits =
        (arguments_.height.empty() ||
         check(TKS_PART_HEIGHTS, window(), heightCopies() + bytes).ok()) &&
        (arguments_.mesh.empty() || check(meshPart(), std::nullopt, meshCopies() + bytes).ok());
    if (fits) beside_bytes_ = bytes;
    return fits;
  }

  /// Decoded once, where there are threads beside the heights.
  const Result<ImageFile>& decodedImage() {
    if (!image_)
      image_ =
          beside_.valid() ? beside_.get() : decodeImage(decoder_, textureWindow(), textureCopies());
    return *image_;
  }

  std::optional<tks_window> window() const {
    if (arguments_.window.empty()) return std::nullopt;
    return windowOf(arguments_);
  }

  std::optional<tks_window> textureWindow() const {
    const tks_info& info = decoder_.info();
    if (!window() || !info.has_heights || !info.has_texture) return window();
    return texelsOver(*window(), info);
  }

  Result<Mesh> chosenMesh(const ImageFile* texture) {
    if (Status status = check(meshPart(), std::nullopt, meshCopies() + beside_bytes_); !status.ok())
      return status;
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
  std::optional<Result<ImageFile>> image_;
  std::future<Result<ImageFile>> beside_;
  uint64_t beside_bytes_ = 0;
};

/// In samples of the heights, if there are any.
Status checkWindow(const DecodeArguments& arguments, const tks_info& info) {
  if (arguments.window.empty()) return Status();
  const tks_window w = windowOf(arguments);
  const uint64_t width = info.has_heights ? info.width : info.texture_width;
  const uint64_t height = info.has_heights ? info.height : info.texture_height;
  if (w.width > 0 && w.height > 0 && uint64_t{w.x} + w.width <= width &&
      uint64_t{w.y} + w.height <= height) {
    return Status();
  }
  return Status(TKS_USAGE, "--window must lie inside the " + std::to_string(width) + " x " +
                               std::to_string(height) + " samples");
}

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

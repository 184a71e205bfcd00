// SPDX-License-Identifier: Apache-2.0
#include "apps/tools/commands/encode_surface.hpp"

#include <cmath>
#include <cstdio>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "apps/tools/commands/encode_maps.hpp"
#include "apps/tools/commands/encode_notes.hpp"
#include "apps/tools/commands/notes.hpp"
#include "apps/tools/files/memory_limit.hpp"
#include "apps/tools/files/text.hpp"
#include "apps/tools/output/json.hpp"
#include "apps/tools/output/output.hpp"
#include "apps/tools/output/output_names.hpp"
#include "apps/tools/output/progress.hpp"
#include "apps/tools/report/surface_pictures.hpp"

namespace tetrakis::tools {
namespace {

/// What the encoder is to take.
struct SurfaceInputs {
  SurfaceFile mesh;
  std::vector<FurtherTexture> further;  ///< what lies on the triangles beside the texture
  std::string unit, material;
};

Result<ImageFile> readTexture(const std::string& path, bool quiet) {
  std::string remark;
  const Result<ImageFile> image = readImage(path, &remark);
  if (!image.ok()) return image.status();
  tellNote(remark, quiet);
  ImageFile texture = withoutAlpha(*image);
  texture.place = {};
  return texture;
}

/// What glTF says of a colour that no texture shows.
void keepColour(SurfaceFile& mesh) {
  MaterialFactors& factors = mesh.maps.material.factors;
  if (!mesh.texture) factors.colour = mesh.base_colour;
  factors.colour[3] = factors.alpha_mode == AlphaMode::kOpaque ? 1 : mesh.base_colour[3];
}

/// What lies on triangles beside their texture, or in the place of one that is not there.
Status readFurther(const EncodeArguments& arguments, bool quiet, SurfaceInputs& inputs) {
  SurfaceFile& mesh = inputs.mesh;
  if (!arguments.also.empty() && mesh.texcoords.empty())
    return {TKS_USAGE, quoted(arguments.height) +
                           " has no texture coordinates, so that --also cannot lie on it"};
  Result<std::vector<FurtherTexture>> further = furtherTextures(arguments, mesh, quiet);
  if (!further.ok()) return further.status();
  inputs.further = *std::move(further);
  const bool has_maps = !inputs.further.empty() || mesh.maps.has_even;
  if (has_maps && !mesh.texture) mesh.texture = plainTexture(mesh);
  const bool has_factors = mesh.y_is_up && arguments.maps != "none";
  if (has_factors) keepColour(mesh);
  if (has_maps || has_factors) inputs.material = materialText(mesh.maps.material);
  return {};
}

/// Colours at corners are a cell of the texture for each triangle, whose places would be rounded.
void leaveOutCornerColours(SurfaceFile& mesh, bool quiet) {
  if (!mesh.texture || !mesh.has_corner_colours) return;
  tellNote("colours at corners are left out: they go with --class resampled", quiet);
  mesh.texture.reset();
}

/// The textures of a mesh itself go with a number of bytes alone.
Result<SurfaceInputs> readSurfaceInputs(const EncodeArguments& arguments, bool quiet) {
  const Result<std::vector<std::string>> maps = wantedMaps(arguments.maps);
  if (!maps.ok()) return maps.status();
  Result<SurfaceFile> mesh =
      readTexturedSurface(arguments.height, {arguments.texture, *maps}, quiet);
  if (!mesh.ok()) return mesh.status();
  if (arguments.bytes == 0) leaveOutTextures(*mesh, quiet);
  if (arguments.kind == "triangles") leaveOutCornerColours(*mesh, quiet);
  if (mesh->texture && !arguments.texture.empty() && arguments.white_level > 0)
    mesh->texture->white_level = arguments.white_level;
  SurfaceInputs inputs{std::move(*mesh), {}, "", ""};
  inputs.unit = arguments.unit ? canonicalUnit(*arguments.unit) : inputs.mesh.y_is_up ? "m" : "";
  if (Status status = readFurther(arguments, quiet, inputs); !status.ok()) return status;
  return inputs;
}

/// Measured: what encoding takes beside the streams that are tried.
Status checkSurfaceMemory(const SurfaceInputs& inputs) {
  constexpr uint64_t kTriangle = 600, kImages = 3;
  uint64_t image = inputs.mesh.texture ? inputs.mesh.texture->data.size() : 0;
  for (const FurtherTexture& one : inputs.further) image += one.image.data.size();
  return checkMemoryFor("encoding so many triangles",
                        kTriangle * inputs.mesh.triangles.size() + kImages * image);
}

/// --sketch as tks_triangle_mesh has it.
Result<uint64_t> parseSketch(const std::string& text) {
  if (text == "auto") return uint64_t{0};
  if (text == "none") return uint64_t{TKS_NO_SKETCH};
  const Result<uint64_t> size = parseSize(text);
  if (size.ok() && *size > 0) return *size;
  return Status(TKS_USAGE, "--sketch takes a size, none or auto, not " + quoted(text));
}

/// A view of the inputs.
tks_triangle_mesh asTriangleMesh(const SurfaceInputs& inputs, const std::string& kind) {
  const SurfaceFile& file = inputs.mesh;
  tks_triangle_mesh mesh = makeTriangleMesh();
  mesh.vertex_count = static_cast<uint32_t>(file.points.size());
  mesh.triangle_count = static_cast<uint32_t>(file.triangles.size());
  mesh.positions = file.points.front().data();
  mesh.triangles = file.triangles.front().data();
  if (!inputs.unit.empty()) mesh.unit = inputs.unit.c_str();
  if (!file.name.empty()) mesh.description = file.name.c_str();
  if (file.texture) mesh.texcoords = file.texcoords.front().data();
  if (!inputs.material.empty()) mesh.material = inputs.material.c_str();
  const bool has_cells = file.texture && file.has_corner_colours;
  mesh.kind = kind == "auto" && !has_cells ? TKS_OBJECT_AUTO
              : kind == "triangles"        ? TKS_OBJECT_TRIANGLES
                                           : TKS_OBJECT_RESAMPLED;
  return mesh;
}

Result<tks_encode_options> surfaceOptions(const EncodeArguments& arguments,
                                          const std::string& unit) {
  tks_encode_options options = makeEncodeOptions();
  options.bytes = arguments.bytes;
  options.psnr = arguments.psnr;
  options.threads = arguments.threads;
  options.index = arguments.index ? TKS_INDEX_PACKETS : TKS_INDEX_NONE;
  options.weights = arguments.weights == "visual" ? TKS_WEIGHTS_VISUAL : TKS_WEIGHTS_PSNR;
  if (arguments.max_error.empty()) return options;
  const Result<double> bound = parseLength(arguments.max_error, unit);
  if (!bound.ok()) return bound.status();
  options.max_error = *bound;
  return options;
}

/// Three digits are what distances between 20 000 places tell.
std::string threeDigits(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value);
  return text;
}

/// With its unit, if that is known.
std::string inUnit(double value, const std::string& unit) {
  return threeDigits(value) + (unit.empty() ? "" : ' ' + unit);
}

std::string squares(uint32_t patches, uint32_t depth) {
  const std::string side = std::to_string((uint64_t{1} << depth) + 1);
  return counted(patches, "patch of ", "patches of ") + side + " x " + side;
}

/// Those that the user has named, of a mesh with a texture.
Result<std::vector<Camera>> wantedCameras(const EncodeArguments& arguments,
                                          const SurfaceFile& mesh) {
  if (arguments.cameras.isDefault()) return std::vector<Camera>();
  if (!mesh.texture)
    return Status(TKS_USAGE, "cameras weigh a texture against the surface: " +
                                 quoted(arguments.height) + " has none that is encoded");
  return chooseCameras(arguments.cameras, boundsOf(mesh));
}

Result<Buffer> encodeMesh(const EncodeArguments& arguments, const SurfaceInputs& inputs, bool quiet,
                          tks_object_report& report) {
  Result<tks_encode_options> options = surfaceOptions(arguments, inputs.unit);
  if (!options.ok()) return options.status();
  const Result<std::vector<Camera>> cameras = wantedCameras(arguments, inputs.mesh);
  if (!cameras.ok()) return cameras.status();
  const std::vector<tks_camera> told = toldCameras(*cameras, GroundAxes());
  options->cameras = told.data();
  options->camera_count = static_cast<uint32_t>(told.size());
  Progress progress("encoding", quiet);
  options->progress = &Progress::report;
  options->user = &progress;
  const Result<uint64_t> sketch = parseSketch(arguments.sketch);
  if (!sketch.ok()) return sketch.status();
  tks_triangle_mesh mesh = asTriangleMesh(inputs, arguments.kind);
  mesh.sketch_bytes = *sketch;
  const GivenMaps maps(inputs.further);
  mesh.maps = maps.maps.data();
  mesh.map_count = static_cast<uint32_t>(maps.maps.size());
  const std::optional<ImageFile>& texture = inputs.mesh.texture;
  const tks_image image = texture ? asImage(*texture) : tks_image{};
  return encodeObject(mesh, texture ? &image : nullptr, *options, &report);
}

}  // namespace

Result<SurfaceFile> readTexturedSurface(const std::string& path, const SurfaceTextures& textures,
                                        bool quiet) {
  std::string remark;
  const std::string& texture = textures.texture;
  Result<SurfaceFile> mesh = readSurface(path, &remark, {texture.empty(), textures.maps});
  if (!mesh.ok()) return mesh.status();
  if (!remark.empty()) tellNote(quoted(path) + ": " + remark, quiet);
  if (!texture.empty()) {
    if (mesh->texcoords.empty())
      return Status(TKS_USAGE, quoted(path) +
                                   " has no texture coordinates, so that --texture cannot lie on "
                                   "it");
    Result<ImageFile> image = readTexture(texture, quiet);
    if (!image.ok()) return image.status();
    mesh->texture = std::move(*image);
  } else if (mesh->texture) {
    mesh->texture = shownTexture(*mesh);
  }
  return mesh;
}

Status checkSurfaceArguments(const EncodeArguments& arguments) {
  if (arguments.lossless)
    return {TKS_USAGE,
            "a mesh is resampled, so that --lossless does not go with it: give --bytes, --psnr or "
            "--max-error"};
  if (!arguments.texture.empty() && arguments.bytes == 0)
    return {TKS_USAGE, "a mesh with --texture takes --bytes as its target"};
  if (!arguments.cameras.isDefault() && arguments.bytes == 0)
    return {TKS_USAGE, "cameras share bytes between a mesh and its texture: give --bytes"};
  if (!arguments.also.empty() && arguments.bytes == 0)
    return {TKS_USAGE, "of a mesh --also goes with --bytes alone"};
  const std::pair<const char*, bool> options[] = {
      {"--triangles", arguments.triangles > 0},
      {"--engine", arguments.engine != "modelled"},
      {"--regions", arguments.regions != "auto" && arguments.regions != "off"},
      {"--windows", arguments.windows},
      {"--domain", arguments.domain != "auto"},
      {"--depth", arguments.depth > 0},
      {"--scale", arguments.scale.has_value()},
      {"--offset", arguments.offset.has_value()},
      {"--nodata", arguments.nodata.has_value()},
      {"--step", arguments.step > 0},
      {"--spacing", !arguments.spacing.empty()},
      {"--vertical-datum", arguments.vertical_datum.has_value()},
      {"--crs", arguments.crs.has_value()},
      {"--report", !arguments.report.empty()}};
  for (const auto& [name, given] : options)
    if (given)
      return {TKS_USAGE, std::string(name) + " is about terrain, and " + quoted(arguments.height) +
                             " is a mesh"};
  return {};
}

std::string cleaningNote(const tks_object_report& report) {
  std::string note;
  if (report.dropped_triangles > 0)
    note = counted(report.dropped_triangles, "triangle has equal corners or is there twice",
                   "triangles have equal corners or are there twice") +
           " and " + (report.dropped_triangles == 1 ? "is" : "are") + " left out";
  if (report.cut_edges > 0)
    note += (note.empty() ? "" : "; ") +
            counted(report.cut_edges, "edge joins more triangles than two, or two that face apart,",
                    "edges join more triangles than two, or two that face apart,") +
            " and " + (report.cut_edges == 1 ? "is" : "are") + " cut open";
  return note;
}

std::string objectNote(const tks_object_report& report, const std::string& unit) {
  const std::string exact = std::isfinite(report.psnr) ? fixed(report.psnr, 1) : "infinitely many";
  const std::string texels =
      report.texture_depth > 0
          ? ", " + std::to_string((1u << report.texture_depth) + 1) + " texels a side"
          : std::string();
  return (report.kind == TKS_OBJECT_TRIANGLES
              ? counted(report.coded_triangles, "triangle", "triangles")
              : squares(report.patches, report.depth) + " samples" + texels) +
         (report.sketch_bytes > 0
              ? " behind a sketch of " + std::to_string(report.sketch_bytes) + " bytes"
              : std::string()) +
         "; RMS distance to the mesh " + inUnit(report.error, unit) + " (" + exact +
         " dB of its diagonal), largest " + inUnit(report.largest, unit);
}

Json trialJson(const tks_object_trial& trial, bool taken) {
  if (trial.bytes == 0) return {};
  return {{"taken", taken},
          {"bytes", trial.bytes},
          {"surface_psnr", finiteOrNull(trial.psnr)},
          {"screen_psnr", trial.screen_psnr > 0 ? finiteOrNull(trial.screen_psnr) : Json()}};
}

/// Both kinds of object, if somebody asked.
Status printTrials(const EncodeArguments& arguments, const tks_object_report& report) {
  if (!arguments.explain) return Status();
  const Json json = {
      {"resampled", trialJson(report.as_resampled, report.kind == TKS_OBJECT_RESAMPLED)},
      {"triangles", trialJson(report.as_triangles, report.kind == TKS_OBJECT_TRIANGLES)}};
  return print(arguments.json ? dump(json) : table(legible(json)));
}

namespace {

/// What became of the mesh, beside its stream.
Status tellResult(const EncodeArguments& arguments, const SurfaceInputs& inputs,
                  const tks_object_report& report, std::span<const uint8_t> bytes) {
  tellNote(mapsNote(inputs.further, inputs.mesh.maps.left_out, report.kind != TKS_OBJECT_TRIANGLES),
           false);
  tellNote(cleaningNote(report), false);
  tellNote(objectNote(report, inputs.unit), false);
  const Result<Decoder> decoder = openDecoder(bytes);
  if (!decoder) return decoder.status();
  tellLine(tools::summary(arguments.output, *decoder));
  return {};
}

}  // namespace

Status encodeSurface(const EncodeArguments& arguments, bool quiet) {
  std::vector<std::string> files = {arguments.height, arguments.texture};
  for (const NamedFile& file : namedFiles(arguments.also)) files.push_back(file.path);
  Status status = checkInputsStay(files, arguments.output);
  if (!status.ok()) return status;
  Result<Output> output = Output::plan(arguments.output, arguments.force, ".tks");
  if (!output.ok()) return output.status();
  const Result<SurfaceInputs> inputs = readSurfaceInputs(arguments, quiet);
  if (!inputs.ok()) return inputs.status();
  status = checkSurfaceMemory(*inputs);
  if (!status.ok()) return status;
  tks_object_report report{};
  const Result<Buffer> stream = encodeMesh(arguments, *inputs, quiet, report);
  if (!stream.ok()) return stream.status();
  const std::span<const uint8_t> bytes = stream->bytes();
  status = output->stage(std::as_bytes(bytes));
  if (status.ok()) status = output->commit();
  if (status.ok()) status = printTrials(arguments, report);
  if (!status.ok() || quiet) return status;
  return tellResult(arguments, *inputs, report, bytes);
}

}  // namespace tetrakis::tools

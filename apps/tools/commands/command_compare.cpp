// SPDX-License-Identifier: Apache-2.0
// tetrakis compare: how far a stream is from what was encoded, and whether it keeps its promise.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <optional>
#include <utility>

#include "apps/tools/commands/camera_pictures.hpp"
#include "apps/tools/commands/command.hpp"
#include "apps/tools/commands/encode_surface.hpp"
#include "apps/tools/commands/notes.hpp"
#include "apps/tools/commands/options.hpp"
#include "apps/tools/files/cube_heights.hpp"
#include "apps/tools/files/file_bytes.hpp"
#include "apps/tools/files/frame_files.hpp"
#include "apps/tools/files/text.hpp"
#include "apps/tools/output/json.hpp"
#include "apps/tools/report/comparison.hpp"
#include "apps/tools/report/object_mesh.hpp"
#include "apps/tools/report/surface_comparison.hpp"
#include "apps/tools/report/surface_pictures.hpp"

namespace tetrakis::tools {
namespace {

struct CompareArguments {
  StreamSource source;
  std::string height, texture, mesh;
  uint32_t triangles = 0;
  CameraChoice cameras;
  std::string pictures;
  bool json = false, force = false;
};

bool isExact(double psnr) {
  return std::isinf(psnr) && psnr > 0;
}

/// "<name>" and "<name minus _psnr>_exact": JSON has no infinity, so exactness is a field of its
/// own.
void addPsnr(Json& json, const std::string& what, std::optional<double> psnr) {
  json[what + "_psnr"] = psnr ? finiteOrNull(*psnr) : Json();
  json[what + "_exact"] = psnr ? Json(isExact(*psnr)) : Json();
}

Json camerasJson(const std::vector<Camera>& cameras, const Measurement& measurement) {
  Json list = Json::array();
  for (size_t i = 0; i < measurement.camera_psnr.size(); ++i) {
    Json camera = {{"name", cameras[i].name}};
    addPsnr(camera, "screen", measurement.camera_psnr[i]);
    list.push_back(std::move(camera));
  }
  return list;
}

Json measurementJson(const Measurement& measurement, const std::vector<Camera>& cameras) {
  const std::optional<HeightErrors>& heights = measurement.heights;
  Json json = {
      {"bytes", measurement.bytes},
      {"geometry_bytes", measurement.geometry_bytes},
      {"texture_bytes", measurement.texture_bytes},
      {"triangles", measurement.triangles ? Json(*measurement.triangles) : Json()},
      {"height_rmse", heights ? finiteOrNull(heights->rmse) : Json()},
      {"height_max_error", heights ? finiteOrNull(heights->max_error) : Json()},
  };
  addPsnr(json, "height", heights ? std::optional(heights->psnr) : std::nullopt);
  addPsnr(json, "texture", measurement.texture_psnr);
  addPsnr(json, "screen", measurement.screen_psnr);
  json["cameras"] = camerasJson(cameras, measurement);
  return json;
}

/// Heights with the voids of the stream.
Result<Reference> readReference(const CompareArguments& arguments, const tks_info& info,
                                bool quiet) {
  if (arguments.height.empty() && arguments.texture.empty())
    return Status(TKS_USAGE, "nothing to compare with: give --height or --texture");
  Reference reference;
  if (!arguments.height.empty()) {
    Result<HeightFile> heights =
        readHeights(arguments.height, info.has_nodata ? std::optional(info.nodata) : std::nullopt);
    if (!heights.ok()) return heights.status();
    if (heights->rounding > 0)
      tellNote(quoted(arguments.height) +
                   " holds 64-bit floats that 32 bits do not hold: errors are those beside them "
                   "as the nearest 32-bit floats",
               quiet);
    reference.heights = std::move(*heights);
  }
  if (!arguments.texture.empty()) {
    std::string note;
    Result<ImageFile> image = readImage(arguments.texture, &note);
    if (!image.ok()) return image.status();
    tellNote(note, quiet);
    reference.image = std::move(*image);
    reference.image->white_level = info.texture_white_level;
  }
  return reference;
}

/// Screen figures need a renderer. Cameras and pictures that were asked for must be drawn; the
/// default view is left out with a note on a machine that cannot draw.
Status look(Comparer& comparer, const CompareArguments& arguments, bool quiet) {
  const Status status = comparer.look(arguments.cameras);
  const bool asked = !arguments.cameras.isDefault() || !arguments.pictures.empty();
  if (status.ok() || status.code() != TKS_UNSUPPORTED || asked) return status;
  tellNote("no screen figures: " + status.message(), quiet);
  return Status();
}

/// Of a promise: what the stream says, and what is found.
Status broken(const std::string& promise, const std::string& finding) {
  return {TKS_MISMATCH, "the stream says " + promise + ", but " + finding +
                            ": it is not of this file, or broke its promise"};
}

/// A complete stream states what it guarantees; the surface itself is held to it.
Status checkPromise(const tks_info& info, const Measurement& measurement) {
  if (info.available_bytes < info.stream_bytes) return Status();
  if (info.lossless && measurement.texture_psnr && !isExact(*measurement.texture_psnr))
    return broken("lossless", "the texture differs");
  // Of heights on a cube those that it has are promised, and not those of the grid.
  if (!measurement.heights || isGridOnCube(info)) return Status();
  const double error = measurement.heights->max_error;
  if (info.lossless && error != 0)
    return broken("lossless", "heights differ by up to " + shortest(error));
  if (info.max_error >= 0 && !(error <= info.max_error + measurement.heights->rounding))
    return broken("heights within " + shortest(info.max_error),
                  "they differ by up to " + shortest(error));
  return Status();
}

Status printJson(const CompareArguments& arguments, const Json& json) {
  return print(arguments.json ? dump(json) : table(legible(json)));
}

Json surfaceJson(const tks_info& info, const SurfaceMeasurement& measured) {
  const MeshDistance& distance = measured.distance;
  return {{"bytes", info.available_bytes},
          {"geometry_bytes", info.geometry_bytes},
          {"texture_bytes", info.texture_bytes},
          {"triangles", measured.triangles},
          {"rms_distance", distance.error},
          {"rms_to_stream", distance.to_second.rms},
          {"rms_to_mesh", distance.to_first.rms},
          {"largest_to_stream", distance.to_second.largest},
          {"largest_to_mesh", distance.to_first.largest},
          {"surface_psnr", finiteOrNull(distance.psnr)},
          {"colour_psnr", measured.colour_psnr ? finiteOrNull(*measured.colour_psnr) : Json()}};
}

/// What the cameras see, into `json` and to a folder that was asked for. As of terrain, pictures
/// that nobody asked for are left out on a machine that cannot draw.
Status lookAt(const CompareArguments& arguments, const SurfaceFile& original, Decoder& decoder,
              bool quiet, Json& json) {
  json["screen_psnr"] = json["screen_exact"] = Json();
  json["cameras"] = Json::array();
  const Result<SurfacePictures> drawn =
      drawSurfaces(original, decoder, arguments.triangles, arguments.cameras);
  const bool asked = !arguments.cameras.isDefault() || !arguments.pictures.empty();
  if (!drawn.ok()) {
    if (drawn.status().code() != TKS_UNSUPPORTED || asked) return drawn.status();
    tellNote("no screen figures: " + drawn.status().message(), quiet);
    return Status();
  }
  addPsnr(json, "screen", screenPsnr(*drawn));
  for (size_t i = 0; i < drawn->cameras.size(); ++i) {
    Json camera = {{"name", drawn->cameras[i].name}};
    addPsnr(camera, "screen", screenPsnr({drawn->originals[i]}, {drawn->pictures[i]}));
    json["cameras"].push_back(std::move(camera));
  }
  if (arguments.pictures.empty()) return Status();
  Result<CameraPictures> planned =
      CameraPictures::plan(arguments.pictures, drawn->cameras.size(), arguments.force);
  if (!planned.ok()) return planned.status();
  return planned->write(drawn->pictures, drawn->originals);
}

/// An object beside the mesh that was encoded, with the texture that `encode` takes.
Status compareMesh(const CompareArguments& arguments, Decoder& decoder, bool quiet) {
  const tks_info& info = decoder.info();
  if (!isObject(info))
    return {TKS_USAGE,
            "--mesh is for streams that hold an object: give --height or "
            "--texture"};
  Result<SurfaceFile> original = readTexturedSurface(arguments.mesh, {arguments.texture}, quiet);
  if (!original.ok()) return original.status();
  if (!arguments.texture.empty()) original->texture->white_level = info.texture_white_level;
  const Result<SurfaceMeasurement> measured =
      compareSurface(decoder, *original, arguments.triangles);
  if (!measured.ok()) return measured.status();
  tellNote(coarsestNote(measured->triangles, arguments.triangles), quiet);
  Json json = surfaceJson(info, *measured);
  if (Status status = lookAt(arguments, *original, decoder, quiet, json); !status.ok())
    return status;
  return printJson(arguments, json);
}

/// What the frames have in common.
struct FrameTotals {
  uint64_t frames = 0;
  double squares = 0, largest = 0;  ///< of heights, in the unit
  double texels = 0;                ///< mean squared error over the squared white level
  bool heights = false, texture = false;

  void add(const Measurement& one) {
    ++frames;
    if (one.heights) {
      heights = true;
      squares += one.heights->rmse * one.heights->rmse;
      largest = std::max(largest, one.heights->max_error);
    }
    if (one.texture_psnr) {
      texture = true;
      texels += std::pow(10, -*one.texture_psnr / 10);
    }
  }
  Json json(uint64_t bytes, Json of_frames) const {
    const auto count = static_cast<double>(frames);
    Json json = {{"bytes", bytes}, {"frames", frames}};
    json["height_rmse"] = heights ? finiteOrNull(std::sqrt(squares / count)) : Json();
    json["height_max_error"] = heights ? finiteOrNull(largest) : Json();
    addPsnr(json, "texture",
            texture ? std::optional(-10 * std::log10(texels / count)) : std::nullopt);
    json["of_frames"] = std::move(of_frames);
    return json;
  }
};

/// Frame by frame, without pictures.
Status compareFrames(const CompareArguments& arguments, bool quiet) {
  if (arguments.triangles > 0 || !arguments.pictures.empty() || !arguments.cameras.isDefault())
    return {TKS_USAGE, "frames are compared sample by sample; give one with --frame to look at it"};
  const Result<FrameNames> names = frameNames(arguments.height, arguments.texture);
  if (!names.ok()) return names.status();
  CompareArguments one = arguments;
  FrameTotals totals;
  Json of_frames = Json::array();
  one.source.frame = 0;
  Result<OpenStream> stream = openStream(one.source);
  if (!stream.ok()) return stream.status();
  for (size_t t = 0; t < names->count(); ++t) {
    one.height = names->height(t);
    one.texture = names->texture(t);
    if (Status status = showFrame(*stream, t); !status.ok()) return status;
    const tks_info& info = stream->decoder.info();
    const Result<Reference> reference = readReference(one, info, quiet || t > 0);
    if (!reference.ok()) return reference.status();
    Result<Comparer> comparer = Comparer::create(*reference, info);
    if (!comparer.ok()) return comparer.status();
    const Result<Measurement> measured = comparer->measure(stream->decoder, 0);
    if (!measured.ok()) return measured.status();
    if (Status status = checkPromise(info, *measured); !status.ok()) return status;
    totals.add(*measured);
    Json json = {{"frame", t}};
    json["height_rmse"] = measured->heights ? finiteOrNull(measured->heights->rmse) : Json();
    json["height_max_error"] =
        measured->heights ? finiteOrNull(measured->heights->max_error) : Json();
    addPsnr(json, "texture", measured->texture_psnr);
    of_frames.push_back(std::move(json));
  }
  const uint64_t bytes = stream->sequence ? stream->sequence->bytes : stream->bytes.size();
  return printJson(arguments, totals.json(bytes, arguments.json ? of_frames : Json()));
}

Status compare(const CompareArguments& arguments, bool quiet) {
  if (isPattern(arguments.height) || isPattern(arguments.texture))
    return compareFrames(arguments, quiet);
  if (arguments.triangles > 0 && arguments.height.empty() && arguments.mesh.empty())
    return {TKS_USAGE, "--triangles is about a mesh: give --height or --mesh"};
  Result<OpenStream> stream = openStream(arguments.source);
  if (!stream.ok()) return stream.status();
  if (!arguments.mesh.empty()) return compareMesh(arguments, stream->decoder, quiet);
  const tks_info& info = stream->decoder.info();
  if (isObject(info))
    return {TKS_USAGE, quoted(arguments.source.path) + " holds an object: compare it with --mesh"};
  const Result<Reference> reference = readReference(arguments, info, quiet);
  if (!reference.ok()) return reference.status();
  Result<Comparer> comparer = Comparer::create(*reference, info);
  if (!comparer.ok()) return comparer.status();
  if (Status status = look(*comparer, arguments, quiet); !status.ok()) return status;
  std::optional<CameraPictures> pictures;
  if (!arguments.pictures.empty()) {
    Result<CameraPictures> planned =
        CameraPictures::plan(arguments.pictures, comparer->cameras().size(), arguments.force);
    if (!planned.ok()) return planned.status();
    pictures = std::move(*planned);
  }
  const Result<Measurement> measurement = comparer->measure(stream->decoder, arguments.triangles);
  if (!measurement.ok()) return measurement.status();
  if (pictures)
    if (Status status = pictures->write(measurement->pictures, comparer->referencePictures());
        !status.ok())
      return status;
  tellNote(coarsestNote(measurement->triangles.value_or(0), arguments.triangles), quiet);
  Json json = measurementJson(*measurement, comparer->cameras());
  if (reference->heights && reference->heights->rounding > 0) json["height_exact"] = false;
  if (Status status = printJson(arguments, json); !status.ok()) return status;
  return arguments.triangles == 0 ? checkPromise(info, *measurement) : Status();
}

}  // namespace

void addCompare(CLI::App& app, CommandLine& line) {
  const auto arguments = std::make_shared<CompareArguments>();
  CLI::App& verb = *app.add_subcommand("compare", "Measure a stream against what was encoded");
  addSource(verb, arguments->source);
  addFrame(verb, arguments->source);
  addComponent(verb, arguments->source);
  CLI::Option* const height =
      verb.add_option("--height", arguments->height, "The original heights")->type_name("REF");
  verb.add_option("--texture", arguments->texture, "The original texture")->type_name("REF");
  addTriangles(verb, arguments->triangles, "Judge the mesh of at most so many triangles");
  addCameraOptions(verb, arguments->cameras);
  verb.add_option("--pictures", arguments->pictures, "Also write what the cameras see into DIR")
      ->type_name("DIR");
  verb.add_option("--mesh", arguments->mesh, "The original mesh of an object")
      ->type_name("REF")
      ->excludes(height);
  verb.add_flag("--json", arguments->json, "JSON instead of a table");
  addForce(verb, arguments->force);
  verb.callback([arguments, &line] {
    line.action = [arguments, &line] { return compare(*arguments, line.quiet); };
  });
}

}  // namespace tetrakis::tools

// SPDX-License-Identifier: Apache-2.0
// tetrakis encode: heights, a texture or both, or a mesh, into one embedded stream.
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <utility>

#include "apps/tools/commands/command.hpp"
#include "apps/tools/commands/encode_inputs.hpp"
#include "apps/tools/commands/encode_memory.hpp"
#include "apps/tools/commands/encode_notes.hpp"
#include "apps/tools/commands/encode_sequence.hpp"
#include "apps/tools/commands/encode_surface.hpp"
#include "apps/tools/commands/explained_plans.hpp"
#include "apps/tools/commands/named_files.hpp"
#include "apps/tools/commands/notes.hpp"
#include "apps/tools/files/cube_heights.hpp"
#include "apps/tools/files/file_bytes.hpp"
#include "apps/tools/files/meshes/surface_file.hpp"
#include "apps/tools/files/place/given_crs.hpp"
#include "apps/tools/files/place/ground_positions.hpp"
#include "apps/tools/files/place/ground_spacing.hpp"
#include "apps/tools/files/units.hpp"
#include "apps/tools/output/output.hpp"
#include "apps/tools/output/output_names.hpp"
#include "apps/tools/output/progress.hpp"
#include "apps/tools/report/picture_judge.hpp"
#include "apps/tools/report/report.hpp"
#include "base/coordinates.hpp"

namespace tetrakis::tools {
namespace {

Status describe(const EncodeArguments& arguments, HeightFile& heights) {
  heights.scale = arguments.scale.value_or(heights.scale);
  heights.offset = arguments.offset.value_or(heights.offset);
  if (arguments.unit) heights.unit = canonicalUnit(*arguments.unit);
  if (arguments.crs) giveCrs(heights, *arguments.crs);
  if (arguments.vertical_datum) giveVerticalDatum(heights, *arguments.vertical_datum);
  if (arguments.spacing.empty()) return Status();
  const Result<std::array<double, 2>> spacing = parseSpacing(arguments.spacing);
  if (!spacing.ok()) return spacing.status();
  heights.spacing_x = (*spacing)[0];
  heights.spacing_y = (*spacing)[1];
  return Status();
}

/// Notes that an option does not answer.
void tellNotes(const Notes& notes, const EncodeArguments& arguments, bool quiet) {
  for (const auto& [text, option] : notes) {
    const bool answered =
        (option == "--spacing" && !arguments.spacing.empty()) ||
        (option == "--unit" && arguments.unit) || (option == "--nodata" && arguments.nodata) ||
        (option == "--scale" && arguments.scale) || (option == "--offset" && arguments.offset);
    if (!answered) tellNote(quoted(arguments.height) + ": " + text, quiet);
  }
}

tks_domain domainOf(const EncodeArguments& arguments, const Georeference& place, uint32_t width) {
  const bool by_place = arguments.domain == "auto" || arguments.domain == "cube";
  const bool goes_round =
      by_place ? columnsRound(place, width) == ColumnsRound::kOnce : arguments.domain == "cylinder";
  return goes_round ? TKS_DOMAIN_CYLINDER : TKS_DOMAIN_PLANE;
}

/// That of a texture, which lies where the heights do unless it says otherwise.
tks_domain domainOf(const EncodeArguments& arguments, const ImageFile& image,
                    const HeightFile* heights) {
  if (heights != nullptr && !image.place.geotransform) return heights->domain;
  Georeference place = image.place;
  if (heights != nullptr && place.crs.empty()) place.crs = heights->crs;
  return domainOf(arguments, place, image.width);
}

}  // namespace

Result<Reference> readInputs(const EncodeArguments& arguments, bool quiet) {
  Reference inputs;
  if (!arguments.height.empty()) {
    Notes notes;
    Result<HeightFile> heights = readHeights(arguments.height, arguments.nodata, &notes);
    if (!heights.ok()) return heights.status();
    if (arguments.lossless && heights->rounding > 0)
      return Status(TKS_USAGE, quoted(arguments.height) +
                                   " holds 64-bit floats that 32 bits do not hold, so nothing "
                                   "keeps them all; round them first: gdal_translate -ot Float32 "
                                   "IN.tif OUT.tif");
    tellNotes(notes, arguments, quiet);
    if (Status status = describe(arguments, *heights); !status.ok()) return status;
    tellNotes(guesses(arguments, *heights, notes), arguments, quiet);
    tellNote(voidNote(*heights), quiet);
    heights->domain = domainOf(arguments, *heights, heights->width);
    if (arguments.domain == "auto") tellNote(roundNote(arguments.height, *heights), quiet);
    inputs.heights = std::move(*heights);
  }
  if (!arguments.texture.empty()) {
    std::string remark;
    Result<ImageFile> image = readImage(arguments.texture, &remark);
    if (!image.ok()) return image.status();
    tellNote(remark, quiet);
    if (arguments.white_level > 0) {
      image->white_level = arguments.white_level;
    } else {
      tellNote(whiteNote(arguments.texture, *image), quiet);
    }
    if (inputs.heights) tellNote(placeNote(arguments.texture, *inputs.heights, *image), quiet);
    image->place.domain = domainOf(arguments, *image, inputs.heights ? &*inputs.heights : nullptr);
    inputs.image = std::move(*image);
  }
  return inputs;
}

namespace {

/// Longitudes and latitudes for web pages, unless they take more than a 64th of the stream, or of
/// a byte a sample where nothing says how long that is to be.
void addPlaces(const EncodeArguments& arguments, Reference& inputs, bool quiet) {
  constexpr uint64_t kShare = 64;
  HeightFile* const heights = inputs.heights ? &*inputs.heights : nullptr;
  ImageFile* const image = inputs.image ? &*inputs.image : nullptr;
  const uint64_t samples = (heights ? uint64_t{heights->width} * heights->height : 0) +
                           (image ? uint64_t{image->width} * image->height : 0);
  const uint64_t expected = arguments.bytes > 0 ? arguments.bytes : samples;
  const std::string remark = addPositions(heights, image, expected / kShare);
  const std::string& name = heights ? arguments.height : arguments.texture;
  if (!remark.empty()) tellNote(quoted(name) + ": " + remark, quiet);
}

/// Of an image that covers all of a grid, edge to edge.
GeoTransform stretchedOver(const HeightFile& grid, const ImageFile& image) {
  const GeoTransform& t = *grid.geotransform;
  const double across = static_cast<double>(grid.width) / image.width,
               down = static_cast<double>(grid.height) / image.height;
  return {t[0], t[1] * across, t[2] * down, t[3], t[4] * across, t[5] * down};
}

/// Takes heights to a cube, if one is asked for. A texture stays as it is, on longitudes and
/// latitudes: those of the grid, where it has none of its own.
Status resample(const EncodeArguments& arguments, Reference& inputs, bool quiet) {
  if (arguments.domain != "cube") return Status();
  CubeErrors errors;
  Result<HeightFile> cube = onCube(*inputs.heights, arguments.depth, arguments.threads, errors);
  if (!cube.ok()) return cube.status();
  tellNote(cubeNote(*cube, errors), quiet);
  if (inputs.image && !inputs.image->place.geotransform) {
    inputs.image->place.geotransform = stretchedOver(*inputs.heights, *inputs.image);
    inputs.image->place.crs = inputs.heights->crs;
  }
  inputs.heights = std::move(*cube);
  return Status();
}

/// Those that are asked for; none: the library looks from all sides.
Result<std::vector<Camera>> wantedCameras(const EncodeArguments& arguments,
                                          const Reference& inputs) {
  const bool rendered = arguments.engine == "rendered";
  if (!inputs.heights || (arguments.cameras.isDefault() && !rendered)) return std::vector<Camera>();
  const Bounds bounds = boundsOf(heightsOf(*inputs.heights), frameOf(*inputs.heights));
  const CameraChoice any{.file = {}, .view = "any"};
  return chooseCameras(arguments.cameras.isDefault() ? any : arguments.cameras, bounds);
}

/// The renderer that looks at the pictures; nothing: the library models them, or there are none.
Result<std::optional<PictureJudge>> wantedJudge(const EncodeArguments& arguments,
                                                const Reference& inputs,
                                                const std::vector<Camera>& cameras) {
  if (arguments.engine != "rendered" || !inputs.heights || !inputs.image)
    return std::optional<PictureJudge>();
  Result<PictureJudge> judge = PictureJudge::create(*inputs.heights, *inputs.image, cameras);
  if (!judge.ok()) return judge.status();
  return std::optional<PictureJudge>(std::move(*judge));
}

/// In metres, or the unit of the heights. What rounding doubles has spent of it is gone.
Result<double> boundOf(const EncodeArguments& arguments, const HeightFile& heights) {
  const Result<double> asked = parseLength(arguments.max_error, heights.unit);
  if (!asked.ok()) return asked.status();
  const double bound = *asked - heights.rounding * std::abs(heights.scale);
  if (bound > 0) return bound;
  return Status(TKS_USAGE, quoted(arguments.height) +
                               " holds 64-bit floats that 32 bits do not hold within that "
                               "--max-error");
}

}  // namespace

Result<tks_encode_options> encodeOptions(const EncodeArguments& arguments,
                                         const Reference& inputs) {
  tks_encode_options options = makeEncodeOptions();
  options.bytes = arguments.bytes;
  options.psnr = arguments.psnr;
  options.lossless = arguments.lossless;
  options.triangles = arguments.triangles;
  options.threads = arguments.threads;
  options.index = arguments.windows ? TKS_INDEX_WINDOWS
                  : arguments.index ? TKS_INDEX_PACKETS
                                    : TKS_INDEX_NONE;
  options.weights = arguments.weights == "visual" ? TKS_WEIGHTS_VISUAL : TKS_WEIGHTS_PSNR;
  const Result<uint32_t> regions = parseRegions(arguments.regions);
  if (!regions.ok()) return regions.status();
  options.regions = *regions;
  if (!arguments.max_error.empty()) {
    const Result<double> bound = boundOf(arguments, *inputs.heights);
    if (!bound.ok()) return bound.status();
    options.max_error = *bound;
  }
  return options;
}

/// The rows of a cube have no latitudes.
tks_heights encodedHeights(const EncodeArguments& arguments, const HeightFile& file) {
  tks_heights heights = asHeights(file);
  heights.step = arguments.step;
  if (file.cube_depth > 0) return heights;
  const std::array<double, 2> latitudes = edgeLatitudes(file, file.height);
  heights.first_latitude = latitudes[0];
  heights.last_latitude = latitudes[1];
  return heights;
}

namespace {

/// plans: are told, if they are asked for.
Result<Buffer> encodeInputs(const EncodeArguments& arguments, const Reference& inputs, bool quiet,
                            ExplainedPlans& plans) {
  Result<tks_encode_options> options = encodeOptions(arguments, inputs);
  if (!options.ok()) return options.status();
  const Result<std::vector<Camera>> cameras = wantedCameras(arguments, inputs);
  if (!cameras.ok()) return cameras.status();
  const GroundAxes axes = inputs.heights ? frameOf(*inputs.heights).axes : GroundAxes();
  const std::vector<tks_camera> told = toldCameras(*cameras, axes);
  options->cameras = told.data();
  options->camera_count = static_cast<uint32_t>(told.size());
  Result<std::optional<PictureJudge>> judge = wantedJudge(arguments, inputs, *cameras);
  if (!judge.ok()) return judge.status();
  if (judge->has_value()) {
    options->picture_error = &PictureJudge::error;
    options->picture_user = &**judge;
  }
  Progress progress("encoding", quiet);
  options->progress = &Progress::report;
  options->user = &progress;
  if (arguments.explain) plans.askFor(*options);
  const tks_heights heights =
      inputs.heights ? encodedHeights(arguments, *inputs.heights) : tks_heights{};
  const tks_image image = inputs.image ? asImage(*inputs.image) : tks_image{};
  Result<Buffer> stream = tetrakis::encode(inputs.heights ? &heights : nullptr,
                                           inputs.image ? &image : nullptr, *options);
  if (!stream) return stream.status();
  return std::move(*stream);
}

Status writeReport(const EncodeArguments& arguments, const Reference& inputs,
                   std::span<const uint8_t> stream, bool quiet, Output& page) {
  tellNote("drawing the report, which takes some seconds", quiet);
  const std::string name = arguments.height.empty() ? arguments.texture : arguments.height;
  Progress progress("drawing", quiet);
  ReportRequest request{std::filesystem::path(name).filename().string(), stream,
                        arguments.triangles, arguments.cameras};
  request.progress = [&](double done) { Progress::report(&progress, done); };
  const Result<Report> report = makeReport(inputs, request);
  if (!report.ok()) return report.status();
  const Result<std::string> html = renderPage(*report);
  if (!html.ok()) return html.status();
  if (Status status = page.stage(std::as_bytes(std::span(*html))); !status.ok()) return status;
  return page.commit();
}

/// What was written, unless nobody wants to know.
Status tellSummary(const EncodeArguments& arguments, std::span<const uint8_t> stream, bool quiet) {
  if (quiet) return Status();
  const Result<Decoder> decoder = openDecoder(stream);
  if (!decoder) return decoder.status();
  tellNote(boundNote(arguments, decoder->info()), quiet);
  tellNote(maskNote(decoder->info()), quiet);
  tellLine(summary(arguments.output, *decoder));
  return Status();
}

/// What was weighed, if somebody asked.
Status printPlans(const EncodeArguments& arguments, const ExplainedPlans& plans) {
  if (!arguments.explain) return Status();
  return print(arguments.json ? dump(plans.json()) : plans.table());
}

/// What is asked of a further texture: the target of the stream, but the last bit where that is
/// about heights.
EncodeArguments argumentsOf(const NamedFile& file, const EncodeArguments& arguments) {
  EncodeArguments one;
  one.texture = file.path;
  one.bytes = arguments.bytes;
  one.psnr = arguments.psnr;
  one.lossless = arguments.lossless || !arguments.max_error.empty();
  one.threads = arguments.threads;
  one.regions = arguments.regions;
  one.weights = arguments.weights;
  one.index = arguments.index;
  one.windows = arguments.windows;
  return one;
}

/// Of a further texture, which lies where the heights do unless it says otherwise.
Result<Buffer> encodeAlso(const NamedFile& file, const EncodeArguments& arguments,
                          const Reference& beside, bool quiet) {
  const EncodeArguments one = argumentsOf(file, arguments);
  Result<Reference> inputs = readInputs(one, quiet);
  if (!inputs.ok()) return inputs.status();
  if (beside.heights && !inputs->image->place.geotransform)
    inputs->image->place.domain = beside.heights->domain;
  if (Status status = checkEncodeMemory(one, *inputs); !status.ok()) return status;
  ExplainedPlans plans;
  return encodeInputs(one, *inputs, quiet, plans);
}

/// The stream with the further textures that are asked for.
Result<Buffer> withFurther(const EncodeArguments& arguments, Result<Buffer> stream,
                           const Reference& inputs, bool quiet) {
  if (!stream.ok() || arguments.also.empty()) return stream;
  std::vector<NamedFile> files = namedFiles(arguments.also);
  if (Status status = takeWeights(arguments.weights_of_also, files); !status.ok()) return status;
  std::vector<Buffer> others;
  std::vector<tks_combined> streams = {
      {sizeof(tks_combined), stream->bytes().data(), stream->bytes().size(), nullptr, 0}};
  for (const NamedFile& file : files) {
    Result<Buffer> other = encodeAlso(file, arguments, inputs, quiet);
    if (!other.ok()) return other.status();
    others.push_back(*std::move(other));
    streams.push_back(asCombined(file, others.back().bytes()));
  }
  const tks_limits limits = limitsOfTools();
  return combine(streams, {sizeof(tks_combine_options), arguments.bytes, &limits});
}

/// The outputs, planned before any work is done.
struct EncodeOutputs {
  Output stream;
  std::optional<OutputFolder> report_folder;
  std::optional<Output> report;
};

Result<EncodeOutputs> planOutputs(const EncodeArguments& arguments) {
  std::vector<std::string> inputs = {arguments.height, arguments.texture};
  for (const NamedFile& file : namedFiles(arguments.also)) inputs.push_back(file.path);
  const Status stay = checkInputsStay(inputs, arguments.output);
  if (!stay.ok()) return stay;
  if (!arguments.report.empty()) {
    const Status distinct = checkDistinct({arguments.output, arguments.report});
    if (!distinct.ok()) return distinct;
  }
  Result<Output> stream = Output::plan(arguments.output, arguments.force, ".tks");
  if (!stream.ok()) return stream.status();
  EncodeOutputs outputs{std::move(*stream), std::nullopt, std::nullopt};
  if (arguments.report.empty()) return outputs;
  Result<OutputFolder> folder = OutputFolder::create(arguments.report);
  if (!folder.ok()) return folder.status();
  outputs.report_folder.emplace(std::move(*folder));
  Result<Output> page =
      Output::plan(outputs.report_folder->file("index.html"), arguments.force, ".html");
  if (!page.ok()) return page.status();
  outputs.report.emplace(std::move(*page));
  return outputs;
}

Status encode(const EncodeArguments& arguments, bool quiet) {
  if (Status status = checkArguments(arguments); !status.ok()) return status;
  if (isMeshFile(arguments.height)) {
    const Status status = checkSurfaceArguments(arguments);
    return status.ok() ? encodeSurface(arguments, quiet) : status;
  }
  if (isSequence(arguments)) return encodeSequence(arguments, quiet);
  if (arguments.sequence.given())
    return {TKS_USAGE, "frames are given by a pattern in quotes: 'frames/*.tif'"};
  if (arguments.kind != "auto")
    return {TKS_USAGE, "--class is about meshes of triangles, and the input is none"};
  if (arguments.sketch != "auto")
    return {TKS_USAGE, "--sketch is about meshes of triangles, and the input is none"};
  if (arguments.maps != "all")
    return {TKS_USAGE, "--maps is about meshes of triangles, and the input is none"};
  if (arguments.also.empty() && !arguments.weights_of_also.empty())
    return {TKS_USAGE, "--also-weight is about further textures: give --also"};
  Result<EncodeOutputs> outputs = planOutputs(arguments);
  if (!outputs.ok()) return outputs.status();
  Result<Reference> inputs = readInputs(arguments, quiet);
  if (!inputs.ok()) return inputs.status();
  addPlaces(arguments, *inputs, quiet);
  if (Status status = resample(arguments, *inputs, quiet); !status.ok()) return status;
  if (Status status = checkEncodeMemory(arguments, *inputs); !status.ok()) return status;
  ExplainedPlans plans;
  const Result<Buffer> stream =
      withFurther(arguments, encodeInputs(arguments, *inputs, quiet, plans), *inputs, quiet);
  if (!stream.ok()) return stream.status();
  const std::span<const uint8_t> bytes = stream->bytes();
  if (Status status = outputs->stream.stage(std::as_bytes(bytes)); !status.ok()) return status;
  if (Status status = outputs->stream.commit(); !status.ok()) return status;
  if (Status status = tellSummary(arguments, bytes, quiet); !status.ok()) return status;
  if (Status status = printPlans(arguments, plans); !status.ok()) return status;
  if (!outputs->report) return Status();
  return writeReport(arguments, *inputs, bytes, quiet, *outputs->report);
}

}  // namespace

void addEncode(CLI::App& app, CommandLine& line) {
  const auto arguments = std::make_shared<EncodeArguments>();
  CLI::App& verb =
      *app.add_subcommand("encode", "Make a stream of heights, a texture or both, or a mesh");
  addArguments(verb, *arguments);
  verb.callback([arguments, &line] {
    line.action = [arguments, &line] { return encode(*arguments, line.quiet); };
  });
}

}  // namespace tetrakis::tools

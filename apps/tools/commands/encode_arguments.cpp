// SPDX-License-Identifier: Apache-2.0
#include "apps/tools/commands/encode_arguments.hpp"

#include <charconv>
#include <system_error>
#include <utility>

#include "apps/tools/commands/named_files.hpp"
#include "apps/tools/files/positive.hpp"
#include "apps/tools/files/text.hpp"

namespace tetrakis::tools {
namespace {

void addInputs(CLI::App& verb, EncodeArguments& arguments) {
  verb.add_option(
          "HEIGHT", arguments.height,
          "Heights (.tif .png .exr .hgt .raw:WxH:TYPE); - is standard input; or a mesh (.glb "
          ".gltf .obj .ply .stl)")
      ->type_name("");
  verb.add_option("--texture", arguments.texture, "Texture over the same ground, or on the mesh")
      ->type_name("IMAGE");
  verb.add_option("--also", arguments.also,
                  "A further texture of that name, such as classes or normals (may be "
                  "repeated)")
      ->type_name("NAME=IMAGE")
      ->expected(1)
      ->take_all();
  addWeights(verb, "--also-weight", arguments.weights_of_also);
  verb.add_option("--maps", arguments.maps,
                  "Maps of a mesh's material to take along: all, none, or names with commas "
                  "(normal,metallic_roughness,occlusion,emissive)")
      ->type_name("NAMES");
  verb.add_option("-o,--output", arguments.output, "Where to write; - is standard output")
      ->required()
      ->type_name("OUT.tks");
  verb.add_option("--report", arguments.report, "Also write DIR/index.html: pictures and figures")
      ->type_name("DIR");
  addForce(verb, arguments.force);
  CLI::Option* const explain =
      verb.add_flag("--explain", arguments.explain, "Print the plans that were weighed");
  verb.add_flag("--json", arguments.json, "With --explain: JSON instead of a table")
      ->needs(explain);
}

void addTargets(CLI::App& verb, EncodeArguments& arguments) {
  CLI::Option_group& target = *verb.add_option_group("Target", "What the stream has to reach");
  addBytes(target, arguments.bytes, "At most so many bytes in all: 65536, 64k, 1M")
      ->check(positive());
  target.add_option("--psnr", arguments.psnr, "Heights and texture reach so many dB each")
      ->check(positive())
      ->type_name("dB");
  target.add_option("--max-error", arguments.max_error, "Every height within that: 0.5, 0.5m, 2ft")
      ->type_name("LENGTH");
  addSize(target, "--rate", arguments.sequence.rate, "Of a sequence, so many bytes a second")
      ->check(positive());
  target.add_flag("--lossless", arguments.lossless, "Everything comes back bit for bit");
  target.require_option(1);
}

void addTuning(CLI::App& verb, EncodeArguments& arguments) {
  addTriangles(verb, arguments.triangles, "Meshes will be drawn with at most so many triangles");
  addCameraOptions(verb, arguments.cameras);
  verb.add_option("--engine", arguments.engine,
                  "What looks at the pictures: modelled (fast), or rendered (needs EGL)")
      ->check(silent(CLI::IsMember({"modelled", "rendered"})))
      ->type_name("ENGINE");
  verb.add_option("--regions", arguments.regions,
                  "Spatial regions, for windows: auto, off, or their side (a power of two)")
      ->type_name("SIDE");
  verb.add_option("--weights", arguments.weights,
                  "What comes first in a texture: psnr, or visual (what is seen from afar)")
      ->check(silent(CLI::IsMember({"psnr", "visual"})))
      ->type_name("WEIGHTS");
  verb.add_option("--domain", arguments.domain,
                  "Whether the last column lies beside the first one: cylinder, plane, or auto (as "
                  "the CRS and the place tell); or cube: the globe is resampled on one")
      ->check(silent(CLI::IsMember({"auto", "plane", "cylinder", "cube"})))
      ->type_name("DOMAIN");
  verb.add_option("--depth", arguments.depth,
                  "With --domain cube: its faces have 2^N x 2^N squares; else chosen")
      ->check(silent(CLI::Range(1, TKS_MOST_CUBE_DEPTH)))
      ->type_name("N");
  verb.add_option(
          "--class", arguments.kind,
          "How a mesh is coded: resampled, triangles (as they are), or auto (what is nearer)")
      ->check(silent(CLI::IsMember({"auto", "resampled", "triangles"})))
      ->type_name("CLASS");
  verb.add_option("--sketch", arguments.sketch,
                  "Of a mesh, what the stream begins with, so that something is seen early: a "
                  "stream of SIZE bytes, none, or auto (a 32nd part, where the header is long)")
      ->type_name("SIZE");
  addThreads(verb, arguments.threads);
  verb.add_flag("--index", arguments.index, "Write the front index of all packets");
  verb.add_flag(
      "--windows", arguments.windows,
      "With --lossless or --max-error: an index, and each region in one piece, for windows over "
      "a network");
}

void addSequence(CLI::App& verb, SequenceArguments& sequence) {
  CLI::Option* const fps =
      verb.add_option("--fps", sequence.fps, "Frames a second, where HEIGHT or IMAGE is a pattern")
          ->check(positive())
          ->type_name("X");
  verb.add_option("--every", sequence.every, "Seconds from one frame to the next: 3600")
      ->check(positive())
      ->type_name("SECONDS")
      ->excludes(fps);
  verb.add_option("--epoch", sequence.epoch, "The time of the first frame: 2019-03-01T00:00:00Z")
      ->type_name("TIME");
  verb.add_option("--calendar", sequence.calendar, "Of the times, as CF has it: noleap, 360_day")
      ->type_name("NAME");
  verb.add_option("--group", sequence.group, "Frames that are coded together (16)")
      ->check(silent(CLI::Range(1, TKS_MOST_FRAMES)))
      ->type_name("N");
  CLI::Option* const reference =
      verb.add_option_function<std::string>(
              "--reference",
              [&sequence](const std::string& text) {
                const Result<uint64_t> size =
                    text == "all" ? Result<uint64_t>(TKS_ALL_BYTES) : parseSize(text);
                if (!size.ok() || *size == 0)
                  throw CLI::ValidationError("--reference", "takes a size above 0, or all");
                sequence.reference = *size;
              },
              "Groups go on from so many bytes a frame of the one before: 2k, all")
          ->type_name("SIZE");
  verb.add_option("--entry", sequence.entry, "At least every Nth group stands by itself (16)")
      ->check(silent(CLI::Range(1, TKS_MOST_DEPTH + 1)))
      ->type_name("N")
      ->needs(reference);
  verb.add_flag("--append", sequence.append, "Add the frames to the sequence that OUT.tks is");
}

void addDescription(CLI::App& verb, EncodeArguments& arguments) {
  verb.add_option("--scale", arguments.scale, "Height = sample * scale + offset")
      ->check(finite())
      ->type_name("X");
  verb.add_option("--offset", arguments.offset, "See --scale")->check(finite())->type_name("X");
  verb.add_option("--nodata", arguments.nodata, "Samples of this value are void; NaN always is")
      ->check(anyNumber())
      ->type_name("X");
  verb.add_option("--step", arguments.step, "Quantisation step in samples; else exact if possible")
      ->check(positive())
      ->type_name("X");
  verb.add_option("--spacing", arguments.spacing, "Metres per sample: 30 or 30,25")
      ->type_name("X[,Y]");
  verb.add_option("--unit", arguments.unit, "Unit of the heights: m, ft, …")->type_name("UNIT");
  verb.add_option("--vertical-datum", arguments.vertical_datum, "For example EGM2008")
      ->type_name("NAME");
  verb.add_option("--white-level", arguments.white_level,
                  "What shows as white in a texture of 16 bits; else found")
      ->check(silent(CLI::Range(1, 65535)))
      ->type_name("VALUE");
  verb.add_option("--crs", arguments.crs, "Reference system: WKT or EPSG:code")->type_name("TEXT");
}

/// What says something about heights needs some.
Status checkHeightOptions(const EncodeArguments& arguments) {
  const std::pair<const char*, bool> options[] = {
      {"--triangles", arguments.triangles > 0},
      {"--max-error", !arguments.max_error.empty()},
      {"--scale", arguments.scale.has_value()},
      {"--offset", arguments.offset.has_value()},
      {"--nodata", arguments.nodata.has_value()},
      {"--step", arguments.step > 0},
      {"--spacing", !arguments.spacing.empty()},
      {"--domain cube", arguments.domain == "cube"},
      {"--unit", arguments.unit.has_value()},
      {"--vertical-datum", arguments.vertical_datum.has_value()},
      {"--crs", arguments.crs.has_value()},
      // The report looks at a texture too.
      {"--cameras", !arguments.cameras.file.empty() && arguments.report.empty()},
      {"--view", !arguments.cameras.view.empty() && arguments.report.empty()}};
  for (const auto& [name, given] : options)
    if (given) return Status(TKS_USAGE, std::string(name) + " is about heights: give HEIGHT");
  return Status();
}

/// Its unit is judged when that of the heights is known.
Status checkMaxError(const std::string& max_error) {
  if (max_error.empty()) return Status();
  const Result<double> length = parseLength(max_error, "m");
  if (!length.ok()) return length.status();
  if (*length > 0) return Status();
  return Status(TKS_USAGE, "--max-error must be above 0; --lossless keeps everything");
}

/// A cube has other samples than the file, and few of its streams' tools.
Status checkCube(const EncodeArguments& arguments) {
  if (arguments.domain != "cube") {
    if (arguments.depth == 0) return Status();
    return Status(TKS_USAGE, "--depth is about a cube: give --domain cube");
  }
  const std::pair<const char*, bool> others[] = {
      {"--lossless", arguments.lossless},
      {"--max-error", !arguments.max_error.empty()},
      {"--report", !arguments.report.empty()},
      {"--triangles", arguments.triangles > 0},
      {"--cameras", !arguments.cameras.file.empty()},
      {"--view", !arguments.cameras.view.empty()},
      {"--engine rendered", arguments.engine == "rendered"}};
  for (const auto& [name, given] : others) {
    if (given)
      return Status(TKS_USAGE, std::string(name) +
                                   " does not go with --domain cube, whose heights are resampled "
                                   "and lie round a globe");
  }
  return Status();
}

}  // namespace

void addArguments(CLI::App& verb, EncodeArguments& arguments) {
  addInputs(verb, arguments);
  addTargets(verb, arguments);
  addTuning(verb, arguments);
  addSequence(verb, arguments.sequence);
  addDescription(verb, arguments);
}

Result<uint32_t> parseRegions(const std::string& text) {
  if (text == "auto") return 0;
  if (text == "off") return 1;
  uint32_t side = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), side);
  if (error == std::errc() && end == text.data() + text.size() && side > 1) return side;
  return Status(TKS_USAGE, "--regions takes auto, off or a power of two, not '" + text + "'");
}

Status checkArguments(const EncodeArguments& arguments) {
  if (arguments.height.empty() && arguments.texture.empty())
    return Status(TKS_USAGE, "nothing to encode: give HEIGHT, --texture or both");
  if (arguments.height == "-" && arguments.texture == "-")
    return Status(TKS_USAGE, "heights and texture cannot both come from standard input");
  if (arguments.explain && arguments.output == "-")
    return Status(TKS_USAGE, "the stream and --explain cannot both go to standard output");
  for (const NamedFile& file : namedFiles(arguments.also))
    if (file.name.empty())
      return Status(TKS_USAGE, "--also " + quoted(file.path) +
                                   " has no name: write for example --also classes=" + file.path);
  if (Status status = checkMaxError(arguments.max_error); !status.ok()) return status;
  if (arguments.white_level > 0 && arguments.texture.empty())
    return Status(TKS_USAGE, "--white-level is about a texture: give --texture");
  if (Status status = checkCube(arguments); !status.ok()) return status;
  return arguments.height.empty() ? checkHeightOptions(arguments) : Status();
}

}  // namespace tetrakis::tools

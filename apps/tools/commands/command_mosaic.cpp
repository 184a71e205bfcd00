// SPDX-License-Identifier: Apache-2.0
// tetrakis mosaic: heights that no machine holds, tile by tile. Each verb below it does one step in
// a folder that all workers share: plan, code, tasks, status, merge.
#include <algorithm>
#include <array>
#include <charconv>
#include <fstream>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "apps/tools/commands/command.hpp"
#include "apps/tools/commands/notes.hpp"
#include "apps/tools/commands/options.hpp"
#include "apps/tools/files/memory_limit.hpp"
#include "apps/tools/files/text.hpp"
#include "apps/tools/mosaic/task_list.hpp"
#include "apps/tools/mosaic/work_folder.hpp"
#include "apps/tools/output/output.hpp"
#include "apps/tools/output/progress.hpp"

namespace tetrakis::tools {
namespace {

/// What the C interface said, or why the source could not be read.
Status statusOf(tks_status status, const char* message, const MosaicSource* source) {
  if (status == TKS_OK) return {};
  if (status == TKS_IO && source != nullptr && !source->failure.ok()) return source->failure;
  return {status, message};
}

struct MosaicPlanArguments {
  std::vector<std::string> sources;
  std::string work, max_error;
  uint64_t bytes = 0;
  double psnr = 0, step = 0;
  bool lossless = false, force = false;
  uint32_t regions = 0, tile = 0;
  std::optional<double> nodata;
  std::optional<std::string> unit, crs, vertical_datum;
};

Status planMosaic(const MosaicPlanArguments& arguments, bool quiet) {
  Notes notes;
  const Result<std::vector<std::string>> paths = sourceFiles(arguments.sources);
  if (!paths.ok()) return paths.status();
  Result<OpenSource> source = openSource(*paths, arguments.nodata, notes);
  if (!source.ok()) return source.status();
  for (const Note& note : notes)
    tellNote(quoted(arguments.sources.front()) + ": " + note.text, quiet);
  MosaicSource given(**source);
  given.heights.step = arguments.step;
  if (arguments.unit) given.heights.unit = arguments.unit->c_str();
  if (arguments.crs) given.heights.crs = arguments.crs->c_str();
  if (arguments.vertical_datum) given.heights.vertical_datum = arguments.vertical_datum->c_str();
  tks_mosaic_options options = {};
  options.size = sizeof options;
  options.bytes = arguments.bytes;
  options.psnr = arguments.psnr;
  options.lossless = arguments.lossless ? 1 : 0;
  options.regions = arguments.regions;
  options.tile = arguments.tile;
  if (!arguments.max_error.empty()) {
    const std::string unit = given.heights.unit != nullptr ? given.heights.unit : "";
    const Result<double> error = parseLength(arguments.max_error, unit);
    if (!error.ok()) return error.status();
    options.max_error = *error;
  }
  std::array<char, 512> message{};
  tks_buffer plan = {};
  const tks_status status =
      tks_mosaic_plan(&given.given, &options, &plan, message.data(), message.size());
  if (status != TKS_OK) return statusOf(status, message.data(), &given);
  const std::vector<uint8_t> bytes(plan.data, plan.data + plan.size);
  tks_free_buffer(&plan);
  return WorkFolder::create(arguments.work, bytes, *paths, arguments.nodata, arguments.force);
}

struct MosaicCodeArguments {
  std::string work, tile, part;
  int group = -1;
  uint32_t threads = hardwareThreads();
};

/// Whole numbers with one separator between each two; nothing if the text is anything else.
std::optional<std::vector<uint32_t>> numbersIn(const std::string& text, char separator) {
  std::vector<uint32_t> numbers;
  const char *at = text.data(), *const end = at + text.size();
  while (true) {
    uint32_t number = 0;
    const auto [next, error] = std::from_chars(at, end, number);
    if (error != std::errc()) return {};
    numbers.push_back(number);
    if (next == end) return numbers;
    if (*next != separator) return {};
    at = next + 1;
  }
}

/// The tasks of a worker: one tile, or every N-th task, of all groups or one.
Result<std::vector<MosaicTask>> chosenTasks(const WorkFolder& folder,
                                            const MosaicCodeArguments& arguments) {
  std::vector<MosaicTask> tasks = folder.tasks();
  if (!arguments.tile.empty()) {
    const auto numbers = numbersIn(arguments.tile, ',');
    if (!numbers || numbers->size() != 3)
      return Status(TKS_USAGE, "--tile takes a group, a column and a row: 0,3,5");
    std::erase_if(tasks, [&](const MosaicTask& task) {
      return task.tile.group != (*numbers)[0] || task.tile.column != (*numbers)[1] ||
             task.tile.row != (*numbers)[2];
    });
    if (tasks.empty()) return Status(TKS_USAGE, "the mosaic has no tile " + arguments.tile);
  }
  if (arguments.group >= 0) {
    std::erase_if(tasks, [&](const MosaicTask& task) {
      return task.tile.group != static_cast<uint32_t>(arguments.group);
    });
  }
  if (arguments.part.empty()) return tasks;
  const auto part = numbersIn(arguments.part, '/');
  if (!part || part->size() != 2 || (*part)[0] < 1 || (*part)[0] > (*part)[1])
    return Status(TKS_USAGE, "--part takes a number and how many there are: 3/8");
  std::vector<MosaicTask> own;
  for (size_t i = (*part)[0] - 1; i < tasks.size(); i += (*part)[1]) own.push_back(tasks[i]);
  return own;
}

/// What a task takes: its block as samples and as integers, with a mask and its copies, and what
/// tracks and the blocks of a TIFF take beside it.
Status checkTaskMemory(const WorkFolder& folder, const tks_tile& tile, tks_sample sample) {
  constexpr uint64_t kBesides = 96 << 20, kAsIntegers = 4, kAsMasks = 3;
  const uint64_t a_sample = tks_sample_bytes(sample) + kAsIntegers + kAsMasks;
  tks_window block = {};
  tks_mosaic_block(folder.plan().data(), folder.plan().size(), tile, &block);
  return checkMemoryFor("coding the tile " + nameOf(tile),
                        kBesides + a_sample * block.width * block.height);
}

Status codeMosaic(const MosaicCodeArguments& arguments, bool quiet) {
  const Result<WorkFolder> folder = WorkFolder::open(arguments.work);
  if (!folder.ok()) return folder.status();
  const Result<std::vector<MosaicTask>> tasks = chosenTasks(*folder, arguments);
  if (!tasks.ok()) return tasks.status();
  Notes ignored;
  Result<OpenSource> source = openSource(folder->sources(), folder->nodata(), ignored);
  if (!source.ok()) return source.status();
  MosaicSource given(**source);
  const tks_mosaic_files files = folder->files();
  Progress progress("coding", quiet);
  for (size_t i = 0; i < tasks->size(); ++i) {
    Progress::report(&progress, static_cast<double>(i) / static_cast<double>(tasks->size()));
    const MosaicTask& task = (*tasks)[i];
    if (folder->isDone(task, source->get())) continue;
    if (Status memory = checkTaskMemory(*folder, task.tile, given.heights.sample); !memory.ok())
      return memory;
    std::array<char, 512> message{};
    const tks_status status =
        tks_mosaic_code(folder->plan().data(), folder->plan().size(), task.tile, &given.given,
                        &files, arguments.threads, message.data(), message.size());
    if (status != TKS_OK) return statusOf(status, message.data(), &given);
  }
  return {};
}

struct MosaicTasksArguments {
  std::string work;
  bool make = false, json = false;
};

Status listTasks(const MosaicTasksArguments& arguments) {
  const Result<WorkFolder> folder = WorkFolder::open(arguments.work);
  if (!folder.ok()) return folder.status();
  if (arguments.make) return print(taskMakefile(*folder));
  if (arguments.json) return print(dump(taskJson(*folder)));
  std::string lines;
  for (const MosaicTask& task : folder->tasks()) lines += nameOf(task.tile) + "\n";
  return print(lines);
}

struct MosaicStatusArguments {
  std::string work;
  bool json = false;
};

Status showStatus(const MosaicStatusArguments& arguments) {
  const Result<WorkFolder> folder = WorkFolder::open(arguments.work);
  if (!folder.ok()) return folder.status();
  Notes ignored;
  const Result<OpenSource> source = openSource(folder->sources(), folder->nodata(), ignored);
  if (!source.ok()) return source.status();
  size_t done = 0;
  uint64_t bytes = 0;
  Json missing = Json::array();
  for (const MosaicTask& task : folder->tasks()) {
    if (!folder->isDone(task, source->get())) {
      missing.push_back(nameOf(task.tile));
      continue;
    }
    ++done;
    std::error_code error;
    bytes += std::filesystem::file_size(folder->file(nameOf(task.tile) + ".part"), error);
  }
  Json json = {{"width", (*source)->described().width},
               {"height", (*source)->described().height},
               {"tasks", folder->tasks().size()},
               {"done", done},
               {"part_bytes", bytes}};
  if (!arguments.json) {
    json["left"] = folder->tasks().size() - done;
    return print(table(json));
  }
  json["missing"] = missing;
  return print(dump(json));
}

struct MosaicMergeArguments {
  std::string work, output;
  bool windows = false, force = false;
};

/// Writes at offsets of a file.
struct StreamFile {
  std::ofstream file;

  static int write(void* user, uint64_t offset, const void* data, size_t size) {
    auto& file = static_cast<StreamFile*>(user)->file;
    file.seekp(static_cast<std::streamoff>(offset));
    file.write(static_cast<const char*>(data), static_cast<std::streamsize>(size));
    return file ? 0 : 1;
  }
};

Status mergeMosaic(const MosaicMergeArguments& arguments) {
  Result<Output> output = Output::plan(arguments.output, arguments.force, ".tks");
  if (!output.ok()) return output.status();
  const Result<WorkFolder> folder = WorkFolder::open(arguments.work);
  if (!folder.ok()) return folder.status();
  const tks_mosaic_files files = folder->files();
  const Status staged = output->stage([&](const std::string& path) -> Status {
    StreamFile stream{std::ofstream(path, std::ios::binary)};
    std::array<char, 512> message{};
    const tks_status status =
        tks_mosaic_merge(folder->plan().data(), folder->plan().size(), &files,
                         arguments.windows ? TKS_INDEX_WINDOWS : TKS_INDEX_NONE, StreamFile::write,
                         &stream, message.data(), message.size());
    if (status != TKS_OK) return {status, message.data()};
    stream.file.close();
    return stream.file ? Status() : Status(TKS_IO, "cannot write " + quoted(path));
  });
  return staged.ok() ? output->commit() : staged;
}

void addWork(CLI::App& verb, std::string& work) {
  verb.add_option("WORK", work, "The folder that all workers share")->required()->type_name("");
}

void addPlanVerb(CLI::App& mosaic, CommandLine& line) {
  const auto arguments = std::make_shared<MosaicPlanArguments>();
  CLI::App& verb = *mosaic.add_subcommand("plan", "Read the source once, and make the plan");
  verb.add_option("SOURCE", arguments->sources,
                  "A TIFF, FILE.raw:WIDTHxHEIGHT:TYPE, a folder of .tif or .hgt files on one grid, "
                  "or several such files")
      ->required()
      ->type_name("");
  verb.add_option("-o,--output", arguments->work, "The folder that all workers share")
      ->required()
      ->type_name("WORK");
  CLI::Option_group& target = *verb.add_option_group("target");
  target.require_option(1);
  target.add_flag("--lossless", arguments->lossless, "Every sample");
  target
      .add_option("--max-error", arguments->max_error, "Every height within that: 0.5, 0.5m, 2ft")
      ->type_name("L");
  addSize(target, "--bytes", arguments->bytes, "At most so many bytes: 65536, 64k, 1M");
  target.add_option("--psnr", arguments->psnr, "Heights of that quality, in dB")
      ->check(finite())
      ->type_name("dB");
  verb.add_option("--tile", arguments->tile, "Side of a tile, in samples (4096)")
      ->check(wholeNumber())
      ->type_name("N");
  verb.add_option("--regions", arguments->regions, "Side of a region, in samples (512)")
      ->check(wholeNumber())
      ->type_name("N");
  verb.add_option("--step", arguments->step, "Step of the samples; else it is found")
      ->check(finite())
      ->type_name("S");
  verb.add_option("--nodata", arguments->nodata, "Sample value of voids")
      ->check(anyNumber())
      ->type_name("V");
  verb.add_option("--unit", arguments->unit, "Unit of the heights")->type_name("TEXT");
  verb.add_option("--crs", arguments->crs, "Reference system, as EPSG:CODE or WKT")
      ->type_name("TEXT");
  verb.add_option("--vertical-datum", arguments->vertical_datum, "Vertical datum")
      ->type_name("TEXT");
  verb.add_flag("-f,--force", arguments->force, "Plan a mosaic again that WORK holds already");
  verb.callback([arguments, &line] {
    line.action = [arguments, &line] { return planMosaic(*arguments, line.quiet); };
  });
}

void addCodeVerb(CLI::App& mosaic, CommandLine& line) {
  const auto arguments = std::make_shared<MosaicCodeArguments>();
  CLI::App& verb = *mosaic.add_subcommand("code", "Run the tasks that are not done yet");
  addWork(verb, arguments->work);
  verb.add_option("--tile", arguments->tile, "One task alone")->type_name("G,X,Y");
  verb.add_option("--group", arguments->group, "Tasks of one group; each needs the one before")
      ->check(wholeNumber())
      ->type_name("G");
  verb.add_option("--part", arguments->part, "Every N-th of them: of N workers the I-th")
      ->type_name("I/N");
  verb.add_option("--threads", arguments->threads, "Threads of a task")
      ->check(wholeNumber())
      ->type_name("N");
  verb.callback([arguments, &line] {
    line.action = [arguments, &line] { return codeMosaic(*arguments, line.quiet); };
  });
}

void addTasksVerb(CLI::App& mosaic, CommandLine& line) {
  const auto arguments = std::make_shared<MosaicTasksArguments>();
  CLI::App& verb = *mosaic.add_subcommand("tasks", "List the tasks, for engines");
  addWork(verb, arguments->work);
  CLI::Option* const make = verb.add_flag("--make", arguments->make, "As rules for make");
  verb.add_flag("--json", arguments->json, "With commands, needs and outputs")->excludes(make);
  verb.callback(
      [arguments, &line] { line.action = [arguments] { return listTasks(*arguments); }; });
}

void addStatusVerb(CLI::App& mosaic, CommandLine& line) {
  const auto arguments = std::make_shared<MosaicStatusArguments>();
  CLI::App& verb = *mosaic.add_subcommand("status", "Show what is done and what is left");
  addWork(verb, arguments->work);
  verb.add_flag("--json", arguments->json, "For programs, with the names of what is left");
  verb.callback(
      [arguments, &line] { line.action = [arguments] { return showStatus(*arguments); }; });
}

void addMergeVerb(CLI::App& mosaic, CommandLine& line) {
  const auto arguments = std::make_shared<MosaicMergeArguments>();
  CLI::App& verb = *mosaic.add_subcommand("merge", "Join all parts into a stream");
  addWork(verb, arguments->work);
  verb.add_option("-o,--output", arguments->output, "Where to write; - is standard output")
      ->required()
      ->type_name("OUT.tks");
  verb.add_flag("--windows", arguments->windows,
                "An index, and each region in one piece, for windows over HTTP");
  addForce(verb, arguments->force);
  verb.callback(
      [arguments, &line] { line.action = [arguments] { return mergeMosaic(*arguments); }; });
}

}  // namespace

void addMosaic(CLI::App& app, CommandLine& line) {
  CLI::App& mosaic =
      *app.add_subcommand("mosaic", "Encode heights that no machine holds, tile by tile");
  mosaic.require_subcommand(1);
  addPlanVerb(mosaic, line);
  addCodeVerb(mosaic, line);
  addTasksVerb(mosaic, line);
  addStatusVerb(mosaic, line);
  addMergeVerb(mosaic, line);
}

}  // namespace tetrakis::tools

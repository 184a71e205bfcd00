// SPDX-License-Identifier: Apache-2.0
#include "apps/tools/mosaic/mosaic_steps.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <utility>

#include "apps/tools/files/file_bytes.hpp"
#include "apps/tools/files/memory_limit.hpp"
#include "apps/tools/files/temporary.hpp"
#include "apps/tools/files/text.hpp"
#include "apps/tools/files/units.hpp"
#include "apps/tools/output/output.hpp"
#include "apps/tools/output/output_names.hpp"
#include "apps/tools/output/progress.hpp"

namespace tetrakis::tools {

namespace {

/// What the C interface said, or why the source could not be read.
Status statusOf(tks_status status, const char* message, const MosaicSource* source) {
  if (status == TKS_OK) return {};
  if (status == TKS_IO && source != nullptr && !source->failure.ok()) return source->failure;
  return {status, message};
}

Result<std::vector<uint8_t>> planBytes(MosaicSource& source, const tks_mosaic_options& options) {
  std::array<char, 512> message{};
  tks_buffer plan = {};
  const tks_status status =
      tks_mosaic_plan(&source.given, &options, &plan, message.data(), message.size());
  if (status != TKS_OK) return statusOf(status, message.data(), &source);
  std::vector<uint8_t> bytes(plan.data, plan.data + plan.size);
  tks_free_buffer(&plan);
  return bytes;
}

/// The plan by what is promised of the files. Their doubles become floats, and how far off these
/// are is known once all have been read.
Result<std::vector<uint8_t>> planWithin(MosaicSource& given, tks_mosaic_options options,
                                        const HeightSource& source) {
  Result<std::vector<uint8_t>> plan = planBytes(given, options);
  const double rounding = source.rounding() * std::abs(given.heights.scale);
  if (!plan.ok() || rounding == 0) return plan;
  if (options.lossless != 0)
    return Status(TKS_USAGE,
                  "the source holds 64-bit floats that 32 bits do not hold, so nothing keeps them "
                  "all; round them first: gdal_translate -ot Float32 IN.tif OUT.tif");
  if (options.max_error == 0) return plan;
  options.max_error -= rounding;
  if (options.max_error > 0) return planBytes(given, options);
  return Status(TKS_USAGE,
                "the source holds 64-bit floats that 32 bits do not hold within that largest "
                "error: give a larger one");
}

}  // namespace

Status planMosaic(const PlanRequest& request, const std::string& work, Notes& notes) {
  const Result<std::vector<std::string>> paths = sourceFiles(request.sources);
  if (!paths.ok()) return paths.status();
  Result<OpenSource> source = openSource(*paths, request.nodata, notes);
  if (!source.ok()) return source.status();
  MosaicSource given(**source);
  given.heights.step = request.step;
  if (request.unit) given.heights.unit = request.unit->c_str();
  if (request.crs) given.heights.crs = request.crs->c_str();
  if (request.vertical_datum) given.heights.vertical_datum = request.vertical_datum->c_str();
  tks_mosaic_options options = {};
  options.size = sizeof options;
  options.bytes = request.bytes;
  options.psnr = request.psnr;
  options.lossless = request.lossless ? 1 : 0;
  options.regions = request.regions;
  options.tile = request.tile;
  if (!request.max_error.empty()) {
    const std::string unit = given.heights.unit != nullptr ? given.heights.unit : "";
    const Result<double> error = parseLength(request.max_error, unit);
    if (!error.ok()) return error.status();
    options.max_error = *error;
  }
  const Result<std::vector<uint8_t>> plan = planWithin(given, options, **source);
  if (!plan.ok()) return plan.status();
  return WorkFolder::create(work, *plan, *paths, request.nodata, request.force);
}

namespace {

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

}  // namespace

Result<std::vector<MosaicTask>> chosenTasks(const WorkFolder& folder, const CodeRequest& request) {
  std::vector<MosaicTask> tasks = folder.tasks();
  if (!request.tile.empty()) {
    const auto numbers = numbersIn(request.tile, ',');
    if (!numbers || numbers->size() != 3)
      return Status(TKS_USAGE, "--tile takes a group, a column and a row: 0,3,5");
    std::erase_if(tasks, [&](const MosaicTask& task) {
      return task.tile.group != (*numbers)[0] || task.tile.column != (*numbers)[1] ||
             task.tile.row != (*numbers)[2];
    });
    if (tasks.empty()) return Status(TKS_USAGE, "the mosaic has no tile " + request.tile);
  }
  if (request.group >= 0) {
    std::erase_if(tasks, [&](const MosaicTask& task) {
      return task.tile.group != static_cast<uint32_t>(request.group);
    });
  }
  if (request.part.empty()) return tasks;
  const auto part = numbersIn(request.part, '/');
  if (!part || part->size() != 2 || (*part)[0] < 1 || (*part)[0] > (*part)[1])
    return Status(TKS_USAGE, "--part takes a number and how many there are: 3/8");
  std::vector<MosaicTask> own;
  for (size_t i = (*part)[0] - 1; i < tasks.size(); i += (*part)[1]) own.push_back(tasks[i]);
  return own;
}

namespace {

/// What a task takes: its block as samples and as integers, with a mask and its copies, and what
/// tracks and the blocks of a TIFF take beside it. A task that restores holds no samples of the
/// regions around its tile, but decoded ones of the tile beside those of the source.
Status checkTaskMemory(const WorkFolder& folder, const MosaicTask& task, tks_sample sample) {
  constexpr uint64_t kBesides = 96 << 20, kCoding = 7, kRestoring = 10;
  const tks_tile& tile = task.tile;
  const uint64_t a_sample = tks_sample_bytes(sample) + (task.restores ? kRestoring : kCoding);
  tks_window block = {};
  tks_mosaic_block(folder.plan().data(), folder.plan().size(), tile, &block);
  return checkMemoryFor("coding the tile " + nameOf(tile),
                        kBesides + a_sample * block.width * block.height);
}

}  // namespace

Status codeMosaic(const CodeRequest& request, bool quiet) {
  const Result<WorkFolder> folder = WorkFolder::open(request.work);
  if (!folder.ok()) return folder.status();
  const Result<std::vector<MosaicTask>> tasks = chosenTasks(*folder, request);
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
    if (Status memory = checkTaskMemory(*folder, task, given.heights.sample); !memory.ok())
      return memory;
    std::array<char, 512> message{};
    const tks_status status =
        tks_mosaic_code(folder->plan().data(), folder->plan().size(), task.tile, &given.given,
                        &files, request.threads, message.data(), message.size());
    if (status != TKS_OK) return statusOf(status, message.data(), &given);
  }
  return {};
}

namespace {

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

Result<tks_merge_options> mergeOptions(const LayoutRequest& request) {
  tks_merge_options options{sizeof options, TKS_LAYOUT_MIXED, request.preview};
  if (request.layout == "mixed") return options;
  if (request.preview > 0)
    return Status(TKS_USAGE, "--preview is for --layout mixed: no other layout has a preview");
  options.layout = request.layout == "windows" ? TKS_LAYOUT_WINDOWS : TKS_LAYOUT_PROGRESSIVE;
  return options;
}

Status mergeInto(Output& output, const std::string& work, const tks_merge_options& options) {
  const Result<WorkFolder> folder = WorkFolder::open(work);
  if (!folder.ok()) return folder.status();
  if (Status stays = checkInputsStay(folder->sources(), output.name()); !stays.ok()) return stays;
  const tks_mosaic_files files = folder->files();
  const Status staged = output.stage([&](const std::string& path) -> Status {
    StreamFile stream{std::ofstream(path, std::ios::binary)};
    std::array<char, 512> message{};
    const tks_status status =
        tks_mosaic_merge(folder->plan().data(), folder->plan().size(), &files, &options,
                         StreamFile::write, &stream, message.data(), message.size());
    if (status != TKS_OK) return {status, message.data()};
    stream.file.close();
    return stream.file ? Status() : Status(TKS_IO, "cannot write " + quoted(path));
  });
  return staged.ok() ? output.commit() : staged;
}

}  // namespace

Status mergeMosaic(const MergeRequest& request) {
  const Result<tks_merge_options> options = mergeOptions(request.layout);
  if (!options.ok()) return options.status();
  Result<Output> output = Output::plan(request.output, request.force, ".tks");
  return output.ok() ? mergeInto(*output, request.work, *options) : output.status();
}

Status joinMosaic(const JoinRequest& request, Notes& notes, bool quiet) {
  const Result<tks_merge_options> options = mergeOptions(request.layout);
  if (!options.ok()) return options.status();
  const Result<std::vector<std::string>> sources = sourceFiles(request.plan.sources);
  if (!sources.ok()) return sources.status();
  if (Status stays = checkInputsStay(*sources, request.plan.output); !stays.ok()) return stays;
  Result<Output> output = Output::plan(request.plan.output, request.plan.force, ".tks");
  if (!output.ok()) return output.status();
  const std::filesystem::path beside = std::filesystem::path(request.plan.output).parent_path();
  const Result<Temporary> folder = Temporary::makeFolder(beside.empty() ? "." : beside);
  if (!folder.ok()) return folder.status();
  const std::string work = folder->path().string();
  Status status = planMosaic(request.plan, work, notes);
  if (status.ok()) status = codeMosaic({.work = work, .threads = request.threads}, quiet);
  return status.ok() ? mergeInto(*output, work, *options) : status;
}

}  // namespace tetrakis::tools

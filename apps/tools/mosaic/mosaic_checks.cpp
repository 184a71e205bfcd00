// SPDX-License-Identifier: Apache-2.0
// showMosaic() and verifyMosaic() look at a mosaic: how far it is, and whether its stream keeps
// what was promised.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>

#include "apps/tools/files/file_bytes.hpp"
#include "apps/tools/files/stream.hpp"
#include "apps/tools/files/text.hpp"
#include "apps/tools/mosaic/mosaic_steps.hpp"
#include "apps/tools/output/json.hpp"
#include "apps/tools/output/progress.hpp"
#include "base/samples.hpp"

namespace tetrakis::tools {

Status showMosaic(const std::string& work, bool json_wanted) {
  const Result<WorkFolder> folder = WorkFolder::open(work);
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
  if (!json_wanted) {
    json["left"] = folder->tasks().size() - done;
    return print(table(json));
  }
  json["missing"] = missing;
  return print(dump(json));
}

namespace {

/// Largest difference of samples of the source and of the stream, in sample units; voids are equal.
double largestDifference(tks_sample sample, const std::vector<std::byte>& a,
                         const std::vector<std::byte>& b) {
  return withSampleType(sample, [&](auto type) {
    using T = decltype(type);
    double largest = 0;
    for (size_t i = 0; i < a.size(); i += sizeof(T)) {
      if (std::memcmp(a.data() + i, b.data() + i, sizeof(T)) == 0) continue;
      T x{}, y{};
      std::memcpy(&x, a.data() + i, sizeof x);
      std::memcpy(&y, b.data() + i, sizeof y);
      const double difference = std::abs(static_cast<double>(x) - static_cast<double>(y));
      if (std::isnan(difference) &&
          std::isnan(static_cast<double>(x)) == std::isnan(static_cast<double>(y)))
        continue;
      largest = std::isnan(difference) ? INFINITY : std::max(largest, difference);
    }
    return largest;
  });
}

}  // namespace

Status verifyMosaic(const VerifyRequest& request, bool quiet) {
  const Result<WorkFolder> folder = WorkFolder::open(request.work);
  if (!folder.ok()) return folder.status();
  Result<std::vector<MosaicTask>> tasks = chosenTasks(*folder, {.part = request.part, .group = 0});
  if (!tasks.ok()) return tasks.status();
  Notes ignored;
  Result<OpenSource> source = openSource(folder->sources(), folder->nodata(), ignored);
  if (!source.ok()) return source.status();
  Result<OpenStream> stream = openStream({request.stream, std::nullopt, true});
  if (!stream.ok()) return stream.status();
  const HeightFile& described = (*source)->described();
  const tks_info& info = stream->decoder.info();
  if (info.width != described.width || info.height != described.height ||
      info.sample != described.sample)
    return {TKS_MISMATCH, quoted(request.stream) + " has another size or type than the source"};
  const double allowed = info.max_error > 0 ? info.max_error / std::abs(info.scale) : 0;
  double largest = 0;
  Progress progress("verifying", quiet);
  for (size_t i = 0; i < tasks->size(); ++i) {
    Progress::report(&progress, static_cast<double>(i) / static_cast<double>(tasks->size()));
    tks_window window = {};
    tks_mosaic_block(folder->plan().data(), folder->plan().size(), (*tasks)[i].tile, &window);
    const size_t bytes = size_t{window.width} * window.height * tks_sample_bytes(described.sample);
    std::vector<std::byte> truth(bytes);
    if (Status status = (*source)->read(window, truth.data()); !status.ok()) return status;
    const Result<std::vector<std::byte>> decoded = stream->decoder.heights(window);
    if (!decoded.ok()) return decoded.status();
    largest = std::max(largest, largestDifference(described.sample, truth, *decoded));
  }
  const bool promised = info.lossless != 0 || info.max_error >= 0;
  if (promised && largest > allowed)
    return {TKS_MISMATCH, quoted(request.stream) + " breaks its promise: a sample is off by " +
                              std::to_string(largest)};
  if (quiet) return {};
  return print(quoted(request.stream) + ": the largest error of a sample is " +
               std::to_string(largest) + "\n");
}

}  // namespace tetrakis::tools

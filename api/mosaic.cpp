// SPDX-License-Identifier: Apache-2.0
// The C interface of mosaics (include/tetrakis/mosaic.h): arguments are checked, and callbacks are
// wrapped for encoder/mosaic/.
#include "tetrakis/mosaic.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstring>
#include <string>
#include <vector>

#include "api/encoded_stream.hpp"
#include "api/guarded.hpp"
#include "encoder/mosaic/merge.hpp"
#include "encoder/mosaic/mosaic_plan.hpp"
#include "encoder/mosaic/part.hpp"
#include "encoder/mosaic/survey.hpp"
#include "encoder/mosaic/tile.hpp"

namespace tetrakis::inline api {

namespace {

Status misused(const std::string& sentence) {
  return {TKS_USAGE, sentence};
}

/// A source whose heights are checked.
struct KnownSource {
  tks_mosaic_source source{};
  tks_heights heights{};

  ReadSamples reader() const {
    return [given = source](const Window& window, void* samples) -> Status {
      const tks_window of{window.x, window.y, window.width, window.height};
      if (given.read(given.user, &of, samples) == 0) return {};
      return {TKS_IO, "The source cannot be read in columns " + std::to_string(of.x) + " to " +
                          std::to_string(of.x + of.width - 1) + ", rows " + std::to_string(of.y) +
                          " to " + std::to_string(of.y + of.height - 1) + "."};
    };
  }
};

Status takeSource(const tks_mosaic_source* given, KnownSource& out) {
  if (given == nullptr) return misused("The source is missing.");
  Status status = takeSized("the source", *given, sizeof(tks_mosaic_source), out.source);
  if (!status.ok()) return status;
  if (out.source.heights == nullptr || out.source.read == nullptr)
    return misused("The source has no heights, or nothing to read them with.");
  tks_heights described = *out.source.heights;
  described.data = given;  // no samples, but checked as if there were some
  if (described.domain != TKS_DOMAIN_PLANE) return misused("The heights of a mosaic are a plane.");
  return checkedHeights(described, out.heights);
}

Result<MosaicOptions> takeOptions(const tks_mosaic_options* given, const tks_heights& heights) {
  if (given == nullptr) return misused("The options are missing.");
  tks_mosaic_options known{};
  const Status status =
      takeSized("the options", *given, offsetof(tks_mosaic_options, regions), known);
  if (!status.ok()) return status;
  MosaicOptions options;
  options.bytes = known.bytes;
  options.psnr = known.psnr;
  options.max_error = known.max_error;
  options.lossless = known.lossless != 0;
  options.step = heights.step;
  for (const auto& [side, log2] :
       {std::pair{known.regions, &options.region_log2}, {known.tile, &options.tile_log2}}) {
    if (side == 0) continue;
    if (!std::has_single_bit(side))
      return misused("The sides of regions and tiles are powers of two.");
    *log2 = std::bit_width(side) - 1;
  }
  options.tile_log2 = std::max(options.tile_log2, known.tile == 0 ? options.region_log2 : 0);
  return options;
}

Result<MosaicFiles> takeFiles(const tks_mosaic_files* given) {
  if (given == nullptr) return misused("The files are missing.");
  tks_mosaic_files files{};
  const Status status = takeSized("the files", *given, sizeof(tks_mosaic_files), files);
  if (!status.ok()) return status;
  if (files.read == nullptr || files.length == nullptr || files.write == nullptr)
    return misused("The files have nothing to read or to write them with.");
  MosaicFiles out;
  out.read = [files](const std::string& name, uint64_t offset,
                     uint64_t bytes) -> Result<std::vector<uint8_t>> {
    const Status failed(TKS_IO, "The file " + name + " of the mosaic cannot be read.");
    uint64_t length = 0, read = 0;
    if (files.length(files.user, name.c_str(), &length) != 0) return failed;
    std::vector<uint8_t> data(
        static_cast<size_t>(std::min(bytes, length - std::min(offset, length))));
    if (data.empty()) return data;
    if (files.read(files.user, name.c_str(), offset, data.size(), data.data(), &read) != 0)
      return failed;
    data.resize(static_cast<size_t>(std::min<uint64_t>(read, data.size())));
    return data;
  };
  out.write = [files](const std::string& name, std::span<const uint8_t> bytes) -> Status {
    if (files.write(files.user, name.c_str(), bytes.data(), bytes.size()) == 0) return {};
    return {TKS_IO, "The file " + name + " of the mosaic cannot be written."};
  };
  return out;
}

Result<MosaicPlan> takePlan(const uint8_t* plan, size_t size) {
  if (plan == nullptr) return misused("The plan is missing.");
  return readPlan({plan, size});
}

Result<Tile> takeTile(const MosaicGrid& grid, tks_tile given) {
  const Tile tile{static_cast<int>(std::min<uint32_t>(given.group, 1000)), given.column, given.row};
  if (grid.has(tile)) return tile;
  return misused("The mosaic has no such tile.");
}

void giveTiles(const std::vector<Tile>& from, tks_tile* tiles, size_t room, size_t* count) {
  *count = from.size();
  for (size_t i = 0; i < std::min(room, from.size()); ++i)
    tiles[i] = {static_cast<uint32_t>(from[i].group), from[i].column, from[i].row};
}

Status makePlanFor(const tks_mosaic_source* source, const tks_mosaic_options* options,
                   tks_buffer* out) {
  KnownSource known;
  if (Status status = takeSource(source, known); !status.ok()) return status;
  const Result<MosaicOptions> wanted = takeOptions(options, known.heights);
  if (!wanted.ok()) return wanted.status();
  const Result<MosaicPlan> plan = makePlan(known.heights, *wanted, known.reader());
  if (!plan.ok()) return plan.status();
  giveBytes(writePlan(*plan), *out);
  return {};
}

Status codeTileFor(const MosaicPlan& plan, tks_tile given, const tks_mosaic_source* source,
                   const tks_mosaic_files* files, uint32_t threads) {
  const Result<Tile> tile = takeTile(plan.grid(), given);
  if (!tile.ok()) return tile.status();
  const Result<MosaicFiles> storage = takeFiles(files);
  if (!storage.ok()) return storage.status();
  KnownSource known;
  if (plan.grid().readsSource(*tile)) {
    if (Status status = takeSource(source, known); !status.ok()) return status;
    const GeometryHeader& header = plan.geometry();
    if (known.heights.width != header.width || known.heights.height != header.height ||
        known.heights.sample != header.sample) {
      return misused(
          "The source has another size or type than the one that the plan was made "
          "for: make a new plan.");
    }
  }
  return runTask(plan, *tile, known.reader(), *storage, std::max(1u, threads));
}

Result<LayoutOptions> takeLayout(const tks_merge_options* given) {
  LayoutOptions options;
  if (given == nullptr) return options;
  tks_merge_options known{};
  const Status status =
      takeSized("the options", *given, offsetof(tks_merge_options, preview), known);
  if (!status.ok()) return status;
  switch (known.layout) {
    case TKS_LAYOUT_PROGRESSIVE:
      break;
    case TKS_LAYOUT_WINDOWS:
      options.layout = Layout::kWindows;
      break;
    case TKS_LAYOUT_MIXED:
      options.layout = Layout::kMixed;
      break;
    default:
      return misused("There is no such layout.");
  }
  if (known.preview > 0) options.preview = known.preview;
  if (options.preview && options.layout != Layout::kMixed)
    return misused("Only the mixed layout has a preview.");
  return options;
}

Status mergeFor(const MosaicPlan& plan, const tks_mosaic_files* files,
                const tks_merge_options* options, tks_write_at write, void* user) {
  if (write == nullptr) return outputMissing();
  const Result<MosaicFiles> storage = takeFiles(files);
  if (!storage.ok()) return storage.status();
  const Result<LayoutOptions> layout = takeLayout(options);
  if (!layout.ok()) return layout.status();
  return mergeParts(plan, *storage, *layout,
                    [&](uint64_t offset, std::span<const uint8_t> bytes) -> Status {
                      if (write(user, offset, bytes.data(), bytes.size()) == 0) return {};
                      return {TKS_IO, "The stream cannot be written."};
                    });
}

}  // namespace

}  // namespace tetrakis::inline api

using namespace tetrakis;

tks_status tks_mosaic_plan(const tks_mosaic_source* source, const tks_mosaic_options* options,
                           tks_buffer* plan, char* message, size_t message_size) {
  if (plan != nullptr) *plan = {nullptr, 0};
  return reporting(message, message_size, [&]() -> Status {
    return plan == nullptr ? outputMissing() : makePlanFor(source, options, plan);
  });
}

tks_status tks_mosaic_tiles(const uint8_t* plan, size_t plan_size, tks_tile* tiles, size_t room,
                            size_t* count) {
  return answering([&]() -> Status {
    if (count == nullptr || (tiles == nullptr && room > 0)) return outputMissing();
    const Result<MosaicPlan> known = takePlan(plan, plan_size);
    if (!known.ok()) return known.status();
    giveTiles(known->grid().tiles(), tiles, room, count);
    return {};
  });
}

tks_status tks_mosaic_coding_groups(const uint8_t* plan, size_t plan_size, uint32_t* groups) {
  return answering([&]() -> Status {
    if (groups == nullptr) return outputMissing();
    const Result<MosaicPlan> known = takePlan(plan, plan_size);
    if (!known.ok()) return known.status();
    *groups = static_cast<uint32_t>(known->grid().codingGroups());
    return {};
  });
}

tks_status tks_mosaic_needs(const uint8_t* plan, size_t plan_size, tks_tile tile, tks_tile* tiles,
                            size_t room, size_t* count) {
  return answering([&]() -> Status {
    if (count == nullptr || (tiles == nullptr && room > 0)) return outputMissing();
    const Result<MosaicPlan> known = takePlan(plan, plan_size);
    if (!known.ok()) return known.status();
    const MosaicGrid grid = known->grid();
    const Result<Tile> of = takeTile(grid, tile);
    if (!of.ok()) return of.status();
    giveTiles(grid.needs(*of), tiles, room, count);
    return {};
  });
}

tks_status tks_mosaic_block(const uint8_t* plan, size_t plan_size, tks_tile tile,
                            tks_window* block) {
  return answering([&]() -> Status {
    if (block == nullptr) return outputMissing();
    const Result<MosaicPlan> known = takePlan(plan, plan_size);
    if (!known.ok()) return known.status();
    const MosaicGrid grid = known->grid();
    const Result<Tile> of = takeTile(grid, tile);
    if (!of.ok()) return of.status();
    const Window window = grid.block(*of);
    *block = {window.x, window.y, window.width, window.height};
    return {};
  });
}

tks_status tks_mosaic_code(const uint8_t* plan, size_t plan_size, tks_tile tile,
                           const tks_mosaic_source* source, const tks_mosaic_files* files,
                           uint32_t threads, char* message, size_t message_size) {
  return reporting(message, message_size, [&]() -> Status {
    const Result<MosaicPlan> known = takePlan(plan, plan_size);
    return known.ok() ? codeTileFor(*known, tile, source, files, threads) : known.status();
  });
}

tks_status tks_mosaic_is_done(const uint8_t* plan, size_t plan_size, tks_tile tile,
                              const tks_mosaic_files* files, int* done) {
  return answering([&]() -> Status {
    if (done == nullptr) return outputMissing();
    const Result<MosaicPlan> known = takePlan(plan, plan_size);
    if (!known.ok()) return known.status();
    const MosaicGrid grid = known->grid();
    const Result<Tile> of = takeTile(grid, tile);
    if (!of.ok()) return of.status();
    const Result<MosaicFiles> storage = takeFiles(files);
    if (!storage.ok()) return storage.status();
    *done = isDone(*storage, hashOf(*known), grid, *of) ? 1 : 0;
    return {};
  });
}

tks_status tks_mosaic_merge(const uint8_t* plan, size_t plan_size, const tks_mosaic_files* files,
                            const tks_merge_options* options, tks_write_at write, void* user,
                            char* message, size_t message_size) {
  return reporting(message, message_size, [&]() -> Status {
    const Result<MosaicPlan> known = takePlan(plan, plan_size);
    return known.ok() ? mergeFor(*known, files, options, write, user) : known.status();
  });
}

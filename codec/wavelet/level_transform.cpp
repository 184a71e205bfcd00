// SPDX-License-Identifier: Apache-2.0
#include "codec/wavelet/level_transform.hpp"

#include <algorithm>
#include <cassert>

#include "base/parallel.hpp"
#include "codec/wavelet/held_lifting.hpp"
#include "codec/wavelet/lifting/lifting.hpp"

namespace tetrakis::inline wavelet {

namespace {

void forEachLowRow(const SplitBlock& block, void (*change)(std::span<int32_t>)) {
  const uint32_t apart = block.splitsColumns() ? 2 : 1;
  for (uint32_t y = 0; y < block.low.height; ++y)
    change(block.row(y * apart).first(block.low.width));
}

/// Columns [begin, end) of a block.
Rows<int32_t> columnsOf(const SplitBlock& block, uint32_t begin, uint32_t end) {
  return {block.first + begin, block.pitch, block.extent.height, end - begin};
}

/// Which values of columns [begin, end) exist.
Rows<const uint8_t> existingOf(const SplitBlock& block, uint32_t begin, uint32_t end) {
  return {block.existing.data() + begin, block.extent.width, block.extent.height, end - begin};
}

/// Which values of a row exist; null: all do.
const uint8_t* existingOf(const SplitBlock& block, uint32_t row) {
  return block.existing.empty() ? nullptr
                                : block.existing.data() + size_t{row} * block.extent.width;
}

}  // namespace

LevelTransform::LevelTransform(const WaveletSpec& spec, int level, Direction direction,
                               uint32_t threads)
    : id_(spec.filter(level)),
      direction_(direction),
      ends_(spec.ring ? Ends::kJoined : Ends::kMirrored),
      doubles_(spec.doubles(level)),
      wide_(spec.wide(level)),
      joint_(spec.joint(level)),
      jointly_wide_(spec.jointlyWide(level)),
      threads_(threads) {}

void LevelTransform::run(const SplitBlock& block) const {
  assert(block.existing.empty() || block.existing.size() == block.extent.samples());
  const bool rows = block.splitsRows(), columns = block.splitsColumns();
  const bool free = block.existing.empty() && block.held == nullptr;
  if (joint_ && rows && columns && free) return liftJointly(block);
  if (doubles_ && !analyses()) forEachLowRow(block, halveValues);
  if (block.held != nullptr) {
    if (!analyses()) holdCoefficients(block);
    if (rows && analyses()) liftHeldRows(block);
    if (columns) liftHeldColumns(block);
    if (rows && !analyses()) liftHeldRows(block);
  } else {
    if (rows && analyses()) liftRows(block);
    if (columns) liftColumns(block);
    if (rows && !analyses()) liftRows(block);
  }
  if (doubles_ && analyses()) forEachLowRow(block, doubleValues);
}

void LevelTransform::liftJointly(const SplitBlock& block) const {
  const JointBlock joint{block.first, block.pitch, block.extent, ends_, doubles_};
  for (const JointStep step : JointLifting::steps(direction_)) {
    inChunks(block.extent.height, [&](uint32_t begin, uint32_t end) {
      JointLifting(joint, id_, direction_, jointly_wide_).run(step, begin, end);
    });
  }
}

void LevelTransform::liftRows(const SplitBlock& block) const {
  const uint32_t width = block.extent.width;
  inChunks(block.extent.height, [&](uint32_t begin, uint32_t end) {
    if (!block.existing.empty()) {
      MaskedRowLifting masked(width, ends_);
      for (uint32_t y = begin; y < end; ++y) {
        int32_t* row = block.row(y).data();
        analyses() ? masked.analyse(row, existingOf(block, y), width, id_)
                   : masked.synthesise(row, existingOf(block, y), width, id_);
      }
      return;
    }
    RowLifting plain(width, ends_);
    for (uint32_t y = begin; y < end; ++y) {
      int32_t* row = block.row(y).data();
      analyses() ? plain.analyse(row, width, id_, wide_) : plain.synthesise(row, width, id_, wide_);
    }
  });
}

void LevelTransform::liftColumns(const SplitBlock& block) const {
  inChunks(block.extent.width, [&](uint32_t begin, uint32_t end) {
    const Rows<int32_t> part = columnsOf(block, begin, end);
    if (block.existing.empty()) {
      tetrakis::liftColumns(part, id_, direction_, wide_);
    } else {
      liftMaskedColumns(part, existingOf(block, begin, end), id_, direction_);
    }
  });
}

void LevelTransform::liftHeldRows(const SplitBlock& block) const {
  inChunks(block.extent.height, [&](uint32_t begin, uint32_t end) {
    HeldRowLifting lifting(block.extent.width, ends_);
    for (uint32_t y = begin; y < end; ++y)
      lifting.lift(block.row(y), existingOf(block, y), *block.held, y, {id_, direction_, wide_});
  });
}

void LevelTransform::liftHeldColumns(const SplitBlock& block) const {
  inChunks(block.extent.width, [&](uint32_t begin, uint32_t end) {
    const bool masked = !block.existing.empty();
    const auto existing = masked ? existingOf(block, begin, end) : Rows<const uint8_t>{};
    tetrakis::liftHeldColumns(columnsOf(block, begin, end), masked ? &existing : nullptr,
                              {block.held, begin, block.low.width}, {id_, direction_, wide_});
  });
}

void LevelTransform::holdCoefficients(const SplitBlock& block) const {
  const HeldBlock& held = *block.held;
  for (uint32_t y = 0; y < block.extent.height; ++y) {
    const bool high_y = block.splitsColumns() && y % 2 == 1;
    const std::span<int32_t> row = block.row(y);
    hold(held.line(y, false), held.states().after(false, high_y), row.first(block.low.width));
    if (!held.splitsRows()) continue;
    hold(held.line(y, true), held.states().after(true, high_y), row.subspan(block.low.width));
  }
}

void LevelTransform::inChunks(uint32_t count,
                              const std::function<void(uint32_t, uint32_t)>& lift) const {
  constexpr uint32_t kChunk = 256;
  const uint32_t chunk = threads_ > 1 ? kChunk : count;
  parallelFor(threads_, (count + chunk - 1) / chunk, [&](size_t i) {
    const auto begin = static_cast<uint32_t>(i) * chunk;
    lift(begin, std::min(count, begin + chunk));
  });
}

}  // namespace tetrakis::inline wavelet

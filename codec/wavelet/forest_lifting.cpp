// SPDX-License-Identifier: Apache-2.0
#include "codec/wavelet/forest_lifting.hpp"

#include <array>
#include <cassert>

#include "base/forest.hpp"
#include "base/parallel.hpp"

namespace tetrakis::inline wavelet {

namespace {

/// How far steps of any filter read, made even, so that even places stay even.
constexpr uint32_t kWidestMargin = 2 * kMaxPairs;

uint32_t marginOf(FilterId id) {
  return stepReach(id) + 1;
}

PatchWindows wholePatches(const Forest& forest, uint32_t side) {
  return PatchWindows(forest.patches(), Window{0, 0, side, side});
}

}  // namespace

ForestLifting::ForestLifting(const WaveletSpec& spec, const Pyramid& pyramid, Levels levels,
                             Direction direction, uint32_t threads, const PatchWindows& blocks)
    : forest_(*spec.forest),
      pyramid_(pyramid),
      plane_(pyramid.low(levels.plane)),
      level_(levels.lifted),
      id_(spec.filter(level_)),
      direction_(direction),
      doubled_(spec.doubles(level_)),
      wide_(spec.jointlyWide(level_)),
      threads_(threads),
      n_(pyramid.low(level_ - 1).extent.width - 1),
      margin_(marginOf(id_)) {
  assert(n_ % 2 == 0 && blocks.size() == forest_.patches());
  size_t values = 0;
  for (const Window& at : blocks) {
    assert(at.x % 2 == 0 && at.y % 2 == 0);
    Block& block = blocks_.emplace_back(Block{at, values});
    if (at.width == 0) continue;
    block.width = at.width + 2 * margin_;
    block.height = at.height + 2 * margin_;
    values += size_t{block.width} * block.height;
  }
  values_.resize(values);
  findCopies();
}

ForestLifting::ForestLifting(const WaveletSpec& spec, const Pyramid& pyramid, Levels levels,
                             Direction direction, uint32_t threads)
    : ForestLifting(spec, pyramid, levels, direction, threads,
                    wholePatches(*spec.forest, pyramid.low(levels.lifted - 1).extent.width)) {}

ForestLifting::ForestLifting(const WaveletSpec& spec, const Pyramid& pyramid, int level,
                             const PatchWindows& blocks)
    : ForestLifting(spec, pyramid, {level - 1, level}, Direction::kSynthesis, 1, blocks) {}

uint64_t ForestLifting::bytesOf(const Forest& forest, int level) {
  return bytesOf(wholePatches(forest, (forest.side() >> level) + 1));
}

uint64_t ForestLifting::bytesOf(const PatchWindows& blocks) {
  uint64_t bytes = 0;
  for (const Window& block : blocks) {
    if (block.width == 0) continue;
    const uint64_t width = block.width + 2 * kWidestMargin,
                   height = block.height + 2 * kWidestMargin;
    const uint64_t around = 2 * kWidestMargin * (width + height),
                   shared = 2 * (uint64_t{block.width} + block.height);
    bytes += width * height * (sizeof(int32_t) + sizeof(uint16_t)) +
             (around + shared) * sizeof(Copy) + sizeof(Block);
  }
  return bytes;
}

bool ForestLifting::holds(const Forest::Place& place) const {
  const Window& at = blocks_[place.patch].at;
  return place.x >= at.x && place.x < int64_t{at.x} + at.width && place.y >= at.y &&
         place.y < int64_t{at.y} + at.height;
}

size_t ForestLifting::indexOf(uint32_t patch, int64_t x, int64_t y) const {
  const Block& block = blocks_[patch];
  const auto column = static_cast<size_t>(x + margin_ - block.at.x),
             row = static_cast<size_t>(y + margin_ - block.at.y);
  const size_t lows = (block.width + 1) / 2;
  return block.first + row * block.width + column / 2 + (column % 2 != 0 ? lows : 0);
}

void ForestLifting::findCopies() {
  const auto areWhole = [&](const Block& block) { return isWhole(block); };
  const bool whole = std::all_of(blocks_.begin(), blocks_.end(), areWhole);
  const size_t side = size_t{n_} + 1;
  if (whole) {
    around_.reserve(values_.size() - forest_.patches() * side * side);
    shared_.reserve(forest_.patches() * Forest::kSides * side);
  }
  const std::array<Range, 3> ranges = {
      {{-int64_t{margin_}, margin_}, {0, side}, {n_ + 1, margin_}}};
  for (uint32_t patch = 0; patch < forest_.patches(); ++patch) {
    if (!whole) {
      seeAround(patch);
      continue;
    }
    for (const Range& rows : ranges) {
      for (const Range& columns : ranges)
        if (rows.first != 0 || columns.first != 0) see(patch, columns, rows);
    }
  }
  forest_.forEachShared(n_, [&](const Forest::Place& sample, const Forest::Place& owner) {
    if (whole || (holds(sample) && holds(owner)))
      shared_.push_back({indexOf(sample), indexOf(owner)});
  });
}

/// What lies beyond the patch and in a block. What lies in the patch beside its block is not read
/// for a sample that is wanted.
void ForestLifting::seeAround(uint32_t patch) {
  const Block& block = blocks_[patch];
  const Window& at = block.at;
  const int64_t margin = at.width > 0 ? margin_ : 0, n = n_;
  const auto isInside = [&](int64_t along) { return along >= 0 && along <= n; };
  for (int64_t y = int64_t{at.y} - margin; y < int64_t{at.y} + at.height + margin; ++y) {
    for (int64_t x = int64_t{at.x} - margin; x < int64_t{at.x} + at.width + margin; ++x) {
      if (isInside(y) && isInside(x)) {
        x = std::max(x, std::min(int64_t{at.x} + at.width + margin - 1, n));
        continue;
      }
      const Forest::Place seen = forest_.locate(n, {patch, x, y});
      if (holds(seen)) around_.push_back({indexOf(patch, x, y), indexOf(seen)});
    }
  }
}

/// All places of such a block are seen in one patch, which is turned as a whole, so that an index
/// is the sum of a part that depends on the column and one that depends on the row. Along a side,
/// even places have equal distances, and so have odd ones.
void ForestLifting::see(uint32_t patch, const Range& columns, const Range& rows) {
  const auto partsOf = [&](const Range& range, const auto& placeOf, std::vector<size_t>& parts) {
    parts.resize(range.count);
    for (size_t k = 0; k < range.count; ++k) {
      parts[k] = k > 2 && range.first == 0
                     ? parts[k - 2] + parts[2] - parts[0]
                     : indexOf(forest_.locate(n_, placeOf(range.first + static_cast<int64_t>(k))));
    }
  };
  const auto inRow = [&](int64_t x) { return Forest::Place{patch, x, rows.first}; };
  const auto inColumn = [&](int64_t y) { return Forest::Place{patch, columns.first, y}; };
  partsOf(columns, inRow, column_parts_);
  partsOf(rows, inColumn, row_parts_);
  for (size_t y = 0; y < rows.count; ++y) {
    const size_t row = row_parts_[y] - row_parts_[0];
    for (size_t x = 0; x < columns.count; ++x) {
      const Forest::Place place{patch, columns.first + static_cast<int64_t>(x),
                                rows.first + static_cast<int64_t>(y)};
      around_.push_back({indexOf(place), column_parts_[x] + row});
    }
  }
}

void ForestLifting::copyAll(const std::vector<Copy>& copies) {
  for (const auto& [to, from] : copies) values_[to] = values_[from];
}

void ForestLifting::findNumbers() {
  const size_t log2 = static_cast<size_t>(level_ - 1), width = pyramid_.plane().width;
  numbers_.resize(values_.size());
  for (uint32_t patch = 0; patch < forest_.patches(); ++patch) {
    const Window& at = blocks_[patch].at;
    for (uint32_t y = at.y; y < at.y + at.height; ++y) {
      const uint16_t* const row =
          pyramid_.held().numbers.data() + (size_t{patch} * forest_.side() + (y << log2)) * width;
      for (uint32_t x = at.x; x < at.x + at.width; ++x)
        numbers_[indexOf(patch, x, y)] = row[x << log2];
    }
  }
  for (const auto& [to, from] : around_) numbers_[to] = numbers_[from];
}

void ForestLifting::hold(uint32_t patch, JointStep step, const std::vector<HeldCell>& held) {
  const Window& at = blocks_[patch].at;
  const uint32_t above = step == JointStep::kCentres;
  for (uint32_t y = at.y + above; y < at.y + at.height; y += step == JointStep::kSides ? 1 : 2) {
    const uint32_t beside = step == JointStep::kSides ? 1 - y % 2 : step == JointStep::kCentres;
    for (uint32_t x = at.x + beside; x < at.x + at.width; x += 2) {
      const size_t i = indexOf(patch, x, y);
      if (numbers_[i] == 0) continue;
      const HeldCell& cell = held[numbers_[i] - 1u];
      values_[i] = step == JointStep::kCorners ? cell.corner
                   : step == JointStep::kSides ? cell.side
                                               : cell.centre;
    }
  }
}

void ForestLifting::holdAll(const std::vector<HeldCell>& held) {
  for (uint32_t patch = 0; patch < forest_.patches(); ++patch)
    for (const JointStep step : {JointStep::kCentres, JointStep::kSides, JointStep::kCorners})
      hold(patch, step, held);
}

void ForestLifting::lift(size_t round, const HeldCellsOfLevel& held) {
  for (const JointStep each : JointLifting::steps(direction_))
    if (each != JointStep::kHalves) step(round, each, held);
}

void ForestLifting::step(size_t round, JointStep step, const HeldCellsOfLevel& held) {
  copyAll(around_);
  const bool doubled = doubled_ && round + 1 == jointRounds(id_);
  const std::vector<HeldCell>& cells =
      direction_ == Direction::kAnalysis ? held.after : held.before;
  parallelFor(threads_, forest_.patches(), [&](size_t patch) {
    const Block& of_patch = blocks_[patch];
    if (of_patch.width == 0) return;
    JointBlock block{values_.data() + of_patch.first,
                     of_patch.width,
                     {of_patch.width, of_patch.height},
                     Ends::kMirrored,
                     doubled,
                     round};
    if (!held.none())
      block.held = {numbers_.data() + of_patch.first, held.raised.data(), held.lowered.data()};
    JointLifting(block, id_, direction_, wide_).run(step, margin_, margin_ + of_patch.at.height);
    if (!held.none()) hold(static_cast<uint32_t>(patch), step, cells);
  });
  copyAll(shared_);
}

template <class RowOf, class Move>
void ForestLifting::forEachSample(const RowOf& rowOf, bool halved, const Move& move) {
  for (uint32_t patch = 0; patch < forest_.patches(); ++patch) {
    const Window& at = blocks_[patch].at;
    const size_t lows = (at.width + 1) / 2, highs = at.width / 2;
    for (uint32_t y = at.y; y < at.y + at.height; ++y) {
      int32_t* const row = rowOf(patch, y);
      int32_t* const even = values_.data() + indexOf(patch, at.x, y);
      int32_t* const odd = values_.data() + indexOf(patch, int64_t{at.x} + 1, y);
      for (size_t k = 0; k < lows; ++k) move(row[halved ? k : 2 * k], even[k]);
      for (size_t k = 0; k < highs; ++k) move(row[halved ? lows + k : 2 * k + 1], odd[k]);
    }
  }
}

template <class RowOf>
void ForestLifting::runRows(const RowOf& rowOf, const HeldCellsOfLevel& held) {
  const bool analyses = direction_ == Direction::kAnalysis;
  forEachSample(rowOf, !analyses, [](int32_t from, int32_t& to) { to = from; });
  copyAll(shared_);  // what is not owned has no coefficient
  const size_t rounds = jointRounds(id_);
  assert(held.none() || rounds == 1);
  if (!held.none()) findNumbers();
  if (!held.none() && !analyses) holdAll(held.after);  // what is held has no coefficients
  for (size_t i = 0; i < rounds; ++i) lift(analyses ? i : rounds - 1 - i, held);
  if (analyses)  // no coefficient counts twice in the encoder's account
    for (const Copy& copy : shared_) values_[copy.to] = 0;
  forEachSample(rowOf, analyses, [](int32_t& to, int32_t from) { to = from; });
}

void ForestLifting::run(std::span<int32_t> values, const HeldCellsOfLevel& held) {
  assert(values.size() == plane_.extent.samples());
  const int splits = level_ - 1 - plane_.splits_y;
  const auto rowOf = [&](uint32_t patch, uint32_t y) {
    return values.data() +
           (size_t{patch} * plane_.patch_rows + (size_t{y} << splits)) * plane_.extent.width;
  };
  runRows(rowOf, held);
}

void ForestLifting::run(std::vector<std::vector<int32_t>>& values, const HeldCellsOfLevel& held) {
  const auto rowOf = [&](uint32_t patch, uint32_t y) {
    const Window& at = blocks_[patch].at;
    assert(values[patch].size() == at.extent().samples());
    return values[patch].data() + size_t{y - at.y} * at.width;
  };
  runRows(rowOf, held);
}

}  // namespace tetrakis::inline wavelet

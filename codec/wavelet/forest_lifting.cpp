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
  size_t pairs = 1;
  for (const LiftingStep& step : liftingFilter(id).steps) pairs = std::max(pairs, step.pairs);
  return static_cast<uint32_t>(2 * pairs);
}

}  // namespace

ForestLifting::ForestLifting(const WaveletSpec& spec, const Pyramid& pyramid, Levels levels,
                             Direction direction, uint32_t threads)
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
      margin_(marginOf(id_)),
      width_(n_ + 1 + 2 * margin_),
      patches_(size_t{forest_.patches()} * width_ * width_) {
  assert(n_ % 2 == 0);
  findCopies();
}

uint64_t ForestLifting::bytesOf(const Forest& forest, int level) {
  const uint64_t side = (forest.side() >> level) + 1, width = side + 2 * kWidestMargin;
  const uint64_t around = 4 * kWidestMargin * width, shared = 4 * side;
  return forest.patches() *
         (width * width * (sizeof(int32_t) + sizeof(uint16_t)) + (around + shared) * sizeof(Copy));
}

size_t ForestLifting::indexOf(uint32_t patch, int64_t x, int64_t y) const {
  const auto column = static_cast<size_t>(x + margin_), row = static_cast<size_t>(y + margin_);
  const size_t lows = (width_ + 1) / 2;
  return (size_t{patch} * width_ + row) * width_ + column / 2 + (column % 2 != 0 ? lows : 0);
}

void ForestLifting::findCopies() {
  const size_t side = size_t{n_} + 1;
  around_.reserve(forest_.patches() * (size_t{width_} * width_ - side * side));
  shared_.reserve(forest_.patches() * Forest::kSides * side);
  const std::array<Range, 3> ranges = {
      {{-int64_t{margin_}, margin_}, {0, side}, {n_ + 1, margin_}}};
  for (uint32_t patch = 0; patch < forest_.patches(); ++patch) {
    for (const Range& rows : ranges) {
      for (const Range& columns : ranges)
        if (rows.first != 0 || columns.first != 0) see(patch, columns, rows);
    }
  }
  forest_.forEachShared(n_, [&](const Forest::Place& sample, const Forest::Place& owner) {
    shared_.push_back({indexOf(sample), indexOf(owner)});
  });
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
  for (const auto& [to, from] : copies) patches_[to] = patches_[from];
}

void ForestLifting::findNumbers() {
  const size_t log2 = static_cast<size_t>(level_ - 1), width = pyramid_.plane().width;
  numbers_.resize(patches_.size());
  for (uint32_t patch = 0; patch < forest_.patches(); ++patch) {
    for (uint32_t y = 0; y <= n_; ++y) {
      const uint16_t* const row =
          pyramid_.held().numbers.data() + (size_t{patch} * forest_.side() + (y << log2)) * width;
      for (uint32_t x = 0; x <= n_; ++x) numbers_[indexOf(patch, x, y)] = row[x << log2];
    }
  }
  for (const auto& [to, from] : around_) numbers_[to] = numbers_[from];
}

void ForestLifting::hold(uint32_t patch, JointStep step, const std::vector<HeldCell>& held) {
  for (uint32_t y = step == JointStep::kCentres; y <= n_; y += step == JointStep::kSides ? 1 : 2) {
    const uint32_t first = step == JointStep::kSides ? 1 - y % 2 : step == JointStep::kCentres;
    for (uint32_t x = first; x <= n_; x += 2) {
      const size_t i = indexOf(patch, x, y);
      if (numbers_[i] == 0) continue;
      const HeldCell& cell = held[numbers_[i] - 1u];
      patches_[i] = step == JointStep::kCorners ? cell.corner
                    : step == JointStep::kSides ? cell.side
                                                : cell.centre;
    }
  }
}

void ForestLifting::lift(size_t round, const HeldCellsOfLevel& held) {
  for (const JointStep each : JointLifting::steps(direction_))
    if (each != JointStep::kHalves) step(round, each, held);
}

void ForestLifting::step(size_t round, JointStep step, const HeldCellsOfLevel& held) {
  copyAll(around_);
  const size_t samples = size_t{width_} * width_;
  const bool doubled = doubled_ && round + 1 == jointRounds(id_);
  const std::vector<HeldCell>& cells =
      direction_ == Direction::kAnalysis ? held.after : held.before;
  parallelFor(threads_, forest_.patches(), [&](size_t patch) {
    JointBlock block{patches_.data() + patch * samples,
                     width_,
                     {width_, width_},
                     Ends::kMirrored,
                     doubled,
                     round};
    if (!held.none())
      block.held = {numbers_.data() + patch * samples, held.raised.data(), held.lowered.data()};
    JointLifting(block, id_, direction_, wide_).run(step, margin_, margin_ + n_ + 1);
    if (!held.none()) hold(static_cast<uint32_t>(patch), step, cells);
  });
  copyAll(shared_);
}

template <class Move>
void ForestLifting::forEachSample(std::span<int32_t> values, bool halved, const Move& move) {
  const size_t lows = n_ / 2 + 1, width = plane_.extent.width;
  const int splits = level_ - 1 - plane_.splits_y;
  for (uint32_t patch = 0; patch < forest_.patches(); ++patch) {
    for (size_t y = 0; y <= n_; ++y) {
      int32_t* const row =
          values.data() + (size_t{patch} * plane_.patch_rows + (y << splits)) * width;
      int32_t* const here = patches_.data() + indexOf(patch, 0, static_cast<int64_t>(y));
      int32_t* const odd = patches_.data() + indexOf(patch, 1, static_cast<int64_t>(y));
      for (size_t k = 0; k < lows; ++k) move(row[halved ? k : 2 * k], here[k]);
      for (size_t k = 0; k < lows - 1; ++k) move(row[halved ? lows + k : 2 * k + 1], odd[k]);
    }
  }
}

void ForestLifting::run(std::span<int32_t> values, const HeldCellsOfLevel& held) {
  assert(values.size() == plane_.extent.samples());
  const bool analyses = direction_ == Direction::kAnalysis;
  forEachSample(values, !analyses, [](int32_t from, int32_t& to) { to = from; });
  copyAll(shared_);  // what is not owned has no coefficient
  const size_t rounds = jointRounds(id_);
  assert(held.none() || rounds == 1);
  if (!held.none()) findNumbers();
  if (!held.none() && !analyses) {  // what is held has no coefficients
    for (uint32_t patch = 0; patch < forest_.patches(); ++patch)
      for (const JointStep step : {JointStep::kCentres, JointStep::kSides, JointStep::kCorners})
        hold(patch, step, held.after);
  }
  for (size_t i = 0; i < rounds; ++i) lift(analyses ? i : rounds - 1 - i, held);
  if (analyses)  // no coefficient counts twice in the encoder's account
    for (const Copy& copy : shared_) patches_[copy.to] = 0;
  forEachSample(values, analyses, [](int32_t& to, int32_t from) { to = from; });
}

}  // namespace tetrakis::inline wavelet

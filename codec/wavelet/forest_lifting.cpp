// SPDX-License-Identifier: Apache-2.0
#include "codec/wavelet/forest_lifting.hpp"

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

ForestLifting::ForestLifting(const WaveletSpec& spec, const Pyramid& pyramid, int level,
                             Direction direction, uint32_t threads)
    : forest_(*spec.forest),
      pyramid_(pyramid),
      level_(level),
      id_(spec.filter(level)),
      direction_(direction),
      doubled_(spec.doubles(level)),
      wide_(spec.jointlyWide(level)),
      threads_(threads),
      n_(pyramid.low(level - 1).extent.width - 1),
      margin_(marginOf(id_)),
      width_(n_ + 1 + 2 * margin_),
      patches_(size_t{forest_.patches()} * width_ * width_) {
  assert(n_ % 2 == 0);
  findCopies();
}

uint64_t ForestLifting::bytesOf(const Forest& forest) {
  const uint64_t width = forest.side() + 2 * kWidestMargin;
  const uint64_t around = 4 * kWidestMargin * width, shared = 4 * uint64_t{forest.side()};
  return forest.patches() *
         (width * width * (sizeof(int32_t) + sizeof(uint16_t)) + (around + shared) * sizeof(Copy));
}

size_t ForestLifting::indexOf(uint32_t patch, int64_t x, int64_t y) const {
  const auto column = static_cast<size_t>(x + margin_), row = static_cast<size_t>(y + margin_);
  const size_t lows = (width_ + 1) / 2;
  return (size_t{patch} * width_ + row) * width_ + column / 2 + (column % 2 != 0 ? lows : 0);
}

void ForestLifting::findCopies() {
  const auto place = [&](const Forest::Place& of) { return indexOf(of.patch, of.x, of.y); };
  const int64_t n = n_, margin = margin_;
  const size_t side = size_t{n_} + 1;
  around_.reserve(forest_.patches() * (size_t{width_} * width_ - side * side));
  shared_.reserve(forest_.patches() * Forest::kSides * side);
  for (uint32_t patch = 0; patch < forest_.patches(); ++patch) {
    const auto see = [&](int64_t x, int64_t y) {
      around_.push_back({indexOf(patch, x, y), place(forest_.locate(n, {patch, x, y}))});
    };
    for (int64_t y = -margin; y <= n + margin; ++y) {
      const bool inside = y >= 0 && y <= n;
      for (int64_t x = -margin; x < 0; ++x) see(x, y);
      for (int64_t x = 0; x <= n && !inside; ++x) see(x, y);
      for (int64_t x = n + 1; x <= n + margin; ++x) see(x, y);
    }
  }
  forest_.forEachShared(n, [&](const Forest::Place& sample, const Forest::Place& owner) {
    shared_.push_back({place(sample), place(owner)});
  });
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
  const size_t lows = n_ / 2 + 1, width = pyramid_.plane().width;
  for (uint32_t patch = 0; patch < forest_.patches(); ++patch) {
    for (size_t y = 0; y <= n_; ++y) {
      int32_t* const row =
          values.data() + (size_t{patch} * forest_.side() + (y << (level_ - 1))) * width;
      int32_t* const here = patches_.data() + indexOf(patch, 0, static_cast<int64_t>(y));
      int32_t* const odd = patches_.data() + indexOf(patch, 1, static_cast<int64_t>(y));
      for (size_t k = 0; k < lows; ++k) move(row[halved ? k : 2 * k], here[k]);
      for (size_t k = 0; k < lows - 1; ++k) move(row[halved ? lows + k : 2 * k + 1], odd[k]);
    }
  }
}

void ForestLifting::run(std::span<int32_t> values, const HeldCellsOfLevel& held) {
  assert(values.size() == pyramid_.plane().samples());
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

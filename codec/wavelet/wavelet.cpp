// SPDX-License-Identifier: Apache-2.0
// forwardWavelet() and inverseWavelet() run the levels of the transform (level_transform.hpp), from
// fine to coarse and back.
#include "codec/wavelet/wavelet.hpp"

#include <algorithm>
#include <cassert>
#include <optional>
#include <vector>

#include "base/forest.hpp"
#include "codec/wavelet/forest_lifting.hpp"
#include "codec/wavelet/held_cells.hpp"
#include "codec/wavelet/held_lifting.hpp"
#include "codec/wavelet/level_transform.hpp"

namespace tetrakis::inline wavelet {

namespace {

/// What a level splits, where it lies in the values of the low band of a finer level.
SplitBlock blockOf(const Pyramid& pyramid, int level, int finer, std::span<int32_t> values) {
  const LowBand &band = pyramid.low(level - 1), &whole = pyramid.low(finer);
  assert(level > finer && values.size() == whole.extent.samples());
  return {values.data(), size_t{whole.extent.width} << (band.splits_y - whole.splits_y),
          band.extent, pyramid.low(level).extent};
}

/// The levels of a pyramid, each of which is run as a whole.
class Levels {
 public:
  Levels(const WaveletSpec& spec, const Pyramid& pyramid) : pyramid_(pyramid) {
    if (!pyramid.held().none()) ladder_.emplace(spec, pyramid);
  }

  /// block: of blockOf().
  void run(const LevelTransform& transform, int level, SplitBlock block) const {
    const Window whole{0, 0, block.extent.width, block.extent.height};
    std::vector<uint8_t> mask;
    if (!pyramid_.allExist()) mask = pyramid_.splitMask(level - 1, whole);
    block.existing = mask;
    if (!ladder_) return transform.run(block);
    const HeldLevel states = ladder_->level(level);
    const HeldBlock held(pyramid_, states, level, whole);
    block.held = &held;
    transform.run(block);
  }

 private:
  const Pyramid& pyramid_;
  std::optional<HeldLadder> ladder_;  ///< where something is held
};

/// The levels of a forest above one, from the first one to the last. values: of its low band.
void runForest(const WaveletSpec& spec, const Pyramid& pyramid, Direction direction,
               const InverseOptions& options, std::span<int32_t> values) {
  std::optional<HeldCells> held;
  if (!pyramid.held().none()) held.emplace(spec, pyramid);
  const int levels = pyramid.levels() - options.level;
  for (int done = 0; done < levels; ++done) {
    const bool analyses = direction == Direction::kAnalysis;
    const int level = analyses ? options.level + done + 1 : pyramid.levels() - done;
    ForestLifting(spec, pyramid, {options.level, level}, direction, options.threads)
        .run(values, held ? held->level(level) : HeldCellsOfLevel());
  }
}

}  // namespace

void forwardWavelet(const WaveletSpec& spec, const Pyramid& pyramid, std::span<int32_t> values,
                    uint32_t threads) {
  if (spec.forest != nullptr)
    return runForest(spec, pyramid, Direction::kAnalysis, {0, threads}, values);
  const Levels levels(spec, pyramid);
  for (int level = 1; level <= pyramid.levels(); ++level) {
    levels.run(LevelTransform(spec, level, Direction::kAnalysis, threads), level,
               blockOf(pyramid, level, 0, values));
  }
}

void inverseWavelet(const WaveletSpec& spec, const Pyramid& pyramid, std::span<int32_t> values,
                    const InverseOptions& options) {
  if (spec.forest != nullptr) {
    runForest(spec, pyramid, Direction::kSynthesis, options, values);
    return shareOwned(*spec.forest, values, pyramid.low(options.level).extent.width - 1);
  }
  const Levels levels(spec, pyramid);
  for (int split = pyramid.levels(); split > options.level; --split) {
    levels.run(LevelTransform(spec, split, Direction::kSynthesis, options.threads), split,
               blockOf(pyramid, split, options.level, values));
  }
}

}  // namespace tetrakis::inline wavelet

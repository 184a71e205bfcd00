// SPDX-License-Identifier: Apache-2.0
// The order of the levels.
#include "wavelet/wavelet.hpp"

#include <algorithm>
#include <cassert>
#include <functional>
#include <optional>
#include <vector>

#include "base/parallel.hpp"
#include "wavelet/held_lifting.hpp"
#include "wavelet/lifting/joint_lifting.hpp"
#include "wavelet/lifting/lifting.hpp"
#include "wavelet/lifting/masked_lifting.hpp"

namespace tetrakis::inline wavelet {

namespace {

/// What a level splits: rows at equal distances, columns together.
struct Block {
  int32_t* first;
  size_t pitch;  ///< from one row to the next, in values
  Extent extent;

  Rows<int32_t> rows() const { return {first, pitch, extent.height, extent.width}; }
  std::span<int32_t> row(uint32_t y) const { return {first + y * pitch, extent.width}; }
};

/// The low band of a level where it lies in the values of the low band of a finer level.
Block blockOf(const Pyramid& pyramid, int level, int finer, std::span<int32_t> values) {
  const LowBand &band = pyramid.low(level), &whole = pyramid.low(finer);
  assert(level >= finer && values.size() == whole.extent.samples());
  return {values.data(), size_t{whole.extent.width} << (band.splits_y - whole.splits_y),
          band.extent};
}

/// Which values of a block exist, where they lie.
struct BlockMask {
  std::span<const uint8_t> marks;
  Extent extent;

  const uint8_t* row(uint32_t y) const { return marks.data() + size_t{y} * extent.width; }
  Rows<const uint8_t> columns(uint32_t begin, uint32_t end) const {
    return {marks.data() + begin, extent.width, extent.height, end - begin};
  }
};

/// What a level does with fractions (wavelet/lifting/joint_lifting.hpp).
struct Carrying {
  bool in = false, out = false;
  std::span<const uint8_t> fractions = {};
};

/// One level of the transform: rows and columns jointly, or rows, then columns; backwards the other
/// way round.
class LevelTransform {
 public:
  LevelTransform(const WaveletSpec& spec, int level, Direction direction, uint32_t threads)
      : id_(spec.filter(level)),
        direction_(direction),
        doubles_(spec.doubles(level)),
        wide_(spec.wide(level)),
        joint_(spec.joint(level)),
        jointly_wide_(spec.jointlyWide(level)),
        threads_(threads) {}

  /// To be called before run(), for a joint level.
  LevelTransform& carry(const Carrying& carrying) {
    carrying_ = carrying;
    return *this;
  }

  /// existing: one byte for each value of the block; empty: all exist. held: null: all are free.
  void run(const Block& whole, Extent low, std::span<const uint8_t> existing,
           const HeldBlock* held) const {
    assert(existing.empty() || existing.size() == whole.extent.samples());
    const bool rows = low.width < whole.extent.width, columns = low.height < whole.extent.height;
    if (joint_ && rows && columns && existing.empty() && held == nullptr) return liftJointly(whole);
    std::optional<BlockMask> mask;
    if (!existing.empty()) mask = BlockMask{existing, whole.extent};
    const Block lows{whole.first, columns ? 2 * whole.pitch : whole.pitch, low};
    if (doubles_ && !analyses()) forEachRow(lows, halveValues);
    if (held != nullptr) {
      if (!analyses()) holdCoefficients(whole, low, *held);
      if (rows && analyses()) liftHeldRows(whole, mask, *held);
      if (columns) liftHeldColumns(whole, low, mask, *held);
      if (rows && !analyses()) liftHeldRows(whole, mask, *held);
    } else {
      if (rows && analyses()) liftRows(whole, mask);
      if (columns) liftColumns(whole, mask);
      if (rows && !analyses()) liftRows(whole, mask);
    }
    if (doubles_ && analyses()) forEachRow(lows, doubleValues);
  }

  /// The fractions of the low band, from coefficients that no level has undone.
  std::vector<uint8_t> lowFractions(const Block& whole) const {
    assert(carrying_.out);
    const uint32_t lows = (whole.extent.width + 1) / 2, rows = (whole.extent.height + 1) / 2;
    std::vector<uint8_t> low(size_t{lows} * rows);
    const JointBlock block = jointBlock(whole);
    inChunks(whole.extent.height, [&](uint32_t begin, uint32_t end) {
      JointLifting(block, id_, direction_, jointly_wide_).findFractions(begin, end, low);
    });
    return low;
  }

 private:
  /// Rows or columns that a thread takes at a time.
  static constexpr uint32_t kChunk = 256;

  static void forEachRow(const Block& block, void (*change)(std::span<int32_t>)) {
    for (uint32_t y = 0; y < block.extent.height; ++y) change(block.row(y));
  }
  bool analyses() const { return direction_ == Direction::kAnalysis; }

  JointBlock jointBlock(const Block& whole) const {
    return {whole.first,  whole.pitch,   whole.extent,       doubles_,
            carrying_.in, carrying_.out, carrying_.fractions};
  }
  void liftJointly(const Block& whole) const {
    const JointBlock block = jointBlock(whole);
    for (const JointStep step : JointLifting::steps(direction_)) {
      inChunks(whole.extent.height, [&](uint32_t begin, uint32_t end) {
        JointLifting(block, id_, direction_, jointly_wide_).run(step, begin, end);
      });
    }
  }
  void liftRows(const Block& whole, const std::optional<BlockMask>& mask) const {
    const uint32_t width = whole.extent.width;
    inChunks(whole.extent.height, [&](uint32_t begin, uint32_t end) {
      if (mask) {
        MaskedRowLifting masked(width);
        for (uint32_t y = begin; y < end; ++y) {
          int32_t* row = whole.row(y).data();
          analyses() ? masked.analyse(row, mask->row(y), width, id_)
                     : masked.synthesise(row, mask->row(y), width, id_);
        }
        return;
      }
      RowLifting plain(width);
      for (uint32_t y = begin; y < end; ++y) {
        int32_t* row = whole.row(y).data();
        analyses() ? plain.analyse(row, width, id_, wide_)
                   : plain.synthesise(row, width, id_, wide_);
      }
    });
  }
  void liftColumns(const Block& whole, const std::optional<BlockMask>& mask) const {
    const Rows<int32_t> rows = whole.rows();
    inChunks(rows.width, [&](uint32_t begin, uint32_t end) {
      const Rows<int32_t> part{rows.first + begin, rows.pitch, rows.count, end - begin};
      if (mask) {
        liftMaskedColumns(part, mask->columns(begin, end), id_, direction_);
      } else {
        tetrakis::liftColumns(part, id_, direction_, wide_);
      }
    });
  }

  LiftedSignals signals() const { return {id_, direction_, wide_}; }

  /// Where held samples lie is what the analysis leaves there, which is not coded.
  void holdCoefficients(const Block& whole, Extent low, const HeldBlock& held) const {
    const bool columns = low.height < whole.extent.height;
    for (uint32_t y = 0; y < whole.extent.height; ++y) {
      const bool high_y = columns && y % 2 == 1;
      const std::span<int32_t> row = whole.row(y);
      hold(held.line(y, false), held.states().after(false, high_y), row.first(low.width));
      if (!held.splitsRows()) continue;
      hold(held.line(y, true), held.states().after(true, high_y), row.subspan(low.width));
    }
  }
  void liftHeldRows(const Block& whole, const std::optional<BlockMask>& mask,
                    const HeldBlock& held) const {
    inChunks(whole.extent.height, [&](uint32_t begin, uint32_t end) {
      HeldRowLifting lifting(whole.extent.width);
      for (uint32_t y = begin; y < end; ++y)
        lifting.lift(whole.row(y), mask ? mask->row(y) : nullptr, held, y, signals());
    });
  }
  void liftHeldColumns(const Block& whole, Extent low, const std::optional<BlockMask>& mask,
                       const HeldBlock& held) const {
    const Rows<int32_t> rows = whole.rows();
    inChunks(rows.width, [&](uint32_t begin, uint32_t end) {
      const Rows<int32_t> part{rows.first + begin, rows.pitch, rows.count, end - begin};
      const auto valid = mask ? mask->columns(begin, end) : Rows<const uint8_t>{};
      tetrakis::liftHeldColumns(part, mask ? &valid : nullptr, {&held, begin, low.width},
                                signals());
    });
  }
  void inChunks(uint32_t count, const std::function<void(uint32_t, uint32_t)>& lift) const {
    const uint32_t chunk = threads_ > 1 ? kChunk : count;
    parallelFor(threads_, (count + chunk - 1) / chunk, [&](size_t i) {
      const auto begin = static_cast<uint32_t>(i) * chunk;
      lift(begin, std::min(count, begin + chunk));
    });
  }

  FilterId id_;
  Direction direction_;
  bool doubles_, wide_, joint_, jointly_wide_;
  uint32_t threads_;
  Carrying carrying_;
};

/// All that a level splits.
Window wholeOf(const Pyramid& pyramid, int level) {
  const Extent whole = pyramid.low(level - 1).extent;
  return {0, 0, whole.width, whole.height};
}

/// The mask of all that a level splits; empty where all of it exists.
std::vector<uint8_t> maskOf(const Pyramid& pyramid, int level) {
  if (pyramid.valid().all()) return {};
  return pyramid.splitMask(level - 1, wholeOf(pyramid, level));
}

/// Which level of which pyramid; the ladder is there if something is held.
struct LevelOf {
  const Pyramid& pyramid;
  int level;
  const std::optional<HeldLadder>& ladder;
};

/// One level of a plane, or of the low band of a level, as a whole.
void runLevel(const LevelTransform& transform, const Block& whole, const LevelOf& of) {
  const auto& [pyramid, level, ladder] = of;
  const Extent low = pyramid.low(level).extent;
  if (!ladder) return transform.run(whole, low, maskOf(pyramid, level), nullptr);
  const HeldLevel states = ladder->level(level);
  const HeldBlock held(pyramid, states, level, wholeOf(pyramid, level));
  transform.run(whole, low, maskOf(pyramid, level), &held);
}

std::optional<HeldLadder> ladderOf(const WaveletSpec& spec, const Pyramid& pyramid) {
  if (pyramid.held().none()) return {};
  return HeldLadder(spec, pyramid);
}

}  // namespace

int carriedTo(const WaveletSpec& spec, const Pyramid& pyramid) {
  if (!pyramid.valid().all() || !pyramid.held().none()) return 0;
  const auto carries = [&](int level) {
    return spec.joint(level) && pyramid.splitsX(level) && pyramid.splitsY(level);
  };
  int last = 0;
  while (last < std::min(spec.first_doubled, pyramid.levels()) && carries(last + 1)) ++last;
  return last > 1 ? last : 0;
}

void inverseLevel(const WaveletSpec& spec, int level, const LevelBlock& block) {
  assert(block.values.size() == block.extent.samples());
  LevelTransform(spec, level, Direction::kSynthesis, 1)
      .carry({block.fractions_in, block.fractions_out, block.fractions})
      .run({block.values.data(), block.extent.width, block.extent}, block.low, block.existing,
           block.held);
}

std::vector<uint8_t> lowFractions(const WaveletSpec& spec, int level, const LevelBlock& block) {
  assert(block.values.size() == block.extent.samples());
  return LevelTransform(spec, level, Direction::kSynthesis, 1)
      .carry({block.fractions_in, block.fractions_out, block.fractions})
      .lowFractions({block.values.data(), block.extent.width, block.extent});
}

void forwardWavelet(const WaveletSpec& spec, const Pyramid& pyramid, std::span<int32_t> values,
                    uint32_t threads) {
  const std::optional<HeldLadder> ladder = ladderOf(spec, pyramid);
  const int carried = carriedTo(spec, pyramid);
  for (int level = 1; level <= pyramid.levels(); ++level) {
    runLevel(LevelTransform(spec, level, Direction::kAnalysis, threads)
                 .carry({level > 1 && level <= carried, level < carried, {}}),
             blockOf(pyramid, level - 1, 0, values), {pyramid, level, ladder});
  }
}

void inverseWavelet(const WaveletSpec& spec, const Pyramid& pyramid, std::span<int32_t> values,
                    const InverseOptions& options) {
  const int level = options.level;
  const std::optional<HeldLadder> ladder = ladderOf(spec, pyramid);
  const int carried = options.rounds && level == 0 ? carriedTo(spec, pyramid) : 0;
  std::vector<std::vector<uint8_t>> fractions(static_cast<size_t>(std::max(carried, 1)));
  const auto transformOf = [&](int split) {
    const bool in = split > 1 && split <= carried;
    return LevelTransform(spec, split, Direction::kSynthesis, options.threads)
        .carry({in, split < carried,
                in ? std::span<const uint8_t>(fractions[static_cast<size_t>(split - 1)])
                   : std::span<const uint8_t>()});
  };
  for (int split = 1; split < carried; ++split) {
    fractions[static_cast<size_t>(split)] =
        transformOf(split).lowFractions(blockOf(pyramid, split - 1, 0, values));
  }
  for (int split = pyramid.levels(); split > level; --split) {
    runLevel(transformOf(split), blockOf(pyramid, split - 1, level, values),
             {pyramid, split, ladder});
  }
}

}  // namespace tetrakis::inline wavelet

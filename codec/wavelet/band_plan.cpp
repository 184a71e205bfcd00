// SPDX-License-Identifier: Apache-2.0
#include "codec/wavelet/band_plan.hpp"

#include <algorithm>
#include <bit>
#include <cassert>
#include <utility>

namespace tetrakis::inline wavelet {

namespace {

/// The finest levels hold most coefficients and get contexts of their own. Orientations share
/// theirs: neighbours are named along and across the direction of the band, so that all look alike.
uint32_t modelsOf(const Subband& subband) {
  constexpr int kOwnLevels = kPlaneModels - 1;
  if (subband.orientation == Orientation::kLL) return kOwnLevels;
  return static_cast<uint32_t>(std::clamp(subband.level, 1, kOwnLevels) - 1);
}

/// The other details of a detail's level: HL, LH and HH follow each other.
std::array<int, 2> siblingsOf(std::span<const BandPart> parts, size_t index,
                              Orientation orientation, int first) {
  std::array<int, 2> siblings = {BandPlan::kNone, BandPlan::kNone};
  const size_t hl = index - (static_cast<size_t>(orientation) - 1);
  size_t count = 0;
  for (size_t i = hl; i < hl + kBandsPerLevel; ++i) {
    if (i != index && !parts[i].shape().empty()) siblings[count++] = first + static_cast<int>(i);
  }
  return siblings;
}

bool isParent(const Subband& of, const Subband& subband) {
  return of.patch == subband.patch && of.level == subband.level + 1 &&
         of.orientation == subband.orientation;
}

/// A row of the coefficients of a part.
struct Coefficients {
  const Subband& subband;
  uint32_t column;  ///< of the subband, where the part begins
  uint32_t y;       ///< of the plane

  uint32_t x(uint32_t at) const { return subband.sampleColumn(column + at); }
};

/// Calls mark(tier, columns) for the marked ones of 32 columns from `first` on: tiles are wide, so
/// that mostly all have one tier.
template <class Mark>
void forEachTier(const CoefficientPriorities& priorities, const Coefficients& line, uint32_t first,
                 uint32_t columns, const Mark& mark) {
  const int level = line.subband.level;
  const auto last = static_cast<uint32_t>(std::bit_width(columns)) - 1;
  const bool alike = priorities.alikeInRow(line.x(first), line.x(first + last), level);
  while (columns != 0) {
    const auto next = static_cast<uint32_t>(std::countr_zero(columns));
    const uint32_t marked = alike ? columns : columns & (0 - columns);
    mark(priorities.at(line.x(first + next), line.y, level), marked);
    columns &= ~marked;
  }
}

/// The tiers of a row of coefficients, absent ones too: of each tier so many words.
class TierRow {
 public:
  explicit TierRow(const BandShape& shape)
      : shape_(shape), words_(kPriorities * size_t{shape.words()}) {}

  void fill(const CoefficientPriorities& priorities, const Coefficients& line) {
    std::fill(words_.begin(), words_.end(), 0);
    present_ = {};
    for (uint32_t k = 0; k < shape_.words(); ++k) {
      forEachTier(priorities, line, 32 * k, shape_.valid(k), [&](uint8_t tier, uint32_t columns) {
        words_[tier * size_t{shape_.words()} + k] |= columns;
        present_[tier] = true;
      });
    }
  }

  /// absent: of the band, or empty.
  void put(uint32_t row, std::span<const uint32_t> absent, BandTiers& tiers) const {
    for (size_t tier = 0; tier < kPriorities; ++tier) {
      if (!present_[tier]) continue;
      const uint32_t* from = words_.data() + tier * shape_.words();
      const size_t first = shape_.word(row, 0);
      uint32_t* to = tiers.members.data() + tier * shape_.wordCells() + first;
      for (uint32_t k = 0; k < shape_.words(); ++k)
        to[k] = absent.empty() ? from[k] : from[k] & ~absent[first + k];
    }
  }

 private:
  const BandShape& shape_;
  std::vector<uint32_t> words_;
  std::array<bool, kPriorities> present_{};
};

}  // namespace

PlaneLayout::PlaneLayout(const WaveletSpec& spec, Pyramid pyramid, const PriorityMap& priorities,
                         const std::optional<SynthesisNorms>& norms)
    : whole_(spec.whole),
      pyramid_(std::move(pyramid)),
      norms_(norms ? *norms : SynthesisNorms(spec, pyramid_.levels())) {
  if (!priorities.empty()) priorities_.emplace(priorities);
}

namespace {

/// The subbands of the patch that a region lies in; the base lies in all patches.
std::pair<size_t, size_t> subbandsAt(std::span<const Subband> subbands, const Region& region) {
  if (region.isBase()) return {0, subbands.size()};
  const auto before = [](uint32_t row, const Subband& subband) { return row < subband.patch_row; };
  const auto end = std::upper_bound(subbands.begin(), subbands.end(), region.y0, before);
  const auto is_above = [&](const Subband& subband) { return subband.patch < end[-1].patch; };
  const auto begin = std::partition_point(subbands.begin(), end, is_above);
  return {static_cast<size_t>(begin - subbands.begin()),
          static_cast<size_t>(end - subbands.begin())};
}

}  // namespace

std::vector<BandPart> partsOf(std::span<const Subband> subbands, const Region& region) {
  std::vector<BandPart> parts;
  const auto [first, behind] = subbandsAt(subbands, region);
  // A region lies in one patch, and the base in all rows of all.
  const uint32_t above = region.isBase() ? 0 : subbands[first].patch_row;
  for (size_t i = first; i < behind; ++i) {
    const Subband& subband = subbands[i];
    if (!(subband.orientation == Orientation::kLL ? region.isBase() : region.holds(subband.level)))
      continue;
    // Sides of regions are multiples of 2^splits, so that low and high bands are cut alike.
    const auto range = [](uint32_t begin, uint32_t end, int splits, uint32_t size) {
      const uint32_t start = std::min(begin >> splits, size);
      const uint64_t round_up = (uint64_t{1} << splits) - 1;
      const auto last = static_cast<uint32_t>(std::min<uint64_t>((end + round_up) >> splits, size));
      return std::pair(start, last - start);
    };
    const auto [column, columns] = range(region.x0, region.x1, subband.splits_x, subband.width);
    const auto [row, rows] =
        range(region.y0 - above, region.y1 - above, subband.splits_y, subband.height);
    parts.push_back({i, column, row, columns, rows});
  }
  return parts;
}

std::vector<BandPlan> PlaneLayout::plan(std::span<const BandPart> parts, int first, int priority,
                                        uint32_t models) const {
  std::vector<BandPlan> bands;
  for (size_t i = 0; i < parts.size(); ++i) {
    const Subband& subband = subbands()[parts[i].subband];
    BandPlan band;
    band.shape = parts[i].shape();
    band.orientation = subband.orientation;
    band.log_norm = norms_.log16(subband) + priority;
    if (whole_ && (subband.level > 1 || subband.orientation == Orientation::kLL))
      band.key_floor = priority;
    band.models = models + modelsOf(subband);
    const size_t parent = i - kBandsPerLevel;  // LL is nobody's
    const bool has_parent = i >= kBandsPerLevel &&
                            isParent(subbands()[parts[parent].subband], subband) &&
                            !parts[parent].shape().empty();
    if (has_parent) band.parent = first + static_cast<int>(parent);
    if (band.orientation != Orientation::kLL)
      band.siblings = siblingsOf(parts, i, band.orientation, first);
    bands.push_back(band);
  }
  return bands;
}

std::vector<BandPlan> PlaneLayout::marked(std::span<const BandPart> parts,
                                          std::vector<BandPlan> plan) const {
  markAbsent(parts, plan);
  markTiers(parts, plan);
  return plan;
}

void PlaneLayout::markAbsent(std::span<const BandPart> parts, std::span<BandPlan> bands) const {
  const HeldSamples held = pyramid_.held();
  if (pyramid_.allExist() && held.none()) return;
  const auto isHeld = [&](uint32_t x, uint32_t y) {
    return held.numbers[size_t{y} * pyramid_.plane().width + x] != 0;
  };
  assert(bands.size() == parts.size());
  for (size_t i = 0; i < bands.size(); ++i) {
    const BandPart& part = parts[i];
    const Subband& subband = subbands()[part.subband];
    const BandShape& shape = bands[i].shape;
    bands[i].absent.assign(shape.wordCells(), 0);
    for (uint32_t row = 0; row < part.rows; ++row) {
      const uint32_t y = subband.planeRow(part.row + row);
      for (uint32_t first = 0; first < part.columns; first += 32) {
        const uint32_t x = subband.sampleColumn(part.column + first);
        uint32_t word = ~pyramid_.existing(subband, x, y);
        for (uint32_t k = 0; !held.none() && k < std::min(32u, part.columns - first); ++k)
          word |= uint32_t{isHeld(subband.sampleColumn(part.column + first + k), y)} << k;
        bands[i].absent[shape.word(row, first / 32)] = word & shape.valid(first / 32);
      }
    }
  }
}

void PlaneLayout::markTiers(std::span<const BandPart> parts, std::span<BandPlan> bands) const {
  if (!priorities_) return;
  assert(bands.size() == parts.size());
  for (size_t i = 0; i < bands.size(); ++i) {
    const BandPart& part = parts[i];
    const Subband& subband = subbands()[part.subband];
    const BandShape& shape = bands[i].shape;
    if (shape.empty()) continue;
    BandTiers tiers;
    tiers.members = ZeroedArray<uint32_t>(kPriorities * shape.wordCells());
    TierRow line(shape);
    for (uint32_t row = 0; row < part.rows; ++row) {
      const auto y = [&](uint32_t of_row) { return subband.planeRow(part.row + of_row); };
      if (row == 0 || !priorities_->alikeRows(y(row - 1), y(row), subband.level))
        line.fill(*priorities_, {subband, part.column, y(row)});
      line.put(row, bands[i].absent, tiers);
    }
    tiers.markBlocks(shape);
    bands[i].tiers = std::make_shared<const BandTiers>(std::move(tiers));
  }
}

std::vector<int32_t> PlaneLayout::gather(std::span<const int32_t> plane,
                                         const BandPart& part) const {
  assert(plane.size() == pyramid_.plane().samples());
  const BandShape shape = part.shape();
  const Subband& subband = subbands()[part.subband];
  std::vector<int32_t> values(shape.cells(), 0);
  for (uint32_t row = 0; row < part.rows; ++row) {
    const size_t first = pyramid_.indexOf(subband, part.row + row) + part.column;
    std::copy_n(plane.data() + first, part.columns, values.data() + shape.cell(row, 0));
  }
  return values;
}

void clearAbsent(const BandPlan& band, std::span<int32_t> values) {
  if (band.absent.empty()) return;
  const BandShape& shape = band.shape;
  for (uint32_t row = 0; row < shape.rows; ++row) {
    for (uint32_t x = 0; x < shape.words(); ++x) {
      uint32_t absent = band.absent[shape.word(row, x)];
      for (; absent != 0; absent &= absent - 1)
        values[shape.cell(row, 32 * x + static_cast<uint32_t>(std::countr_zero(absent)))] = 0;
    }
  }
}

}  // namespace tetrakis::inline wavelet

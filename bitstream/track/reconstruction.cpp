// SPDX-License-Identifier: Apache-2.0
#include "bitstream/track/reconstruction.hpp"

#include <algorithm>
#include <bit>

#include "bitstream/track/band_models.hpp"

namespace tetrakis::inline track {

namespace {

/// Offset of a significant coefficient from the low end of its interval, in 1/64 of the interval,
/// by the class of its neighbours' magnitudes. Means over terrain and aerial images.
constexpr std::array<int, BandModels::kLocal> kCentroid = {16, 19, 20, 22, 23, 25,
                                                           27, 28, 29, 30, 30};

}  // namespace

/// What the sign of each neighbour says about an insignificant coefficient, in 1/64 of the interval
/// that it is known to lie in. Means over terrain and aerial images.
Reconstruction::SignWeights Reconstruction::weightsOf(Orientation orientation) {
  if (orientation == Orientation::kLL) return {0, 0, 0};
  if (orientation == Orientation::kHH) return {-3, -3, 1};
  return {-8, 3, -1};
}

Reconstruction::Reconstruction(const Band& band, int fraction_bits)
    : band_(band),
      fraction_bits_(fraction_bits),
      neighbours_(band.shape, band.orientation),
      weights_(weightsOf(band.orientation)) {
  const size_t tiers = band.tiers == nullptr ? 1 : kPriorities;
  for (size_t tier = 0; tier < tiers; ++tier)
    tables_.push_back(tablesOf(band.tier_states[tier].plane));
}

Reconstruction::TierTables Reconstruction::tablesOf(int plane_of_tier) const {
  TierTables both;
  for (int above = 0; above < 2; ++above) {
    const int plane = plane_of_tier + above;
    if (plane == 0) continue;  // nothing is left open
    PlaneTables& tables = both[static_cast<size_t>(above)];
    for (size_t i = 0; i < kCentroid.size(); ++i) tables.rest[i] = fraction(kCentroid[i], plane);
    for (int hint = -kMostHint; hint <= kMostHint; ++hint)
      tables.guess[static_cast<size_t>(hint + kMostHint)] = fraction(hint, plane);
  }
  return both;
}

void Reconstruction::row(uint32_t row, int32_t* values) const {
  const BandShape& shape = band_.shape;
  for (uint32_t x = 0; x < shape.words(); ++x) {
    const uint32_t count = std::min(32u, shape.columns - 32 * x), valid = shape.valid(x);
    const size_t word = shape.word(row, x), first = shape.cell(row, 32 * x);
    const uint32_t here = band_.significant[word] & valid, visited = band_.visited[word];
    const uint32_t beside = band_.nearSignificant(word) & valid & ~here;
    int32_t* out = values + 32 * x;
    const bool known = band_.tiers == nullptr && band_.tier_states[0].plane == 0;
    if (known && (valid & ~visited) == 0) {
      exact(first, count, out);
      continue;
    }
    std::fill_n(out, count, 0);
    if (band_.tiers != nullptr) {
      for (size_t tier = 0; tier < kPriorities && (here | beside) != 0; ++tier)
        tierRow(tier, row, x, out);
      continue;
    }
    if ((here & visited) != 0) significant<0>(first, here & visited, out);
    if ((here & ~visited) != 0) significant<1>(first, here & ~visited, out);
    if (beside != 0) insignificant(first, beside, visited, out);
  }
}

/// Up to 32 columns that are known to the last bit.
void Reconstruction::exact(size_t first, uint32_t count, int32_t* out) const {
  const uint32_t* magnitude = band_.magnitude.data() + first;
  const int8_t* sign = band_.sign.data() + first;
  const int shift = fraction_bits_;
  std::array<uint32_t, 32> values;  // of whole words, for vector units
  for (size_t i = 0; i < values.size(); ++i) {
    const uint32_t negative = 0u - (sign[i] < 0);
    values[i] = ((magnitude[i] << shift) ^ negative) - negative;
  }
  std::copy_n(values.begin(), count, out);
}

/// 32 columns of a tier, whose neighbours may be known down to other planes.
void Reconstruction::tierRow(size_t tier, uint32_t row, uint32_t word, int32_t* out) const {
  const size_t index = band_.shape.word(row, word), first = band_.shape.cell(row, 32 * word);
  const uint32_t known = band_.significant[index] | band_.nearSignificant(index);
  for (uint32_t todo = known & band_.members(tier, row, word); todo != 0; todo &= todo - 1) {
    const auto i = static_cast<uint32_t>(std::countr_zero(todo));
    const size_t cell = first + i, above = ~(band_.visited[index] >> i) & 1;
    const int plane = band_.tier_states[tier].plane + static_cast<int>(above);
    const PlaneTables& tables = tables_[tier][above];
    if (((band_.significant[index] >> i) & 1) == 0) {
      out[i] = besideTiers(cell, plane, tables);
      continue;
    }
    const auto open = static_cast<uint32_t>(tables.rest[kLocalClass[localSum(band_, cell, plane)]]);
    const uint32_t value = (band_.magnitude[cell] << fraction_bits_) + open;
    out[i] = static_cast<int32_t>(band_.sign[cell] < 0 ? 0u - value : value);
  }
}

/// An insignificant coefficient. Neighbours count that are about as large as it may be at least.
int32_t Reconstruction::besideTiers(size_t cell, int plane, const PlaneTables& tables) const {
  const auto sign = [&](ptrdiff_t offset) {
    const size_t i = cell + static_cast<size_t>(offset);
    return (uint64_t{band_.magnitude[i]} << 1) >> plane != 0 ? int{band_.sign[i]} : 0;
  };
  const auto &near = neighbours_.near, &far = neighbours_.far;
  const int hint = weights_.along * (sign(near[0]) + sign(near[1])) +
                   weights_.across * (sign(near[2]) + sign(near[3])) +
                   weights_.diagonal * (sign(far[0]) + sign(far[1]) + sign(far[2]) + sign(far[3]));
  return tables.guess[static_cast<size_t>(hint + kMostHint)];
}

/// sixtyfourths / 64 of the open interval in output units, rounded towards zero. It reaches from
/// the least integer in it to the greatest.
int32_t Reconstruction::fraction(int sixtyfourths, int plane) const {
  const auto magnitude = static_cast<uint64_t>(sixtyfourths < 0 ? -sixtyfourths : sixtyfourths);
  const uint64_t interval = ((uint64_t{1} << plane) - 1) << fraction_bits_;
  const auto value = static_cast<int32_t>(static_cast<uint32_t>((magnitude * interval) >> 6));
  return sixtyfourths < 0 ? -value : value;
}

/// Writes those coefficients of 32 columns that are significant and known down to plane
/// band.plane + kAbove.
template <int kAbove>
void Reconstruction::significant(size_t first, uint32_t columns, int32_t* out) const {
  LocalSums sums;
  localSums<kAbove>(band_, first, sums);
  const std::array<int32_t, BandModels::kLocal>& rest = tables_[0][kAbove].rest;
  const uint32_t* magnitude = band_.magnitude.data() + first;
  const int8_t* sign = band_.sign.data() + first;
  for (; columns != 0; columns &= columns - 1) {
    const auto i = static_cast<uint32_t>(std::countr_zero(columns));
    const auto open = static_cast<uint32_t>(rest[kLocalClass[sums[i]]]);
    const uint32_t value = (magnitude[i] << fraction_bits_) + open;
    out[i] = static_cast<int32_t>(sign[i] < 0 ? 0u - value : value);
  }
}

void Reconstruction::insignificant(size_t first, uint32_t columns, uint32_t visited,
                                   int32_t* out) const {
  constexpr int kFew = 4;  // take less time one by one than all 32 by vectors
  const int8_t* s = band_.sign.data() + first;
  const auto &near = neighbours_.near, &far = neighbours_.far;
  const auto hint = [&](ptrdiff_t i) {
    const int along = s[i + near[0]] + s[i + near[1]], across = s[i + near[2]] + s[i + near[3]];
    const int diagonal = s[i + far[0]] + s[i + far[1]] + s[i + far[2]] + s[i + far[3]];
    return static_cast<int16_t>(kMostHint + weights_.along * along + weights_.across * across +
                                weights_.diagonal * diagonal);
  };
  const bool few = std::popcount(columns) <= kFew;
  std::array<int16_t, 32> hints;
  for (ptrdiff_t i = 0; i < 32 && !few; ++i) hints[static_cast<size_t>(i)] = hint(i);
  for (; columns != 0; columns &= columns - 1) {
    const auto i = static_cast<uint32_t>(std::countr_zero(columns));
    const size_t above = ~(visited >> i) & 1;
    out[i] = tables_[0][above].guess[static_cast<size_t>(few ? hint(i) : hints[i])];
  }
}

}  // namespace tetrakis::inline track

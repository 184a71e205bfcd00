// SPDX-License-Identifier: Apache-2.0
// Reconstruction picks the most likely value of a coefficient. Bit-planes leave an interval; its
// middle is not the best guess, because small magnitudes are more frequent, the more so where the
// neighbourhood is quiet, and because neighbours along the band's direction tend to alternate in
// sign. The rules cost no bytes: against 7/16 of the interval they save 2 to 3 %.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "bitstream/track/band.hpp"
#include "bitstream/track/band_models.hpp"

namespace tetrakis::inline track {

/// Reads the coefficients of a band.
class Reconstruction {
 public:
  /// Coefficients come in units of 2^-fraction_bits (0 to 8); those known to the last bit exactly.
  Reconstruction(const Band& band, int fraction_bits);

  /// All columns of a row.
  void row(uint32_t row, int32_t* values) const;

 private:
  struct SignWeights {
    int along, across, diagonal;
  };
  static SignWeights weightsOf(Orientation orientation);

  /// What the signs of the neighbours can say at most, in 1/64 of an interval.
  static constexpr int kMostHint = 26;
  /// What to make of coefficients that are known down to one plane.
  struct PlaneTables {
    std::array<int32_t, BandModels::kLocal> rest{};  ///< unknown part, by the neighbours' class
    std::array<int32_t, 2 * kMostHint + 1> guess{};  ///< [hint + kMostHint]: of insignificant ones
  };

  /// What is left open of the coefficients of a tier. [0]: known down to its plane, [1]: to the one
  /// above.
  using TierTables = std::array<PlaneTables, 2>;
  TierTables tablesOf(int plane) const;

  void exact(size_t first, uint32_t count, int32_t* out) const;
  void tierRow(size_t tier, uint32_t row, uint32_t word, int32_t* out) const;
  int32_t besideTiers(size_t cell, int plane, const PlaneTables& tables) const;

  template <int kAbove>
  void significant(size_t first, uint32_t columns, int32_t* out) const;
  void insignificant(size_t first, uint32_t columns, uint32_t visited, int32_t* out) const;
  int32_t fraction(int sixtyfourths, int plane) const;

  const Band& band_;
  int fraction_bits_;
  Neighbours neighbours_;
  SignWeights weights_;
  std::vector<TierTables> tables_;  ///< of each tier that the band may have
};

/// Reconstruction point of a magnitude known down to bit-plane `plane`, not knowing its
/// neighbours: what the encoder counts its distortion with.
inline uint32_t typicalMagnitude(uint32_t magnitude, int plane) {
  return magnitude == 0 ? 0 : magnitude + (((uint32_t{1} << plane) * 7) >> 4);
}

}  // namespace tetrakis::inline track

// SPDX-License-Identifier: Apache-2.0
// Plan states how a component is coded, as a value: what its samples are counted in, what makes
// their base, where the base is cut, what residual follows, and which layers lie around both. Plans
// can be compared and told to people; two codings of one component with equal plans differ in
// nothing that a plan states.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "bitstream/stream/coding_headers.hpp"

namespace tetrakis::inline plans {

/// What predicts the samples that a residual restores.
enum class Predictor : uint8_t {
  kNone,
  kDecoded,     ///< the decoded base alone
  kNeighbours,  ///< the base, and the errors of the exact steps beside a sample
  kRelative,    ///< multiples of a step beside the samples before
  kFacets       ///< planes and lines through the samples before
};

/// What follows the base.
struct Residual {
  enum class Kind : uint8_t { kNone, kWithin, kExact };

  Kind kind = Kind::kNone;
  double within = 0;  ///< kWithin only: the error that is left, in steps
  Predictor predictor = Predictor::kNone;

  bool operator==(const Residual&) const = default;
};

/// What lies around the base.
enum class Layer : uint8_t {
  kMask,       ///< of voids, ahead of the base
  kLateMask,   ///< of voids, within the base
  kBridges,    ///< the transform goes on over what is not coded
  kFlatAreas,  ///< shapes with a height
  kCutOut,     ///< alpha that is 0 or the largest value
  kOverlay,    ///< drawn over a photograph
  kPriorities,
  kRegions
};

struct Plan {
  Coding base = Coding::kWavelet;  ///< kStored: there is none, the samples are stored
  double step = 0;                 ///< in sample units; 0: a table's places, or texels
  uint32_t table_values = 0;       ///< of all tables together; 0: there is none
  /// Of level 1, of level 2, of all coarser ones. Nothing: there are no filters, or an estimate did
  /// without the choice of them.
  std::optional<std::array<uint8_t, 3>> filters = {};
  bool fractions = false;          ///< the transform keeps fractions: it does not end exact
  std::optional<double> cut = {};  ///< the RMSE, in steps, at which coefficients end; nothing: none
  Residual residual = {};
  std::vector<Layer> layers = {};  ///< in the order of the enumeration

  bool operator==(const Plan&) const = default;
};

}  // namespace tetrakis::inline plans

// SPDX-License-Identifier: Apache-2.0
// chooseFlatAreas() decides which flat areas of heights save more bytes than their shapes take, and
// which filters suit the other samples.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "base/plane.hpp"
#include "codec/geometry/flat/flat_areas.hpp"
#include "codec/geometry/heights_encoder.hpp"
#include "codec/wavelet/choice/filter_choice.hpp"

namespace tetrakis::inline coding_choice {

/// Areas and their codeword; both are empty if none pays.
struct FlatLayer {
  FlatAreas areas;
  std::vector<uint8_t> codeword;
  /// Bytes with the best areas that were looked at, over those without, by the estimate; nothing:
  /// there is hardly anything flat.
  std::optional<double> ratio = {};

  /// Options for coefficients beside the areas. The layer outlives the options.
  CoefficientOptions beside(CoefficientOptions options) const {
    if (!areas.empty()) options.flat = &areas;
    return options;
  }
};

/// The purpose for which heights in steps are coded.
struct HeightPurpose {
  int range_bits;  ///< the steps span less than 2^range_bits
  Purpose purpose;
  uint64_t bytes = UINT64_MAX;  ///< that there will be for them
  double mean_square = 0;       ///< > 0: the error wanted, in squared steps
  uint32_t threads = 1;         ///< nothing depends on them
  bool seen = false;            ///< heights of prefixes are shown without corrections
  SharedForest forest = {};     ///< that the heights are the raster of; null: of none
};

struct FlatChoice {
  FlatLayer flat;
  WaveletHeader wavelet;
};

/// Chooses the areas and the filters. heights: in steps, with the samples that are lifted. valid:
/// samples that are not void; its bytes outlive the call.
FlatChoice chooseFlatAreas(const PlaneView<const int32_t>& heights, Mask valid,
                           const HeightPurpose& purpose);

}  // namespace tetrakis::inline coding_choice

// SPDX-License-Identifier: Apache-2.0
#include "codec/drawing/drawing_models.hpp"

namespace tetrakis::inline drawing {

DrawingModels::DrawingModels()
    : pairs_(size_t{1} << kPairBits),
      singles_(size_t{1} << kSingleBits),
      indices_(size_t{1} << kDrawnIndexBits),
      rivals_(size_t{1} << kRivalBits),
      patterns_(size_t{2 * Candidates::kRanked} << kPatternBits),
      differences_(size_t{1} << kDifferencesBits),
      values_(size_t{1} << kValuesBits) {
  candidate_weights_.fill(freshWeights<5>());
}

}  // namespace tetrakis::inline drawing

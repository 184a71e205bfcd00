// SPDX-License-Identifier: Apache-2.0
#include "codec/geometry/steps/decoded_heights.hpp"

#include <utility>

namespace tetrakis::inline steps {

std::vector<int32_t> wholeSteps(DecodedGeometry decoded) {
  std::vector<int32_t> steps = std::move(decoded.heights);
  for (int32_t& q : steps) q = wholeStep(q, decoded.fraction_bits);
  return steps;
}

}  // namespace tetrakis::inline steps

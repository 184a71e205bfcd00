// SPDX-License-Identifier: Apache-2.0
// How far textures are from each other.
#pragma once

#include <cstddef>

#include "base/samples.hpp"

namespace tetrakis {

/// Summed over all samples of two textures of one shape.
inline double squaredError(const Texels& a, const Texels& b) {
  double sum = 0;
  for (size_t i = 0; i < a.samples.size(); ++i) {
    const double difference = double{1} * a.samples[i] - b.samples[i];
    sum += difference * difference;
  }
  return sum;
}

}  // namespace tetrakis

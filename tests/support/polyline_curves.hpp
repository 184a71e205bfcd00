// SPDX-License-Identifier: Apache-2.0
// Curves for the tests of polylines.
#pragma once

#include <cstdint>
#include <random>
#include <string>
#include <vector>

namespace tetrakis::test {

struct NamedCurve {
  std::string name;
  std::vector<double> heights;
};

/// Table 2.1 of the thesis (fig. 2.5a).
inline std::vector<double> zigzag() {
  return {0, 1, -2, 1, 0};
}

/// Whole heights: a walk, noise, steps, a straight line, a parabola, flat ground with one peak.
inline std::vector<NamedCurve> namedCurves(uint32_t knots, uint32_t seed) {
  std::minstd_rand random(seed);
  std::vector<NamedCurve> curves = {{"walk", {}},     {"noise", {}},    {"steps", {}},
                                    {"straight", {}}, {"parabola", {}}, {"peak", {}}};
  double height = 0;
  for (uint32_t k = 0; k < knots; ++k) {
    height += static_cast<double>(random() % 21) - 10;
    curves[0].heights.push_back(height);
    curves[1].heights.push_back(static_cast<double>(random() % 101));
    curves[2].heights.push_back(static_cast<double>(k / 3 * 7 % 4));
    curves[3].heights.push_back(3.0 * k - 5);
    curves[4].heights.push_back(static_cast<double>(k) * k);
    curves[5].heights.push_back(k == knots / 3 ? 50 : 0);
  }
  return curves;
}

}  // namespace tetrakis::test

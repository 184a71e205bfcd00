// SPDX-License-Identifier: Apache-2.0
// patches() makes heights of few values in patches with straight borders, which drawings code in
// the fewest bytes.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "conformance/samples/terrain_samples.hpp"

namespace tetrakis::samples {

/// Each sample has the value of the nearest of some sites, one of 0, 50, … 200.
inline Raster patches(uint32_t width, uint32_t height, uint32_t samples_a_site = 600) {
  struct Site {
    int64_t x, y;
    std::byte value;
  };
  std::vector<Site> sites;
  for (uint32_t i = 0; i < std::max(width * height / samples_a_site, 3u); ++i)
    sites.push_back(
        {hash(i, 0, 71) % width, hash(i, 1, 71) % height, std::byte(hash(i, 2, 71) % 5 * 50)});
  Raster heights = make({Pattern::kRidges, width, height, 1, TKS_U8, 3});
  for (size_t i = 0; i < heights.data.size(); ++i) {
    const auto x = static_cast<int64_t>(i % width), y = static_cast<int64_t>(i / width);
    const auto distance = [&](const Site& site) {
      return (site.x - x) * (site.x - x) + (site.y - y) * (site.y - y);
    };
    heights.data[i] =
        std::min_element(sites.begin(), sites.end(), [&](const Site& a, const Site& b) {
          return distance(a) < distance(b);
        })->value;
  }
  return heights;
}

}  // namespace tetrakis::samples

// SPDX-License-Identifier: Apache-2.0
#include "codec/mesh/surface/masked_surface.hpp"

#include <algorithm>

namespace tetrakis::inline surface {

namespace {

/// The mean of a valid sample and those around it with the weights 1 2 1 in x and y. Across a coast
/// or a border the surface goes on turned about its edge.
int32_t meanAt(const MaskedSurface& fine, int64_t x, int64_t y) {
  constexpr struct { int dx, dy, weight; } kPairs[] = {{1, 0, 2}, {0, 1, 2}, {1, 1, 1}, {1, -1, 1}};
  const std::vector<int32_t>& z = fine.surface.heights;
  const int64_t here = z[fine.at(x, y)];
  int64_t sum = 4 * here;
  for (const auto& [dx, dy, weight] : kPairs) {
    const bool both = fine.holds(x - dx, y - dy) && fine.holds(x + dx, y + dy);
    sum += weight *
           (both ? int64_t{z[fine.at(x - dx, y - dy)]} + z[fine.at(x + dx, y + dy)] : 2 * here);
  }
  return static_cast<int32_t>((sum + 8) >> 4);
}

MaskedSurface halved(const MaskedSurface& fine) {
  const uint32_t right = fine.surface.width - 1, bottom = fine.surface.height - 1;
  MaskedSurface coarse{{(right + 1) / 2 + 1, (bottom + 1) / 2 + 1, {}}, {}};
  const size_t count = size_t{coarse.surface.width} * coarse.surface.height;
  coarse.surface.heights.reserve(count);
  coarse.valid.reserve(count);
  for (uint32_t y = 0; y <= bottom + 1; y += 2) {
    for (uint32_t x = 0; x <= right + 1; x += 2) {
      const uint32_t column = std::min(x, right), row = std::min(y, bottom);
      const bool valid = fine.holds(column, row);
      coarse.surface.heights.push_back(valid ? meanAt(fine, column, row) : 0);
      coarse.valid.push_back(valid);
    }
  }
  return coarse;
}

}  // namespace

MaskedSurface maskedSurface(const WeightedSurface& surface, uint32_t levels) {
  const SurfaceView& view = surface.view;
  MaskedSurface masked{{view.width, view.height, {view.heights.begin(), view.heights.end()}},
                       {surface.known.begin(), surface.known.end()}};
  if (masked.valid.empty()) masked.valid.assign(view.heights.size(), 1);
  for (; levels > 0; --levels) masked = halved(masked);
  return masked;
}

}  // namespace tetrakis::inline surface

// SPDX-License-Identifier: Apache-2.0
#include "codec/mesh/surface/surface.hpp"

#include <algorithm>
#include <cassert>
#include <limits>

namespace tetrakis::inline surface {

namespace {

/// b and what lies around it with the weights 1 2 1.
int32_t mean(int64_t a, int64_t b, int64_t c) {
  return static_cast<int32_t>((a + 2 * b + c + 2) >> 2);
}

/// The height on the line from a over b, which are 2^k apart, `rest` < 2^k behind b.
int32_t beyond(int64_t a, int64_t b, uint32_t rest, uint32_t k) {
  const int64_t value = b + ((b - a) * rest >> k);
  return static_cast<int32_t>(std::clamp<int64_t>(value, std::numeric_limits<int32_t>::min(),
                                                  std::numeric_limits<int32_t>::max()));
}

}  // namespace

/// The overhang of the lattice is clamped onto the last sample.
uint32_t coarseSide(uint32_t side, uint32_t k) {
  return ((side - 2 + (uint32_t{1} << k)) >> k) + 1;
}

CoarseSurface coarsen(const SurfaceView& surface, uint32_t k) {
  assert(surface.heights.size() == size_t{surface.width} * surface.height);
  CoarseSurface coarse{coarseSide(surface.width, k), coarseSide(surface.height, k), {}};
  coarse.heights.reserve(size_t{coarse.width} * coarse.height);
  for (uint32_t y = 0; y < coarse.height; ++y) {
    const size_t row = size_t{std::min(y << k, surface.height - 1)} * surface.width;
    for (uint32_t x = 0; x < coarse.width; ++x)
      coarse.heights.push_back(surface.heights[row + std::min(x << k, surface.width - 1)]);
  }
  return coarse;
}

CoarseSurface smoothed(const SurfaceView& surface) {
  assert(surface.heights.size() == size_t{surface.width} * surface.height);
  const uint32_t right = surface.width - 1, bottom = surface.height - 1;
  CoarseSurface coarse{coarseSide(surface.width, 1), coarseSide(surface.height, 1), {}};
  coarse.heights.reserve(size_t{coarse.width} * coarse.height);
  std::vector<int32_t> line(surface.width);
  for (uint32_t y = 0; y <= bottom + 1; y += 2) {
    // Across a border the surface goes on turned about its edge: the mean is the sample there.
    const bool inside = y > 0 && y < bottom;
    const int32_t* here = &surface.heights[size_t{std::min(y, bottom)} * surface.width];
    const ptrdiff_t next = inside ? static_cast<ptrdiff_t>(surface.width) : 0;
    for (uint32_t x = 0; x <= right; ++x)
      line[x] = mean(*(here + x - next), here[x], *(here + x + next));
    coarse.heights.push_back(line[0]);
    for (uint32_t x = 2; x < right; x += 2)
      coarse.heights.push_back(mean(line[x - 1], line[x], line[x + 1]));
    coarse.heights.push_back(line[right]);
  }
  assert(coarse.heights.size() == size_t{coarse.width} * coarse.height);
  return coarse;
}

CoarseSurface ofMipLevel(std::span<const int32_t> level, uint32_t whole_width,
                         uint32_t whole_height, uint32_t k) {
  CoarseSurface coarse{coarseSide(whole_width, k), coarseSide(whole_height, k), {}};
  const uint32_t columns = ((whole_width - 1) >> k) + 1, rows = ((whole_height - 1) >> k) + 1;
  const uint32_t mask = (uint32_t{1} << k) - 1;
  assert(columns > 1 && rows > 1 && level.size() == size_t{columns} * rows);
  std::vector<int32_t>& heights = coarse.heights;
  heights.reserve(size_t{coarse.width} * coarse.height);
  for (uint32_t y = 0; y < rows; ++y) {
    const std::span<const int32_t> row = level.subspan(size_t{y} * columns, columns);
    heights.insert(heights.end(), row.begin(), row.end());
    if (coarse.width > columns)
      heights.push_back(beyond(row[columns - 2], row[columns - 1], (whole_width - 1) & mask, k));
  }
  if (coarse.height == rows) return coarse;
  for (uint32_t x = 0; x < coarse.width; ++x) {
    const size_t above = size_t{rows - 1} * coarse.width + x;
    heights.push_back(
        beyond(heights[above - coarse.width], heights[above], (whole_height - 1) & mask, k));
  }
  return coarse;
}

uint32_t wholeSample(uint32_t sample, uint32_t coarse_width, uint32_t whole_width,
                     uint32_t whole_height, uint32_t k) {
  assert(coarse_width > 0);
  const uint32_t x = std::min((sample % coarse_width) << k, whole_width - 1);
  const uint32_t y = std::min((sample / coarse_width) << k, whole_height - 1);
  return y * whole_width + x;
}

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

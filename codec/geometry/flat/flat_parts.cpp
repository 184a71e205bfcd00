// SPDX-License-Identifier: Apache-2.0
#include "codec/geometry/flat/flat_parts.hpp"

#include <algorithm>
#include <array>

namespace tetrakis::inline flat {

namespace {

/// Samples along a side of the parts. Larger parts judge coarse levels better, and take time.
constexpr uint32_t kPartSide = 128;
/// Parts that are taken with shores, with small flat areas, and without any. More of them choose
/// better, and take time: 16 of them make the choices of the whole plane.
constexpr std::array<size_t, 3> kMost = {8, 4, 4};
/// Planes of no more parts than this are judged whole, which takes time for each part more.
constexpr size_t kMostParts = 16;

/// The parts of a grid. The last row and column of parts take the rest of the plane.
std::vector<Window> partsOf(Extent plane) {
  const auto count = [](uint32_t side) { return std::max((side + kPartSide / 2) / kPartSide, 1u); };
  const uint32_t columns = count(plane.width), rows = count(plane.height);
  std::vector<Window> parts;
  for (uint32_t row = 0; row < rows; ++row) {
    const uint32_t y = row * kPartSide;
    const uint32_t height = row + 1 < rows ? kPartSide : plane.height - y;
    for (uint32_t column = 0; column < columns; ++column) {
      const uint32_t x = column * kPartSide;
      parts.push_back({x, y, column + 1 < columns ? kPartSide : plane.width - x, height});
    }
  }
  return parts;
}

/// Takes at most `most` of the parts, at equal distances.
void takeEvenly(const std::vector<Window>& parts, size_t most, std::vector<SampledPart>& taken) {
  const size_t count = std::min(parts.size(), most), before = taken.size();
  double all = 0, some = 0;
  for (const Window& part : parts) all += static_cast<double>(part.extent().samples());
  for (size_t i = 0; i < count; ++i) {
    taken.push_back({parts[(2 * i + 1) * parts.size() / (2 * count)], 0});
    some += static_cast<double>(taken.back().window.extent().samples());
  }
  for (size_t i = before; i < taken.size(); ++i) taken[i].stands_for = all / some;
}

}  // namespace

std::vector<SampledPart> sampleParts(const FlatFinder& finder, uint32_t large, uint32_t small) {
  const Extent plane = finder.extent();
  const std::vector<Window> parts = partsOf(plane);
  if (parts.size() <= kMostParts) return {{{0, 0, plane.width, plane.height}, 1}};
  std::array<std::vector<Window>, kMost.size()> kinds;
  for (const Window& part : parts) {
    const uint64_t in_large = finder.samplesOf(large, part);
    const bool shore = in_large > 0 && in_large < part.extent().samples();
    const bool flat = in_large == 0 && finder.samplesOf(small, part) > 0;
    kinds[shore ? 0 : flat ? 1 : 2].push_back(part);
  }
  std::vector<SampledPart> taken;
  for (size_t kind = 0; kind < kinds.size(); ++kind) takeEvenly(kinds[kind], kMost[kind], taken);
  return taken;
}

}  // namespace tetrakis::inline flat

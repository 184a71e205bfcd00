// SPDX-License-Identifier: Apache-2.0
#include "codec/geometry/flat/flat_encoder.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <utility>

#include "bitstream/coder/range_encoder.hpp"
#include "bitstream/stream/geometry_header.hpp"
#include "codec/geometry/flat/flat_pass.hpp"
#include "codec/wavelet/morphology.hpp"

namespace tetrakis::inline flat {

namespace {

/// visit(sample, owner): of a raster, where patches share a sample.
template <class Visit>
void forEachSharedIndex(const Forest& forest, const Visit& visit) {
  const size_t side = forest.side();
  const auto index = [&](const Forest::Place& at) {
    return (at.patch * side + static_cast<size_t>(at.y)) * side + static_cast<size_t>(at.x);
  };
  forest.forEachShared(forest.side() - 1, [&](const auto& sample, const auto& owner) {
    visit(index(sample), index(owner));
  });
}

/// Leaves in the mask of a forest what all patches mark that share a sample.
void keepCommon(const Forest& forest, std::vector<uint8_t>& mask) {
  forEachSharedIndex(forest, [&](size_t sample, size_t owner) { mask[owner] &= mask[sample]; });
  forEachSharedIndex(forest, [&](size_t sample, size_t owner) { mask[sample] = mask[owner]; });
}

}  // namespace

FlatFinder::FlatFinder(const PlaneView<const int32_t>& heights, const Forest* forest)
    : heights_(heights), forest_(forest) {
  const Extent extent = heights.extent();
  if (extent.samples() > GeometryLayers::kMostFlatSamples) return;
  const std::span<const int32_t> values = heights.values();
  JoinedLabels joined(extent.samples());
  const auto join = [&](uint32_t i, uint32_t j) {
    if (values[i] == values[j] && heights.valid[i] && heights.valid[j]) joined.join(i, j);
  };
  uint32_t i = 0;
  for (uint32_t y = 0; y < extent.height; ++y) {
    for (uint32_t x = 0; x < extent.width; ++x, ++i) {
      if (x > 0) join(i, i - 1);
      if (y > 0 && (forest == nullptr || y % forest->side() != 0)) join(i, i - extent.width);
    }
  }
  if (forest != nullptr) {
    forEachSharedIndex(*forest, [&](size_t sample, size_t owner) {
      join(static_cast<uint32_t>(sample), static_cast<uint32_t>(owner));
    });
  }
  areas_ = std::move(joined).earlier();
  for (i = 0; i < areas_.size(); ++i) {
    if (areas_[i] == i) {
      areas_[i] = kFirst + (heights.valid[i] ? 1 : 0);
      continue;
    }
    if ((areas_[areas_[i]] & kFirst) == 0) areas_[i] = areas_[areas_[i]];
    uint32_t& first = areas_[areas_[i]];
    if (first < kFirst + kMostSize) ++first;
  }
}

uint64_t FlatFinder::samplesOf(uint32_t least, const Window& window) const {
  if (none()) return 0;
  uint64_t sum = 0;
  for (uint32_t y = window.y; y < window.y + window.height; ++y) {
    const size_t row = size_t{y} * heights_.width;
    for (size_t k = row + window.x; k < row + window.x + window.width; ++k)
      sum += sizeAt(k) >= least;
  }
  return sum;
}

/// Marks the samples of areas of `least` samples or more, except where two areas touch.
std::vector<uint8_t> FlatFinder::marked(uint32_t least, const Window& window) const {
  std::vector<uint8_t> flat(window.extent().samples());
  const std::span<const int32_t> values = heights_.values();
  size_t i = 0, k = 0;  // of a sample in the window, and in the plane
  // Where areas of two heights touch, the smaller one gives way by a sample.
  const auto part = [&](size_t before, size_t k_before) {
    if ((flat[i] & flat[before]) == 0 || values[k] == values[k_before]) return;
    flat[sizeAt(k) <= sizeAt(k_before) ? i : before] = 0;
  };
  for (uint32_t y = 0; y < window.height; ++y) {
    k = size_t{window.y + y} * heights_.width + window.x;
    for (uint32_t x = 0; x < window.width; ++x, ++k, ++i) {
      if (sizeAt(k) < least) continue;
      flat[i] = 1;
      if (x > 0) part(i - 1, k - 1);
      if (y > 0) part(i - window.width, k - heights_.width);
    }
  }
  return flat;
}

FlatAreas FlatFinder::areas(const FlatShape& shape, const Window& window) const {
  assert(shape.least > 0 && window.isInside(extent()));
  if (none()) return {};
  std::vector<uint8_t> flat = marked(shape.least, window);
  if (shape.reach > 0) flat = opened(flat, window.extent(), shape.reach);
  if (isForest(window)) keepCommon(*forest_, flat);
  NumberedAreas numbered = numberAreas(PlaneView<const uint8_t>(flat, window.extent()),
                                       isForest(window) ? forest_ : nullptr);
  if (numbered.count == 0) return {};
  FlatAreas areas{std::move(numbered.numbers), std::vector<int32_t>(numbered.count)};
  const uint16_t* number = areas.numbers.data();
  for (uint32_t y = 0; y < window.height; ++y) {
    const int32_t* const shown = heights_.row(window.y + y) + window.x;
    for (uint32_t x = 0; x < window.width; ++x, ++number) {
      if (*number != 0) areas.heights[*number - 1u] = shown[x];
    }
  }
  return areas;
}

std::vector<uint8_t> encodeFlatAreas(const FlatAreas& areas, Extent plane, Mask valid) {
  assert(!areas.empty() && areas.numbers.size() == plane.samples());
  std::vector<uint8_t> flat(plane.samples());
  std::transform(areas.numbers.begin(), areas.numbers.end(), flat.begin(),
                 [](uint16_t number) { return static_cast<uint8_t>(number != 0); });
  DecisionEncoding io;
  const SharedBits valid_bits = sharedBits(valid, plane);
  FlatMaskIo<DecisionEncoding> mask_io(io, valid_bits.get(), flat.data());
  ValidityPass<FlatMaskIo<DecisionEncoding>>(plane, mask_io).run();
  std::vector<int32_t> heights = areas.heights;
  FlatHeightsPass<DecisionEncoding>(io).run(heights);
  std::vector<uint8_t> codeword = io.finish();
  if (codeword.empty()) codeword.push_back(0);  // flat_bytes is at least 1
  return codeword;
}

namespace {

/// Samples along a side of the parts. Larger parts judge coarse levels better, and take time.
constexpr uint32_t kPartSide = 128;
/// Parts that are taken with shores, with small flat areas, and without any. More of them choose
/// better, and take time: 16 of them make the choices of the whole plane.
constexpr std::array<size_t, 3> kMost = {8, 4, 4};
/// Planes of no more parts than this are judged whole, which takes time for each part more.
constexpr size_t kMostParts = 16;

/// The parts of a grid. The last row and column of parts take the rest of the plane.
std::vector<Window> gridOf(Extent plane) {
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

/// Those of a plane, or of each patch.
std::vector<Window> partsOf(Extent plane, uint32_t patch_rows) {
  const uint32_t rows = patch_rows > 0 ? patch_rows : plane.height;
  const std::vector<Window> first = gridOf({plane.width, rows});
  std::vector<Window> parts;
  for (uint32_t y = 0; y < plane.height; y += rows)
    for (const Window& part : first) parts.push_back({part.x, y + part.y, part.width, part.height});
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

std::vector<SampledPart> sampleParts(const FlatFinder& finder, uint32_t large, uint32_t small,
                                     uint32_t patch_rows) {
  const Extent plane = finder.extent();
  const std::vector<Window> parts = partsOf(plane, patch_rows);
  if (parts.size() <= kMostParts && patch_rows == 0)
    return {{{0, 0, plane.width, plane.height}, 1}};
  if (parts.size() <= kMostParts) {
    std::vector<SampledPart> patches;
    for (uint32_t y = 0; y < plane.height; y += patch_rows)
      patches.push_back({{0, y, plane.width, patch_rows}, 1});
    return patches;
  }
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

// SPDX-License-Identifier: Apache-2.0
#include "codec/geometry/flat_encoder.hpp"

#include <algorithm>
#include <cassert>
#include <utility>

#include "bitstream/coder/decision_encoding.hpp"
#include "bitstream/stream/header.hpp"
#include "codec/geometry/flat_pass.hpp"

namespace tetrakis::inline geometry {

FlatFinder::FlatFinder(const PlaneView<const int32_t>& heights) : heights_(heights) {
  const Extent extent = heights.extent();
  if (extent.samples() > GeometryLayers::kMostFlatSamples) return;
  const std::span<const int32_t> values = heights.values();
  first_ = firstSamples(extent, [&](uint32_t i, uint32_t j) {
    return values[i] == values[j] && heights.valid[i] && heights.valid[j];
  });
  sizes_.resize(first_.size());
  for (size_t i = 0; i < first_.size(); ++i) sizes_[first_[i]] += heights.valid[i];
}

uint64_t FlatFinder::samplesOf(uint32_t least) const {
  uint64_t sum = 0;
  for (const uint32_t size : sizes_) sum += size >= least ? size : 0;
  return sum;
}

FlatAreas FlatFinder::areas(uint32_t least) const {
  assert(least > 0);
  const std::span<const int32_t> values = heights_.values();
  std::vector<uint8_t> flat(first_.size());
  for (size_t k = 0; k < flat.size(); ++k)
    flat[k] = heights_.valid[k] && sizes_[first_[k]] >= least;
  // Where areas of two levels touch, the smaller one gives way by a sample.
  const auto part = [&](size_t a, size_t b) {
    if ((flat[a] & flat[b]) == 0 || values[a] == values[b]) return;
    flat[sizes_[first_[a]] <= sizes_[first_[b]] ? a : b] = 0;
  };
  if (flat.empty()) return {};
  size_t i = 0;
  for (uint32_t y = 0; y < heights_.height; ++y) {
    for (uint32_t x = 0; x < heights_.width; ++x, ++i) {
      if (x > 0) part(i, i - 1);
      if (y > 0) part(i, i - heights_.width);
    }
  }
  NumberedAreas numbered = numberAreas(PlaneView<const uint8_t>(flat, heights_.extent()));
  if (numbered.count == 0) return {};
  FlatAreas areas{std::move(numbered.numbers), std::vector<int32_t>(numbered.count)};
  for (size_t k = 0; k < values.size(); ++k) {
    if (areas.numbers[k] != 0) areas.levels[areas.numbers[k] - 1u] = values[k];
  }
  return areas;
}

std::vector<uint8_t> encodeFlatAreas(const FlatAreas& areas, Extent plane, Mask valid) {
  assert(!areas.empty() && areas.numbers.size() == plane.samples());
  std::vector<uint8_t> flat(plane.samples()), known(plane.samples());
  std::transform(areas.numbers.begin(), areas.numbers.end(), flat.begin(),
                 [](uint16_t number) { return static_cast<uint8_t>(number != 0); });
  DecisionEncoding io;
  FlatMaskIo<DecisionEncoding> mask_io(io, valid, flat.data());
  ValidityPass<FlatMaskIo<DecisionEncoding>>({known, plane}, mask_io).run();
  std::vector<int32_t> levels = areas.levels;
  FlatLevelsPass<DecisionEncoding>(io).run(levels);
  std::vector<uint8_t> codeword = io.finish();
  if (codeword.empty()) codeword.push_back(0);  // flat_bytes is at least 1
  return codeword;
}

}  // namespace tetrakis::inline geometry

// SPDX-License-Identifier: Apache-2.0
#include "codec/geometry/flat_encoder.hpp"

#include <algorithm>
#include <cassert>
#include <utility>

#include "bitstream/coder/range_encoder.hpp"
#include "bitstream/stream/header.hpp"
#include "codec/geometry/flat_pass.hpp"

namespace tetrakis::inline geometry {

namespace {

class FlatEncoding {
 public:
  bool decide(AdaptiveBit& model, bool answer) {
    encoder_.encode(model, answer);
    return answer;
  }
  bool even(bool answer) {
    encoder_.encodeEven(answer);
    return answer;
  }
  bool stopped() const { return false; }
  std::vector<uint8_t> finish() {
    std::vector<uint8_t> codeword = encoder_.finish();
    if (codeword.empty()) codeword.push_back(0);
    return codeword;
  }

 private:
  RangeEncoder encoder_;
};

/// The sizes of areas, at their first samples.
std::vector<uint32_t> sizesOf(const std::vector<uint32_t>& first) {
  std::vector<uint32_t> sizes(first.size());
  for (const uint32_t i : first) ++sizes[i];
  return sizes;
}

/// Where areas of two levels touch, the smaller one gives way by a sample.
void separate(const PlaneView<const int32_t>& heights, const std::vector<uint32_t>& first,
              const std::vector<uint32_t>& sizes, std::vector<uint8_t>& flat) {
  const auto part = [&](uint32_t i, uint32_t j) {
    if ((flat[i] & flat[j]) == 0 || heights.data[i] == heights.data[j]) return;
    flat[sizes[first[i]] <= sizes[first[j]] ? i : j] = 0;
  };
  for (uint32_t i = 0; i < flat.size(); ++i) {
    if (i % heights.width > 0) part(i, i - 1);
    if (i >= heights.width) part(i, i - heights.width);
  }
}

}  // namespace

FlatAreas findFlatAreas(const PlaneView<const int32_t>& heights, uint32_t least) {
  const Extent extent = heights.extent();
  const std::span<const int32_t> values = heights.values();
  if (extent.samples() > GeometryLayers::kMostFlatSamples) return {};
  const std::vector<uint32_t> first = firstSamples(extent, [&](uint32_t i, uint32_t j) {
    return values[i] == values[j] && heights.valid[i] && heights.valid[j];
  });
  const std::vector<uint32_t> sizes = sizesOf(first);
  std::vector<uint8_t> flat(values.size());
  for (size_t i = 0; i < flat.size(); ++i) flat[i] = heights.valid[i] && sizes[first[i]] >= least;
  separate(heights, first, sizes, flat);
  NumberedAreas numbered = numberAreas(PlaneView<const uint8_t>(flat, extent));
  if (numbered.count == 0) return {};
  FlatAreas areas{std::move(numbered.numbers), std::vector<int32_t>(numbered.count)};
  for (size_t i = 0; i < values.size(); ++i) {
    if (areas.numbers[i] != 0) areas.levels[areas.numbers[i] - 1u] = values[i];
  }
  return areas;
}

std::vector<uint8_t> encodeFlatAreas(const FlatAreas& areas, Extent plane, Mask valid) {
  assert(!areas.empty() && areas.numbers.size() == plane.samples());
  std::vector<uint8_t> flat(plane.samples()), known(plane.samples());
  std::transform(areas.numbers.begin(), areas.numbers.end(), flat.begin(),
                 [](uint16_t number) { return static_cast<uint8_t>(number != 0); });
  FlatEncoding io;
  FlatMaskIo<FlatEncoding> mask_io(io, valid, flat.data());
  ValidityPass<FlatMaskIo<FlatEncoding>>({known, plane}, mask_io).run();
  std::vector<int32_t> levels = areas.levels;
  FlatLevelsPass<FlatEncoding>(io).run(levels);
  return io.finish();
}

}  // namespace tetrakis::inline geometry

// SPDX-License-Identifier: Apache-2.0
#include "codec/geometry/drawn_heights/drawn_heights_encoder.hpp"

#include <cmath>
#include <memory>
#include <unordered_map>
#include <utility>
#include <vector>

#include "base/portable_math.hpp"
#include "bitstream/stream/geometry_header.hpp"
#include "codec/drawing/drawing_encoding.hpp"
#include "codec/drawing/drawing_pass.hpp"
#include "codec/drawing/drawing_prefixes.hpp"
#include "codec/geometry/drawn_heights/drawn_heights_decoder.hpp"

namespace tetrakis::inline drawn_heights {

namespace {

using NumberedSteps = Numbered<int32_t>;

/// The list of values and the number of each sample's value in it, 0 for voids; nothing if there
/// are too many values.
std::optional<NumberedSteps> number(const PlaneView<const int32_t>& heights) {
  NumberedSteps out;
  out.numbers.resize(heights.extent().samples());
  std::unordered_map<int32_t, DrawnIndex> known;
  DrawnIndex last = kNoIndex;
  for (size_t i = 0; i < out.numbers.size(); ++i) {
    if (!heights.valid[i]) continue;
    const int32_t step = heights.data[i];
    if (last == kNoIndex || step != out.values[last]) {
      const auto [entry, added] =
          known.try_emplace(step, static_cast<DrawnIndex>(out.values.size()));
      if (added && out.values.size() == kMostDrawnValues) return {};
      if (added) out.values.push_back(step);
      last = entry->second;
    }
    out.numbers[i] = last;
  }
  return out;
}

double squaredError(const PlaneView<const int32_t>& heights, const DrawnSurface& surface) {
  std::vector<int32_t> shown(surface.extent.samples());
  surface.fill(shown.data());
  const double unit = portable::exp2(-DrawnSurface::kFractionBits);
  double squares = 0;
  for (size_t i = 0; i < shown.size(); ++i) {
    if (!heights.valid[i]) continue;
    const double error = shown[i] * unit - heights.data[i];
    squares += error * error;
  }
  return squares;
}

}  // namespace

std::optional<EncodedTrack> encodeDrawnHeights(const PlaneView<const int32_t>& heights) {
  const std::optional<NumberedSteps> numbered = number(heights);
  if (!numbered) return {};
  const Extent extent = heights.extent();
  std::vector<KeptIndex> indices(extent.samples());
  const PlaneView<KeptIndex> plane(indices, extent);
  const SharedBits valid = sharedBits(heights.valid, extent);
  const std::vector<Level> levels = levelsOf(heights.width, heights.height);
  DrawnSteps steps;
  const DrawnSurface surface{indices, extent, valid.get(),
                             steps,   levels, {0, 0, extent.width, extent.height}};
  DrawingEncoding<int32_t> io(*numbered, 0, [&] { return squaredError(heights, surface); });
  DrawingPass(plane, valid.get(), steps, io).run(levels);
  return io.finishTrack(GeometryHeader::kDirectPlanes);
}

namespace {

using HeightPrefixes = DrawingPrefixes<DrawnSteps, int32_t>;

}  // namespace

std::function<DecodedGeometry(uint64_t bytes)> prefixesOfDrawing(const GeometryHeader& header,
                                                                 std::span<const uint8_t> codeword,
                                                                 Mask valid) {
  const Extent extent = header.extent();
  const SharedBits marks = sharedBits(valid, extent);
  std::vector<Level> levels = levelsOf(extent.width, extent.height);
  const auto prefixes =
      std::make_shared<HeightPrefixes>(codeword, extent, marks.get(), levels, DrawnSteps());
  const Window whole{0, 0, extent.width, extent.height};
  return [=, levels = std::move(levels)](uint64_t bytes) {
    return decodedHeights(
        {prefixes->indicesAfter(bytes), extent, marks.get(), prefixes->list(), levels, whole});
  };
}

}  // namespace tetrakis::inline drawn_heights

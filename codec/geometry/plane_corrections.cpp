// SPDX-License-Identifier: Apache-2.0
#include "codec/geometry/plane_corrections.hpp"

#include <algorithm>
#include <cassert>
#include <optional>
#include <utility>

#include "base/parallel.hpp"
#include "bitstream/stream/geometry_header.hpp"
#include "codec/geometry/corrections/corrections_decoder.hpp"
#include "codec/geometry/facets/facet_coder.hpp"
#include "codec/geometry/relative/relative_pass.hpp"
#include "codec/geometry/steps/decoded_heights.hpp"

namespace tetrakis::inline geometry {

namespace {

/// The heights with corrections in units of `correction_step` steps.
DecodedGeometry correctedSteps(DecodedGeometry geometry, uint32_t correction_step,
                               std::span<const uint8_t> codeword) {
  const std::vector<uint8_t> hints = activityHints(geometry.significant, geometry.extent());
  const uint32_t unit = correction_step << geometry.fraction_bits;
  const auto add = [&](size_t first, std::span<const int32_t> row) {
    for (size_t x = 0; x < row.size(); ++x) {
      int32_t& height = geometry.heights[first + x];
      height = static_cast<int32_t>(static_cast<uint32_t>(height) +
                                    static_cast<uint32_t>(row[x]) * unit);
    }
  };
  decodeCorrections(codeword, {hints, geometry.extent(), geometry.valid}, add);
  return geometry;
}

/// The heights with corrections to whole steps. The fraction that a height has beside its sample is
/// an error of the cut, which surfaces and meshes need not show.
DecodedGeometry exactSteps(DecodedGeometry geometry, std::span<const uint8_t> codeword) {
  const auto put = [&](size_t first, std::span<const int32_t> row) {
    for (size_t x = 0; x < row.size(); ++x) {
      const uint32_t whole = static_cast<uint32_t>(row[x]) << geometry.fraction_bits;
      geometry.heights[first + x] = static_cast<int32_t>(whole);
    }
  };
  decodeExactSteps(codeword, {geometry.heights, geometry.extent(), geometry.valid},
                   geometry.fraction_bits, put);
  return geometry;
}

/// The heights with corrections of samples, added to the corrections of a table of values, if there
/// is one.
DecodedHeights correctedSamples(DecodedHeights decoded, const GeometryHeader& header,
                                std::span<const uint8_t> codeword) {
  const DecodedGeometry& geometry = decoded.geometry;
  const std::vector<uint8_t> hints = sampleHints(geometry.heights, geometry.fraction_bits, header);
  std::vector<int32_t>& corrections = decoded.corrections;
  corrections.resize(geometry.heights.size());
  const auto add = [&](size_t first, std::span<const int32_t> row) {
    for (size_t x = 0; x < row.size(); ++x) {
      int32_t& sum = corrections[first + x];
      sum = static_cast<int32_t>(static_cast<uint32_t>(sum) + static_cast<uint32_t>(row[x]));
    }
  };
  decodeCorrections(codeword, {hints, geometry.extent(), geometry.valid}, add);
  return decoded;
}

/// One part, or its first rows, with its corrections.
DecodedHeights correctedPart(DecodedHeights part, const GeometryHeader& header,
                             const GeometryLayers& layers, std::span<const uint8_t> codeword) {
  switch (layers.corrections) {
    case CorrectionKind::kNone:
      break;
    case CorrectionKind::kSteps:
      part.geometry = layers.correction_step > 1 ? correctedSteps(std::move(part.geometry),
                                                                  layers.correction_step, codeword)
                                                 : exactSteps(std::move(part.geometry), codeword);
      break;
    case CorrectionKind::kSamples:
      return correctedSamples(std::move(part), header, codeword);
    case CorrectionKind::kRelative:
      return restoreRelative(std::move(part), header, layers.relative, codeword);
    case CorrectionKind::kFacets:
      return restoreFacets(std::move(part), header, layers.facet_unit, codeword);
  }
  return part;
}

/// Writes the corrected values of a part into a window of a plane.
void put(const DecodedHeights& part, const Window& window, DecodedHeights& whole) {
  const auto copy = [&](const std::vector<int32_t>& from, std::vector<int32_t>& to) {
    for (uint32_t y = 0; y < window.height && !from.empty(); ++y) {
      const auto row = from.begin() + static_cast<ptrdiff_t>(size_t{y} * window.width);
      const size_t place = (size_t{window.y} + y) * whole.geometry.width + window.x;
      std::copy_n(row, window.width, to.begin() + static_cast<ptrdiff_t>(place));
    }
  };
  copy(part.geometry.heights, whole.geometry.heights);
  copy(part.corrections, whole.corrections);
}

/// A part that a view shows.
struct ShownPart {
  size_t number;
  Window window;  ///< in the view
  std::span<const uint8_t> codeword;
};

std::vector<ShownPart> shownParts(const std::vector<Window>& parts, const Codewords& codewords,
                                  const View& view, Extent shown) {
  assert(codewords.size() == parts.size());
  std::vector<ShownPart> some;
  for (size_t i = 0; i < parts.size(); ++i) {
    const Window& part = parts[i];
    const uint64_t x = uint64_t{part.x} - view.firstColumn(),
                   y = uint64_t{part.y} - view.firstRow();
    if (codewords[i].empty() || x >= shown.width || y >= shown.height) continue;
    assert(x + part.width <= shown.width && y + part.height <= shown.height);
    some.push_back({i,
                    {static_cast<uint32_t>(x), static_cast<uint32_t>(y), part.width, part.height},
                    codewords[i]});
  }
  return some;
}

/// The rectangle of whole parts around a window.
Window partsAround(const std::vector<Window>& parts, const Window& window) {
  uint32_t x0 = window.x, y0 = window.y, x1 = x0 + window.width, y1 = y0 + window.height;
  for (const Window& part : parts) {
    if (!part.meets(window)) continue;
    x0 = std::min(x0, part.x);
    y0 = std::min(y0, part.y);
    x1 = std::max(x1, part.x + part.width);
    y1 = std::max(y1, part.y + part.height);
  }
  return {x0, y0, x1 - x0, y1 - y0};
}

}  // namespace

View correctedView(const GeometryHeader& header, const GeometryLayers& layers, const View& view) {
  const bool corrects = view.level == 0 && layers.corrections != CorrectionKind::kNone;
  if (!view.window || !corrects) return view;
  if (correctionTracks(header, layers) > 0)
    return {0, partsAround(correctionParts(header), *view.window)};
  // Hints of steps know the row below.
  const uint32_t hints = layers.corrections == CorrectionKind::kSteps ? 1 : 0;
  const uint32_t rows = std::min(view.window->y + view.window->height + hints, header.height);
  if (rows == header.height) return {};
  return {0, Window{0, 0, header.width, rows}};
}

DecodedHeights corrected(DecodedHeights decoded, const TakenLayers& taken, const View& view,
                         const DecodeContext<CorrectedParts>& context) {
  assert(view.level == 0);
  const GeometryHeader& header = taken.header;
  const GeometryLayers& stated = taken.stated;
  if (correctionTracks(header, stated) == 0) {
    decoded.geometry.quiet_levels = 0;
    return correctedPart(std::move(decoded), header, stated, taken.corrections.front());
  }
  const std::vector<ShownPart> parts =
      shownParts(correctionParts(header), taken.corrections, view, decoded.geometry.extent());
  if (parts.empty()) return decoded;
  decoded.geometry.quiet_levels = 0;
  if (stated.restoresSamples()) decoded.corrections.resize(decoded.geometry.heights.size());
  CorrectedParts::Call call(context.memory, taken.corrections.size());
  parallelFor(context.threads, parts.size(), [&](size_t i) {
    const auto& [number, window, codeword] = parts[i];
    DecodedHeights before = viewOf(decoded, {0, window});
    if (context.memory == nullptr)
      return put(correctedPart(std::move(before), header, stated, codeword), window, decoded);
    std::optional<CorrectedPart>& part = call.at(number);
    if (!part || !part->isOf(before, codeword)) {
      DecodedHeights after = correctedPart(before, header, stated, codeword);
      part = CorrectedPart{std::move(before), codeword.size(), std::move(after)};
    }
    put(part->after, window, decoded);
    call.keepIfFits(number);
  });
  return decoded;
}

bool CorrectedPart::isOf(const DecodedHeights& heights, std::span<const uint8_t> codeword) const {
  const DecodedGeometry &a = before.geometry, &b = heights.geometry;
  return codeword.size() == codeword_bytes && a.fraction_bits == b.fraction_bits &&
         a.heights == b.heights && a.significant == b.significant && a.valid == b.valid &&
         before.corrections == heights.corrections;
}

uint64_t CorrectedPart::bytes() const {
  const auto bytesOf = [](const DecodedHeights& heights) {
    const DecodedGeometry& geometry = heights.geometry;
    return (geometry.heights.size() + heights.corrections.size()) * sizeof(int32_t) +
           geometry.significant.size() + geometry.valid.size();
  };
  return bytesOf(before) + bytesOf(after);
}

DecodedHeights viewOf(const DecodedHeights& decoded, const View& view) {
  const DecodedGeometry& geometry = decoded.geometry;
  const auto cut_out = [&]<class T>(const std::vector<T>& values) {
    return slice(std::span<const T>(values), geometry.extent(), view);
  };
  const Extent shown = view.extentIn(geometry.extent());
  DecodedHeights part;
  part.geometry.width = shown.width;
  part.geometry.height = shown.height;
  part.geometry.fraction_bits = geometry.fraction_bits;
  part.geometry.heights = cut_out(geometry.heights);
  part.geometry.significant = cut_out(geometry.significant);
  part.geometry.valid = cut_out(geometry.valid);
  part.corrections = cut_out(decoded.corrections);
  return part;
}

}  // namespace tetrakis::inline geometry

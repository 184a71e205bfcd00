// SPDX-License-Identifier: Apache-2.0
// decodeCoefficients() turns the coefficients of a view into heights, and ShownSignificance marks
// the vertices that have significant ones.
#include "codec/geometry/heights_decoder.hpp"

#include <algorithm>
#include <bit>
#include <cassert>
#include <optional>
#include <span>
#include <utility>

#include "codec/wavelet/band_plan.hpp"
#include "codec/wavelet/held_lifting.hpp"
#include "codec/wavelet/synthesis/view_synthesis.hpp"
#include "codec/wavelet/wavelet.hpp"

namespace tetrakis::inline geometry {

ShownSignificance::ShownSignificance(const Pyramid& pyramid, const View& view, size_t tracks)
    : pyramid_(pyramid),
      level_(view.level),
      low_(pyramid.low(view.level)),
      shown_low_(pyramid, view),
      shown_(shown_low_.window),
      is_window_(view.window.has_value()),
      marks_(shown_.extent().samples()),
      quiet_(tracks, pyramid.levels() - view.level) {}

void ShownSignificance::take(size_t track, std::span<const Band> bands,
                             std::span<const BandPart> parts) {
  for (size_t i = 0; i < parts.size(); ++i) {
    const Subband& subband = pyramid_.subbands()[parts[i].subband];
    if (!pyramid_.isIn(subband, level_)) continue;
    mark(bands[i], subband, parts[i]);
    if (bands[i].nonzero() && subband.orientation != Orientation::kLL)
      quiet_[track] = std::min(quiet_[track], subband.level - 1 - level_);
  }
}

void ShownSignificance::giveTo(DecodedGeometry& geometry) {
  assert(!quiet_.empty());
  if (!is_window_) {
    geometry.quiet_levels = static_cast<uint32_t>(*std::min_element(quiet_.begin(), quiet_.end()));
    marks_.resize(thin(pyramid_, level_, std::span(marks_)));
  } else {
    shown_low_.thin(marks_);
  }
  geometry.significant = std::move(marks_);
}

/// Marks the vertices that the significant coefficients of the part belong to.
void ShownSignificance::mark(const Band& band, const Subband& subband, const BandPart& part) {
  if (band.shape.empty()) return;
  const int splits = subband.splits_x - low_.splits_x;
  const size_t first = (subband.isHighX() ? size_t{1} << (splits - 1) : 0) - shown_.x;
  for (uint32_t row = 0; row < part.rows; ++row) {
    const uint32_t y = pyramid_.lowRow(subband, part.row + row, level_) - shown_.y;
    if (y >= shown_.height) continue;
    uint8_t* out = marks_.data() + size_t{y} * shown_.width;
    for (uint32_t x = 0; x < band.shape.words(); ++x) {
      uint32_t todo = band.significant[band.shape.word(row, x)];
      for (; todo != 0; todo &= todo - 1) {
        const size_t column =
            part.column + 32 * size_t{x} + static_cast<size_t>(std::countr_zero(todo));
        const size_t shown = first + (column << splits);
        if (shown < shown_.width) out[shown] = 1;
      }
    }
  }
}

namespace {

/// Where the plane is flat, its heights are exact at all mip levels.
void holdShown(const HeldSamples& flat, Extent plane, const View& view,
               std::vector<int32_t>& heights) {
  if (flat.none()) return;
  const Extent extent = view.extentIn(plane);
  for (uint32_t y = 0; y < extent.height; ++y) {
    const size_t row = size_t{view.rowOf(y)} * plane.width;
    hold({flat.numbers.data() + row + view.firstColumn(), view.step()}, flat.values,
         std::span(heights).subspan(size_t{y} * extent.width, extent.width));
  }
}

/// The layout of the plane. Held samples outlive it. memory: null, or that of earlier calls.
PlaneLayout layoutOf(const GeometryHeader& header, const SampleMarks& lifted, HeldSamples flat,
                     TrackMemory* memory) {
  const WaveletSpec spec = specOf(header.wavelet);
  PlaneLayout layout(spec, pyramidOf(spec, lifted, header.extent(), flat),
                     priorityMapOf(header.priorities, header.extent()),
                     memory != nullptr ? memory->norms : std::nullopt);
  if (memory != nullptr) memory->norms = layout.norms();
  return layout;
}

}  // namespace

DecodedGeometry decodeCoefficients(const GeometryHeader& header, const Codewords& codewords,
                                   KnownSamples known, const View& view,
                                   const DecodeContext<TrackMemory>& context) {
  std::vector<int32_t> area_heights(known.flat.values.begin(), known.flat.values.end());
  const HeldSamples flat{known.flat.numbers, area_heights};
  const PlaneLayout layout = layoutOf(
      header, known.lifted ? SampleMarks(*known.lifted) : known.valid, flat, context.memory);
  const std::vector<Region> regions =
      regionsOf(header.width, header.height, header.regions.side_log2, header.wavelet.patches());
  assert(codewords.size() == regions.size());
  ViewSynthesis synthesis(specOf(header.wavelet), layout.pyramid(), view);
  synthesis.allocate();
  ShownSignificance significance(layout.pyramid(), view, regions.size());
  const RegionDecoder tracks{header.wavelet, header.regions, header.planes, view.level, context};
  const TrackBands bands{
      [&](size_t i) { return neededParts(synthesis, layout.subbands(), regions[i]); },
      [&](size_t i) {
        const std::vector<BandPart> parts = layout.parts(regions[i]);
        return layout.marked(parts, layout.plan(parts));
      }};
  const int fraction_bits =
      tracks.run(codewords, bands, [&](size_t i, const TrackState& state, int more_bits) {
        const std::vector<BandPart> parts = layout.parts(regions[i]);
        for (size_t k = 0; k < parts.size(); ++k)
          synthesis.put(state.bands[k], more_bits, parts[k]);
        significance.take(i, state.bands, parts);
      });
  // The layout holds these values, which get fraction bits like those of the synthesis.
  for (int32_t& height : area_heights) height <<= fraction_bits;
  const Extent extent = view.extentIn(header.extent());
  DecodedGeometry out;
  out.width = extent.width;
  out.height = extent.height;
  out.heights = synthesis.run(context.threads);
  out.fraction_bits = fraction_bits;
  out.valid = known.valid.shown(view);
  clearUnmarked(std::span(out.heights), out.valid);
  significance.giveTo(out);
  clearUnmarked(std::span(out.significant), out.valid);
  holdShown(flat, header.extent(), view, out.heights);
  return out;
}

}  // namespace tetrakis::inline geometry

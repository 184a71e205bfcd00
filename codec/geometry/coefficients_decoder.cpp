// SPDX-License-Identifier: Apache-2.0
#include "codec/geometry/coefficients_decoder.hpp"

#include <algorithm>
#include <cassert>
#include <optional>
#include <span>
#include <utility>

#include "codec/geometry/shown_significance.hpp"
#include "codec/wavelet/band_plan.hpp"
#include "codec/wavelet/held_lifting.hpp"
#include "codec/wavelet/synthesis/view_synthesis.hpp"
#include "codec/wavelet/wavelet_header.hpp"

namespace tetrakis::inline geometry {

namespace {

/// Where the plane is flat, its heights are exact at all mip levels.
void holdShown(const HeldSamples& flat, Extent plane, const View& view,
               std::vector<int32_t>& heights) {
  if (flat.none()) return;
  const Extent extent = view.extentIn(plane);
  for (uint32_t y = 0; y < extent.height; ++y) {
    const size_t row = (view.firstRow() + size_t{y} * view.step()) * plane.width;
    hold({flat.numbers.data() + row + view.firstColumn(), view.step()}, flat.values,
         std::span(heights).subspan(size_t{y} * extent.width, extent.width));
  }
}

/// The bands of a track, with marks of the parts that the view needs; empty: it needs none.
std::vector<BandPlan> planOf(const PlaneLayout& layout, std::span<const BandPart> parts,
                             const ViewSynthesis& synthesis) {
  std::vector<BandPlan> plan = withNeeds(synthesis, parts, layout.plan(parts));
  return plan.empty() ? plan : layout.marked(parts, std::move(plan));
}

/// The layout of the plane. Held samples outlive it. memory: null, or that of earlier calls.
PlaneLayout layoutOf(const GeometryHeader& header, const SharedBits& lifted, HeldSamples flat,
                     TrackMemory* memory) {
  PlaneLayout layout(specOf(header.wavelet), Pyramid(lifted, header.extent(), flat),
                     priorityMapOf(header.priorities, header.extent()),
                     memory != nullptr ? memory->norms : std::nullopt);
  if (memory != nullptr) memory->norms = layout.norms();
  return layout;
}

}  // namespace

DecodedGeometry decodeCoefficients(const GeometryHeader& header, const Codewords& codewords,
                                   KnownSamples known, const View& view,
                                   const DecodeContext<TrackMemory>& context) {
  assert(context.memory == nullptr || !view.window);
  std::vector<int32_t> area_heights(known.flat.values.begin(), known.flat.values.end());
  const HeldSamples flat{known.flat.numbers, area_heights};
  const PlaneLayout layout =
      layoutOf(header, known.lifted.value_or(known.valid), flat, context.memory);
  const std::vector<Region> regions =
      regionsOf(header.width, header.height, header.regions.side_log2);
  assert(codewords.size() == regions.size());
  ViewSynthesis synthesis(specOf(header.wavelet), layout.pyramid(), view);
  synthesis.allocate();
  ShownSignificance significance(layout.pyramid(), view, regions.size());
  const RegionDecoder tracks{header.wavelet, header.regions, header.planes, view.level, context};
  const int fraction_bits = tracks.run(
      codewords, [&](size_t i) { return planOf(layout, layout.parts(regions[i]), synthesis); },
      [&](size_t i, const TrackState& state, int more_bits) {
        const std::vector<BandPart> parts = layout.parts(regions[i]);
        for (size_t k = 0; k < parts.size(); ++k)
          synthesis.put(state.bands[k], more_bits, parts[k]);
        significance.take(i, state, parts);
      });
  // The layout holds these values, which get fraction bits like those of the synthesis.
  for (int32_t& height : area_heights) height <<= fraction_bits;
  const Extent extent = view.extentIn(header.extent());
  DecodedGeometry out;
  out.width = extent.width;
  out.height = extent.height;
  out.heights = synthesis.run(context.threads);
  out.fraction_bits = fraction_bits;
  out.valid = shownMarks(known.valid, view);
  clearUnmarked(std::span(out.heights), out.valid);
  significance.giveTo(out);
  clearUnmarked(std::span(out.significant), out.valid);
  holdShown(flat, header.extent(), view, out.heights);
  return out;
}

}  // namespace tetrakis::inline geometry

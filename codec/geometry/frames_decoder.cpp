// SPDX-License-Identifier: Apache-2.0
// decodeFrame() decodes heights in frames: the masks of all frames, then the planes, of which one
// is shown.
#include <algorithm>
#include <cstddef>
#include <memory>
#include <utility>

#include "codec/frames/frame_reference.hpp"
#include "codec/geometry/heights_decoder.hpp"
#include "codec/wavelet/morphology.hpp"
#include "codec/wavelet/wavelet.hpp"

namespace tetrakis::inline geometry {

FrameLayout frameLayoutOf(const GeometryHeader& header) {
  return {header.extent(), header.frames, header.wavelet, header.regions, header.planes};
}

FrameMasks frameMasksOf(const TakenLayers& taken, HeightsMemory* memory) {
  const bool whole = memory != nullptr && taken.validity.size() == taken.stated.validity_bytes;
  if (whole && !memory->frame_masks.empty()) return memory->frame_masks;
  FrameMasks masks =
      decodeFrameMasks(taken.validity, taken.header.extent(), taken.header.frames.count);
  if (whole) memory->frame_masks = masks;
  return masks;
}

namespace {

/// What a view shows of all frames, with the vertices that have a coefficient in one of them.
FramePlanes decodeAll(const TakenLayers& taken, const SharedBits& lifted, const View& view,
                      const DecodeContext<TrackMemory>& context) {
  const FrameLayout layout = frameLayoutOf(taken.header);
  TrackMemory* const memory = context.memory;
  const FramePlan plan(layout, lifted, memory != nullptr ? memory->norms : std::nullopt);
  if (memory != nullptr) memory->norms = plan.layout().norms();
  ShownSignificance significance(plan.layout().pyramid(), view, plan.regions().size());
  const auto take = [&](size_t track, std::span<const Band> bands,
                        std::span<const BandPart> parts) {
    for (; !bands.empty(); bands = bands.subspan(parts.size()))
      significance.take(track, bands.first(parts.size()), parts);
  };
  const auto before = referenceOf(layout.frames);
  FramePlanes all = decodeFramePlanes(layout, plan, joinCoefficients(taken).codewords, view,
                                      before.get(), context, take);
  DecodedGeometry marks;
  significance.giveTo(marks);
  all.significant = std::move(marks.significant);
  all.quiet_levels = marks.quiet_levels;
  if (before != nullptr && !view.window) {  // meshes are made of whole levels
    const std::vector<uint8_t> earlier = slice(std::span(before->significant), layout.extent, view);
    for (size_t i = 0; i < all.significant.size(); ++i) all.significant[i] |= earlier[i];
    const auto level = static_cast<uint32_t>(view.level);
    const uint32_t quiet = before->quiet_levels - std::min(before->quiet_levels, level);
    all.quiet_levels = std::min(all.quiet_levels, quiet);
  }
  return all;
}

std::shared_ptr<const FramePlanes> framesOf(const TakenLayers& taken, const FrameMasks& masks,
                                            const View& view,
                                            const DecodeContext<HeightsMemory>& context) {
  HeightsMemory* const memory = context.memory;
  const uint64_t known = taken.validity.size() + bytesOf(joinCoefficients(taken).codewords);
  if (memory != nullptr && memory->frames.holds(view, known)) return memory->frames.planes;
  const SharedBits ever = everValid(masks);
  const SharedBits lifted =
      taken.stated.bridge > 0 ? liftedSamples(ever, taken.stated.bridge) : ever;
  TrackMemory* const tracks = memory != nullptr && taken.isOpened() ? &memory->tracks : nullptr;
  auto planes = std::make_shared<const FramePlanes>(
      decodeAll(taken, lifted, view, {context.threads, tracks}));
  if (memory != nullptr) memory->frames = {view, known, planes};
  return planes;
}

}  // namespace

DecodedGeometry decodeFrame(const TakenLayers& taken, const View& view,
                            const DecodeContext<HeightsMemory>& context) {
  const FrameMasks masks = frameMasksOf(taken, context.memory);
  const std::shared_ptr<const FramePlanes> all = framesOf(taken, masks, view, context);
  const Extent extent = view.extentIn(taken.header.extent());
  DecodedGeometry out;
  out.width = extent.width;
  out.height = extent.height;
  out.heights = all->planes[view.frame];
  out.fraction_bits = all->fraction_bits;
  out.significant = all->significant;
  out.quiet_levels = all->quiet_levels;
  out.valid = shownMarks(masks[view.frame], view);
  clearUnmarked(std::span(out.heights), out.valid);
  clearUnmarked(std::span(out.significant), out.valid);
  return out;
}

FrameReference lastFrame(const GeometryHeader& header, const GeometryLayers& layers,
                         const Codewords& codewords, const DecodeContext<HeightsMemory>& context) {
  const View view{0, {}, header.frames.count - 1u};
  const DecodedGeometry shown = decodeFrame(takeApart(codewords, header, layers), view, context);
  FrameReference last;
  last.planes.push_back(filledReference(wholeSteps(shown.heights, shown.fraction_bits), shown.valid,
                                        header.extent()));
  last.significant = shown.significant;
  last.quiet_levels = shown.quiet_levels;
  return last;
}

}  // namespace tetrakis::inline geometry

// SPDX-License-Identifier: Apache-2.0
#include "codec/frames/frame_planes.hpp"

#include <cassert>
#include <utility>

#include "base/parallel.hpp"
#include "codec/frames/frame_reference.hpp"
#include "codec/wavelet/synthesis/view_synthesis.hpp"
#include "codec/wavelet/wavelet.hpp"

namespace tetrakis::inline frames {

FramePlan::FramePlan(const FrameLayout& of, const SharedBits& lifted,
                     const std::optional<SynthesisNorms>& norms)
    : of_(of),
      layout_(specOf(of.wavelet), Pyramid(lifted, of.extent), {}, norms),
      regions_(regionsOf(of.extent.width, of.extent.height, of.regions.side_log2)),
      norms_(of.frames) {}

std::optional<uint32_t> FramePlan::companionOf(uint32_t plane) const {
  const uint32_t colours = of_.colours(), frame = plane / colours;
  if (plane % colours > 0) return plane - 1;
  const uint32_t coarser = coarserFrame(frame, of_.frames.count);
  if (coarser == frame || of_.frames.filter == TimeFilter::kNone) return std::nullopt;
  return coarser * colours;
}

std::vector<BandPlan> FramePlan::bands(std::span<const BandPart> parts) const {
  std::vector<BandPlan> bands;
  for (uint32_t p = 0; p < of_.planes(); ++p) {
    const uint32_t frame = p / of_.colours(), colour = p % of_.colours();
    const int priority = of_.priorities[colour] + norms_.log16(frame);
    const auto first = static_cast<int>(bands.size());
    std::vector<BandPlan> plan = layout_.plan(parts, first, priority, kPlaneModels * (colour > 0));
    if (p == 0) plan = layout_.marked(parts, std::move(plan));
    const std::optional<uint32_t> companion = companionOf(p);
    for (size_t i = 0; i < plan.size(); ++i) {
      if (companion) plan[i].companion = static_cast<int>(*companion * parts.size() + i);
      if (p > 0) plan[i].absent = bands[i].absent;
      bands.push_back(std::move(plan[i]));
    }
  }
  return bands;
}

uint64_t FramePlanes::bytes() const {
  uint64_t bytes = significant.capacity();
  for (const std::vector<int32_t>& plane : planes) bytes += plane.capacity() * sizeof(int32_t);
  return bytes;
}

FramePlanes decodeFramePlanes(const FrameLayout& of, const FramePlan& plan,
                              const Codewords& codewords, const View& view,
                              const FrameReference* before,
                              const DecodeContext<TrackMemory>& context, const TakeBands& take) {
  std::vector<ViewSynthesis> synthesis(
      of.planes(), ViewSynthesis(specOf(of.wavelet), plan.layout().pyramid(), view));
  for (ViewSynthesis& plane : synthesis) plane.allocate();
  const RegionDecoder tracks{of.wavelet, of.regions, of.bit_planes, view.level, context};
  const TrackBands bands{[&](size_t track) {
                           return neededParts(synthesis.front(), plan.layout().subbands(),
                                              plan.regions()[track]);
                         },
                         [&](size_t track) { return plan.bands(plan.parts(track)); }};
  FramePlanes out;
  out.fraction_bits =
      tracks.run(codewords, bands, [&](size_t track, const TrackState& state, int more_bits) {
        const std::vector<BandPart> parts = plan.parts(track);
        for (size_t k = 0; k < state.bands.size(); ++k)
          synthesis[k / parts.size()].put(state.bands[k], more_bits, parts[k % parts.size()]);
        if (take) take(track, state.bands, parts);
      });
  out.planes.resize(synthesis.size());
  parallelFor(context.threads, synthesis.size(),
              [&](size_t p) { out.planes[p] = synthesis[p].run(1); });
  for (uint32_t c = 0; c < of.colours(); ++c) {
    if (before != nullptr)
      addReference(before->planes[c], of.extent, view, out.fraction_bits, out.planes[c]);
    FrameViews frames;
    for (uint32_t p = c; p < of.planes(); p += of.colours()) frames.emplace_back(out.planes[p]);
    inverseFrames(of.frames, out.fraction_bits, frames);
  }
  return out;
}

}  // namespace tetrakis::inline frames

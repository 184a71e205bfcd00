// SPDX-License-Identifier: Apache-2.0
#include "wavelet/choice/typical_plane.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "wavelet/wavelet_header.hpp"

namespace tetrakis::inline choice {

TypicalPlane::Part::Part(PlanePart part, const WaveletHeader& header, size_t shown)
    : samples(std::move(part)),
      layout(specOf(header), samples.extent, samples.valid, {}),
      coefficients(withFractions(samples.values, header.fraction_bits)) {
  forwardWavelet(specOf(header), layout.pyramid(), coefficients);
  const size_t coded = markedIn(samples.extent, samples.valid);
  share = static_cast<double>(shown) / static_cast<double>(std::max<size_t>(coded, 1));
}

TypicalPlane::TypicalPlane(const PlaneView<const int32_t>& plane, int bits, Purpose purpose,
                           Mask shown) {
  const WaveletHeader header = chooseWavelet(plane, bits, purpose);
  unit_ = std::exp2(header.fraction_bits);
  size_t samples = 0;
  const Extent extent = plane.extent();
  const IsCoded is_shown = shown.all() ? IsCoded() : [&](size_t i) { return shown[i]; };
  for (const Window& window : typicalParts(extent, kUsualSide, is_shown)) {
    const std::vector<uint8_t> here = cut(shown.bytes(), extent, {0, window});
    const size_t shown_here = markedIn(window.extent(), here);
    samples += shown_here;
    parts_.emplace_back(partOf(plane, {}, window), header, shown_here);
  }
  whole_ = static_cast<double>(markedIn(extent, shown)) /
           static_cast<double>(std::max<size_t>(samples, 1));
}

PlaneCost TypicalPlane::cost(double step) const {
  PlaneCost sum;
  for (const Part& part : parts_) {
    const PlaneCost cost = costOf(part.layout, part.coefficients, step * unit_);
    sum.bits += whole_ * cost.bits;
    sum.squares += whole_ * part.share * cost.squares / (unit_ * unit_);
  }
  return sum;
}

double TypicalPlane::step(double bits) const {
  constexpr int kMost = 60;
  int log2 = 0;
  while (log2 < kMost && cost(std::exp2(log2)).bits > bits) ++log2;
  return std::exp2(log2);
}

PlaneCost typicalCost(const PlaneView<const int32_t>& plane, int bits, double step) {
  return TypicalPlane(plane, bits, step == 0 ? Purpose::kLossless : Purpose::kLossy).cost(step);
}

}  // namespace tetrakis::inline choice

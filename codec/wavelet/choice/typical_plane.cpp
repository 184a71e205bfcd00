// SPDX-License-Identifier: Apache-2.0
#include "codec/wavelet/choice/typical_plane.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "base/portable_math.hpp"
#include "codec/wavelet/wavelet.hpp"

namespace tetrakis::inline choice {

namespace {

/// log2 of the coarsest step that is looked for; every plane fits it.
constexpr int kMostStepLog2 = 60;

}  // namespace

TypicalPlane::Part::Part(PlanePart part, const WaveletHeader& header, size_t shown)
    : samples(std::move(part)),
      layout(specOf(header), Pyramid(samples.extent, samples.valid)),
      coefficients(withFractions(samples.values, header.fraction_bits)),
      wavelet(header) {
  forwardWavelet(specOf(header), layout.pyramid(), coefficients);
  const size_t coded = markedIn(samples.extent, samples.valid);
  share = static_cast<double>(shown) / static_cast<double>(std::max<size_t>(coded, 1));
}

TypicalPlane::TypicalPlane(const PlaneView<const int32_t>& plane, int bits, Purpose purpose,
                           Mask shown) {
  const WaveletHeader header = chooseWavelet(plane, bits, purpose);
  unit_ = portable::exp2(header.fraction_bits);
  size_t samples = 0;
  const Extent extent = plane.extent();
  const IsCoded is_shown = shown.all() ? IsCoded() : [&](size_t i) { return shown[i]; };
  for (const Window& window : typicalParts(extent, kUsualSide, is_shown)) {
    const std::vector<uint8_t> here = slice(shown.bytes(), extent, {0, window});
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
  int log2 = 0;
  while (log2 < kMostStepLog2 && cost(portable::exp2(log2)).bits > bits) ++log2;
  return portable::exp2(log2);
}

namespace {

/// What a decoder makes of coefficients that are known down to a step.
void requantise(std::span<int32_t> coefficients, double step) {
  constexpr double kBeyond = 7. / 16;  // as in typicalMagnitude()
  for (int32_t& c : coefficients) {
    const double level = std::trunc(std::abs(c) / step);
    const double known = level == 0 ? 0 : (level + kBeyond) * step;
    c = static_cast<int32_t>(std::lround(std::copysign(known, c)));
  }
}

}  // namespace

std::vector<TypicalPlane::Shown> TypicalPlane::shown(double step) const {
  std::vector<Shown> all;
  for (const Part& part : parts_) {
    std::vector<int32_t> values = part.coefficients;
    const Pyramid& pyramid = part.layout.pyramid();
    for (size_t i = 0; i < part.layout.subbands().size(); ++i) {
      const Subband& band = part.layout.subbands()[i];
      const double own = step * unit_ / std::sqrt(part.layout.energy(i));
      for (uint32_t y = 0; y < band.height; ++y)
        requantise(std::span(values).subspan(pyramid.indexOf(band, y), band.width), own);
    }
    inverseWavelet(specOf(part.wavelet), pyramid, values);
    all.push_back({part.samples, std::move(values), part.wavelet.fraction_bits});
  }
  return all;
}

PlaneCost typicalCost(const PlaneView<const int32_t>& plane, int bits, double step) {
  return TypicalPlane(plane, bits, step == 0 ? Purpose::kLossless : Purpose::kLossy).cost(step);
}

}  // namespace tetrakis::inline choice

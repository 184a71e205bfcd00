// SPDX-License-Identifier: Apache-2.0
#include "texture_wavelet/colour/colour_fit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "base/portable_math.hpp"
#include "codec/wavelet/choice/typical_plane.hpp"

namespace tetrakis::inline colour {

namespace {

/// The colours of lossy streams are taken up to this many times the bits of the best ones, because
/// prefixes are better with them. A larger number takes bytes.
constexpr double kAboutAsFew = 1.01;

constexpr int16_t kOne = 1 << kShearFractionBits;

/// Differences to channel kChannelOrders[order][0], and its mean with them: RCT (ISO/IEC 15444-1,
/// G.2) where that is green.
ColourTransform reversible(const ColourTransform& none, uint8_t order) {
  ColourTransform transform = none;
  transform.order = order;
  transform.shears = {0, -kOne, 0, -kOne, kOne / 4, kOne / 4};
  return transform;
}

struct Sample {
  Extent extent;
  std::vector<std::vector<int32_t>> planes;
};

Sample sampleOf(const Window& part, std::span<const int32_t* const> planes, Extent whole) {
  Sample sample{part.extent(), {}};
  for (const int32_t* plane : planes)
    sample.planes.push_back(slice(std::span(plane, whole.samples()), whole, {0, part}));
  return sample;
}

/// About the bits of a plane: log2(1 + |x - (west + north - northwest)|) a sample.
double bitsOf(const std::vector<int32_t>& plane, uint32_t width, uint32_t height) {
  constexpr double kLarge = 1e200;  // one logarithm for many factors, each below 1e20
  double bits = 0, product = 1;
  for (uint32_t y = 1; y < height; ++y) {
    const int32_t *row = plane.data() + size_t{y} * width, *above = row - width;
    for (uint32_t x = 1; x < width; ++x) {
      const double residual = row[x] - row[x - 1] - above[x] + above[x - 1];
      product *= 1 + std::abs(residual);
      if (product > kLarge) bits += portable::log2(std::exchange(product, 1));
    }
  }
  return bits + portable::log2(product);
}

/// The estimated bits of all planes. The shears of coefficients are left out.
double bitsOf(std::vector<Sample> samples, const ColourTransform& transform) {
  double bits = 0;
  for (Sample& sample : samples) {
    std::vector<int32_t*> pointers;
    for (std::vector<int32_t>& plane : sample.planes) pointers.push_back(plane.data());
    forwardColour(transform, pointers, sample.planes.front().size(), 0);
    for (const std::vector<int32_t>& plane : sample.planes)
      bits += bitsOf(plane, sample.extent.width, sample.extent.height);
  }
  return bits;
}

}  // namespace

ColourTransform chooseLosslessColour(std::span<const int32_t* const> channels, Extent extent) {
  const ColourTransform none = centred(channels, extent.samples());
  if (channels.size() < 3) return none;
  const ColourAxes axes = fitAxes(channels, extent, Purpose::kLossless);
  // One order for each channel that may come first; that of the other two makes no difference.
  std::vector<ColourTransform> candidates = {none, reversible(none, 0), reversible(none, 2),
                                             reversible(none, 4)};
  candidates.push_back(rotated(none, axes.overall));
  if (!axes.levels.empty()) candidates.push_back(rotated(none, axes.levels.front()));
  std::vector<Sample> samples;
  for (const Window& part : typicalParts(extent))
    samples.push_back(sampleOf(part, channels, extent));
  ColourTransform best;
  double least = std::numeric_limits<double>::infinity();
  for (const ColourTransform& candidate : candidates) {
    const double bits = bitsOf(samples, candidate);
    if (bits >= least) continue;
    least = bits;
    best = candidate;
  }
  const ColourTransform lossy = fitColour(channels, extent);
  if (bitsOf(samples, lossy) <= kAboutAsFew * least) return lossy;
  constexpr double kStep = 1;  // what is left when the last bits are coded
  return turnLevels(best, axes, kStep).transform;
}

}  // namespace tetrakis::inline colour

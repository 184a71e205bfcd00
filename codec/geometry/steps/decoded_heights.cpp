// SPDX-License-Identifier: Apache-2.0
#include "codec/geometry/steps/decoded_heights.hpp"

#include <algorithm>
#include <limits>
#include <span>
#include <type_traits>
#include <utility>

#include "base/samples.hpp"
#include "codec/geometry/steps/restore.hpp"
#include "codec/geometry/steps/sample_order.hpp"
#include "codec/geometry/steps/step_units.hpp"

namespace tetrakis::inline steps {

std::vector<int32_t> wholeSteps(DecodedGeometry decoded) {
  std::vector<int32_t> steps = std::move(decoded.heights);
  for (int32_t& q : steps) q = wholeStep(q, decoded.fraction_bits);
  return steps;
}

namespace {

template <class T>
T voidSample(const GeometryLayers& layers) {
  if constexpr (std::is_floating_point_v<T>) {
    return layers.has_nodata ? static_cast<T>(layers.nodata) : std::numeric_limits<T>::quiet_NaN();
  } else {
    return restore<T>(layers.nodata, 0, 0);
  }
}

/// Whether the type T has the value that is declared for voids. If not, no sample can be mistaken
/// for a void.
template <class T>
bool holdsNodata(const GeometryLayers& layers) {
  if (layers.has_nodata == 0) return false;
  return std::is_floating_point_v<T> || static_cast<double>(voidSample<T>(layers)) == layers.nodata;
}

/// The sample for a height that came out as the value of voids: the next larger sample or, beside
/// the largest finite one or infinity, the next smaller. Both zeros have the same neighbour.
template <class T>
T besides(T nodata) {
  if (nodata >= std::numeric_limits<T>::max()) return fromOrder<T>(orderOf(nodata) - 1);
  return fromOrder<T>(orderOf(nodata == 0 ? T{0} : nodata) + 1);
}

/// Gives voids the nodata value, and moves heights that equal this value to the next one.
template <class T>
void markVoids(const std::vector<uint8_t>& valid, const GeometryLayers& layers,
               std::span<T> samples) {
  const T nodata = voidSample<T>(layers);
  if (holdsNodata<T>(layers)) std::replace(samples.begin(), samples.end(), nodata, besides(nodata));
  for (size_t i = 0; i < valid.size(); ++i) {
    if (!valid[i]) samples[i] = nodata;
  }
}

}  // namespace

void fromSteps(const DecodedHeights& decoded, const GeometryHeader& header,
               const GeometryLayers& layers, void* out) {
  const DecodedGeometry& geometry = decoded.geometry;
  withSampleType(static_cast<tks_sample>(header.sample), [&](auto type) {
    using T = decltype(type);
    const std::span<T> samples(static_cast<T*>(out), geometry.heights.size());
    restoreCorrected(decoded, 0, {header.base, header.step}, samples);
    markVoids(geometry.valid, layers, samples);
  });
}

std::vector<uint8_t> sampleHints(std::span<const int32_t> heights, int fraction_bits,
                                 const GeometryHeader& header) {
  std::vector<uint8_t> hints(heights.size());
  const StepGrid grid(header.base, header.step);
  withSampleType(static_cast<tks_sample>(header.sample), [&](auto type) {
    using T = decltype(type);
    for (size_t i = 0; i < heights.size(); ++i) {
      const int32_t q = wholeStep(heights[i], fraction_bits);
      hints[i] = openBits(grid.sampleNear<T>(q), grid.exponent());
    }
  });
  return hints;
}

}  // namespace tetrakis::inline steps

// SPDX-License-Identifier: Apache-2.0
#include "codec/geometry/facets/facets_encoder.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/portable_math.hpp"
#include "bitstream/coder/range_encoder.hpp"
#include "codec/geometry/facets/facet_coder.hpp"
#include "codec/geometry/facets/facet_rows.hpp"
#include "codec/geometry/steps/sample_order.hpp"

namespace tetrakis::inline facets {

namespace {

/// Rows of a band that are known before samples count. More rows show more ways to go on, and leave
/// fewer samples to count.
constexpr uint32_t kBefore = 2;
/// Floats on either side of a prediction that count as met. With more of them ground that is only
/// smooth counts as facets.
constexpr int32_t kNearFloats = 2;
/// One sample in this number may be an outlier, which does not make the unit coarser. A smaller
/// number lets more samples be larger than the unit suits.
constexpr uint64_t kOutliersIn = 256;
/// Bands of the plane that are examined, their rows and their columns at most. More samples tell
/// the share of facets more exactly, and take time.
constexpr uint32_t kBands = 32, kBandRows = 8, kBandColumns = 512;

/// Looks at bands of rows, the first two of which only predict, unless no rows are above them.
class BandReader {
 public:
  BandReader(const tks_heights& heights, Mask valid, int unit)
      : samples_(static_cast<const float*>(heights.data)),
        width_(heights.width),
        valid_(valid),
        unit_(unit) {}

  void look(uint32_t x, uint32_t columns, uint32_t y, uint32_t rows) {
    FacetRows band(columns);
    for (uint32_t row = 0; row < rows; ++row) {
      band.nextRow();
      for (uint32_t column = 0; column < columns; ++column) {
        const size_t i = (size_t{y} + row) * width_ + x + column;
        if (!valid_[i]) continue;
        band.look(column, 0);
        if (y == 0 || row >= kBefore) count(samples_[i], isNear(band, samples_[i]));
        band.put(column, unit_.multiplesOf(samples_[i]));
      }
    }
  }

  FacetShare share(int unit) const {
    if (seen_ == 0) return {1, 1, unit};
    const auto seen = static_cast<double>(seen_);
    return {static_cast<double>(beyond_) / seen,
            portable::exp2(static_cast<double>(exponents_) / seen), unit};
  }

 private:
  /// Whether a prediction leads to the sample, or to one of kNearFloats on either side.
  bool isNear(FacetRows& band, float sample) const {
    while (band.more()) {
      const uint32_t predicted = unit_.nearest(band.next().multiples).order;
      const auto rest = static_cast<int32_t>(orderOf(sample) - predicted);
      if (rest >= -kNearFloats && rest <= kNearFloats) return true;
    }
    return false;
  }

  void count(float sample, bool near) {
    ++seen_;
    beyond_ += !near;
    exponents_ += spacingExponent(sample);
  }

  const float* samples_;
  uint32_t width_;
  Mask valid_;
  FacetUnit unit_;
  uint64_t seen_ = 0, beyond_ = 0;
  int64_t exponents_ = 0;
};

/// A size that all samples but a few outliers have at most.
float largestOf(const tks_heights& heights, Mask valid) {
  const auto* samples = static_cast<const float*>(heights.data);
  std::array<uint64_t, 256> counts{};  // by exponent field
  uint64_t all = 0;
  for (size_t i = 0; i < size_t{heights.width} * heights.height; ++i) {
    if (!valid[i] || !std::isfinite(samples[i])) continue;
    ++counts[std::bit_cast<uint32_t>(samples[i]) >> 23 & 0xff];
    ++all;
  }
  size_t field = counts.size() - 1;
  for (uint64_t beyond = counts[field]; field > 0 && beyond * kOutliersIn <= all;
       beyond += counts[field])
    --field;
  return std::bit_cast<float>(static_cast<uint32_t>(field << 23));
}

}  // namespace

FacetShare findFacets(const tks_heights& heights, Mask valid) {
  const int unit = FacetUnit::exponentFor(largestOf(heights, valid));
  BandReader reader(heights, valid, unit);
  const uint32_t columns = std::min(kBandColumns, heights.width);
  const uint32_t rows = std::min(kBandRows, heights.height);
  for (uint32_t band = 0; band < kBands; ++band) {
    const auto place = [&](uint32_t room, double part) {
      return static_cast<uint32_t>((part - std::floor(part)) * room);
    };
    constexpr double kGolden = 0.6180339887498949;
    reader.look(place(heights.width - columns + 1, band * kGolden), columns,
                place(heights.height - rows + 1, (band + 0.5) / kBands), rows);
  }
  return reader.share(unit);
}

std::vector<uint8_t> encodeFacets(const tks_heights& samples, PlaneView<const int32_t> steps,
                                  const Window& part, const GeometryHeader& header, int unit) {
  assert(samples.sample == TKS_F32);
  assert(samples.width == steps.width && samples.height == steps.height);
  const WindowValues<int32_t> heights(steps.values(), steps.extent(), part);
  const WindowValues<uint8_t> valid(steps.valid.bytes(), steps.extent(), part);
  const auto* first =
      static_cast<const float*>(samples.data) + size_t{part.y} * samples.width + part.x;
  DecisionEncoding writer;
  codeFacets(
      {header, FacetUnit(unit), {heights.values(), part.extent(), valid.values()}, 0}, writer,
      [&](size_t i) { return first[i / part.width * samples.width + i % part.width]; },
      [](size_t, float) {});
  return writer.finish();
}

}  // namespace tetrakis::inline facets

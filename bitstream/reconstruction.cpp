// SPDX-License-Identifier: Apache-2.0
#include "bitstream/reconstruction.hpp"

#include <algorithm>
#include <array>

#include "bitstream/plane_pass.hpp"

namespace tetrakis {

namespace {

/// Offset of a significant coefficient from the low end of its interval, in 1/64 of the interval,
/// by the class of its neighbours' magnitudes. Means over terrain and aerial images.
constexpr std::array<int, BandModels::kLocal> kCentroid = {16, 19, 20, 22, 23, 25,
                                                           27, 28, 29, 30, 30};

/// What the sign of each neighbour says about an insignificant coefficient, in 1/64 of the interval
/// that it is known to lie in.
struct SignWeights {
  int along, across, diagonal;
};

constexpr SignWeights weightsOf(Orientation orientation) {
  if (orientation == Orientation::kLL) return {0, 0, 0};
  if (orientation == Orientation::kHH) return {-3, -3, 1};
  return {-8, 3, -1};
}

/// mantissa * 2^(plane + fraction_bits) / 64, rounded towards zero.
int32_t scaledTo(int mantissa, int shift) {
  const auto magnitude = static_cast<uint64_t>(mantissa < 0 ? -mantissa : mantissa);
  const auto value = static_cast<int32_t>(static_cast<uint32_t>((magnitude << shift) >> 6));
  return mantissa < 0 ? -value : value;
}

class Reconstruction {
 public:
  Reconstruction(const Band& band, int fraction_bits)
      : band_(band),
        fraction_bits_(fraction_bits),
        neighbours_(band.shape, band.orientation),
        weights_(weightsOf(band.orientation)) {}

  int32_t value(size_t cell, int plane) const {
    if (band_.sign[cell] == 0) return plane == 0 ? 0 : insignificant(cell, plane);
    const auto exact = static_cast<int32_t>(band_.magnitude[cell] << fraction_bits_);
    if (plane == 0) return band_.sign[cell] * exact;
    return band_.sign[cell] *
           (exact + scaledTo(kCentroid[static_cast<size_t>(localClass(localSum(cell, plane)))],
                             plane + fraction_bits_));
  }

 private:
  uint32_t localSum(size_t cell, int plane) const {
    const uint32_t* m = band_.magnitude.data() + cell;
    uint32_t near = 0, far = 0;
    for (ptrdiff_t n : neighbours_.near) near += std::min(m[n] >> plane, 30u);
    for (ptrdiff_t n : neighbours_.far) far += std::min(m[n] >> plane, 30u);
    return 2 * near + far;
  }

  int32_t insignificant(size_t cell, int plane) const {
    const int8_t* s = band_.sign.data() + cell;
    const auto &near = neighbours_.near, &far = neighbours_.far;
    const int mantissa = weights_.along * (s[near[0]] + s[near[1]]) +
                         weights_.across * (s[near[2]] + s[near[3]]) +
                         weights_.diagonal * (s[far[0]] + s[far[1]] + s[far[2]] + s[far[3]]);
    return scaledTo(mantissa, plane + fraction_bits_);
  }

  const Band& band_;
  int fraction_bits_;
  Neighbours neighbours_;
  SignWeights weights_;
};

}  // namespace

void reconstruct(const Band& band, int fraction_bits, std::vector<int32_t>& values) {
  const BandShape& shape = band.shape;
  values.assign(size_t{shape.rows} * shape.columns, 0);
  if (!band.nonzero) return;
  const Reconstruction rule(band, fraction_bits);
  int32_t* out = values.data();
  for (uint32_t row = 0; row < shape.rows; ++row) {
    for (uint32_t column = 0; column < shape.columns; ++column) {
      *out++ = rule.value(shape.cell(row, column), band.knownPlane(row, column));
    }
  }
}

}  // namespace tetrakis

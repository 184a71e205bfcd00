// SPDX-License-Identifier: Apache-2.0
// The shears are those that leave the fewest bits, counted as in colour_axes.cpp: log2(1 + |c| / T)
// for each Haar detail c. Least squares whose weights follow the residuals find the direction (I.
// Daubechies et al., Iteratively reweighted least squares, 2010). A further colour that follows the
// others repeats their errors, which makes these dearer by its share in their energies; so lossy
// coding takes the part of the way along that direction where all planes together are cheapest.
#include "texture_wavelet/colour/colour_fit.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace tetrakis::inline colour {
namespace {

/// Rounds of weighed least squares. More of them come nearer to the fewest bits, and take time.
constexpr int kRounds = 8;
/// Coefficients below this part of the step weigh alike. A larger number draws the fit to samples
/// that are met already.
constexpr double kFloorPart = 8;
/// The parts of the fitted shears that are tried for lossy streams, where errors of the other
/// planes count again. More of them save bits, and take the time of an estimate each.
constexpr std::array<double, 5> kTriedParts = {0., 0.25, 0.5, 0.75, 1.};
/// The largest shear. A larger number allows colours that are multiples of the others, and spreads
/// errors of these more.
constexpr double kMostShear = 2.;
constexpr double kHold = 1e-6;  // keeps equations of planes that are alike solvable

using Vector3 = std::array<double, 3>;

/// The planes before the further colour: directions in their channels, and the energy of their
/// errors there.
struct Planes {
  size_t count;
  Matrix3 axes;
  Vector3 energies;
};

Planes planesOf(const ColourTransform& transform, size_t count) {
  if (count < 3) return {1, {{{1, 0, 0}, {}, {}}}, {1, 1, 1}};
  return {3, colourMatrix(transform), planeEnergies(transform)};
}

/// Details of the channels before, and of the further colour at the same places.
struct Details {
  std::vector<ColourDetails> before, further;
};

Details detailsOf(std::span<const int32_t* const> channels, Extent extent) {
  const auto of = [&](size_t a, size_t b, size_t c) {
    const std::array<const int32_t*, 3> planes = {channels[a], channels[b], channels[c]};
    return sampleDetails(planes, extent);
  };
  const size_t last = channels.size() - 1;
  return {last == 1 ? of(0, 0, 0) : of(0, 1, 2), of(last, last, last)};
}

/// The details of one plane.
double along(const Vector3& axis, const ColourDetails& details, size_t i) {
  double sum = 0;
  for (size_t k = 0; k < 3; ++k) sum += axis[k] * details.channels[k][i];
  return sum;
}

/// Normal equations of a least-squares fit, solved with a little of each unknown's own square added
/// so that planes which say nothing get 0.
struct NormalEquations {
  Matrix3 squares{};
  Vector3 products{};

  void add(const Vector3& known, double wanted, double weight) {
    for (size_t i = 0; i < 3; ++i) {
      products[i] += weight * known[i] * wanted;
      for (size_t j = 0; j < 3; ++j) squares[i][j] += weight * known[i] * known[j];
    }
  }

  Vector3 solved() const {
    Matrix3 a = squares;
    Vector3 b = products;
    for (size_t i = 0; i < 3; ++i) a[i][i] = a[i][i] * (1 + kHold) + kHold;
    for (size_t i = 0; i < 3; ++i) {
      for (size_t row = 0; row < 3; ++row) {
        if (row == i) continue;
        const double times = a[row][i] / a[i][i];
        for (size_t j = i; j < 3; ++j) a[row][j] -= times * a[i][j];
        b[row] -= times * b[i];
      }
    }
    for (size_t i = 0; i < 3; ++i) b[i] /= a[i][i];
    return b;
  }
};

/// Coefficients of the planes whose sum with the further colour has the fewest bits.
Vector3 fewestBits(const Planes& planes, const Details& details, double step) {
  Vector3 best{};
  for (int round = 0; round < kRounds; ++round) {
    NormalEquations equations;
    for (size_t scale = 0; scale < details.before.size(); ++scale) {
      const ColourDetails &before = details.before[scale], &further = details.further[scale];
      for (size_t i = 0; i < before.count(); ++i) {
        Vector3 known{};
        double rest = further.channels[0][i];
        for (size_t p = 0; p < planes.count; ++p) {
          known[p] = along(planes.axes[p], before, i);
          rest += best[p] * known[p];
        }
        // log2(1 + |c| / T) grows as the square of c times this.
        const double size = std::abs(rest) + step;
        const double weight = round == 0 ? 1 : 1 / (size * (std::abs(rest) + step / kFloorPart));
        equations.add(known, -static_cast<double>(further.channels[0][i]), before.weight * weight);
      }
    }
    best = equations.solved();
  }
  return best;
}

/// The bits of all planes where the further colour follows the others by `shears`.
double bitsWith(const Vector3& shears, const Planes& planes, const Details& details, double step) {
  Vector3 axis{};
  for (size_t p = 0; p < planes.count; ++p)
    for (size_t k = 0; k < 3; ++k) axis[k] += shears[p] * planes.axes[p][k];
  double bits = 0;
  for (size_t scale = 0; scale < details.before.size(); ++scale) {
    const ColourDetails& before = details.before[scale];
    ColourDetails sums{{details.further[scale].channels[0], {}, {}}, before.weight};
    sums.channels[2].resize(before.count());
    for (size_t i = 0; i < before.count(); ++i)
      sums.channels[1].push_back(static_cast<float>(along(axis, before, i)));
    bits += bitsAlong({1, 1, 0}, sums, step);
    for (size_t p = 0; p < planes.count; ++p) {
      const double energy = planes.energies[p] + shears[p] * shears[p];
      bits += bitsAlong(planes.axes[p], before, step / std::sqrt(energy));
    }
  }
  return bits;
}

/// At most twice: 16-bit samples stay clear of overflow.
std::array<int16_t, 3> quantised(const Vector3& shears) {
  std::array<int16_t, 3> out{};
  std::transform(shears.begin(), shears.end(), out.begin(), [](double shear) {
    return static_cast<int16_t>(
        std::lround(std::clamp(shear, -kMostShear, kMostShear) * (1 << kShearFractionBits)));
  });
  return out;
}

}  // namespace

std::array<int16_t, 3> fitFurtherColour(const ColourTransform& transform,
                                        std::span<const int32_t* const> channels, Extent extent,
                                        Purpose purpose) {
  const Planes planes = planesOf(transform, channels.size() - 1);
  const Details details = detailsOf(channels, extent);
  if (details.before.empty()) return {};
  const double step = purpose == Purpose::kLossless ? 1 : typicalStep(details.before);
  const Vector3 direction = fewestBits(planes, details, step);
  if (purpose == Purpose::kLossless) return quantised(direction);
  Vector3 best{};
  double least = std::numeric_limits<double>::infinity();
  for (const double part : kTriedParts) {
    const Vector3 shears = {part * direction[0], part * direction[1], part * direction[2]};
    const double bits = bitsWith(shears, planes, details, step);
    if (bits >= least) continue;
    least = bits;
    best = shears;
  }
  return quantised(best);
}

}  // namespace tetrakis::inline colour

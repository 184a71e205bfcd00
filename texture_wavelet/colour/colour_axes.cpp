// SPDX-License-Identifier: Apache-2.0
// sampleDetails() samples the details of an image, and fitAxes() turns the axes of colour until
// these details take the fewest bits.
#include "texture_wavelet/colour/colour_fit.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/portable_math.hpp"

namespace tetrakis::inline colour {

namespace {

/// Blocks of each scale of which details are sampled, three of each. More of them fit axes better,
/// and take time.
constexpr size_t kBlocksPerScale = 2048;
/// The share of the coefficients that the typical step leaves above itself. A larger share fits
/// colours to higher rates.
constexpr double kExceeding = 0.1;

struct Image {
  size_t width = 0, height = 0;
  std::vector<Colour> colours;
};

/// Halves an image, read through colour_at(index), and samples its orthonormal Haar details. Values
/// are `gain` times means over the pixels of the original.
template <class ColourAt>
Image halve(size_t width, size_t height, float gain, ColourAt colour_at, ColourDetails& details) {
  Image half{width / 2, height / 2, {}};
  half.colours.resize(half.width * half.height);
  // Odd, so that the sampled blocks do not line up in columns.
  const size_t stride = (half.colours.size() / kBlocksPerScale) | 1;
  details.weight = static_cast<double>(stride);
  for (size_t i = 0; i < half.colours.size(); ++i) {
    const size_t corner = (i / half.width) * 2 * width + (i % half.width) * 2;
    const Colour a = colour_at(corner), b = colour_at(corner + 1);
    const Colour c = colour_at(corner + width), d = colour_at(corner + width + 1);
    Colour rows{}, columns{}, diagonal{};
    for (size_t k = 0; k < 3; ++k) {
      half.colours[i][k] = (a[k] + b[k] + c[k] + d[k]) / 4;
      rows[k] = (a[k] - b[k] + c[k] - d[k]) * gain / 2;
      columns[k] = (a[k] + b[k] - c[k] - d[k]) * gain / 2;
      diagonal[k] = (a[k] - b[k] - c[k] + d[k]) * gain / 2;
    }
    if (i % stride != 0) continue;
    for (const Colour& detail : {rows, columns, diagonal}) details.add(detail);
  }
  return half;
}

}  // namespace

std::vector<ColourDetails> sampleDetails(std::span<const int32_t* const> channels, Extent extent) {
  const auto [width, height] = extent;
  std::vector<ColourDetails> details;
  if (std::min(width, height) < 2) return details;
  const auto pixel = [&](size_t i) {
    return Colour{static_cast<float>(channels[0][i]), static_cast<float>(channels[1][i]),
                  static_cast<float>(channels[2][i])};
  };
  Image image = halve(width, height, 1, pixel, details.emplace_back());
  for (float gain = 2; std::min(image.width, image.height) >= 2; gain *= 2) {
    const auto colour_at = [&](size_t i) { return image.colours[i]; };
    image = halve(image.width, image.height, gain, colour_at, details.emplace_back());
  }
  return details;
}

namespace {

/// Mean over samples and channels; 0 if there are none.
double meanMagnitude(const ColourDetails& details) {
  double sum = 0;
  const auto& [first, second, third] = details.channels;
  for (size_t i = 0; i < details.count(); ++i)
    sum += std::abs(first[i]) + std::abs(second[i]) + std::abs(third[i]);
  const auto count = static_cast<double>(3 * details.count());
  return count == 0 ? 0 : sum / count;
}

}  // namespace

double typicalStep(std::span<const ColourDetails> details) {
  struct Magnitude {
    float value;
    double weight;
  };
  std::vector<Magnitude> magnitudes;
  double left = 0;
  for (const ColourDetails& scale : details) {
    for (const std::vector<float>& channel : scale.channels) {
      for (const float value : channel) magnitudes.push_back({std::abs(value), scale.weight});
    }
    left += kExceeding * scale.weight * static_cast<double>(3 * scale.count());
  }
  if (magnitudes.empty()) return 1;
  // The one with which the weights of the largest come to that: in the first half of those that are
  // in question, or in the second.
  auto first = magnitudes.begin(), last = magnitudes.end();
  while (last - first > 1) {
    const auto middle = first + (last - first) / 2;
    std::nth_element(first, middle, last,
                     [](const Magnitude& a, const Magnitude& b) { return a.value > b.value; });
    double larger = 0;
    for (auto m = first; m != middle; ++m) larger += m->weight;
    if (larger >= left) {
      last = middle;
    } else {
      left -= larger;
      first = middle;
    }
  }
  return std::max(1.0, static_cast<double>(first->value));
}

double bitsAlong(const std::array<double, 3>& axis, const ColourDetails& details, double step) {
  // One logarithm for many factors, each below 1e40, and products side by side.
  constexpr double kLarge = 1e200;
  std::array<double, 8> products;
  products.fill(1);
  const std::array<double, 3> per_step = {axis[0] / step, axis[1] / step, axis[2] / step};
  const auto& channels = details.channels;
  const auto factor = [&](size_t i) {
    return 1 + std::abs(per_step[0] * channels[0][i] + per_step[1] * channels[1][i] +
                        per_step[2] * channels[2][i]);
  };
  double bits = 0;
  size_t i = 0;
  for (; i + products.size() <= details.count(); i += products.size()) {
    for (size_t k = 0; k < products.size(); ++k) products[k] *= factor(i + k);
    if (*std::max_element(products.begin(), products.end()) < kLarge) continue;
    for (double& product : products) bits += portable::log2(std::exchange(product, 1));
  }
  for (; i < details.count(); ++i) bits += portable::log2(factor(i));
  for (const double product : products) bits += portable::log2(product);
  return details.weight * bits;
}

// Rotation of the colour axes that needs the fewest bits.
//
// A wavelet coefficient c coded with a step T costs about log2(1 + |c| / T) bits. The sum of that
// over Haar details ranks rotations as a coder does; the variances of a KLT do not, because a few
// strong edges rule them. Starting from the fixed rotation to (sum, red - blue, green - magenta),
// plane rotations walk to the minimum. T is the mean of |c|, or 1 where every bit will be coded;
// with a half or a quarter of the mean the bytes change by 0.1 %.

namespace {

/// Angles, in radians, by which axes are turned at first and in the end, each half of the one
/// before. A wider range finds better axes, and takes time.
constexpr double kFirstAngle = 0.2, kLastAngle = 0.005;
constexpr double kSlack = 1e-9;  // a smaller gain is one of rounding

Matrix3 fixedRotation() {
  const double s3 = std::sqrt(1.0 / 3), s2 = std::sqrt(0.5), s6 = std::sqrt(1.0 / 6);
  return {{{s3, s3, s3}, {s2, 0, -s2}, {-s6, 2 * s6, -s6}}};
}

void rotateRows(Matrix3& rotation, size_t p, size_t q, double angle) {
  const double c = portable::cos(angle), s = portable::sin(angle);
  for (size_t j = 0; j < 3; ++j) {
    const double a = rotation[p][j], b = rotation[q][j];
    rotation[p][j] = c * a + s * b;
    rotation[q][j] = c * b - s * a;
  }
}

/// The estimated bits of all details along an axis.
struct AxisRate {
  const ColourDetails& details;
  double step;

  double operator()(const std::array<double, 3>& axis) const {
    return bitsAlong(axis, details, step);
  }
};

/// Rotates two rows by +-angle for as long as that saves bits. Returns whether it did.
bool descend(Matrix3& rotation, std::array<double, 3>& rates, std::pair<size_t, size_t> rows,
             double angle, const AxisRate& rate) {
  const auto [p, q] = rows;
  bool moved = false;
  for (double turn : {angle, -angle}) {
    for (;;) {
      Matrix3 turned = rotation;
      rotateRows(turned, p, q, turn);
      const double rate_p = rate(turned[p]);
      const double rate_q = rate(turned[q]);
      if (!(rate_p + rate_q < (rates[p] + rates[q]) * (1 - kSlack))) break;
      rotation = turned;
      rates[p] = rate_p;
      rates[q] = rate_q;
      moved = true;
    }
  }
  return moved;
}

/// Walks from a rotation to the nearest that needs the fewest bits.
Matrix3 cheapestRotation(Matrix3 rotation, const ColourDetails& details, Purpose purpose) {
  const double step = purpose == Purpose::kLossless ? 1 : meanMagnitude(details);
  if (step == 0) return rotation;
  const AxisRate rate{details, step};
  std::array<double, 3> rates{};
  for (size_t i = 0; i < 3; ++i) rates[i] = rate(rotation[i]);
  constexpr std::array<std::pair<size_t, size_t>, 3> kPairs = {{{0, 1}, {0, 2}, {1, 2}}};
  for (double angle = kFirstAngle; angle > kLastAngle; angle /= 2) {
    // Any two pairs have a row in common: what moves one may be worth moving the others.
    for (size_t pair = 0, still = 0; still < kPairs.size(); pair = (pair + 1) % kPairs.size())
      still = descend(rotation, rates, kPairs[pair], angle, rate) ? 0 : still + 1;
  }
  return rotation;
}

/// With the row of the greatest energy at the front.
Matrix3 lumaFirst(Matrix3 rotation, const ColourDetails& details) {
  std::array<double, 3> energies{};
  const auto& [first, second, third] = details.channels;
  for (size_t k = 0; k < details.count(); ++k) {
    for (size_t i = 0; i < 3; ++i) {
      const double along =
          rotation[i][0] * first[k] + rotation[i][1] * second[k] + rotation[i][2] * third[k];
      energies[i] += along * along;
    }
  }
  const auto strongest = std::max_element(energies.begin(), energies.end()) - energies.begin();
  std::swap(rotation[0], rotation[static_cast<size_t>(strongest)]);
  return rotation;
}

ColourDetails pooled(std::span<const ColourDetails> details) {
  ColourDetails all;
  for (const ColourDetails& scale : details) {
    for (size_t k = 0; k < all.channels.size(); ++k)
      all.channels[k].insert(all.channels[k].end(), scale.channels[k].begin(),
                             scale.channels[k].end());
  }
  return all;
}

/// One for each level. Each starts from that of the finer level, so that colour planes keep
/// their places.
std::vector<Matrix3> fitRotations(std::span<const ColourDetails> details, Purpose purpose) {
  std::vector<Matrix3> rotations;
  for (const ColourDetails& scale : details) {
    const Matrix3 cheapest =
        cheapestRotation(rotations.empty() ? fixedRotation() : rotations.back(), scale, purpose);
    rotations.push_back(rotations.empty() ? lumaFirst(cheapest, scale) : cheapest);
  }
  return rotations;
}

}  // namespace

ColourAxes fitAxes(std::span<const int32_t* const> channels, Extent extent, Purpose purpose) {
  std::vector<ColourDetails> details = sampleDetails(channels, extent);
  if (details.empty()) return {{}, fixedRotation(), {}};
  const ColourDetails all = pooled(details);
  const Matrix3 overall = lumaFirst(cheapestRotation(fixedRotation(), all, purpose), all);
  std::vector<Matrix3> levels = fitRotations(details, purpose);
  return {std::move(details), overall, std::move(levels)};
}

}  // namespace tetrakis::inline colour

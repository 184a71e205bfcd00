// SPDX-License-Identifier: Apache-2.0
#include "texture_wavelet/colour/colour_details.hpp"

#include <algorithm>
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

double meanMagnitude(const ColourDetails& details) {
  double sum = 0;
  const auto& [first, second, third] = details.channels;
  for (size_t i = 0; i < details.count(); ++i)
    sum += std::abs(first[i]) + std::abs(second[i]) + std::abs(third[i]);
  const auto count = static_cast<double>(3 * details.count());
  return count == 0 ? 0 : sum / count;
}

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

}  // namespace tetrakis::inline colour

// SPDX-License-Identifier: Apache-2.0
// With the constants of the paper: Gaussian window of 11 x 11 samples, sigma 1.5, K1 = 0.01,
// K2 = 0.03, five scales, of which the mean of 2 x 2 samples is the next.
#include "bench/harness/ms_ssim.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace tetrakis::bench {
namespace {

constexpr std::array<double, 5> kExponents = {0.0448, 0.2856, 0.3001, 0.2363, 0.1333};
constexpr uint32_t kWindow = 11;

struct Plane {
  uint32_t width = 0, height = 0;
  std::vector<float> values;
};

/// ITU-R BT.601, of interleaved samples.
Plane lumaOf(const Raster& raster, const std::vector<uint16_t>& samples) {
  Plane plane{raster.width, raster.height, std::vector<float>(raster.pixels())};
  for (size_t i = 0; i < plane.values.size(); ++i) {
    const uint16_t* s = samples.data() + i * raster.channels;
    plane.values[i] = raster.channels < 3
                          ? static_cast<float>(s[0])
                          : 0.299f * static_cast<float>(s[0]) + 0.587f * static_cast<float>(s[1]) +
                                0.114f * static_cast<float>(s[2]);
  }
  return plane;
}

std::array<float, kWindow> gaussian() {
  std::array<float, kWindow> weights;
  float sum = 0;
  for (uint32_t i = 0; i < kWindow; ++i) {
    const float x = (static_cast<float>(i) - 5) / 1.5f;
    sum += weights[i] = std::exp(-x * x / 2);
  }
  for (float& w : weights) w /= sum;
  return weights;
}

/// Weighted means over all windows that lie inside.
Plane blurred(const Plane& in) {
  static const std::array<float, kWindow> weights = gaussian();
  Plane rows{in.width - kWindow + 1, in.height, {}};
  rows.values.resize(size_t{rows.width} * rows.height);
  for (uint32_t y = 0; y < rows.height; ++y) {
    for (uint32_t x = 0; x < rows.width; ++x) {
      const float* from = in.values.data() + size_t{y} * in.width + x;
      float sum = 0;
      for (uint32_t k = 0; k < kWindow; ++k) sum += weights[k] * from[k];
      rows.values[size_t{y} * rows.width + x] = sum;
    }
  }
  Plane out{rows.width, in.height - kWindow + 1, {}};
  out.values.assign(size_t{out.width} * out.height, 0);
  for (uint32_t y = 0; y < out.height; ++y) {
    float* to = out.values.data() + size_t{y} * out.width;
    for (uint32_t k = 0; k < kWindow; ++k) {
      const float* from = rows.values.data() + size_t{y + k} * rows.width;
      for (uint32_t x = 0; x < out.width; ++x) to[x] += weights[k] * from[x];
    }
  }
  return out;
}

Plane product(const Plane& a, const Plane& b) {
  Plane out{a.width, a.height, a.values};
  for (size_t i = 0; i < out.values.size(); ++i) out.values[i] *= b.values[i];
  return out;
}

Plane halved(const Plane& in) {
  Plane out{in.width / 2, in.height / 2, {}};
  for (uint32_t y = 0; y < out.height; ++y) {
    for (uint32_t x = 0; x < out.width; ++x) {
      const float* a = in.values.data() + size_t{2 * y} * in.width + 2 * x;
      out.values.push_back((a[0] + a[1] + a[in.width] + a[in.width + 1]) / 4);
    }
  }
  return out;
}

struct Similarity {
  double luminance = 0, structure = 0;  ///< means; structure: times contrast
};

Similarity compare(const Plane& a, const Plane& b) {
  constexpr double kC1 = 0.01 * 255 * 0.01 * 255, kC2 = 0.03 * 255 * 0.03 * 255;
  const Plane ma = blurred(a), mb = blurred(b), aa = blurred(product(a, a)),
              bb = blurred(product(b, b)), ab = blurred(product(a, b));
  Similarity sum;
  for (size_t i = 0; i < ma.values.size(); ++i) {
    const double x = ma.values[i], y = mb.values[i];
    sum.luminance += (2 * x * y + kC1) / (x * x + y * y + kC1);
    sum.structure +=
        (2 * (ab.values[i] - x * y) + kC2) / (aa.values[i] - x * x + bb.values[i] - y * y + kC2);
  }
  const auto count = static_cast<double>(ma.values.size());
  return {sum.luminance / count, sum.structure / count};
}

}  // namespace

double msSsim(const Raster& raster, const std::vector<uint16_t>& decoded) {
  Plane a = lumaOf(raster, raster.samples), b = lumaOf(raster, decoded);
  double similarity = 1;
  for (size_t scale = 0; scale < kExponents.size(); ++scale) {
    const Similarity here = compare(a, b);
    const bool last = scale + 1 == kExponents.size() || std::min(a.width, a.height) / 2 < kWindow;
    similarity *= std::pow(std::max(here.structure, 0.0), kExponents[scale]);
    if (last) return similarity * std::pow(here.luminance, kExponents[scale]);
    a = halved(a);
    b = halved(b);
  }
  return similarity;
}

}  // namespace tetrakis::bench

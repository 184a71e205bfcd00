// SPDX-License-Identifier: Apache-2.0
// Texels that no triangle shows: a pyramid of means of those that are shown, from which the others
// are filled in from coarse to fine ("push and pull", Gortler et al. 1996).
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "bench/meshes/surface_atlas.hpp"

namespace tetrakis::bench {
namespace {

/// R, G, B, and the weight that they count.
struct Level {
  uint32_t width, height;
  std::vector<std::array<float, 4>> texels;

  const std::array<float, 4>& at(uint32_t x, uint32_t y) const {
    return texels[size_t{std::min(y, height - 1)} * width + std::min(x, width - 1)];
  }
};

/// Marks the texels around a triangle that takes less than the whole image.
void markTriangle(const std::array<std::array<float, 2>, 3>& corners, const tools::ImageFile& image,
                  std::vector<uint8_t>& shown) {
  constexpr double kAround = 1.5;  // texels: what means of neighbours reach
  std::array<double, 3> x{}, y{};
  for (size_t k = 0; k < 3; ++k) {
    x[k] = double{corners[k][0]} * image.width - 0.5;
    y[k] = double{corners[k][1]} * image.height - 0.5;
  }
  const auto [left, right] = std::minmax_element(x.begin(), x.end());
  const auto [top, bottom] = std::minmax_element(y.begin(), y.end());
  if (*right - *left >= image.width || *bottom - *top >= image.height) {
    std::fill(shown.begin(), shown.end(), uint8_t{1});
    return;
  }
  const double area = (x[1] - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (y[1] - y[0]);
  const auto isNear = [&](double px, double py) {
    for (size_t k = 0; k < 3; ++k) {
      const size_t n = (k + 1) % 3;
      const double ex = x[n] - x[k], ey = y[n] - y[k];
      const double beside = (ex * (py - y[k]) - ey * (px - x[k])) * (area < 0 ? -1 : 1);
      if (beside < -kAround * std::hypot(ex, ey)) return false;
    }
    return true;
  };
  const auto wrapped = [](double at, uint32_t side) {
    return static_cast<size_t>(at - std::floor(at / side) * side);
  };
  for (double py = std::floor(*top - kAround); py <= *bottom + kAround; ++py)
    for (double px = std::floor(*left - kAround); px <= *right + kAround; ++px)
      if (isNear(px, py))
        shown[wrapped(py, image.height) * image.width + wrapped(px, image.width)] = 1;
}

Level coarser(const Level& fine) {
  Level out{(fine.width + 1) / 2, (fine.height + 1) / 2, {}};
  for (uint32_t y = 0; y < out.height; ++y) {
    for (uint32_t x = 0; x < out.width; ++x) {
      std::array<float, 4> sum{};
      for (const uint32_t dy : {0u, 1u})
        for (const uint32_t dx : {0u, 1u})
          for (size_t c = 0; c < 4; ++c)
            sum[c] += fine.at(2 * x + dx, 2 * y + dy)[c] *
                      (c < 3 ? fine.at(2 * x + dx, 2 * y + dy)[3] : 1);
      for (size_t c = 0; c < 3; ++c) sum[c] /= std::max(sum[3], 1e-9F);
      sum[3] = std::min(sum[3], 1.0F);
      out.texels.push_back(sum);
    }
  }
  return out;
}

/// Bilinear, of a level that is filled.
std::array<float, 4> between(const Level& coarse, uint32_t x, uint32_t y) {
  const uint32_t x0 = x / 2, y0 = y / 2;
  const uint32_t x1 = x % 2 == 0 ? std::max(x0, 1u) - 1 : x0 + 1;
  const uint32_t y1 = y % 2 == 0 ? std::max(y0, 1u) - 1 : y0 + 1;
  std::array<float, 4> out{};
  for (size_t c = 0; c < 4; ++c)
    out[c] = (9 * coarse.at(x0, y0)[c] + 3 * coarse.at(x1, y0)[c] + 3 * coarse.at(x0, y1)[c] +
              coarse.at(x1, y1)[c]) /
             16;
  return out;
}

void fill(Level& fine) {
  if (fine.width == 1 && fine.height == 1) return;
  Level coarse = coarser(fine);
  fill(coarse);
  for (uint32_t y = 0; y < fine.height; ++y)
    for (uint32_t x = 0; x < fine.width; ++x)
      if (auto& texel = fine.texels[size_t{y} * fine.width + x]; texel[3] == 0) {
        texel = between(coarse, x, y);
      }
}

}  // namespace

tools::ImageFile filledAtlas(const SurfaceModel& model) {
  tools::ImageFile image = *model.painted.image;
  if (image.sample != TKS_U8) return image;
  std::vector<uint8_t> shown(size_t{image.width} * image.height);
  const auto& texcoords = model.painted.texcoords;
  for (size_t i = 0; i < texcoords.size(); i += 3)
    markTriangle({texcoords[i], texcoords[i + 1], texcoords[i + 2]}, image, shown);
  Level level{image.width, image.height, std::vector<std::array<float, 4>>(shown.size())};
  for (size_t i = 0; i < shown.size(); ++i) {
    for (size_t c = 0; c < std::min(image.channels, 3u); ++c)
      level.texels[i][c] = std::to_integer<uint8_t>(image.data[i * image.channels + c]);
    level.texels[i][3] = shown[i];
  }
  fill(level);
  for (size_t i = 0; i < shown.size(); ++i)
    for (size_t c = 0; c < std::min(image.channels, 3u); ++c)
      image.data[i * image.channels + c] =
          static_cast<std::byte>(static_cast<uint8_t>(level.texels[i][c] + 0.5F));
  return image;
}

}  // namespace tetrakis::bench

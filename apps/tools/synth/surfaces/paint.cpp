// SPDX-License-Identifier: Apache-2.0
// The texture: texels get the colour of the place in space that they show.
#include <algorithm>

#include "apps/tools/synth/surfaces/atlas.hpp"
#include "apps/tools/synth/surfaces/solid_noise.hpp"

namespace tetrakis::tools::synth {
namespace {

using Flat = std::array<double, 2>;

/// Veins through bright and dark stone.
Spot stone(uint64_t seed, const Spot& p) {
  constexpr Spot kBright{224, 205, 170}, kDark{120, 84, 60}, kVein{60, 92, 110};
  constexpr double kWide = 2.2, kFine = 12, kGrain = 24;
  const double cloud = smoothStep(-0.3, 0.3, solidFractal(seed, kWide * p, 3));
  const double vein = smoothStep(0.06, 0.02, std::abs(solidFractal(seed + 9, kWide * p, 2)));
  const double grain = kGrain * solidFractal(seed + 17, kFine * p, 2);
  Spot colour{};
  for (size_t k = 0; k < 3; ++k)
    colour[k] = mix(mix(kDark[k], kBright[k], cloud), kVein[k], vein) + grain;
  return colour;
}

/// A triangle in texels.
struct FlatTriangle {
  std::array<Flat, 3> corners;
  double area() const { return side(corners[0], corners[1], corners[2]); }
  static double side(const Flat& a, const Flat& b, const Flat& p) {
    return (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]);
  }
  /// What the corners weigh at a place, beyond the triangle too.
  Spot weights(const Flat& p) const {
    const double all = area();
    return {side(corners[1], corners[2], p) / all, side(corners[2], corners[0], p) / all,
            side(corners[0], corners[1], p) / all};
  }
};

class Painter {
 public:
  Painter(const TriangleMesh& shape, uint64_t seed, ImageFile& image)
      : shape_(shape), seed_(seed), image_(image) {}

  /// Texels whose middles lie in the triangle, or up to `margin` texels off.
  void fill(const Triangle& t, const FlatTriangle& flat, double margin) {
    if (!(std::abs(flat.area()) > 0)) return;
    const auto range = [&](size_t axis) {
      const auto [low, high] =
          std::minmax({flat.corners[0][axis], flat.corners[1][axis], flat.corners[2][axis]});
      const double last = image_.width - 1;
      return std::pair{static_cast<uint32_t>(std::clamp(low - margin, 0.0, last)),
                       static_cast<uint32_t>(std::clamp(high + margin, 0.0, last))};
    };
    const auto columns = range(0), rows = range(1);
    for (uint32_t y = rows.first; y <= rows.second; ++y)
      for (uint32_t x = columns.first; x <= columns.second; ++x) fillTexel(t, flat, {x, y}, margin);
  }

 private:
  void fillTexel(const Triangle& t, const FlatTriangle& flat, const std::array<uint32_t, 2>& at,
                 double margin) {
    const Spot weights = flat.weights({at[0] + 0.5, at[1] + 0.5});
    if (margin == 0 && *std::min_element(weights.begin(), weights.end()) < 0) return;
    Spot place{};
    for (size_t k = 0; k < 3; ++k) place = place + weights[k] * shape_.points[t[k]];
    const Spot colour = stone(seed_, place);
    std::byte* const texel = &image_.data[3 * (size_t{at[1]} * image_.width + at[0])];
    for (size_t k = 0; k < 3; ++k)
      texel[k] = static_cast<std::byte>(std::clamp(std::floor(colour[k] + 0.5), 0.0, 255.0));
  }

  const TriangleMesh& shape_;
  uint64_t seed_;
  ImageFile& image_;
};

}  // namespace

ImageFile paint(const TriangleMesh& shape, const Atlas& atlas, uint32_t side, uint64_t seed) {
  constexpr std::byte kGrey{128};
  constexpr double kMargin = 2;
  ImageFile image{side, side, 3, TKS_U8, std::vector<std::byte>(size_t{3} * side * side, kGrey)};
  Painter painter(shape, seed, image);
  for (const double margin : {kMargin, 0.0}) {
    for (size_t i = 0; i < shape.triangles.size(); ++i) {
      if (margin > 0 && !atlas.borders[i]) continue;
      FlatTriangle flat{};
      for (size_t k = 0; k < 3; ++k)
        for (size_t axis = 0; axis < 2; ++axis)
          flat.corners[k][axis] = side * atlas.places[3 * i + k][axis];
      painter.fill(shape.triangles[i], flat, margin);
    }
  }
  return image;
}

}  // namespace tetrakis::tools::synth

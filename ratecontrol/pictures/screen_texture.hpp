// SPDX-License-Identifier: Apache-2.0
// ScreenTexture is a texture as renderers show it: a pyramid of levels, each half the size of the
// one before, and trilinear filters between their texels.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/texels.hpp"

namespace tetrakis::inline pictures {

using Colour = std::array<float, 3>;  ///< of 0 to 255

class ScreenTexture {
 public:
  /// texels: the whole image, or its samples at multiples of 2^level in x and y (base/view.hpp),
  /// which hold what coarser levels of the image show. Grey becomes three equal colours; alpha
  /// darkens them.
  ScreenTexture(const Texels& texels, Extent whole, int level = 0);

  /// u, v: from 0 to 1 over the image; clamped. level: of detail, 0 the finest resolution.
  Colour at(double u, double v, double level) const;

 private:
  /// R, G and B in 16 bits each, from the lowest up: one multiplication weighs all three.
  using Lanes = uint64_t;
  struct Level {
    uint32_t width = 0, height = 0;
    std::vector<Lanes> texels;
    /// Place of a level's texel = scale * (place from 0 to 1) - shift.
    double scale_x = 1, scale_y = 1, shift = 0;
  };
  static Level halved(const Level& fine);
  void place(Level& level, int halvings) const;
  static void addBilinear(const Level& level, double u, double v, float weight, Colour& sum);

  Extent whole_;
  int first_;                  ///< level of detail of levels_[0]
  std::vector<Level> levels_;  ///< each half as wide as the one before
};

}  // namespace tetrakis::inline pictures

// SPDX-License-Identifier: Apache-2.0
// The modelled distortion engine (thesis 6.1 and 6.2, without rendering): what an error of the
// heights costs in the picture, in the units of the texture's squared error.
//
// Seen at an angle, a height error dz moves the texture by delta = s dz texels (s: parallax). A
// texture of local variance v and mean squared gradient g changes by about g delta^2 / 2 (mean over
// directions), and by no more than 2 v when the shift has decorrelated it:
//
//   D(delta) = 2 v (1 - exp(-g delta^2 / (4 v)))
#pragma once

#include <vector>

#include "base/texels.hpp"

namespace tetrakis::inline ratecontrol {

class ScreenModel {
 public:
  /// texels_per_height: texels that the texture moves per unit of height error.
  ScreenModel(const Texels& texture, double texels_per_height);

  /// Mean squared error of the picture (texture units) where the heights' mean squared error is
  /// `height_mse`. Rises from 0, concave.
  double cost(double height_mse) const;

 private:
  struct Patch {
    double variance, gradient;
  };
  std::vector<Patch> patches_;
  double squared_parallax_;
};

/// Texture metres that one metre of height error moves in the default oblique view: cot 35 degrees.
inline constexpr double kDefaultParallax = 1.43;

}  // namespace tetrakis::inline ratecontrol

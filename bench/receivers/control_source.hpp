// SPDX-License-Identifier: Apache-2.0
// The source of bench/control, frames of heights, and what a viewer of them sees wrongly.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "apps/tools/report/scene.hpp"
#include "ratecontrol/receiver/ground_sight.hpp"
#include "tetrakis/result.hpp"
#include "tetrakis/tetrakis.h"

namespace tetrakis::bench {

using Heights = std::vector<float>;  ///< row by row, in their unit

/// Frames without voids, all of one size, `fps` a second.
struct Source {
  std::vector<Heights> frames;
  uint32_t width = 0, height = 0;
  double step = 1;   ///< that samples are multiples of
  double range = 1;  ///< of the first frame's heights
  double fps = 5;
  tools::PlacedFrame place;

  double seconds() const { return static_cast<double>(frames.size()) / fps; }
  /// The same ground in every frame.
  Source still() const;
};

/// All frames that a folder holds as *.tif. TKS_USAGE: they are not alike, or have voids.
Result<Source> readSource(const std::string& folder, double fps);

/// The heights of a part, in steps, for encoders. `data` outlives it.
tks_heights givenHeights(uint32_t width, uint32_t height, const Heights& data);

/// Where a viewer is who flies over the ground, and turns half of the way.
tks_screen_camera flightAt(const Source& source, double time);

/// PSNR of shown heights beside a frame: of all of them alike, or by the pixels that show them.
double psnrOf(const Source& source, size_t frame, const Heights& shown,
              const std::optional<tks_screen_camera>& view);

}  // namespace tetrakis::bench

// SPDX-License-Identifier: Apache-2.0
// screenWeights() gives each sample of a surface a weight: the cost of a height error there in the
// pictures of cameras (thesis 6.1, figure 6.4). Meshes with these weights err least on the screen.
//
// A sample that is too high by e moves the ground that it carries by e v on the screen, v =
// d(screen) / d(height). The picture I then errs by I(s) - I(s - e v) wherever that ground is seen:
// by the squared derivative of the picture along v, on as many pixels as the sample covers. So
//
//   weight = sum over cameras of  c A |v|^2 D,  c = weight of the camera / pixels that show ground
//
// A: pixels that the sample covers, the determinant of its ground axes on the screen; 0 where it is
// hidden. D: mean squared difference of brightness to the pixels a pixel away, along v and against
// it; ground with little in it, and ground seen from above, gets few triangles, and outlines before
// the sky many. Without an image all ground has the same detail, of a sample's size: D = min(1, 1 /
// A). Hidden ground keeps a 64th of the mean, so that meshes stay sensible where cameras do not
// look.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "codec/mesh/screen/surface_picture.hpp"
#include "codec/mesh/surface/weighted_surface.hpp"

namespace tetrakis::inline screen {

/// Returns a weight for each sample, for SurfaceView::weights: means over 3 x 3 samples, rounded to
/// multiples of 2^-10 of the mean of all, from 2^-6 to 2^14; 1 where a sample is not known, and
/// everywhere if no view sees ground. The surface's own weights do not count. The same bits with
/// every compiler.
std::vector<float> screenWeights(const WeightedSurface& surface, std::span<const ScreenView> views,
                                 const GroundImage& image);

/// Bytes that this takes at most beside what it is given: weights, costs, and a picture.
uint64_t screenWeightsBytes(uint64_t samples);

}  // namespace tetrakis::inline screen

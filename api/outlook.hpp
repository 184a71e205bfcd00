// SPDX-License-Identifier: Apache-2.0
// outlookOf() takes a camera, which takeCamera() has checked, and returns the ground that its
// viewer sees or may see after a turn, so that the bytes for that ground can be fetched first.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "api/decoder.hpp"
#include "base/plane.hpp"
#include "base/view.hpp"
#include "ratecontrol/receiver/fetch_plan.hpp"
#include "ratecontrol/receiver/globe_sight.hpp"
#include "tetrakis/result.hpp"
#include "tetrakis/tetrakis.h"

namespace tetrakis::inline api {

// takeCamera() checks a camera of a caller and copies it into the struct of this library.

/// Copies the fields that the caller's struct of a camera has; fields that it lacks are 0.
/// TKS_USAGE, TKS_UNSUPPORTED with a sentence that begins with `name` or holds it.
Status takeCamera(const std::string& name, const tks_screen_camera& given, tks_screen_camera& out);

/// TKS_UNSUPPORTED with a sentence about `what`, which knows no globe, if a camera looks at one.
Status refuseGlobes(const std::string& what, std::span<const tks_screen_camera> cameras);

/// All cameras of an array of structs of one size.
Result<std::vector<tks_screen_camera>> takeCameras(const tks_screen_camera* given, uint32_t count);

/// How much a camera counts beside others.
inline double weightOf(const tks_screen_camera& camera) {
  return camera.weight > 0 ? camera.weight : 1;
}

// outlookOf() tells which ground a camera of the caller sees, as far as the decoder knows it, and
// which ground it would see after a turn on the spot. A plan for the present picture alone leaves
// the ground behind the viewer bare: the first picture after a turn lost 11 dB.

constexpr uint32_t kCoarsePoints = 128;  ///< a side: hidden ground need not be known more finely

/// The first level with no more than so many samples along the longer side.
inline View coarseViewOf(Extent plane, uint32_t most = kCoarsePoints) {
  View view;
  while ((std::max(plane.width, plane.height) - 1) >> view.level >= most) ++view.level;
  return view;
}

/// Heights in the unit from what is there: 0 where nothing is, the lowest one where they are void.
/// TKS_LIMIT.
Result<std::vector<float>> coarseHeights(tks_decoder& decoder, const View& view);

/// The ground at a coarse mip level, from what is there; flat where nothing is.
Result<CoarseGround> coarseGround(tks_decoder& decoder);

/// The same of heights round a globe, and of a texture that lies otherwise; without points: it lies
/// as the heights do.
struct CoarseGlobe {
  GlobeGround heights, texture;
};

/// TKS_USAGE: as tks_decode_globe. TKS_LIMIT.
Result<CoarseGlobe> coarseGlobe(tks_decoder& decoder, const tks_globe* globe);

/// camera: one that takeCamera() took.
Sighting sightingOf(const CoarseGround& ground, const tks_screen_camera& camera,
                    uint32_t triangles);
Sighting sightingOf(const CoarseGlobe& globe, const tks_screen_camera& camera, uint32_t triangles);

/// Sightings of the ground that this viewer sees, of the ground around it, which comes into the
/// picture after a turn, and of all ground.
std::vector<WeightedSighting> outlookOf(const tks_decoder& decoder, const CoarseGround& ground,
                                        const tks_screen_camera& camera, uint32_t triangles);
std::vector<WeightedSighting> outlookOf(const CoarseGlobe& globe, const tks_screen_camera& camera,
                                        uint32_t triangles);

/// TKS_LIMIT with a sentence if choosing packets takes more than the limit. beside: further bytes.
Status checkPlanMemory(const tks_decoder& decoder, uint64_t beside = 0);

}  // namespace tetrakis::inline api

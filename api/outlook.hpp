// SPDX-License-Identifier: Apache-2.0
// outlookOf() takes a camera, which takeCamera() has checked, and returns the ground that its
// viewer sees or may see after a turn, so that the bytes for that ground can be fetched first.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "api/decoder.hpp"
#include "ratecontrol/receiver/fetch_plan.hpp"
#include "tetrakis/result.hpp"
#include "tetrakis/tetrakis.h"

namespace tetrakis::inline api {

// takeCamera() checks a camera of a caller and copies it into the struct of this library.

/// What the caller has of a camera; fields that it lacks are 0. TKS_USAGE, TKS_UNSUPPORTED with a
/// sentence that begins with `name` or holds it.
Status takeCamera(const std::string& name, const tks_screen_camera& given, tks_screen_camera& out);

/// All cameras of an array of structs of one size.
Result<std::vector<tks_screen_camera>> takeCameras(const tks_screen_camera* given, uint32_t count);

/// How much a camera counts beside others.
inline double weightOf(const tks_screen_camera& camera) {
  return camera.weight > 0 ? camera.weight : 1;
}

// outlookOf() tells which ground a camera of the caller sees, as far as the decoder knows it, and
// which ground it would see after a turn on the spot. A plan for the present picture alone leaves
// the ground behind the viewer bare: the first picture after a turn lost 11 dB.

/// The ground at a coarse mip level, from what is there; flat where nothing is.
Result<CoarseGround> coarseGround(tks_decoder& decoder);

/// camera: one that takeCamera() took.
Sighting sightingOf(const CoarseGround& ground, const tks_screen_camera& camera,
                    uint32_t triangles);

/// What that viewer sees, and what else may come into the picture: the ground around, after a turn,
/// and all of the ground.
std::vector<WeightedSighting> outlookOf(const tks_decoder& decoder, const CoarseGround& ground,
                                        const tks_screen_camera& camera, uint32_t triangles);

/// TKS_LIMIT with a sentence if choosing packets takes more than the limit.
Status checkPlanMemory(const tks_decoder& decoder);

}  // namespace tetrakis::inline api

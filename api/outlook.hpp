// SPDX-License-Identifier: Apache-2.0
// outlookOf() tells which ground a camera of the caller sees, as far as the decoder knows it, and
// which ground it would see after a turn on the spot. A plan for the present picture alone leaves
// the ground behind the viewer bare: the first picture after a turn lost 11 dB.
#pragma once

#include "api/decoder.hpp"
#include "ratecontrol/receiver/fetch_plan.hpp"

namespace tetrakis::inline api {

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

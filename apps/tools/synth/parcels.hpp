// SPDX-License-Identifier: Apache-2.0
// parcelAt() divides a plain into parcels as farmers do.
#pragma once

#include <cstdint>

#include "apps/tools/synth/noise.hpp"

namespace tetrakis::tools::synth {

struct Parcel {
  uint64_t id = 0;
  double edge = 0;     ///< metres to the nearest boundary
  double along = 0;    ///< metres along its furrows
  double across = 0;   ///< metres across them
  bool track = false;  ///< the nearest boundary is a farm track, not a hedge
};

/// The parcel at a place in metres. Districts of about 1.5 km, each with a direction of its own,
/// are cut into strips and these into parcels of 1 to 12 hectares.
Parcel parcelAt(uint64_t seed, Point metres);

}  // namespace tetrakis::tools::synth

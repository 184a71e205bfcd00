// SPDX-License-Identifier: Apache-2.0
// chooseBridges() takes a plane with voids and returns the reach of the bridges that save bytes,
// and bridged() fills the bridged voids with values that take few bytes. Encoder only.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "base/plane.hpp"
#include "codec/wavelet/choice/filter_choice.hpp"

namespace tetrakis::inline choice {

// bridged() fills bridged voids (codec/wavelet/morphology.hpp) with a smooth surface through the
// samples around them. Decoders throw these values away, so an encoder is free to choose the ones
// that take the fewest bytes.

/// Returns the plane with the voids that are lifted filled smoothly; all other values stay as they
/// are. plane: with the mask of valid samples, which has bytes. Values stay within those of the
/// valid samples.
std::vector<int32_t> bridged(const PlaneView<const int32_t>& plane, Mask lifted);

// chooseBridges() decides which voids are bridged (codec/wavelet/morphology.hpp). Holes of single
// samples cut lifting short, and cost a multiple of the bytes of the samples in them; a frame of
// voids is cheaper as it is. Bridges are chosen by the cost of typical parts, at the step of the
// target and at coarser ones, because prefixes pay as well.

/// A plane over whose voids lifting goes on.
struct BridgedPlane {
  uint8_t reach = 0;            ///< 0: none of them pays; the rest is empty then
  std::vector<uint8_t> lifted;  ///< liftedSamples(); empty: all
  std::vector<int32_t> values;  ///< with what stands at voids
};

/// What a plane is coded for.
struct BridgeTarget {
  Purpose purpose;
  uint64_t bytes = UINT64_MAX;  ///< that there will be for it
  double mean_square = 0;       ///< > 0: the error wanted
  uint8_t most = 255;           ///< reach that may be chosen
  /// Whether bridges with such lifted samples are better for other reasons; they may lose 1 % of
  /// the bits against the best. Null: none are.
  std::function<bool(const std::vector<uint8_t>& lifted)> preferred = {};
  /// Only preferred ones will do, whatever they cost: the mask alone leaves too few bytes.
  bool needed = false;
};

/// plane: of so many bits, with the mask of valid samples.
BridgedPlane chooseBridges(const PlaneView<const int32_t>& plane, int bits,
                           const BridgeTarget& target);

}  // namespace tetrakis::inline choice

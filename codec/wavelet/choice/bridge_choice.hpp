// SPDX-License-Identifier: Apache-2.0
// chooseBridges() decides which voids are bridged (codec/wavelet/bridges.hpp). Holes of single
// samples cut lifting short, and cost a multiple of the bytes of the samples in them; a frame of
// voids is cheaper as it is. Bridges are chosen by the cost of typical parts, at the step of the
// target and at coarser ones, because prefixes pay as well.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "base/plane.hpp"
#include "codec/wavelet/choice/filter_choice.hpp"

namespace tetrakis::inline choice {

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

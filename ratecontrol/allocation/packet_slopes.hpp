// SPDX-License-Identifier: Apache-2.0
// stateSlopes() computes the worth of a byte of each packet, which the front index states
// (docs/FORMAT.md, section 2), so that viewers can choose packets for the ground that they look at.
#pragma once

#include <array>
#include <span>

#include "bitstream/stream/packet.hpp"
#include "ratecontrol/allocation/pair_errors.hpp"
#include "ratecontrol/curves/component_curve.hpp"

namespace tetrakis::inline allocation {

/// Sets the slopes of packets, which are in their joint order: what each takes off the error of the
/// picture per byte, where it stands. Within a component slopes do not rise, because what looks
/// cheap behind something dear needs that first. A null curve: there is no such component; null
/// errors: there is but one, and its own squared error counts.
void stateSlopes(std::span<Packet> packets,
                 const std::array<const ComponentCurve*, kComponents>& curves,
                 const PairErrors* errors);

}  // namespace tetrakis::inline allocation

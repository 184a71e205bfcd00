// SPDX-License-Identifier: Apache-2.0
// What a byte of each packet is worth, for viewers that choose packets by what they look at: the
// front index says it (docs/FORMAT.md, section 2).
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

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

/// Sets the slopes of packets, which are in their joint order: the error of the picture that each
/// packet takes off per byte, at its place in the order. Within a component slopes do not rise,
/// because a cheap packet behind a dear one needs the dear one first. A null curve: the stream
/// lacks the component; null errors: there is only one component, and its own squared error counts.
void stateSlopes(std::span<Packet> packets,
                 const std::array<const ComponentCurve*, kComponents>& curves,
                 const PairErrors* errors);

}  // namespace tetrakis::inline allocation

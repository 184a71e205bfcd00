// SPDX-License-Identifier: Apache-2.0
// Marginal allocation (thesis 6.3): this file puts the packets of both components into one order,
// by falling slope. Read backwards, the order gives up the packet that costs least per byte first,
// so every prefix divides its bytes well between the components. It does not depend on any budget.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "bitstream/stream/packet.hpp"
#include "ratecontrol/component_curve.hpp"

namespace tetrakis::inline ratecontrol {

/// Steepest slope first; within a component the order of its packets. Equal slopes: geometry first.
std::vector<Packet> allocate(const std::array<ComponentCurve, kComponents>& curves);

/// The same bytes in fewer packets: neighbours of one track become one, as long as it takes less
/// than two steps of stated quality (1.5 dB). Packets that count only when whole stay as they are.
std::vector<Packet> joinNeighbours(std::span<const Packet> packets);

}  // namespace tetrakis::inline ratecontrol

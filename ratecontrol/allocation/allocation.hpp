// SPDX-License-Identifier: Apache-2.0
// allocate() puts the packets of both components into one order, by marginal analysis (thesis
// 6.3.2). The next packet is always the one that lowers the error of the picture most per byte, and
// both slopes are renewed after each step, because errors of heights and of textures do not add.
// Read backwards, the order gives up first what costs least per byte. It does not depend on any
// budget.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "bitstream/stream/packet.hpp"
#include "ratecontrol/allocation/pair_errors.hpp"
#include "ratecontrol/curves/component_curve.hpp"

namespace tetrakis::inline allocation {

/// Orders the packets of both components. Within a component their order stays. Of equal slopes,
/// geometry comes first. A slope is the steepest to any point further on: where heights are still
/// so coarse that the next packet changes little, the packets behind it count. Openings come before
/// the packets that need them, whatever they cost.
std::vector<Packet> allocate(const std::array<ComponentCurve, kComponents>& curves,
                             const PairErrors& errors);

/// The same bytes in fewer packets: neighbours of one track are joined if they take less than two
/// steps of stated quality (1.5 dB) together. Packets that count only when whole stay as they are.
std::vector<Packet> joinNeighbours(std::span<const Packet> packets);

}  // namespace tetrakis::inline allocation

// SPDX-License-Identifier: Apache-2.0
// The functions here keep the packets of an order that fit in a budget of bytes, to which the heads
// of packets count, and move packets so that one component ends within it.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "bitstream/stream/packet.hpp"

namespace tetrakis::inline needs {

/// Returns the bytes of all packets with their heads.
uint64_t bytesOfPackets(std::span<const Packet> packets);

/// Returns the payload bytes of each component that the first `budget` bytes of the packets hold.
std::array<uint64_t, kComponents> payloadWithin(std::span<const Packet> packets, uint64_t budget);

/// Keeps the packets that begin within the budget.
std::vector<Packet> keepWithinBudget(std::span<const Packet> packets, uint64_t budget);

/// Orders packets so that the packets that hold the first `needed` payload bytes of a component, or
/// all of its packets, end within the budget, if the budget has room for them: packets of the other
/// component that would push the last of them out come behind it.
std::vector<Packet> endWithin(std::span<const Packet> packets, Component component, uint64_t needed,
                              uint64_t budget);

/// The RMSE of each component that its last packet within the budget states; without a packet, the
/// largest RMSE that can be stated.
std::array<double, kComponents> statedWithin(std::span<const Packet> packets, uint64_t budget);

}  // namespace tetrakis::inline needs

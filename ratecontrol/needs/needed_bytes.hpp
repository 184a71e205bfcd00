// SPDX-License-Identifier: Apache-2.0
// The functions here find the number of bytes of each component that a target needs, and keep the
// packets that hold them. They decode nothing: the caller says whether a number of bytes suffices.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "bitstream/stream/packet.hpp"

namespace tetrakis::inline needs {

/// Payload bytes of each component's packets, in their order.
using Needs = std::array<uint64_t, kComponents>;
inline constexpr uint64_t kAllBytes = UINT64_MAX;

/// The least bytes that `meets` accepts, to 1/64 of a packet, by bisection, as quality rises with
/// bytes; nothing if it accepts no end of a packet. packets: of one component.
std::optional<uint64_t> leastBytes(std::span<const Packet> packets,
                                   const std::function<bool(uint64_t bytes)>& meets);

/// The bytes of each component that have been sent when the first `bytes` of `component` have; all
/// bytes if there are fewer.
Needs sentWith(std::span<const Packet> packets, Component component, uint64_t bytes);

/// The packets that hold the needed bytes. The last packet of a component ends where its need ends,
/// and quality_after gives the quality that it then states.
std::vector<Packet> keepNeeded(
    std::span<const Packet> packets, const Needs& needs,
    const std::function<uint8_t(Component component, uint64_t bytes)>& quality_after);

/// Bytes of the codewords that all packets hold.
uint64_t payloadOf(std::span<const Packet> packets);

}  // namespace tetrakis::inline needs

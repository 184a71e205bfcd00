// SPDX-License-Identifier: Apache-2.0
// leastBytes() finds the bytes of a component that a target needs, and keepNeeded() and
// keepWithinBudget() the packets that hold them, or that fit a budget. fewestBytes() chooses the
// Candidate that needs the fewest. Nothing is decoded: callers say what suffices.
#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "bitstream/stream/packet.hpp"
#include "ratecontrol/curves/component_curve.hpp"

namespace tetrakis::inline needs {

// leastBytes() finds the number of bytes of each component that a target needs, and keepNeeded()
// keeps the packets that hold them. They decode nothing: the caller says whether a number of bytes
// suffices.

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

// keepWithinBudget() keeps the packets of an order that fit in a budget of bytes, to which the
// heads of packets count, and endWithin() moves packets so that one component ends within it.

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

// A Candidate is the result of one attempt to code a component, with its curve once that is known.
// Attempts do not know of each other and change nothing that they are given, so that none of them
// has anything to take back: fewestBytes() chooses among the candidates.

/// Coded: CodedHeights or CodedTexture.
template <class Coded>
struct Candidate {
  std::shared_ptr<const Coded> coded;
  std::optional<ComponentCurve> curve = {};  ///< once somebody needed it
  uint64_t need = kAllBytes;                 ///< bytes of its packets that the target needs

  uint64_t bytes() const { return std::min(need, bytesOf(coded->tracks)) + coded->inHeader(); }
};

/// A candidate whose target needs all of its bytes, without a curve.
template <class Coded>
Candidate<Coded> candidateOf(Coded coded) {
  return {std::make_shared<const Coded>(std::move(coded))};
}

/// The candidate of the fewest bytes; of equal ones the first. There is at least one. lost: called
/// with each of the others.
template <class Coded, class Lost>
Candidate<Coded> fewestBytes(std::vector<Candidate<Coded>> candidates, const Lost& lost) {
  assert(!candidates.empty());
  const auto best = std::min_element(
      candidates.begin(), candidates.end(),
      [](const Candidate<Coded>& a, const Candidate<Coded>& b) { return a.bytes() < b.bytes(); });
  for (auto one = candidates.begin(); one != candidates.end(); ++one)
    if (one != best) lost(*one);
  return std::move(*best);
}

}  // namespace tetrakis::inline needs

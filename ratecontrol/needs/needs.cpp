// SPDX-License-Identifier: Apache-2.0
#include "ratecontrol/needs/needs.hpp"

#include <algorithm>
#include <cassert>

namespace tetrakis::inline needs {

namespace {

/// The part of a packet to which the bytes that a target needs are found. A larger number saves as
/// many bytes, and takes the time of decoding more prefixes.
constexpr uint64_t kClosePart = 64;

/// A packet among the payload bytes of its component.
struct PayloadRange {
  uint64_t begin, end;
  bool whole;
};

std::vector<PayloadRange> rangesOf(std::span<const Packet> packets) {
  std::vector<PayloadRange> ranges;
  uint64_t sent = 0;
  for (const Packet& packet : packets) {
    assert(packet.begin < packet.end && packet.component == packets.front().component);
    ranges.push_back({sent, sent + packet.length(), packet.whole});
    sent = ranges.back().end;
  }
  return ranges;
}

}  // namespace

std::optional<uint64_t> leastBytes(std::span<const Packet> packets,
                                   const std::function<bool(uint64_t)>& meets) {
  const std::vector<PayloadRange> ranges = rangesOf(packets);
  if (meets(0)) return 0;
  const auto packet = std::partition_point(ranges.begin(), ranges.end(),
                                           [&](const PayloadRange& p) { return !meets(p.end); });
  if (packet == ranges.end()) return {};
  if (packet->whole) return packet->end;
  uint64_t low = packet->begin, high = packet->end;
  const uint64_t close = std::max<uint64_t>(1, (high - low) / kClosePart);
  while (high - low > close) {
    const uint64_t middle = low + (high - low) / 2;
    (meets(middle) ? high : low) = middle;
  }
  assert(low < high && high <= packet->end);
  return high;
}

Needs sentWith(std::span<const Packet> packets, Component component, uint64_t bytes) {
  Needs sent = {};
  const uint64_t& of_component = sent[static_cast<size_t>(component)];
  for (const Packet& packet : packets) {
    sent[static_cast<size_t>(packet.component)] += packet.length();
    if (packet.component == component && of_component >= bytes) break;
  }
  return sent;
}

std::vector<Packet> keepNeeded(
    std::span<const Packet> packets, const Needs& needs,
    const std::function<uint8_t(Component component, uint64_t bytes)>& quality_after) {
  Needs left = needs;
  std::vector<Packet> kept;
  for (Packet packet : packets) {
    assert(packet.begin < packet.end);
    const auto component = static_cast<size_t>(packet.component);
    const uint64_t taken = std::min(left[component], packet.length());
    left[component] -= taken;
    if (taken == 0) continue;
    if (packet.begin + taken < packet.end) {
      packet.end = packet.begin + taken;
      packet.quality = quality_after(packet.component, needs[component]);
    }
    kept.push_back(packet);
  }
  return kept;
}

uint64_t payloadOf(std::span<const Packet> packets) {
  uint64_t total = 0;
  for (const Packet& packet : packets) total += packet.length();
  return total;
}

namespace {

/// The bytes of the packet with its head.
uint64_t sizeOf(const Packet& packet) {
  return overheadOf(packet) + packet.length();
}

}  // namespace

uint64_t bytesOfPackets(std::span<const Packet> packets) {
  uint64_t total = 0;
  for (const Packet& packet : packets) total += sizeOf(packet);
  return total;
}

std::array<uint64_t, kComponents> payloadWithin(std::span<const Packet> packets, uint64_t budget) {
  std::array<uint64_t, kComponents> payload{};
  for (const Packet& packet : packets) {
    budget -= std::min<uint64_t>(budget, overheadOf(packet));
    const uint64_t held = std::min(budget, packet.length());
    payload[static_cast<size_t>(packet.component)] += held;
    budget -= held;
  }
  return payload;
}

std::vector<Packet> keepWithinBudget(std::span<const Packet> packets, uint64_t budget) {
  uint64_t begin = 0;
  size_t kept = 0;
  for (; kept < packets.size() && begin < budget; ++kept) begin += sizeOf(packets[kept]);
  assert(kept == packets.size() || begin >= budget);
  return {packets.begin(), packets.begin() + static_cast<ptrdiff_t>(kept)};
}

std::vector<Packet> endWithin(std::span<const Packet> packets, Component component, uint64_t needed,
                              uint64_t budget) {
  uint64_t whole = 0, held = 0;  // bytes of the needed packets, and of their payload
  size_t count = 0;              // of packets up to the last needed one
  for (size_t i = 0; i < packets.size() && held < needed; ++i) {
    if (packets[i].component != component) continue;
    whole += sizeOf(packets[i]);
    held += packets[i].length();
    count = i + 1;
  }
  std::vector<Packet> order, behind;
  uint64_t room = budget - std::min(budget, whole);  // for the other component
  for (const Packet& packet : packets.first(count)) {
    const bool others = packet.component != component;
    if (others && behind.empty() && sizeOf(packet) <= room) {
      room -= sizeOf(packet);
      order.push_back(packet);
    } else {
      (others ? behind : order).push_back(packet);
    }
  }
  order.insert(order.end(), behind.begin(), behind.end());
  order.insert(order.end(), packets.begin() + static_cast<ptrdiff_t>(count), packets.end());
  return order;
}

std::array<double, kComponents> statedWithin(std::span<const Packet> packets, uint64_t budget) {
  std::array<double, kComponents> rmse = {rmseOf(255), rmseOf(255)};
  for (const Packet& packet : packets) {
    const uint64_t size = sizeOf(packet);
    if (size > budget) break;
    budget -= size;
    rmse[static_cast<size_t>(packet.component)] = rmseOf(packet.quality);
  }
  return rmse;
}

}  // namespace tetrakis::inline needs

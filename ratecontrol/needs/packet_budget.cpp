// SPDX-License-Identifier: Apache-2.0
#include "ratecontrol/needs/packet_budget.hpp"

#include <algorithm>
#include <cassert>

namespace tetrakis::inline needs {

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

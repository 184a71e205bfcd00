// SPDX-License-Identifier: Apache-2.0
#include "ratecontrol/allocation.hpp"

#include <algorithm>
#include <cassert>
#include <utility>

namespace tetrakis::inline ratecontrol {

namespace {

struct Priced {
  double slope;  // distortion removed per byte
  std::vector<Packet> packets;
};

std::vector<Priced> price(const ComponentCurve& curve) {
  std::vector<Priced> out;
  auto next = curve.packets.begin();
  uint64_t sent = 0;
  for (size_t i = 1; i < curve.points.size(); ++i) {
    const RatePoint &a = curve.points[i - 1], &b = curve.points[i];
    std::vector<Packet> packets;
    for (; sent < b.bytes && next != curve.packets.end(); ++next) {
      sent += next->end - next->begin;
      packets.push_back(*next);
    }
    assert(a.bytes < b.bytes && sent == b.bytes);
    out.push_back({(a.distortion - b.distortion) / static_cast<double>(b.bytes - a.bytes),
                   std::move(packets)});
  }
  return out;
}

}  // namespace

std::vector<Packet> allocate(const std::array<ComponentCurve, kComponents>& curves) {
  std::vector<Packet> order;
  const std::vector<Priced> geometry = price(curves[0]);
  const std::vector<Priced> texture = price(curves[1]);
  // Convex curves have falling slopes, so a merge keeps each codeword in order.
  size_t g = 0, t = 0;
  while (g < geometry.size() || t < texture.size()) {
    const bool take_geometry =
        t == texture.size() || (g < geometry.size() && geometry[g].slope >= texture[t].slope);
    const Priced& next = take_geometry ? geometry[g++] : texture[t++];
    order.insert(order.end(), next.packets.begin(), next.packets.end());
  }
  return order;
}

std::vector<Packet> joinNeighbours(std::span<const Packet> packets) {
  constexpr int kQualitySteps = 2;
  std::vector<Packet> joined;
  // Stated of each component ahead of the last packet, and with it.
  std::array<int, kComponents> before = {511, 511}, stated = {511, 511};
  for (const Packet& packet : packets) {
    const auto component = static_cast<size_t>(packet.component);
    const bool same_track = !joined.empty() && joined.back().component == packet.component &&
                            joined.back().track == packet.track;
    if (same_track && !joined.back().whole && !packet.whole &&
        before[component] - packet.quality <= kQualitySteps) {
      assert(joined.back().end == packet.begin);
      joined.back().end = packet.end;
      joined.back().quality = packet.quality;
    } else {
      before[component] = stated[component];
      joined.push_back(packet);
    }
    stated[component] = packet.quality;
  }
  return joined;
}

}  // namespace tetrakis::inline ratecontrol

// SPDX-License-Identifier: Apache-2.0
#include "ratecontrol/receiver/placed_packets.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "bitstream/stream/geometry_header.hpp"
#include "bitstream/stream/scattered_packets.hpp"

namespace tetrakis::inline receiver {

namespace {

/// What packets are worth, taken in the stream's order, beside those before them: it does not rise
/// within a track, and a component's opening comes before all others.
class WorthInOrder {
 public:
  explicit WorthInOrder(const StreamHeader& header) : header_(header) {}

  /// worth: of the packet without what came before.
  PacketWorth take(const PacketHead& head, const PacketWorth& worth) {
    const auto component = static_cast<size_t>(head.component);
    if (head.track == 0 && opened_[component] < openingBytes(header_, head.component)) {
      opened_[component] += head.length;
      return {kOpening, kOpening, kOpening};
    }
    const auto [last, is_new] = last_.try_emplace({head.component, head.track}, worth);
    last->second = last->second.least(worth);
    return last->second;
  }

 private:
  const StreamHeader& header_;
  std::array<uint64_t, kRoles> opened_{};
  std::map<std::pair<Component, uint32_t>, PacketWorth> last_;
};

/// Whether a packet holds corrections in tracks of their own.
bool isCorrection(const StreamHeader& header, const PacketHead& head) {
  if (head.component != Component::kGeometry || !header.geometry) return false;
  return head.track >= coefficientTracks(*header.geometry);
}

/// Corrections come behind all coefficients that help: beside those that lack something they
/// correct nothing.
class CorrectionsLast {
 public:
  void take(const PacketWorth& worth, bool is_correction) {
    if (!(worth.all > 0) || worth.all == kOpening) return;
    if (is_correction)
      most_ = std::max(most_, worth.all);
    else
      least_ = std::min(least_, worth.all);
  }

  PacketWorth of(const PacketWorth& correction) const {
    const double factor = most_ > 0 && least_ < kOpening ? least_ / (2 * most_) : 1;
    return {correction.all * factor, correction.now * factor, 0};
  }

 private:
  double least_ = kOpening, most_ = 0;
};

}  // namespace

bool helpsMore(const PacketWorth& a, const PacketWorth& b) {
  return a.all != b.all ? a.all > b.all : a.slope > b.slope;
}

Result<std::vector<PlacedPacket>> placedPackets(const StreamHeader& header, uint64_t begin,
                                                std::span<const WeightedSighting> sightings) {
  std::vector<TrackCosts> costs;
  costs.reserve(sightings.size());
  for (const WeightedSighting& s : sightings) costs.emplace_back(header, s.sighting);
  const TrackCounts counts = trackCounts(header);
  WorthInOrder in_order(header);
  CorrectionsLast last;
  std::vector<PlacedPacket> packets;
  packets.reserve(header.index.size());
  for (const IndexedPacket& packet : IndexedPackets(header, begin)) {
    const PacketHead& head = packet.entry.packet;
    if (head.component == Component::kOther && counts.of(head).tracks > 0) {
      packets.push_back(
          {packet.number, packet.begin, packet.end, {}, false});  // worth nothing here
      continue;
    }
    const bool is_correction = isCorrection(header, head);
    const double slope = is_correction ? 1 : slopeOf(packet.entry.slope);
    PacketWorth worth{0, 0, slope};
    for (size_t i = 0; i < costs.size(); ++i) {
      if (!costs[i].holds(head))
        return Status(TKS_CORRUPT, "Corrupt stream: its index names a track that there is not.");
      const double here = slope * sightings[i].weight * costs[i].at(head);
      if (i == 0) worth.now = here;
      worth.all += here;
    }
    packets.push_back(
        {packet.number, packet.begin, packet.end, in_order.take(head, worth), is_correction});
    last.take(packets.back().worth, is_correction);
  }
  for (PlacedPacket& packet : packets)
    if (packet.is_correction) packet.worth = last.of(packet.worth);
  return packets;
}

std::vector<PlacedPacket> withFiniteOpenings(std::vector<PlacedPacket> packets,
                                             uint64_t request_bytes) {
  double most = std::numeric_limits<double>::min();
  for (const PlacedPacket& packet : packets)
    if (packet.worth.all < kOpening) most = std::max(most, packet.worth.all);
  const double opening = 2 * most * (static_cast<double>(request_bytes) + 2);
  for (PlacedPacket& packet : packets)
    if (packet.worth.all == kOpening) packet.worth = {opening, opening, opening};
  return packets;
}

}  // namespace tetrakis::inline receiver

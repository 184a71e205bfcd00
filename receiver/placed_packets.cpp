// SPDX-License-Identifier: Apache-2.0
#include "receiver/placed_packets.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "bitstream/stream/pieces.hpp"
#include "receiver/track_costs.hpp"

namespace tetrakis::inline receiver {

namespace {

/// Follows an index through the stream. What packets are worth does not rise within a track.
class IndexWalk {
 public:
  explicit IndexWalk(const StreamHeader& header, uint64_t begin)
      : header_(header), counts_(trackCounts(header)), place_(begin) {}

  /// Where the next packet begins.
  uint64_t place() const { return place_; }

  /// worth: of an entry without what came before.
  PlacedPacket take(const IndexEntry& entry, const PacketWorth& worth) {
    const PacketHead& head = entry.packet;
    const auto component = static_cast<size_t>(head.component());
    const uint64_t length = head.head >> 2;
    const size_t before = headBytes(head, counts_[component].named).size();
    constexpr uint64_t kBehindAll = uint64_t{1} << 63;  // lengths are below 2^62
    const uint64_t end = std::min(place_ + before + length, kBehindAll);
    PlacedPacket packet = {number_++, place_, end, worth};
    place_ = end;
    if (head.track == 0 && opened_[component] < openingBytes(header_, head.component())) {
      opened_[component] += length;
      packet.worth = {kOpening, kOpening, kOpening};
      return packet;
    }
    const auto [last, is_new] = last_.try_emplace({head.component(), head.track}, worth);
    packet.worth = last->second = last->second.least(worth);
    return packet;
  }

 private:
  const StreamHeader& header_;
  TrackCounts counts_;
  uint64_t place_;
  size_t number_ = 0;
  std::array<uint64_t, kComponents> opened_{};
  std::map<std::pair<Component, uint32_t>, PacketWorth> last_;
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
  IndexWalk walk(header, begin);
  std::vector<PlacedPacket> packets;
  packets.reserve(header.index.size());
  for (const IndexEntry& entry : header.index) {
    if (walk.place() >= begin + header.payload_bytes) break;  // the index runs ahead of the packets
    const double slope = slopeOf(entry.slope);
    PacketWorth worth{0, 0, slope};
    for (size_t i = 0; i < costs.size(); ++i) {
      if (!costs[i].holds(entry.packet))
        return Status(TKS_CORRUPT, "Corrupt stream: its index names a track that there is not.");
      const double here = slope * sightings[i].weight * costs[i].at(entry.packet);
      if (i == 0) worth.now = here;
      worth.all += here;
    }
    packets.push_back(walk.take(entry, worth));
  }
  return packets;
}

void boundOpenings(std::vector<PlacedPacket>& packets, uint64_t request_bytes) {
  double most = std::numeric_limits<double>::min();
  for (const PlacedPacket& packet : packets)
    if (packet.worth.all < kOpening) most = std::max(most, packet.worth.all);
  const double opening = 2 * most * (static_cast<double>(request_bytes) + 2);
  for (PlacedPacket& packet : packets)
    if (packet.worth.all == kOpening) packet.worth = {opening, opening, opening};
}

}  // namespace tetrakis::inline receiver

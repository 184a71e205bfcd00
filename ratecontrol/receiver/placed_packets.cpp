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

namespace {

/// Takes packets in the stream's order and says what they are worth.
class PacketsInOrder {
 public:
  PacketsInOrder(const StreamHeader& header, std::span<const WeightedSighting> sightings)
      : header_(header), sightings_(sightings), counts_(trackCounts(header)), in_order_(header) {
    costs_.reserve(sightings.size());
    for (const WeightedSighting& s : sightings) costs_.emplace_back(header, s.sighting);
  }

  Status take(const IndexedPacket& packet) {
    const PacketHead& head = packet.entry.packet;
    if (head.component == Component::kOther && counts_.of(head).tracks > 0) {
      packets_.push_back(
          {packet.number, packet.begin, packet.end, {}, false});  // worth nothing here
      return {};
    }
    const bool is_correction = isCorrection(header_, head);
    for (const TrackCosts& costs : costs_)
      if (!costs.holds(head))
        return {TKS_CORRUPT, "Corrupt stream: its index names a track that there is not."};
    const PacketWorth worth = worthOf(head, is_correction ? 1 : slopeOf(packet.entry.slope));
    packets_.push_back(
        {packet.number, packet.begin, packet.end, in_order_.take(head, worth), is_correction});
    last_.take(packets_.back().worth, is_correction);
    return {};
  }

  /// Records come behind all packets.
  void takeRecords(const PageIndex& pages) {
    std::vector<PacketWorth> best(pages.grid().pages());
    PacketHead head{.component = Component::kGeometry};
    for (uint64_t track = 0; track < pages.grid().tracks(); ++track) {
      const uint32_t page = pages.grid().pageOf(track);
      if (pages.isKnown(page)) continue;
      head.track = static_cast<uint32_t>(track);
      const PacketWorth worth = worthOf(head, slopeOf(pages.slope(page)));
      if (worth.all > best[page].all) best[page] = worth;
    }
    for (uint32_t page = 0; page < best.size(); ++page) {
      const auto [begin, end] = pages.record(page);
      if (pages.isKnown(page) || begin == end) continue;
      const PacketWorth first{kOpening, kOpening, kOpening};  // everything waits for the base
      packets_.push_back({packets_.size(), begin, end, page == 0 ? first : best[page], false});
    }
  }

  std::vector<PlacedPacket> result() && {
    for (PlacedPacket& packet : packets_)
      if (packet.is_correction) packet.worth = last_.of(packet.worth);
    return std::move(packets_);
  }

 private:
  PacketWorth worthOf(const PacketHead& head, double slope) const {
    PacketWorth worth{0, 0, slope};
    for (size_t i = 0; i < costs_.size(); ++i) {
      const double here = slope * sightings_[i].weight * costs_[i].at(head);
      if (i == 0) worth.now = here;
      worth.all += here;
    }
    return worth;
  }

  const StreamHeader& header_;
  std::span<const WeightedSighting> sightings_;
  TrackCounts counts_;
  std::vector<TrackCosts> costs_;
  WorthInOrder in_order_;
  CorrectionsLast last_;
  std::vector<PlacedPacket> packets_;
};

}  // namespace

Result<std::vector<PlacedPacket>> placedPackets(const StreamHeader& header, uint64_t begin,
                                                const PageIndex* pages,
                                                std::span<const WeightedSighting> sightings) {
  PacketsInOrder packets(header, sightings);
  if (pages == nullptr) {
    for (const IndexedPacket& packet : IndexedPackets(header, begin))
      if (Status status = packets.take(packet); !status.ok()) return status;
    return std::move(packets).result();
  }
  size_t number = 0;
  for (const PagedPacket& packet : pages->inOrder(pages->known())) {
    const IndexedPacket listed{
        number++, {packet.head, packet.slope}, packet.begin, packet.payload, packet.end()};
    if (Status status = packets.take(listed); !status.ok()) return status;
  }
  packets.takeRecords(*pages);
  return std::move(packets).result();
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

// SPDX-License-Identifier: Apache-2.0
#include "bitstream/stream/scattered_packets.hpp"

#include <algorithm>
#include <string>
#include <utility>

namespace tetrakis::inline stream {

IndexedPackets::IndexedPackets(const StreamHeader& header, uint64_t begin)
    : header_(header),
      counts_(trackCounts(header)),
      begin_(begin),
      end_(begin + header.payload_bytes) {}

void IndexedPackets::Iterator::place(uint64_t begin) {
  packet_.begin = begin;
  if (*this == std::default_sentinel) return;
  packet_.entry = packets_.header_.index[packet_.number];
  const PacketHead& head = packet_.entry.packet;
  // A packet begins within 2^63 bytes and has fewer than 2^62, so that 64 bits hold its end.
  packet_.payload = begin + headSize(head, packets_.counts_);
  packet_.end = packet_.payload + head.length;
}

uint64_t openingBytes(const StreamHeader& header, Component component) {
  if (component == Component::kGeometry) return header.layers.openingBytes();
  return component == Component::kTexture && header.texture
             ? header.texture->alpha_bytes + header.texture->overlay_bytes
             : 0;
}

ScatteredPackets::ScatteredPackets(const ParsedHeader& parsed, const Demultiplexed& taken)
    : header_(&parsed.header),
      counts_(taken.counts),
      begin_(parsed.bytes),
      end_(parsed.bytes + parsed.header.payload_bytes),
      front_(parsed.bytes + taken.end.at),
      front_taken_(0),
      front_number_(taken.heads.size()) {
  if (const std::optional<PacketHead>& open = taken.end.open) {
    front_ -= headSize(*open, counts_);
    front_taken_ = open->whole ? 0 : taken.end.seen;
    --front_number_;
  }
  std::vector<Place> packets;
  packets.reserve(header_->index.size());
  for (const IndexedPacket& packet : IndexedPackets(*header_, parsed.bytes))
    packets.push_back({packet.begin, packet.entry.packet});
  know(std::move(packets));
}

void ScatteredPackets::know(std::vector<Place>&& packets) {
  std::array<std::map<uint32_t, Place*>, kRoles> last;
  for (Place& packet : packets) {
    const auto component = static_cast<size_t>(packet.head.component);
    const auto [before, is_first] = last[component].try_emplace(packet.head.track, &packet);
    if (!is_first) std::exchange(before->second, &packet)->next = packet.begin;
    if (packet.begin >= front_)
      frontiers_[component].try_emplace(
          packet.head.track, Frontier{packet.begin, packet.begin == front_ ? front_taken_ : 0});
  }
  std::vector<Place> both(places_.size() + packets.size());
  std::merge(places_.begin(), places_.end(), packets.begin(), packets.end(), both.begin(),
             [](const Place& a, const Place& b) { return a.begin < b.begin; });
  places_ = std::move(both);
}

size_t ScatteredPackets::packetAt(uint64_t place) const {
  const auto after = std::upper_bound(places_.begin(), places_.end(), place,
                                      [](uint64_t at, const Place& p) { return at < p.begin; });
  return static_cast<size_t>(after - places_.begin()) - (after == places_.begin() ? 0 : 1);
}

Status ScatteredPackets::checkHead(const Pieces& pieces, const Place& packet) const {
  if (packet.head.track >= counts_.of(packet.head).tracks)
    return {TKS_CORRUPT, "Corrupt stream: its index names a track that there is not."};
  std::vector<uint8_t> bytes = headBytes(packet.head, counts_);
  if (header_->index.empty()) bytes.pop_back();  // the quality
  const std::span<const uint8_t> there = pieces.from(packet.begin);
  const size_t known = std::min<uint64_t>({bytes.size(), there.size(), end_ - packet.begin});
  if (packet.head.length > 0 &&
      std::equal(bytes.begin(), bytes.begin() + static_cast<ptrdiff_t>(known), there.begin()))
    return {};
  return {TKS_CORRUPT, "Corrupt stream: its index does not describe the packet at byte " +
                           std::to_string(packet.begin) + "."};
}

Status ScatteredPackets::check(const Pieces& pieces, ByteRange range) const {
  const uint64_t end = std::min(range.end, end_);
  for (size_t i = packetAt(range.begin); i < places_.size() && places_[i].begin < end; ++i)
    if (Status status = checkHead(pieces, places_[i]); !status.ok()) return status;
  if (header_->index.empty()) return {};  // pages that are not known describe the rest
  const PacketHead& last = places_.back().head;
  const uint64_t told = places_.back().begin + headSize(last, counts_) + last.length;
  if (std::max(range.begin, begin_) >= end || told >= end) return {};
  return {TKS_CORRUPT, "Corrupt stream: its index does not describe the packet at byte " +
                           std::to_string(told) + "."};
}

Status ScatteredPackets::check(const Pieces& pieces, std::span<const PagedPacket> pages) const {
  for (const PagedPacket& packet : pages)
    if (Status status = checkHead(pieces, {packet.begin, packet.head}); !status.ok()) return status;
  return {};
}

void ScatteredPackets::take(const Pieces& pieces, std::span<const PagedPacket> pages,
                            Demultiplexed& out) {
  std::vector<Place> packets;
  for (const PagedPacket& packet : pages) packets.push_back({packet.begin, packet.head});
  know(std::move(packets));
  auto& frontiers = frontiers_[static_cast<size_t>(Component::kGeometry)];
  for (const PagedPacket& packet : pages) {
    const auto frontier = frontiers.find(packet.head.track);
    if (frontier != frontiers.end() && frontier->second.packet == packet.begin)
      advance(pieces, frontier->second, out);
  }
}

void ScatteredPackets::take(const Pieces& pieces, ByteRange range, Demultiplexed& out) {
  const uint64_t end = std::min(range.end, end_);
  for (size_t i = packetAt(range.begin); i < places_.size() && places_[i].begin < end; ++i) {
    const Place& place = places_[i];
    auto& frontiers = frontiers_[static_cast<size_t>(place.head.component)];
    const auto frontier = frontiers.find(place.head.track);
    if (frontier != frontiers.end() && frontier->second.packet == place.begin)
      advance(pieces, frontier->second, out);
  }
}

void ScatteredPackets::takeFront(const Pieces& pieces, const PageIndex& pages, Demultiplexed& out) {
  for (; front_number_ < out.heads.size(); ++front_number_) {
    const PacketHead& head = out.heads[front_number_];
    const uint64_t payload = front_ + headSize(head, counts_);
    const std::span<const uint8_t> there = pieces.from(std::min(payload, end_));
    const uint64_t known =
        std::min<uint64_t>({there.size(), end_ - std::min(payload, end_), head.length});
    const bool complete = known == head.length;
    if (!pages.knowsTrack(head.track) && (complete || !head.whole) && known > front_taken_) {
      add(head, there.subspan(front_taken_, known - front_taken_), out);
      front_taken_ = known;
    }
    if (!complete) return;
    front_ = payload + head.length;
    front_taken_ = 0;
  }
}

void ScatteredPackets::advance(const Pieces& pieces, Frontier& frontier, Demultiplexed& out) {
  while (frontier.packet != kNone) {
    const Place& place = places_[packetAt(frontier.packet)];
    const PacketHead& packet = place.head;
    const uint64_t payload = place.begin + headSize(packet, counts_);
    const uint64_t from = std::min(payload + frontier.taken, end_);
    std::span<const uint8_t> bytes = pieces.from(from);
    bytes = bytes.first(
        std::min<uint64_t>({bytes.size(), end_ - from, packet.length - frontier.taken}));
    const bool complete = frontier.taken + bytes.size() == packet.length;
    if (!complete && packet.whole) return;
    if (!bytes.empty()) add(packet, bytes, out);
    frontier.taken += bytes.size();
    if (!complete) return;
    frontier = {place.next, 0};
  }
}

void ScatteredPackets::add(const PacketHead& head, std::span<const uint8_t> bytes,
                           Demultiplexed& out) {
  Waiting& waiting = waiting_[static_cast<size_t>(head.component)];
  if (!waiting.any || head.track == 0) return out.add(head.component, head.track, bytes);
  std::vector<uint8_t>& codeword = waiting.codewords[head.track];
  codeword.insert(codeword.end(), bytes.begin(), bytes.end());
  waiting.bytes += bytes.size();
}

std::array<bool, kComponents> ScatteredPackets::settle(bool has_gap, Demultiplexed& out) {
  std::array<bool, kComponents> withdrawn{};
  for (size_t c = 0; c < kComponents; ++c) {
    const auto first = out.codewords[c].find(0);
    const uint64_t opened = first == out.codewords[c].end() ? 0 : first->second.size();
    const bool waits = has_gap && opened < openingBytes(*header_, static_cast<Component>(c));
    if (waits == waiting_[c].any) continue;
    withdrawn[c] = waits;
    exchangeWaiting(c, out);
    waiting_[c].any = waits;
  }
  return withdrawn;
}

/// All tracks but the first one change places with those that wait.
void ScatteredPackets::exchangeWaiting(size_t component, Demultiplexed& out) {
  auto& shown = out.codewords[component];
  Waiting& waiting = waiting_[component];
  auto first = shown.extract(0);
  const uint64_t opening = first.empty() ? 0 : first.mapped().size();
  out.bytes[component] -= opening;
  std::swap(shown, waiting.codewords);
  std::swap(out.bytes[component], waiting.bytes);
  out.bytes[component] += opening;
  if (!first.empty()) shown.insert(std::move(first));
}

}  // namespace tetrakis::inline stream

// SPDX-License-Identifier: Apache-2.0
#include "bitstream/stream/packet.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>

#include "base/portable_math.hpp"
#include "bitstream/stream/fields.hpp"

namespace tetrakis::inline stream {

namespace {

void putHead(const PacketHead& head, const TrackCounts& counts, FieldWriter& writer) {
  writer.put(fieldOf(head, counts));
  if (counts.of(head).named) writer.put(head.track);
  writer.bytes.push_back(head.quality);
}

/// 2^(eighths / 8). The tables of std::exp2() are one part in 80 of a WebAssembly module.
double powerOfTwo(int eighths) {
  constexpr std::array kRoots = {1.0,
                                 1.0905077326652577,
                                 1.189207115002721,
                                 1.2968395546510096,
                                 1.4142135623730951,
                                 1.5422108254079407,
                                 1.681792830507429,
                                 1.8340080864093424};
  return std::ldexp(kRoots[static_cast<size_t>(eighths & 7)], eighths >> 3);
}

}  // namespace

uint8_t qualityOf(double rmse) {
  assert(!std::isnan(rmse));
  if (!(rmse > 0)) return 0;
  return static_cast<uint8_t>(std::clamp(std::ceil(8 * portable::log2(rmse)) + 64, 1.0, 255.0));
}

double rmseOf(uint8_t quality) {
  return quality == 0 ? 0.0 : powerOfTwo(quality - 64);
}

bool describes(std::span<const IndexEntry> index, std::span<const PacketHead> heads) {
  return heads.size() <= index.size() &&
         std::equal(
             heads.begin(), heads.end(), index.begin(),
             [](const PacketHead& head, const IndexEntry& told) { return head == told.packet; });
}

uint8_t slopeByte(double slope, double steepest) {
  assert(!std::isnan(slope) && slope <= steepest);
  if (!(slope > 0)) return 0;
  return static_cast<uint8_t>(
      std::clamp(std::round(255 + 4 * portable::log2(slope / steepest)), 1.0, 255.0));
}

double slopeOf(uint8_t slope) {
  return slope == 0 ? 0.0 : powerOfTwo(2 * (slope - 255));
}

void TrackCounts::add(Component component, TrackCount count) {
  const bool known = component != Component::kOther;
  if (known) counts_[static_cast<size_t>(component)] = count;
  listed_.push_back({component, known ? count : TrackCount{uint64_t{1} << 32, count.named}});
}

TrackCount TrackCounts::of(const PacketHead& head) const {
  return head.number < listed_.size() ? listed_[head.number].count : TrackCount{};
}

Component TrackCounts::componentOf(size_t number) const {
  return number < listed_.size() ? listed_[number].component : Component::kOther;
}

int TrackCounts::numberBits() const {
  return listed_.size() <= 2 ? 1 : static_cast<int>(std::bit_width(listed_.size() - 1));
}

uint64_t TrackCounts::all() const {
  return counts_[0].tracks + counts_[1].tracks;
}

PacketHead headOf(const Packet& packet, const TrackCounts& counts) {
  uint8_t number = 0;
  while (counts.componentOf(number) != packet.component) ++number;
  return {packet.length(), packet.track.value_or(0), packet.quality, packet.whole,
          number,          packet.component};
}

uint64_t fieldOf(const PacketHead& head, const TrackCounts& counts) {
  return (head.length << 1 | uint64_t{head.whole}) << counts.numberBits() | head.number;
}

PacketHead headOf(uint64_t field, const TrackCounts& counts) {
  const int bits = counts.numberBits();
  PacketHead head;
  head.length = field >> (bits + 1);
  head.whole = (field >> bits & 1) != 0;
  head.number = static_cast<uint8_t>(field & ((uint64_t{1} << bits) - 1));
  head.component = counts.componentOf(head.number);
  return head;
}

size_t overheadOf(const Packet& packet) {
  TrackCounts alone;
  alone.add(packet.component, {1, packet.track.has_value()});
  return headSize(headOf(packet, alone), alone);
}

std::vector<uint8_t> headBytes(const PacketHead& head, const TrackCounts& counts) {
  FieldWriter writer;
  putHead(head, counts, writer);
  return std::move(writer.bytes);
}

size_t headSize(const PacketHead& head, const TrackCounts& counts) {
  const auto varint = [](uint64_t value) {
    return (static_cast<size_t>(std::bit_width(value | 1)) + 6) / 7;
  };
  const size_t track = counts.of(head).named ? varint(head.track) : 0;
  return varint(fieldOf(head, counts)) + track + 1;
}

std::vector<uint8_t> multiplex(std::span<const Packet> packets, const TrackCounts& counts,
                               const std::array<Codewords, kComponents>& codewords,
                               uint64_t limit) {
  FieldWriter writer;
  for (const Packet& packet : packets) {
    putHead(headOf(packet, counts), counts, writer);
    const auto& codeword =
        codewords[static_cast<size_t>(packet.component)][packet.track.value_or(0)];
    assert(packet.begin < packet.end && packet.end <= codeword.size());
    const auto payload = codeword.subspan(packet.begin, packet.length());
    writer.bytes.insert(writer.bytes.end(), payload.begin(), payload.end());
    if (writer.bytes.size() >= limit) break;
  }
  if (writer.bytes.size() > limit) writer.bytes.resize(limit);
  assert(writer.bytes.size() <= limit);
  return std::move(writer.bytes);
}

Codewords Demultiplexed::codewordsOf(Component component) const {
  Codewords all(counts[static_cast<size_t>(component)].tracks);
  for (const auto& [number, codeword] : codewords[static_cast<size_t>(component)]) {
    assert(number < all.size());
    all[number] = codeword;
  }
  return all;
}

void Demultiplexed::add(Component component, uint32_t track, std::span<const uint8_t> more) {
  if (component == Component::kOther) return;
  const auto c = static_cast<size_t>(component);
  std::vector<uint8_t>& codeword = codewords[c][track];
  codeword.insert(codeword.end(), more.begin(), more.end());
  bytes[c] += more.size();
}

namespace {

/// What is there of a packet, and how much of it was there before.
struct PacketPart {
  const PacketHead& head;
  std::span<const uint8_t> bytes;
  size_t seen;
  bool begins, complete;
};

/// The head before a packet's payload, and the bytes that it takes: none if it is cut.
Status readHead(std::span<const uint8_t> bytes, size_t origin, const TrackCounts& counts,
                PacketHead& head, size_t& size) {
  FieldReader reader(bytes, origin);
  uint64_t field = 0;
  reader.shortestVarint("head", field, 0, UINT64_MAX);
  head = headOf(field, counts);
  if (counts.of(head).named) reader.shortestVarint("region", head.track, 0, UINT32_MAX);
  reader.u8("quality", head.quality, 0, 255);
  size = 0;
  if (reader.starved()) return {};
  if (!reader.ok()) return reader.status();
  if (head.length == 0 || head.track >= counts.of(head).tracks) {
    return {TKS_CORRUPT, "Corrupt stream: the packet at byte " + std::to_string(origin) +
                             " is empty or of a track that the header does not announce."};
  }
  size = reader.position();
  return {};
}

/// Calls visit(part) for every packet that has begun, from the place on, which moves to the end.
template <class Visit>
Status forEachPacket(std::span<const uint8_t> payload, size_t origin, const TrackCounts& counts,
                     PayloadPlace& place, Visit&& visit) {
  while (place.at < payload.size()) {
    const bool begins = !place.open;
    if (begins) {
      PacketHead head;
      size_t size = 0;
      const Status status =
          readHead(payload.subspan(place.at), origin + place.at, counts, head, size);
      if (!status.ok() || size == 0) return status;
      place = {place.at + size, head, 0};
    }
    const uint64_t length = place.open->length;
    const bool complete = length <= payload.size() - place.at;
    const size_t available = complete ? static_cast<size_t>(length) : payload.size() - place.at;
    visit(PacketPart{*place.open, payload.subspan(place.at, available), place.seen, begins,
                     complete});
    if (!complete) {
      place.seen = available;
      return {};
    }
    place = {place.at + available, {}, 0};
  }
  return {};
}

/// What of a packet belongs to its track now and did not before: of one that counts only when it is
/// complete, nothing or all.
std::span<const uint8_t> newBytes(const PacketPart& part) {
  if (!part.head.whole) return part.bytes.subspan(part.seen);
  return part.complete ? part.bytes : std::span<const uint8_t>();
}

}  // namespace

Result<std::vector<FoundPacket>> packetsIn(std::span<const uint8_t> payload, size_t origin,
                                           const TrackCounts& counts) {
  std::vector<FoundPacket> packets;
  PayloadPlace place;
  const Status status = forEachPacket(payload, origin, counts, place, [&](const PacketPart& part) {
    packets.push_back({part.head, part.bytes});
  });
  if (!status.ok()) return status;
  return packets;
}

Result<PayloadCount> countPackets(std::span<const uint8_t> payload, size_t origin,
                                  const TrackCounts& counts, PayloadPlace from) {
  PayloadCount count;
  const Status status = forEachPacket(payload, origin, counts, from, [&](const PacketPart& part) {
    count.packets += part.begins;
    count.bytes += part.bytes.size() - part.seen;
  });
  if (!status.ok()) return status;
  return count;
}

namespace {

void takeHead(const PacketPart& part, Demultiplexed& out) {
  const auto component = static_cast<size_t>(part.head.component);
  assert(part.head.track < out.counts.of(part.head).tracks);
  if (part.begins) out.heads.push_back(part.head);
  if (part.complete) out.quality[component] = part.head.quality;
}

}  // namespace

Status demultiplexMore(std::span<const uint8_t> payload, size_t origin, Demultiplexed& out) {
  return forEachPacket(payload, origin, out.counts, out.end, [&](const PacketPart& part) {
    takeHead(part, out);
    if (part.complete || !part.head.whole)
      out.add(part.head.component, part.head.track, newBytes(part));
  });
}

Status passHeads(std::span<const uint8_t> payload, size_t origin, Demultiplexed& out) {
  return forEachPacket(payload, origin, out.counts, out.end,
                       [&](const PacketPart& part) { takeHead(part, out); });
}

Result<Demultiplexed> demultiplex(std::span<const uint8_t> payload, size_t origin,
                                  const TrackCounts& counts, uint64_t packets) {
  Demultiplexed out;
  out.counts = counts;
  out.heads.reserve(packets);
  const Status status = demultiplexMore(payload, origin, out);
  if (!status.ok()) return status;
  assert(packets == 0 || out.heads.size() <= packets);
  return out;
}

}  // namespace tetrakis::inline stream

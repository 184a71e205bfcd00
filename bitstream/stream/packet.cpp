// SPDX-License-Identifier: Apache-2.0
#include "bitstream/stream/packet.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "bitstream/stream/fields.hpp"

namespace tetrakis::inline stream {

namespace {

void putHead(const PacketHead& head, bool named, FieldWriter& writer) {
  writer.put(head.head);
  if (named) writer.put(head.track);
  writer.bytes.push_back(head.quality);
}

void putHead(const Packet& packet, FieldWriter& writer) {
  putHead({packet.head(), packet.track.value_or(0), packet.quality}, packet.track.has_value(),
          writer);
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
  return static_cast<uint8_t>(std::clamp(std::ceil(8 * std::log2(rmse)) + 64, 1.0, 255.0));
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
      std::clamp(std::round(255 + 4 * std::log2(slope / steepest)), 1.0, 255.0));
}

double slopeOf(uint8_t slope) {
  return slope == 0 ? 0.0 : powerOfTwo(2 * (slope - 255));
}

size_t overheadOf(const Packet& packet) {
  FieldWriter writer;
  putHead(packet, writer);
  return writer.bytes.size();
}

std::vector<uint8_t> headBytes(const PacketHead& head, bool named) {
  FieldWriter writer;
  putHead(head, named, writer);
  return std::move(writer.bytes);
}

std::vector<uint8_t> multiplex(std::span<const Packet> packets,
                               const std::array<Codewords, kComponents>& codewords,
                               uint64_t limit) {
  FieldWriter writer;
  for (const Packet& packet : packets) {
    putHead(packet, writer);
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

bool Demultiplexed::nothingOf(Component component) const {
  const auto& known = codewords[static_cast<size_t>(component)];
  return std::all_of(known.begin(), known.end(),
                     [](const auto& one) { return one.second.empty(); });
}

namespace {

/// Calls visit(head, payload, complete) for every packet begun.
template <class Visit>
Status forEachPacket(std::span<const uint8_t> payload, size_t origin, const TrackCounts& counts,
                     Visit&& visit) {
  size_t at = 0;
  while (at < payload.size()) {
    FieldReader reader(payload.subspan(at), origin + at);
    PacketHead head;
    reader.shortestVarint("head", head.head, 0, UINT64_MAX);
    const TrackCount& count = counts[static_cast<size_t>(head.component())];
    const uint64_t length = head.length();
    if (count.named) reader.shortestVarint("region", head.track, 0, UINT32_MAX);
    reader.u8("quality", head.quality, 0, 255);
    if (reader.starved()) break;
    if (!reader.ok()) return reader.status();
    if (length == 0 || head.track >= count.tracks) {
      return Status(TKS_CORRUPT, "Corrupt stream: the packet at byte " +
                                     std::to_string(origin + at) +
                                     " is empty or of a track that the header does not announce.");
    }
    at += reader.position();
    const bool complete = length <= payload.size() - at;
    const size_t available = complete ? static_cast<size_t>(length) : payload.size() - at;
    visit(head, payload.subspan(at, available), complete);
    assert(available > 0 || at == payload.size());
    at += available;
  }
  return {};
}

}  // namespace

Result<PayloadCount> countPackets(std::span<const uint8_t> payload, size_t origin,
                                  const TrackCounts& counts) {
  PayloadCount count;
  const Status status = forEachPacket(payload, origin, counts,
                                      [&](const PacketHead&, std::span<const uint8_t> bytes, bool) {
                                        ++count.packets;
                                        count.bytes += bytes.size();
                                      });
  if (!status.ok()) return status;
  return count;
}

Result<Demultiplexed> demultiplex(std::span<const uint8_t> payload, size_t origin,
                                  const TrackCounts& counts, uint64_t packets) {
  Demultiplexed out;
  out.counts = counts;
  out.heads.reserve(packets);
  const Status status =
      forEachPacket(payload, origin, counts,
                    [&](const PacketHead& head, std::span<const uint8_t> bytes, bool complete) {
                      const auto component = static_cast<size_t>(head.component());
                      assert(head.track < counts[component].tracks);
                      out.heads.push_back(head);
                      if (complete || !head.whole()) {
                        std::vector<uint8_t>& codeword = out.codewords[component][head.track];
                        codeword.insert(codeword.end(), bytes.begin(), bytes.end());
                      }
                      if (complete) out.quality[component] = head.quality;
                    });
  if (!status.ok()) return status;
  assert(packets == 0 || out.heads.size() <= packets);
  return out;
}

}  // namespace tetrakis::inline stream

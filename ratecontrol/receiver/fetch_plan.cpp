// SPDX-License-Identifier: Apache-2.0
#include "ratecontrol/receiver/fetch_plan.hpp"

#include <algorithm>
#include <utility>

#include "bitstream/stream/scattered_packets.hpp"
#include "bitstream/track/track.hpp"
#include "ratecontrol/receiver/placed_packets.hpp"

namespace tetrakis::inline receiver {

namespace {

/// Chosen pieces in the stream's order; neighbours are one, unless only one of them helps.
std::vector<RankedRange> stretches(std::span<const Piece> pieces, std::span<const uint32_t> order,
                                   const Choice& chosen) {
  std::vector<uint32_t> ranks(pieces.size(), static_cast<uint32_t>(pieces.size()));
  for (uint32_t rank = 0; rank < order.size(); ++rank) ranks[order[rank]] = rank;
  std::vector<RankedRange> found;
  for (size_t i = 0; i < pieces.size(); ++i) {
    if (chosen[i] == 0) continue;
    const uint64_t begin = pieces[i].begin;
    const RankedRange next{{begin, begin + chosen[i], pieces[i].worth.now}, ranks[i]};
    const bool touches = !found.empty() && found.back().range.end == begin;
    if (touches && (found.back().range.gain > 0) == pieces[i].helps())
      found.back().join(next);
    else
      found.push_back(next);
  }
  return found;
}

}  // namespace

std::vector<FetchRange> rangesOf(std::span<const Piece> pieces, std::span<const uint32_t> order,
                                 const Choice& chosen, uint64_t request_bytes) {
  std::vector<RankedRange> joined;
  const std::vector<RankedRange> found = stretches(pieces, order, chosen);
  for (size_t i = 0; i < found.size(); ++i) {
    joined.push_back(found[i]);
    while (joined.back().range.gain > 0 && i + 2 < found.size()) {
      const FetchRange &between = found[i + 1].range, &next = found[i + 2].range;
      const bool touch = joined.back().range.end == between.begin && between.end == next.begin;
      if (!touch || between.end - between.begin > request_bytes) break;
      joined.back().join(found[i + 1]);
      joined.back().join(found[i + 2]);
      i += 2;
    }
  }
  std::vector<FetchRange> ranked(pieces.size() + 1);
  for (const RankedRange& r : joined) ranked[r.rank] = r.range;
  std::erase_if(ranked, [](const FetchRange& range) { return range.begin == range.end; });
  return ranked;
}

namespace {

/// The pieces of packets that are missing, in the order of the stream.
std::vector<Piece> piecesOf(std::span<const PlacedPacket> packets, const Missing& missing,
                            uint64_t end) {
  std::vector<Piece> pieces;
  for (const PlacedPacket& packet : packets) {
    const uint64_t last = packet.begin < end ? std::min(packet.end, end) : packet.end;
    for (const ByteRange& gap : missing(packet.begin, last)) {
      if (gap.begin == gap.end) continue;
      if (!pieces.empty() && pieces.back().end < gap.begin)
        pieces.push_back({pieces.back().end, gap.begin, {}, false});
      pieces.push_back({gap.begin, gap.end, packet.worth, true});
    }
  }
  return pieces;
}

}  // namespace

Result<std::vector<FetchRange>> planFetch(const ParsedHeader& parsed, const PageIndex* pages,
                                          std::span<const WeightedSighting> sightings,
                                          const Missing& missing, const FetchLimits& limits) {
  const StreamHeader& header = parsed.header;
  const uint64_t end = parsed.bytes + header.payload_bytes;
  std::vector<PlacedPacket> packets = {{0, parsed.bytes, end, {1, 1, 1}}};
  if (pages != nullptr && missing(parsed.bytes, end).empty()) return std::vector<FetchRange>();
  if (!header.index.empty() || pages != nullptr) {
    auto placed = placedPackets(header, parsed.bytes, pages, sightings);
    if (!placed.ok()) return placed.status();
    packets = std::move(*placed);
  }
  packets = withFiniteOpenings(std::move(packets), limits.request_bytes);
  const std::vector<Piece> pieces = piecesOf(packets, missing, end);
  const std::vector<uint32_t> order = rankedPieces(pieces);
  const Choice chosen = choosePieces(pieces, order, limits);
  return rangesOf(pieces, order, chosen, limits.request_bytes);
}

Result<std::vector<size_t>> orderFor(const StreamHeader& header,
                                     std::span<const WeightedSighting> sightings) {
  auto packets = placedPackets(header, 0, nullptr, sightings);
  if (!packets.ok()) return packets.status();
  std::stable_sort(packets->begin(), packets->end(),
                   [](const auto& a, const auto& b) { return helpsMore(a.worth, b.worth); });
  // A prefix of the order corrects nothing that is still to change, seen or not.
  std::stable_partition(packets->begin(), packets->end(),
                        [](const PlacedPacket& packet) { return !packet.is_correction; });
  std::vector<size_t> order;
  for (const PlacedPacket& packet : *packets) order.push_back(packet.number);
  for (size_t i = order.size(); i < header.index.size(); ++i) order.push_back(i);
  return order;
}

uint64_t planBytes(const StreamHeader& header, uint64_t packets) {
  const uint64_t tracks = trackCounts(header).all();
  constexpr uint64_t kTrack = sizeof(Region) + 2 * sizeof(double) + 96;  // in a map
  constexpr uint64_t kPiece = sizeof(Piece) + 2 * sizeof(uint64_t) + 2 * sizeof(uint32_t) +
                              2 * sizeof(RankedRange) + sizeof(FetchRange);
  constexpr uint64_t kPacket =
      sizeof(PlacedPacket) + sizeof(IndexedPacket) + 4 * kPiece;  // what is there lies between
  return tracks * kTrack + packets * kPacket;
}

}  // namespace tetrakis::inline receiver

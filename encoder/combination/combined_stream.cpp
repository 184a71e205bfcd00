// SPDX-License-Identifier: Apache-2.0
#include "encoder/combination/combined_stream.hpp"

#include <algorithm>
#include <string>
#include <utility>

namespace tetrakis::inline combination {
namespace {

/// The packets of all parts, as they stand behind one header.
struct JoinedPackets {
  std::vector<IndexEntry> index;  ///< without entries unless all parts have an index
  std::vector<uint8_t> payload;
};

bool haveIndices(const std::vector<CombinedPart>& parts) {
  return std::all_of(parts.begin(), parts.end(), [](const CombinedPart& part) {
    std::vector<PacketHead> heads;
    for (const FoundPacket& packet : part.packets) heads.push_back(packet.head);
    if (part.ends_cut) heads.pop_back();  // whose length has changed
    const std::vector<IndexEntry>& index = part.parsed.header.index;
    return index.size() >= part.packets.size() && describes(index, heads);
  });
}

JoinedPackets joinPackets(const std::vector<CombinedPart>& parts, const CombinedHeader& combined) {
  const TrackCounts counts = trackCounts(combined.header);
  const bool are_indexed = haveIndices(parts);
  JoinedPackets joined;
  for (const auto& [part, number] : combinedOrder(parts)) {
    const FoundPacket& packet = parts[part].packets[number];
    PacketHead head = packet.head;
    head.number = combined.numbers[part][head.number];
    head.component = counts.componentOf(head.number);
    if (are_indexed) joined.index.push_back({head, parts[part].parsed.header.index[number].slope});
    const std::vector<uint8_t> bytes = headBytes(head, counts);
    joined.payload.insert(joined.payload.end(), bytes.begin(), bytes.end());
    joined.payload.insert(joined.payload.end(), packet.bytes.begin(), packet.bytes.end());
  }
  return joined;
}

/// Cuts the payload, so that header and payload take no more.
Status cutTo(uint64_t budget, StreamHeader& header, std::vector<uint8_t>& payload) {
  const size_t header_bytes = writeHeader(header).size();
  if (header_bytes > budget)
    return {TKS_USAGE, "The header of the combined stream takes " + std::to_string(header_bytes) +
                           " bytes, more than the " + std::to_string(budget) +
                           " that all of it may take."};
  payload.resize(std::min<uint64_t>(payload.size(), budget - header_bytes));
  header.payload_bytes = payload.size();  // a varint of a smaller number is never longer
  return {};
}

}  // namespace

Result<CombinedStream> combinedStream(const std::vector<CombinedPart>& parts,
                                      std::optional<uint64_t> budget) {
  Result<CombinedHeader> combined = combinedHeader(parts, !budget);
  if (!combined.ok()) return combined.status();
  StreamHeader& header = combined->header;
  auto [index, payload] = joinPackets(parts, *combined);
  header.index = std::move(index);
  header.payload_bytes = payload.size();
  header.payload_crc.reset();
  if (combined->promisesSomething()) header.payload_crc = crc32(payload);
  if (budget)
    if (Status status = cutTo(*budget, header, payload); !status.ok()) return status;
  CombinedStream stream{writeHeader(header), std::move(combined->numbers)};
  stream.bytes.insert(stream.bytes.end(), payload.begin(), payload.end());
  return stream;
}

namespace {

/// The part that a component of the combined stream comes from; parts.size(): none.
size_t partOf(const std::vector<std::vector<uint8_t>>& numbers, uint8_t number) {
  const auto has = [&](const std::vector<uint8_t>& part) {
    return std::find(part.begin(), part.end(), number) != part.end();
  };
  return static_cast<size_t>(std::find_if(numbers.begin(), numbers.end(), has) - numbers.begin());
}

}  // namespace

Status checkKept(const CombinedStream& stream, const std::vector<CombinedPart>& parts,
                 bool is_whole) {
  const Status broken(TKS_MISMATCH, "The encoder failed: a component differs from what it was.");
  const Result<ParsedHeader> parsed = readHeader(stream.bytes);
  if (!parsed.ok()) return broken;
  const auto packets =
      packetsIn(behindHeader(stream.bytes, *parsed), parsed->bytes, trackCounts(parsed->header));
  if (!packets.ok()) return broken;
  std::vector<size_t> next(parts.size(), 0);
  for (const FoundPacket& packet : *packets) {
    const size_t part = partOf(stream.numbers, packet.head.number);
    if (part == parts.size() || next[part] == parts[part].packets.size()) return broken;
    const std::span<const uint8_t> source = parts[part].packets[next[part]++].bytes;
    const bool same = packet.bytes.size() <= source.size() &&
                      std::equal(packet.bytes.begin(), packet.bytes.end(), source.begin());
    if (!same || (is_whole && packet.bytes.size() < source.size())) return broken;
  }
  for (size_t part = 0; is_whole && part < parts.size(); ++part)
    if (next[part] < parts[part].packets.size()) return broken;
  return {};
}

}  // namespace tetrakis::inline combination

// SPDX-License-Identifier: Apache-2.0
#include "bitstream/stream/pieces.hpp"

#include <algorithm>
#include <iterator>
#include <set>
#include <string>
#include <utility>

#include "bitstream/stream/indexed_packets.hpp"

namespace tetrakis::inline stream {

void Pieces::put(uint64_t place, std::span<const uint8_t> bytes) {
  if (bytes.empty()) return;
  const uint64_t end = place + bytes.size();
  auto run = runs_.upper_bound(place);  // the run that the bytes belong to, or the next one
  if (run != runs_.begin() && std::prev(run)->first + std::prev(run)->second.size() >= place) {
    --run;
  } else {
    run = runs_.emplace_hint(run, place, std::vector<uint8_t>());
  }
  std::vector<uint8_t>& joined = run->second;
  const auto append = [&](std::span<const uint8_t> more) {
    joined.insert(joined.end(), more.begin(), more.end());
    bytes_ += more.size();
  };
  for (;;) {
    const uint64_t known = run->first + joined.size();
    const auto next = std::next(run);
    const uint64_t stop = next == runs_.end() ? end : std::min(end, next->first);
    if (stop > known) append(bytes.subspan(known - place, stop - known));
    if (next == runs_.end() || next->first > run->first + joined.size()) return;
    bytes_ -= next->second.size();
    append(next->second);
    runs_.erase(next);
  }
}

std::span<const uint8_t> Pieces::from(uint64_t place) const {
  const auto after = runs_.upper_bound(place);
  if (after == runs_.begin()) return {};
  const auto& [begin, run] = *std::prev(after);
  return place - begin < run.size() ? std::span(run).subspan(place - begin)
                                    : std::span<const uint8_t>();
}

std::vector<ByteRange> Pieces::missing(ByteRange wanted) const {
  std::vector<ByteRange> gaps;
  uint64_t at = wanted.begin;
  auto run = runs_.upper_bound(at);
  if (run != runs_.begin()) --run;
  for (; run != runs_.end() && run->first < wanted.end; ++run) {
    if (run->first > at) gaps.push_back({at, run->first});
    at = std::max(at, run->first + run->second.size());
  }
  if (at < wanted.end) gaps.push_back({at, wanted.end});
  return gaps;
}

uint64_t openingBytes(const StreamHeader& header, Component component) {
  if (component == Component::kGeometry) return header.layers.openingBytes();
  return header.texture ? header.texture->alpha_bytes + header.texture->overlay_bytes : 0;
}

namespace {

/// Drops the tracks behind the first of a component whose opening is not complete: they mean
/// nothing without it.
void dropUnopened(const StreamHeader& header, Demultiplexed& payload) {
  for (size_t i = 0; i < kComponents; ++i) {
    auto& tracks = payload.codewords[i];
    const auto first = tracks.find(0);
    const uint64_t opened = first == tracks.end() ? 0 : first->second.size();
    if (opened >= openingBytes(header, static_cast<Component>(i))) continue;
    std::erase_if(tracks, [](const auto& track) { return track.first > 0; });
  }
}

}  // namespace

Status addScattered(const Pieces& pieces, const ParsedHeader& parsed, Demultiplexed& payload) {
  const uint64_t end = parsed.bytes + parsed.header.payload_bytes;
  std::set<std::pair<Component, uint32_t>> ended;  // tracks whose next byte is missing
  const auto before_end = [&](uint64_t from) {
    const std::span<const uint8_t> bytes = pieces.from(from);
    return bytes.first(std::min<uint64_t>(bytes.size(), end - std::min(from, end)));
  };
  for (const IndexedPacket& packet : IndexedPackets(parsed.header, parsed.bytes)) {
    const PacketHead& entry = packet.entry.packet;
    const auto component = static_cast<size_t>(entry.component());
    const TrackCount& tracks = payload.counts[component];
    if (entry.track >= tracks.tracks) {
      return {TKS_CORRUPT, "Corrupt stream: its index names a track that there is not."};
    }
    const std::vector<uint8_t> head = headBytes(entry, tracks.named);
    const std::span<const uint8_t> known = before_end(packet.begin),
                                   bytes = before_end(packet.payload);
    if (!std::equal(head.begin(), head.begin() + std::min(head.size(), known.size()),
                    known.begin())) {
      return {TKS_CORRUPT, "Corrupt stream: its index does not describe the packet at byte " +
                               std::to_string(packet.begin) + "."};
    }
    const bool complete = bytes.size() >= entry.length();
    const std::pair track(entry.component(), entry.track);
    const bool is_new = packet.number >= payload.heads.size();
    if (is_new && (complete || !entry.whole()) && !ended.contains(track)) {
      std::vector<uint8_t>& codeword = payload.codewords[component][entry.track];
      const auto taken = bytes.first(std::min<uint64_t>(bytes.size(), entry.length()));
      codeword.insert(codeword.end(), taken.begin(), taken.end());
    }
    if (!complete) ended.insert(track);
  }
  dropUnopened(parsed.header, payload);
  return {};
}

}  // namespace tetrakis::inline stream

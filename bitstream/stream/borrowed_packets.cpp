// SPDX-License-Identifier: Apache-2.0
#include "bitstream/stream/borrowed_packets.hpp"

#include <algorithm>
#include <utility>

namespace tetrakis::inline stream {

namespace {

bool isAmong(const std::vector<bool>& tracks, uint32_t track) {
  return track < tracks.size() && tracks[track];
}

}  // namespace

BorrowedPackets::BorrowedPackets(std::span<const uint8_t> payload, Demultiplexed& passed) {
  size_t at = 0;
  for (const PacketHead& head : passed.heads) {
    at += headSize(head, passed.counts);
    const bool complete = head.length <= payload.size() - at;
    const size_t there = complete ? static_cast<size_t>(head.length) : payload.size() - at;
    if (head.component != Component::kOther && (complete || !head.whole)) {
      add(head, payload.subspan(at, there));
      passed.bytes[static_cast<size_t>(head.component)] += there;
    }
    at += there;
  }
}

void BorrowedPackets::add(const PacketHead& head, std::span<const uint8_t> bytes) {
  Track& track = tracksOf(head.component)[head.track];
  track.packets.push_back(bytes);
  track.bytes += bytes.size();
}

namespace {

std::vector<uint8_t> joined(const std::vector<std::span<const uint8_t>>& packets, uint64_t bytes) {
  std::vector<uint8_t> codeword;
  codeword.reserve(bytes);
  for (const auto& packet : packets) codeword.insert(codeword.end(), packet.begin(), packet.end());
  return codeword;
}

}  // namespace

Codewords BorrowedPackets::codewordsOf(Component component, const std::vector<bool>& needed,
                                       Demultiplexed& out) {
  auto& whole = out.codewords[static_cast<size_t>(component)];
  Tracks& tracks = tracksOf(component);
  for (auto track = tracks.begin(); track != tracks.end();) {
    const auto& [number, packets] = *track;
    if (!isAmong(needed, number)) {
      ++track;
      continue;
    }
    whole[number] = joined(packets.packets, packets.bytes);
    track = tracks.erase(track);
  }
  Codewords all = out.codewordsOf(component);
  // From the first packet on the payload has as many bytes: heads lie between the packets.
  for (const auto& [number, track] : tracks)
    all[number] = {track.packets.front().data(), static_cast<size_t>(track.bytes)};
  return all;
}

void BorrowedPackets::joinAll(Demultiplexed& out) {
  for (size_t c = 0; c < kComponents; ++c) {
    for (const auto& [number, track] : tracks_[c])
      out.codewords[c][number] = joined(track.packets, track.bytes);
    tracks_[c].clear();
  }
}

uint64_t BorrowedPackets::bytesOf(Component component, uint32_t track) const {
  const auto found = tracksOf(component).find(track);
  return found == tracksOf(component).end() ? 0 : found->second.bytes;
}

uint64_t BorrowedPackets::bytesOf(Component component, const std::vector<bool>& tracks) const {
  uint64_t sum = 0;
  for (const auto& [number, track] : tracksOf(component))
    if (isAmong(tracks, number)) sum += track.bytes;
  return sum;
}

uint64_t BorrowedPackets::bytes() const {
  uint64_t sum = 0;
  for (const Tracks& tracks : tracks_)
    for (const auto& [number, track] : tracks) sum += track.bytes;
  return sum;
}

}  // namespace tetrakis::inline stream

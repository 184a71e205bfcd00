// SPDX-License-Identifier: Apache-2.0
#include "apps/tools/report/split_stream.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace tetrakis::tools {

Result<SplitStream> SplitStream::take(std::span<const uint8_t> stream) {
  Result<ParsedHeader> parsed = readHeader(stream);
  if (!parsed.ok()) return parsed.status();
  const TrackCounts counts = trackCounts(parsed->header);
  if (counts[0].tracks != 1 || counts[1].tracks != 1)
    return Status(TKS_UNSUPPORTED, "Only a stream of two tracks can be split anew.");
  Result<Demultiplexed> payload = demultiplex(stream.subspan(parsed->bytes), parsed->bytes, counts);
  if (!payload.ok()) return payload.status();
  SplitStream taken;
  taken.header_ = std::move(parsed->header);
  taken.header_.index.clear();
  taken.header_.lossless = 0;
  taken.payload_ = std::move(*payload);
  return taken;
}

uint64_t SplitStream::mapBytes() const {
  const auto of = [](const auto& component) {
    const PriorityHeader& map = component->priorities;
    return map.none() ? size_t{0} : map.code.size() + 2;  // tile_log2 and the length
  };
  return of(header_.geometry) + of(header_.texture);
}

Split SplitStream::most() const {
  const auto bytes = [&](Component component) {
    return payload_.codewordsOf(component).front().size();
  };
  return {bytes(Component::kGeometry), bytes(Component::kTexture)};
}

Split SplitStream::shipped(uint64_t payload) const {
  Split split;
  for (const PacketHead& head : payload_.heads) {
    if (head.component == Component::kOther) continue;
    const uint64_t taken = std::min(head.length, payload - split.total());
    (head.component == Component::kGeometry ? split.heights : split.texture) += taken;
  }
  const Split all = most();
  return {std::min(split.heights, all.heights), std::min(split.texture, all.texture)};
}

std::vector<uint8_t> SplitStream::cut(const Split& split) const {
  constexpr uint8_t kUnstated = 128;
  const std::array<Codewords, kComponents> codewords = {payload_.codewordsOf(Component::kGeometry),
                                                        payload_.codewordsOf(Component::kTexture)};
  std::vector<Packet> packets;
  const std::array<uint64_t, kComponents> wanted = {split.heights, split.texture};
  for (size_t c = 0; c < kComponents; ++c) {
    const uint64_t bytes = std::min<uint64_t>(wanted[c], codewords[c].front().size());
    if (bytes > 0) packets.push_back({static_cast<Component>(c), false, kUnstated, 0, bytes, {}});
  }
  const std::vector<uint8_t> payload =
      multiplex(packets, payload_.counts, codewords, UINT64_MAX >> 1);
  StreamHeader header = header_;
  header.payload_bytes = payload.size();
  header.payload_crc.reset();
  std::vector<uint8_t> stream = writeHeader(header);
  stream.insert(stream.end(), payload.begin(), payload.end());
  return stream;
}

}  // namespace tetrakis::tools

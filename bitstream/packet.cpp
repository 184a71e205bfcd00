// SPDX-License-Identifier: Apache-2.0
#include "bitstream/packet.hpp"

#include <algorithm>
#include <cmath>

#include "bitstream/fields.hpp"

namespace tetrakis {

uint8_t qualityOf(double rmse) {
  if (!(rmse > 0)) return 0;
  return static_cast<uint8_t>(std::clamp(std::ceil(8 * std::log2(rmse)) + 64, 1.0, 255.0));
}

double rmseOf(uint8_t quality) {
  return quality == 0 ? 0.0 : std::exp2((quality - 64) / 8.0);
}

size_t overheadOf(const Packet& packet) {
  FieldWriter writer;
  writer.put(packet.head());
  return writer.bytes.size() + 1;
}

std::vector<uint8_t> multiplex(std::span<const Packet> packets,
                               const std::array<std::span<const uint8_t>, kTracks>& codewords,
                               uint64_t limit) {
  FieldWriter writer;
  for (const Packet& packet : packets) {
    writer.put(packet.head());
    writer.bytes.push_back(packet.quality);
    const auto payload = codewords[static_cast<size_t>(packet.track)].subspan(
        packet.begin, packet.end - packet.begin);
    writer.bytes.insert(writer.bytes.end(), payload.begin(), payload.end());
    if (writer.bytes.size() >= limit) break;
  }
  if (writer.bytes.size() > limit) writer.bytes.resize(limit);
  return std::move(writer.bytes);
}

Result<Demultiplexed> demultiplex(std::span<const uint8_t> payload, size_t origin,
                                  const std::array<bool, kTracks>& present) {
  Demultiplexed out;
  size_t at = 0;
  while (at < payload.size()) {
    FieldReader reader(payload.subspan(at), origin + at);
    const uint64_t head = reader.take();
    uint8_t quality = 0;
    reader.u8("quality", quality, 0, 255);
    if (reader.starved()) break;
    if (!reader.ok()) return reader.status();
    const size_t track = head & 1;
    const uint64_t length = head >> 2;
    if (length == 0 || !present[track]) {
      return Status(TKS_CORRUPT, "Corrupt stream: the packet at byte " +
                                     std::to_string(origin + at) +
                                     " is empty or of a track that the header does not announce.");
    }
    at += reader.position();
    out.heads.push_back({head, quality});
    const bool complete = length <= payload.size() - at;
    const bool whole = (head & 2) != 0;
    const size_t available = complete ? static_cast<size_t>(length) : payload.size() - at;
    if (complete || !whole) {
      const auto from = payload.begin() + static_cast<ptrdiff_t>(at);
      out.codewords[track].insert(out.codewords[track].end(), from,
                                  from + static_cast<ptrdiff_t>(available));
    }
    if (complete) out.quality[track] = quality;
    at += available;
  }
  return out;
}

}  // namespace tetrakis

// SPDX-License-Identifier: Apache-2.0
// The packets of a stream in another order: nothing is decoded or encoded but a coarse surface, for
// what is hidden.
#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "api/encoded_stream.hpp"
#include "api/outlook.hpp"
#include "bitstream/stream/header.hpp"
#include "bitstream/stream/scattered_packets.hpp"

namespace tetrakis::inline api {
namespace {

Result<Sighting> sightingIn(tks_decoder& decoder, const tks_screen_camera& camera) {
  const uint32_t triangles = decoder.parsed.header.triangles;
  if (camera.globe != nullptr) {
    const Result<CoarseGlobe> globe = coarseGlobe(decoder, camera.globe);
    if (!globe.ok()) return globe.status();
    return sightingOf(*globe, camera, triangles);
  }
  const Result<CoarseGround> ground = coarseGround(decoder);
  if (!ground.ok()) return ground.status();
  return sightingOf(*ground, camera, triangles);
}

Result<std::vector<WeightedSighting>> sightingsOf(tks_decoder& decoder,
                                                  const std::vector<tks_screen_camera>& cameras) {
  std::vector<WeightedSighting> sightings;
  for (const tks_screen_camera& camera : cameras) {
    Result<Sighting> sighting = sightingIn(decoder, camera);
    if (!sighting.ok()) return sighting.status();
    sightings.push_back({*std::move(sighting), weightOf(camera)});
  }
  return sightings;
}

/// The packets of a stream, as far as they are there.
std::span<const uint8_t> payloadOf(std::span<const uint8_t> stream, const ParsedHeader& parsed) {
  const std::span<const uint8_t> behind = stream.subspan(parsed.bytes);
  return behind.first(std::min<uint64_t>(behind.size(), parsed.header.payload_bytes));
}

/// The bytes of a packet that are there, its head included.
struct AvailablePacket {
  std::span<const uint8_t> bytes;
  bool is_whole = false;
};

/// The packets of the index, of which those behind the end of the stream have no bytes.
std::vector<AvailablePacket> packetsOf(const tks_decoder& decoder) {
  const ParsedHeader& parsed = decoder.parsed;
  const std::span<const uint8_t> payload = payloadOf(decoder.data, parsed);
  const uint64_t end = parsed.bytes + payload.size();
  std::vector<AvailablePacket> packets(parsed.header.index.size());
  for (const IndexedPacket& packet : IndexedPackets(parsed.header, parsed.bytes)) {
    if (packet.begin >= end) break;
    const uint64_t known = std::min(packet.end, end) - packet.begin;
    packets[packet.number] = {payload.subspan(packet.begin - parsed.bytes, known),
                              packet.end <= end};
  }
  return packets;
}

/// The packets that are whole come first.
void keepCutLast(const std::vector<AvailablePacket>& packets, std::vector<size_t>& order) {
  const auto cut = std::stable_partition(order.begin(), order.end(),
                                         [&](size_t i) { return packets[i].is_whole; });
  std::sort(cut, order.end());
}

/// The error of a component while some of its packets are missing.
class ErrorLeft {
 public:
  /// entries: of the component, in the stream's order.
  explicit ErrorLeft(const std::vector<IndexEntry>& entries) : is_there_(entries.size()) {
    for (const auto& [packet, slope] : entries) {
      qualities_.push_back(packet.quality);
      gains_.push_back(slopeOf(slope) * static_cast<double>(packet.length));
    }
    for (size_t i = entries.size(); i-- > 0;) {
      const double taken = squares(i) - squares(entries.size() - 1);
      if (missing_ > 0) unit_ = std::max(unit_, taken / missing_);
      missing_ += gains_[i];
    }
  }

  /// Takes one of the packets, by its place in the stream, and returns the quality that it leaves:
  /// that of the packets before the first one missing, or what the slopes of all that are missing
  /// come to where that is less.
  uint8_t take(size_t packet) {
    is_there_[packet] = true;
    missing_ -= gains_[packet];
    while (first_ < is_there_.size() && is_there_[first_]) ++first_;
    if (first_ == is_there_.size()) return qualities_.back();
    const double left = squares(qualities_.size() - 1) + unit_ * std::max(missing_, 0.0);
    const uint8_t before = first_ > 0 ? qualities_[first_ - 1] : 255;
    return std::min(before, qualityOf(std::sqrt(left)));
  }

 private:
  double squares(size_t packet) const { return std::pow(rmseOf(qualities_[packet]), 2); }

  std::vector<uint8_t> qualities_;
  std::vector<double> gains_;  ///< what each takes off the squared error, in `unit_`
  std::vector<bool> is_there_;
  double unit_ = 0, missing_ = 0;
  size_t first_ = 0;  ///< that is missing
};

/// The index in that order, with what is left of the errors after each packet.
std::vector<IndexEntry> reorderedIndex(const std::vector<IndexEntry>& index,
                                       const std::vector<size_t>& order) {
  std::array<std::vector<IndexEntry>, kComponents> entries;
  std::vector<size_t> places;  // among those of the component
  for (const IndexEntry& entry : index) {
    places.push_back(0);
    if (entry.packet.component == Component::kOther) continue;
    std::vector<IndexEntry>& of = entries[static_cast<size_t>(entry.packet.component)];
    places.back() = of.size();
    of.push_back(entry);
  }
  std::array<ErrorLeft, kComponents> left = {ErrorLeft(entries[0]), ErrorLeft(entries[1])};
  std::vector<IndexEntry> reordered;
  for (const size_t i : order) {
    reordered.push_back(index[i]);
    PacketHead& packet = reordered.back().packet;
    if (packet.component == Component::kOther) continue;  // these keep their order
    packet.quality = left[static_cast<size_t>(packet.component)].take(places[i]);
  }
  return reordered;
}

/// Appends a packet with another head, of which the quality alone differs, up to where it is cut.
void appendPacket(std::span<const uint8_t> packet, const PacketHead& head,
                  const TrackCounts& counts, std::vector<uint8_t>& stream) {
  std::vector<uint8_t> bytes = headBytes(head, counts);
  assert(packet.size() <= bytes.size() + head.length);
  bytes.resize(std::min(bytes.size(), packet.size()));
  stream.insert(stream.end(), bytes.begin(), bytes.end());
  const std::span<const uint8_t> rest = packet.subspan(bytes.size());
  stream.insert(stream.end(), rest.begin(), rest.end());
}

/// Whether all tracks have the same bytes in both streams.
bool holdTheSame(std::span<const uint8_t> a, std::span<const uint8_t> b) {
  const auto tracks = [](std::span<const uint8_t> stream) -> Result<Demultiplexed> {
    const Result<ParsedHeader> parsed = readHeader(stream);
    if (!parsed.ok()) return parsed.status();
    return demultiplex(payloadOf(stream, *parsed), parsed->bytes, trackCounts(parsed->header), 0);
  };
  const Result<Demultiplexed> of_a = tracks(a), of_b = tracks(b);
  return of_a.ok() && of_b.ok() && of_a->codewords == of_b->codewords;
}

Status reorder(tks_decoder& decoder, const std::vector<WeightedSighting>& sightings,
               tks_buffer& out) {
  const StreamHeader& header = decoder.parsed.header;
  Result<std::vector<size_t>> order = orderFor(header, sightings);
  if (!order.ok()) return order.status();
  const std::vector<AvailablePacket> packets = packetsOf(decoder);
  keepCutLast(packets, *order);
  StreamHeader reordered = header;
  reordered.index = reorderedIndex(header.index, *order);
  std::vector<uint8_t> payload;
  const TrackCounts counts = trackCounts(header);
  for (size_t i = 0; i < order->size(); ++i) {
    const PacketHead& head = reordered.index[i].packet;
    appendPacket(packets[(*order)[i]].bytes, head, counts, payload);
  }
  if (reordered.payload_crc) reordered.payload_crc = crc32(payload);
  std::vector<uint8_t> stream = writeHeader(reordered);
  stream.insert(stream.end(), payload.begin(), payload.end());
  if (!holdTheSame(decoder.data, stream)) return wrongIndex();
  giveBytes(stream, out);
  return {};
}

}  // namespace
}  // namespace tetrakis::inline api

tks_status tks_reorder(tks_decoder* decoder, const tks_screen_camera* cameras,
                       uint32_t camera_count, tks_buffer* out) {
  if (out == nullptr) return tetrakis::keeping(decoder, tetrakis::outputMissing);
  *out = {nullptr, 0};
  return tetrakis::keeping(decoder, [&]() -> tetrakis::Status {
    const tetrakis::StreamHeader& header = decoder->parsed.header;
    if (header.index.empty() && header.payload_bytes > 0)
      return {
          TKS_USAGE,
          "The stream has no front index, which says what its packets are worth: encode with one."};
    if (header.choice.heights || header.choice.texture)
      return {TKS_USAGE,
              "Packets are put in order for the first heights and the first texture of "
              "a stream: do so before others are chosen."};
    if (!tetrakis::describes(header.index, decoder->packets.payload.heads))
      return tetrakis::wrongIndex();
    if (camera_count == 0) return {TKS_USAGE, "The cameras are missing."};
    const auto taken = tetrakis::takeCameras(cameras, camera_count);
    if (!taken.ok()) return taken.status();
    if (tetrakis::Status status = tetrakis::checkPlanMemory(*decoder); !status.ok()) return status;
    const auto sightings = tetrakis::sightingsOf(*decoder, *taken);
    if (!sightings.ok()) return sightings.status();
    return tetrakis::reorder(*decoder, *sightings, *out);
  });
}

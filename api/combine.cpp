// SPDX-License-Identifier: Apache-2.0
// Makes one stream of the components of several: their descriptions join one list, and their
// packets one order, by what a byte takes off the weighted error (marginal analysis, thesis 6.3).
// Nothing is coded anew.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "api/component_ranges.hpp"
#include "api/encoded_stream.hpp"
#include "api/guarded.hpp"
#include "bitstream/stream/component_list.hpp"
#include "bitstream/stream/header.hpp"
#include "bitstream/stream/packet.hpp"
#include "ratecontrol/curves/component_curve.hpp"
#include "tetrakis/components.h"

namespace tetrakis::inline api {
namespace {

constexpr size_t kMostNameBytes = 255;

/// A stream that is combined with others.
struct CombinedPart {
  std::span<const uint8_t> bytes;
  std::string name;
  double weight = 1;
  ParsedHeader parsed;
  std::vector<FoundPacket> packets;
  std::vector<double> slopes;   ///< of each packet, on the hull of the stream's error
  std::vector<uint8_t> places;  ///< of its components in the list of the combined stream
  bool is_whole = false;        ///< all of its bytes are there
};

/// Where a packet comes from.
struct Origin {
  size_t part, packet;
};

Status inPart(const Status& status, size_t number) {
  return {status.code(), "Stream " + std::to_string(number) + ": " + status.message()};
}

/// The payload of a stream, as far as it is there.
std::span<const uint8_t> behindHeader(std::span<const uint8_t> stream, const ParsedHeader& parsed) {
  const std::span<const uint8_t> behind = stream.subspan(parsed.bytes);
  return behind.first(std::min<uint64_t>(behind.size(), parsed.header.payload_bytes));
}

/// What is left of a cut packet is a packet of its own, which shows no more than the one before; or
/// nothing, if it counts only when complete.
void endCut(std::vector<FoundPacket>& packets) {
  if (packets.empty() || !packets.back().isCut()) return;
  FoundPacket& cut = packets.back();
  if (cut.head.whole || cut.bytes.empty()) return packets.pop_back();
  cut.head.length = cut.bytes.size();
  cut.head.quality = 255;
  for (const FoundPacket& packet : std::span(packets).first(packets.size() - 1))
    if (packet.head.number == cut.head.number) cut.head.quality = packet.head.quality;
}

/// Each packet's slope on the lower hull of the error of all components together.
std::vector<double> slopesOf(const std::vector<FoundPacket>& packets,
                             const std::vector<ComponentRange>& ranges) {
  std::vector<double> errors;
  for (const ComponentRange& range : ranges) errors.push_back(range.unsent);
  const auto sum = [&] {
    double all = 0;
    for (const double error : errors) all += error;
    return all;
  };
  std::vector<RatePoint> points = {{0, sum()}};
  for (const FoundPacket& packet : packets) {
    const size_t number = packet.head.number;
    const double error = rmseOf(packet.head.quality) / ranges[number].quality_unit;
    errors[number] = std::min(errors[number], error * error);
    points.push_back({points.back().bytes + packet.head.length, sum()});
  }
  const std::vector<RatePoint> hull = lowerHull(points, 0);
  std::vector<double> slopes;
  size_t end = 1;
  for (size_t i = 1; i < points.size(); ++i) {
    while (hull[end].bytes < points[i].bytes) ++end;
    const auto bytes = static_cast<double>(hull[end].bytes - hull[end - 1].bytes);
    slopes.push_back((hull[end - 1].distortion - hull[end].distortion) / bytes);
  }
  return slopes;
}

Status takePackets(CombinedPart& part, const tks_limits* limits) {
  const auto payload = behindHeader(part.bytes, part.parsed);
  Result<std::vector<FoundPacket>> packets =
      packetsIn(payload, part.parsed.bytes, trackCounts(part.parsed.header));
  if (!packets.ok()) return packets.status();
  part.packets = *std::move(packets);
  endCut(part.packets);
  part.is_whole = payload.size() == part.parsed.header.payload_bytes;
  const Result<std::vector<ComponentRange>> ranges = componentRanges(part.bytes, limits);
  if (!ranges.ok()) return ranges.status();
  part.slopes = slopesOf(part.packets, *ranges);
  return {};
}

Status checkPart(const StreamHeader& header, size_t number) {
  const auto moves = [](const auto& component) {
    return component && !component->frames.none();
  };
  if (moves(header.geometry) || moves(header.texture))
    return {TKS_USAGE, "Streams of frames are not combined with others."};
  if (number > 0 && !header.triangle_mesh.none())
    return {TKS_USAGE, "A mesh of triangles stands in the first of the streams alone."};
  return {};
}

Status takePart(const tks_combined& given, size_t number, const tks_limits* limits, CombinedPart& part) {
  tks_combined known{};
  if (Status status = takeSized("the stream", given, sizeof given.size, known); !status.ok())
    return status;
  if (known.data == nullptr && known.data_size != 0)
    return {TKS_USAGE, "The bytes of the stream are missing."};
  part.bytes = {known.data, known.data_size};
  part.name = known.name != nullptr ? known.name : "";
  part.weight = known.weight == 0 ? 1 : known.weight;
  if (part.name.size() > kMostNameBytes)
    return {TKS_USAGE, "A name has at most " + std::to_string(kMostNameBytes) + " bytes."};
  if (!(part.weight > 0) || std::isinf(part.weight))
    return {TKS_USAGE, "A weight is a positive number."};
  Result<ParsedHeader> parsed = readHeader(part.bytes);
  if (!parsed.ok()) return parsed.status();
  part.parsed = *std::move(parsed);
  if (Status status = checkPart(part.parsed.header, number); !status.ok()) return status;
  return takePackets(part, limits);
}

/// The fields of a component behind its domain, as a list of components has them.
std::string fieldsOf(StreamHeader& header, const ListedComponent& one) {
  FieldWriter fields;
  visitKnown(fields, header, one);
  return {fields.bytes.begin(), fields.bytes.end()};
}

/// Of a texture with the reference system of the heights beside it only its transform is said.
void shareReference(const StreamHeader& header, Placement& place, std::string& crs) {
  const bool same = place.geo_keys == header.georeference.heights.geo_keys &&
                    crs == header.metadata.crs;
  if (!same || !place.has_transform || !header.geometry) return;
  place.geo_keys.clear();
  crs.clear();
}

/// The header of a combined stream, while components join its list.
class CombinedHeader {
 public:
  /// promises: all samples come back that the streams promise.
  explicit CombinedHeader(bool promises) : promises_(promises) {}

  /// Takes the first stream as it is, and of others their components.
  Status take(CombinedPart& part) {
    const bool is_first = header_.components.empty() && header_.triangle_mesh.none();
    if (is_first) takeFirst(part);
    part.places.clear();
    for (size_t i = 0; i < part.parsed.header.components.size(); ++i) {
      if (!is_first) {
        if (Status status = join(part, i); !status.ok()) return status;
      }
      part.places.push_back(static_cast<uint8_t>(is_first ? i : header_.components.size() - 1));
    }
    return checkNames();
  }
  StreamHeader& header() { return header_; }
  bool promisesSomething() const {
    const bool bound = header_.geometry && header_.geometry->max_error >= 0;
    return header_.lossless > 0 || bound;
  }

 private:
  void takeFirst(const CombinedPart& part) {
    header_ = part.parsed.header;
    header_.index.clear();
    for (ListedComponent& one : header_.components)
      if (one.details.name.empty()) one.details.name = part.name;
    if (promises_ && part.is_whole) return;
    header_.lossless = 0;
    for (ListedComponent& one : header_.components) one.details.lossless = 0;
    if (header_.geometry) header_.geometry->max_error = GeometryHeader::kNotStated;
  }

  /// Component `number` of a stream, of which the header says what is its own.
  Status join(const CombinedPart& part, size_t number) {
    if (header_.components.size() == kMostListed)
      return {TKS_USAGE, "A stream has at most " + std::to_string(kMostListed) + " components."};
    ListedComponent one = part.parsed.header.components[number];
    if (one.details.name.empty()) one.details.name = part.name;
    one.component = Component::kOther;
    if (one.isHeights() || one.isTexture()) {
      ComponentChoice choice;
      (one.isHeights() ? choice.heights : choice.texture) = number;
      Result<ParsedHeader> own = readHeader(part.bytes, choice);
      if (!own.ok()) return own.status();
      StreamHeader& header = own->header;
      if (!promises_ || !part.is_whole) {
        header.lossless = 0;
        if (header.geometry) header.geometry->max_error = GeometryHeader::kNotStated;
      }
      one.isHeights() ? joinHeights(header, one) : joinTexture(header, one);
    }
    header_.components.push_back(std::move(one));
    return {};
  }

  void joinHeights(StreamHeader& own, ListedComponent& one) {
    if (!header_.geometry) {
      one.component = Component::kGeometry;
      header_.geometry = own.geometry;
      header_.layers = own.layers;
      header_.metadata = own.metadata;
      header_.georeference.heights = own.georeference.heights;
      header_.georeference.description = own.georeference.description;
      header_.georeference.nan_nodata = own.georeference.nan_nodata;
      header_.height_positions = own.height_positions;
      header_.grid = own.grid;
      header_.lossless &= own.lossless;
      return;
    }
    one.component = Component::kGeometry;
    one.rest = fieldsOf(own, one);
    one.component = Component::kOther;
    one.details.metadata = own.metadata;
    one.details.place = own.georeference;
    one.details.lossless = own.lossless;
  }

  void joinTexture(StreamHeader& own, ListedComponent& one) {
    Georeference place = own.georeference;
    shareReference(header_, place.texture, place.texture_crs);
    if (!header_.texture) {
      one.component = Component::kTexture;
      header_.texture = own.texture;
      header_.georeference.texture = place.texture;
      header_.georeference.texture_crs = place.texture_crs;
      header_.texture_positions = own.texture_positions;
      header_.lossless &= own.lossless;
      return;
    }
    one.component = Component::kTexture;
    one.rest = fieldsOf(own, one);
    one.component = Component::kOther;
    one.details.place = place;
    one.details.lossless = own.lossless;
  }

  /// Both are heights, or both textures.
  static bool mayBeTakenAs(const ListedComponent& a, const ListedComponent& b) {
    return (a.isHeights() && b.isHeights()) || (a.isTexture() && b.isTexture());
  }

  Status checkNames() const {
    const std::vector<ListedComponent>& list = header_.components;
    for (size_t i = 0; i < list.size(); ++i)
      for (size_t j = 0; j < i; ++j)
        if (mayBeTakenAs(list[i], list[j]) && list[i].details.name == list[j].details.name)
          return {TKS_USAGE, "Components " + std::to_string(j) + " and " + std::to_string(i) +
                                 " are of one kind and have the same name, or none: names tell "
                                 "them apart."};
    return {};
  }

  StreamHeader header_;
  bool promises_;
};

/// The packets of all parts, the steepest first, each part's in their order.
std::vector<Origin> orderOf(const std::vector<CombinedPart>& parts) {
  std::vector<size_t> next(parts.size(), 0);
  std::vector<Origin> order;
  for (;;) {
    std::optional<size_t> best;
    double steepest = 0;
    for (size_t p = 0; p < parts.size(); ++p) {
      if (next[p] == parts[p].packets.size()) continue;
      const double slope = parts[p].weight * parts[p].slopes[next[p]];
      if (best && slope <= steepest) continue;
      best = p;
      steepest = slope;
    }
    if (!best) return order;
    order.push_back({*best, next[*best]++});
  }
}

/// The head of a packet in the combined stream.
PacketHead headIn(const CombinedPart& part, const PacketHead& head, const TrackCounts& counts) {
  PacketHead in = head;
  in.number = part.places[head.number];
  in.component = counts.componentOf(in.number);
  return in;
}

/// The index of the combined stream, if all parts have one.
std::vector<IndexEntry> indexOf(const std::vector<CombinedPart>& parts, const std::vector<Origin>& order,
                                const TrackCounts& counts) {
  for (const CombinedPart& part : parts) {
    std::vector<PacketHead> heads;
    for (const FoundPacket& packet : part.packets) heads.push_back(packet.head);
    if (!describes(part.parsed.header.index, heads)) return {};
  }
  std::vector<IndexEntry> index;
  for (const auto& [part, packet] : order) {
    const IndexEntry& entry = parts[part].parsed.header.index[packet];
    index.push_back({headIn(parts[part], entry.packet, counts), entry.slope});
  }
  return index;
}

std::vector<uint8_t> joined(const std::vector<CombinedPart>& parts, const std::vector<Origin>& order,
                               const TrackCounts& counts) {
  std::vector<uint8_t> payload;
  for (const auto& [part, number] : order) {
    const FoundPacket& packet = parts[part].packets[number];
    const std::vector<uint8_t> head = headBytes(headIn(parts[part], packet.head, counts), counts);
    payload.insert(payload.end(), head.begin(), head.end());
    payload.insert(payload.end(), packet.bytes.begin(), packet.bytes.end());
  }
  return payload;
}

/// The stream of all parts, or its first `budget` bytes as a stream that promises nothing.
Result<std::vector<uint8_t>> streamOf(std::vector<CombinedPart>& parts, const std::vector<Origin>& order,
                                      std::optional<uint64_t> budget) {
  CombinedHeader combined(!budget);
  for (CombinedPart& part : parts)
    if (Status status = combined.take(part); !status.ok()) return status;
  StreamHeader& header = combined.header();
  const TrackCounts counts = trackCounts(header);
  header.index = indexOf(parts, order, counts);
  std::vector<uint8_t> payload = joined(parts, order, counts);
  header.payload_bytes = payload.size();
  header.payload_crc.reset();
  if (combined.promisesSomething()) header.payload_crc = crc32(payload);
  std::vector<uint8_t> stream = writeHeader(header);
  if (budget) {
    if (stream.size() > *budget)
      return Status(TKS_USAGE, "The header of the combined stream takes " +
                                   std::to_string(stream.size()) + " bytes, more than all of the " +
                                   std::to_string(*budget) + " that it may take.");
    payload.resize(std::min<uint64_t>(payload.size(), *budget - stream.size()));
    header.payload_bytes = payload.size();
    stream = writeHeader(header);  // never longer: a varint of a smaller number
  }
  stream.insert(stream.end(), payload.begin(), payload.end());
  return stream;
}

/// Whether each component has the same bytes in its own stream, as far as they go in this one.
Status checkKept(std::span<const uint8_t> stream, const std::vector<CombinedPart>& parts, bool is_whole) {
  const Status broken(TKS_MISMATCH, "The encoder failed: a component differs from what it was.");
  const Result<ParsedHeader> parsed = readHeader(stream);
  if (!parsed.ok()) return parsed.status();
  const auto packets =
      packetsIn(behindHeader(stream, *parsed), parsed->bytes, trackCounts(parsed->header));
  if (!packets.ok()) return packets.status();
  std::vector<size_t> next(parts.size(), 0);
  for (const FoundPacket& packet : *packets) {
    size_t p = 0;
    while (p < parts.size() &&
           std::find(parts[p].places.begin(), parts[p].places.end(), packet.head.number) ==
               parts[p].places.end())
      ++p;
    if (p == parts.size() || next[p] == parts[p].packets.size()) return broken;
    const std::span<const uint8_t> source = parts[p].packets[next[p]++].bytes;
    const bool same = packet.bytes.size() <= source.size() &&
                      std::equal(packet.bytes.begin(), packet.bytes.end(), source.begin());
    if (!same || (is_whole && packet.bytes.size() < source.size())) return broken;
  }
  for (size_t p = 0; is_whole && p < parts.size(); ++p)
    if (next[p] < parts[p].packets.size()) return broken;
  return {};
}

Status combine(std::span<const tks_combined> streams, const tks_combine_options& options,
               tks_buffer& out) {
  std::vector<CombinedPart> parts(streams.size());
  for (size_t i = 0; i < streams.size(); ++i) {
    if (Status status = takePart(streams[i], i, options.limits, parts[i]); !status.ok())
      return inPart(status, i);
  }
  const std::vector<Origin> order = orderOf(parts);
  Result<std::vector<uint8_t>> stream = streamOf(parts, order, {});
  if (!stream.ok()) return stream.status();
  const bool is_cut = options.bytes != 0 && stream->size() > options.bytes;
  if (is_cut) stream = streamOf(parts, order, options.bytes);
  if (!stream.ok()) return stream.status();
  if (Status status = checkKept(*stream, parts, !is_cut); !status.ok()) return status;
  giveBytes(*stream, out);
  return {};
}

}  // namespace
}  // namespace tetrakis::inline api

tks_status tks_combine(const tks_combined* streams, uint32_t count,
                       const tks_combine_options* options, tks_buffer* out, char* message,
                       size_t message_size) {
  if (out != nullptr) *out = {nullptr, 0};
  return tetrakis::reporting(message, message_size, [&]() -> tetrakis::Status {
    if (out == nullptr) return tetrakis::outputMissing();
    if (streams == nullptr || count == 0) return {TKS_USAGE, "The streams are missing."};
    tks_combine_options known{};
    if (options != nullptr) {
      if (auto status = tetrakis::takeSized("the options", *options, sizeof options->size, known);
          !status.ok())
        return status;
    }
    return tetrakis::combine({streams, count}, known, *out);
  });
}

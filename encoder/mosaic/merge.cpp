// SPDX-License-Identifier: Apache-2.0
#include "encoder/mosaic/merge.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "encoder/mosaic/part.hpp"
#include "encoder/selection/write_stream.hpp"
#include "ratecontrol/needs/needs.hpp"

namespace tetrakis::inline mosaic {

namespace {

/// Where the codeword of a track lies.
struct TrackPlace {
  Tile tile;
  PartTable::Track stated;  ///< without points
};

/// What the merge holds of all parts.
struct Parts {
  std::vector<EncodedTrack> tracks;  ///< without codewords; those of corrections last
  std::vector<TrackPlace> places;    ///< of each track
  uint64_t valid_samples = 0;
};

size_t correctionTracksOf(const MosaicPlan& plan) {
  return static_cast<size_t>(correctionTracks(plan.geometry(), plan.header.layers));
}

/// The error that coefficients leave is that of the corrections, which take it off.
void passRestToCorrections(size_t coefficient_tracks, std::vector<EncodedTrack>& tracks) {
  const std::span coefficients = std::span(tracks).first(coefficient_tracks);
  const std::span corrections = std::span(tracks).subspan(coefficient_tracks);
  double rest = 0, before = 0;
  for (EncodedTrack& track : coefficients) {
    const double left = track.points.back().distortion;
    for (RatePoint& point : track.points) point.distortion -= left;
    rest += left;
  }
  for (const EncodedTrack& track : corrections) before += track.points.front().distortion;
  for (EncodedTrack& track : corrections)
    for (RatePoint& point : track.points) point.distortion *= before > 0 ? rest / before : 0;
}

Result<Parts> readParts(const MosaicPlan& plan, const MosaicGrid& grid, const MosaicFiles& files) {
  Parts parts;
  const size_t all = grid.regions().size() + correctionTracksOf(plan);
  parts.tracks.resize(all);
  parts.places.resize(all);
  const uint32_t hash = hashOf(plan);
  for (const Tile& tile : grid.tiles()) {
    Result<PartTable> table = readTable(files, hash, tile);
    if (!table.ok()) return table.status();
    const std::vector<uint32_t> numbers = grid.tracks(tile);
    if (table->tracks.size() != numbers.size())
      return Status(TKS_IO, "The part " + partName(tile) + " of the mosaic has other tracks.");
    for (size_t i = 0; i < numbers.size(); ++i) {
      PartTable::Track& track = table->tracks[i];
      parts.tracks[numbers[i]] = {{}, std::move(track.points), plan.geometry().planes};
      parts.places[numbers[i]] = {tile, {track.offset, track.bytes, track.crc, track.opening, {}}};
    }
    parts.valid_samples += table->valid_samples;
  }
  if (plan.corrects()) passRestToCorrections(grid.regions().size(), parts.tracks);
  return parts;
}

/// The packets of all tracks in their order, each with the error that it leaves.
std::vector<Packet> orderedPackets(const MosaicPlan& plan, const Parts& parts, TrackOrder by) {
  const CodedTracks coded{Component::kGeometry, parts.tracks, parts.places.front().stated.opening,
                          0, correctionTracksOf(plan)};
  OrderedTracks order = orderTracks(coded, by);
  const double samples = std::max(1.0, static_cast<double>(parts.valid_samples));
  const bool whole = plan.geometry().regions.side_log2 > 0;
  for (size_t i = 0; i < order.packets.size(); ++i) {
    Packet& packet = order.packets[i];
    const RatePoint &before = order.points[i], &after = order.points[i + 1];
    packet.quality = qualityOf(std::sqrt(std::max(0.0, after.distortion) / samples));
    packet.slope = (before.distortion - after.distortion) / static_cast<double>(packet.length());
    if (!whole) packet.track.reset();
  }
  const double enough = plan.target.mean_square * samples;
  if (enough > 0) {
    const auto reached = std::find_if(order.points.begin(), order.points.end(),
                                      [&](const RatePoint& p) { return p.distortion <= enough; });
    order.packets.resize(std::min<size_t>(order.packets.size(),
                                          static_cast<size_t>(reached - order.points.begin())));
  }
  return order.packets;
}

/// The header of a stream whose payload has these packets.
StreamHeader headerFor(const MosaicPlan& plan, const Parts& parts,
                       const std::vector<Packet>& packets, const MergeOptions& options) {
  StreamHeader header = plan.header;
  header.layers.validity_bytes = parts.places.front().stated.opening;
  WaveletHeader& wavelet = header.geometry->wavelet;
  uint64_t coefficients = 0;
  const size_t of_coefficients = parts.places.size() - correctionTracksOf(plan);
  for (const TrackPlace& place : std::span(parts.places).first(of_coefficients))
    coefficients += place.stated.bytes - place.stated.opening;
  if (wavelet.fraction_bits == 0) wavelet.rounded_bytes = coefficients;
  const PartTable::Track& base = parts.places.front().stated;
  if (plan.corrects()) header.layers.coefficient_bytes = base.bytes - base.opening;
  if (header.lossless != 0 || plan.target.bounded) header.payload_crc = 0;  // until it is known
  header.payload_bytes = bytesOfPackets(packets);
  if (options.index) header.index = indexOf(packets, trackCounts(header));
  return header;
}

/// Writes a payload packet by packet, and keeps its checksum.
class PayloadWriter {
 public:
  PayloadWriter(const MosaicFiles& files, const WriteAt& write, uint64_t offset, uint64_t limit)
      : files_(files), write_(write), offset_(offset), left_(limit) {}

  Status add(const Parts& parts, const Packet& packet, const TrackCounts& counts) {
    if (Status status = append(headBytes(headOf(packet, counts), counts)); !status.ok())
      return status;
    const TrackPlace& place = parts.places[packet.track.value_or(0)];
    const std::string name = partName(place.tile);
    const auto bytes = files_.read(name, place.stated.offset + packet.begin, packet.length());
    if (!bytes.ok()) return bytes.status();
    if (bytes->size() != packet.length())
      return {TKS_IO, "The part " + name + " of the mosaic is too short."};
    return append(*bytes);
  }

  Status flush() {
    if (buffer_.empty()) return {};
    crc_.add(buffer_);
    const Status status = write_(offset_, buffer_);
    offset_ += buffer_.size();
    buffer_.clear();
    return status;
  }
  uint32_t crc() const { return crc_.value(); }

 private:
  static constexpr size_t kBuffer = size_t{1} << 20;

  Status append(std::span<const uint8_t> bytes) {
    const auto count = static_cast<size_t>(std::min<uint64_t>(left_, bytes.size()));
    buffer_.insert(buffer_.end(), bytes.begin(), bytes.begin() + static_cast<ptrdiff_t>(count));
    left_ -= count;
    return buffer_.size() < kBuffer ? Status() : flush();
  }

  const MosaicFiles& files_;
  const WriteAt& write_;
  uint64_t offset_, left_;
  std::vector<uint8_t> buffer_;
  Crc32 crc_;
};

/// Reads every codeword once: a damaged one must not become part of a stream.
Status checkCodewords(const Parts& parts, const MosaicFiles& files) {
  for (const TrackPlace& place : parts.places) {
    const auto codeword = readCodeword(files, place.tile, place.stated);
    if (!codeword.ok()) return codeword.status();
  }
  return {};
}

}  // namespace

Status mergeParts(const MosaicPlan& plan, const MosaicFiles& files, const MergeOptions& options,
                  const WriteAt& write) {
  const MosaicGrid grid = plan.grid();
  const Result<Parts> parts = readParts(plan, grid, files);
  if (!parts.ok()) return parts.status();
  if (Status status = checkCodewords(*parts, files); !status.ok()) return status;
  const std::vector<Packet> packets = orderedPackets(plan, *parts, options.order);
  StreamHeader header = headerFor(plan, *parts, packets, options);
  size_t header_bytes = writeHeader(header).size();
  if (header_bytes > kMaxHeaderBytes)
    return {TKS_USAGE, "The index is too long for a header: take larger regions, or no index."};
  if (plan.target.bytes < header_bytes) {
    return {TKS_USAGE, "A budget of " + std::to_string(plan.target.bytes) +
                           " bytes is too small: the header of this stream takes " +
                           std::to_string(header_bytes) + "."};
  }
  header.payload_bytes = std::min(header.payload_bytes, plan.target.bytes - header_bytes);
  header_bytes = writeHeader(header).size();  // never more: a varint of a smaller number
  PayloadWriter payload(files, write, header_bytes, header.payload_bytes);
  const TrackCounts counts = trackCounts(header);
  for (const Packet& packet : packets)
    if (Status status = payload.add(*parts, packet, counts); !status.ok()) return status;
  if (Status status = payload.flush(); !status.ok()) return status;
  if (header.payload_crc) header.payload_crc = payload.crc();
  return write(0, writeHeader(header));
}

}  // namespace tetrakis::inline mosaic

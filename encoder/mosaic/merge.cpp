// SPDX-License-Identifier: Apache-2.0
#include "encoder/mosaic/merge.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "bitstream/stream/page_index.hpp"
#include "encoder/mosaic/part.hpp"
#include "encoder/selection/write_stream.hpp"
#include "ratecontrol/needs/needs.hpp"

namespace tetrakis::inline mosaic {

namespace {

/// A longer front index becomes pages: whoever reads a window of a stream with pages does not read
/// what is worth knowing of the rest, and pays with requests.
constexpr size_t kMostFrontIndex = 64 << 10;

/// Where the codeword of a track lies.
struct TrackPlace {
  Tile tile;
  PartTable::Track stated;  ///< without points
};

/// The accounts of all parts, which the merge holds.
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

/// A stream whose codewords still lie in the parts.
struct Draft {
  std::vector<Packet> packets;
  StreamHeader header;
  std::vector<uint8_t> records;  ///< of index pages

  size_t headerBytes() const { return writeHeader(header).size(); }
};

/// The header of a stream of these parts, without what depends on its packets.
StreamHeader headerFor(const MosaicPlan& plan, const Parts& parts) {
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
  return header;
}

/// Gives a draft its index: a front index, while that is short, else pages.
void addIndex(LaidPackets& laid, Draft& draft) {
  const TrackCounts counts = trackCounts(draft.header);
  draft.header.index = indexOf(laid.packets, counts);
  if (draft.headerBytes() <= kMostFrontIndex || !takesPages(draft.header)) return;
  draft.packets = laid.joined();
  draft.header.index.clear();
  draft.header.payload_bytes = bytesOfPackets(draft.packets);
  WrittenPages pages = writePages(draft.header, indexOf(draft.packets, counts));
  draft.header.pages = std::move(pages.root);
  draft.records = std::move(pages.records);
}

/// left_out: of the packets that are worth least.
Draft draftOf(const MosaicPlan& plan, const Parts& parts, const LayoutOptions& options,
              size_t left_out) {
  const CodedTracks coded{Component::kGeometry, parts.tracks, parts.places.front().stated.opening,
                          0, correctionTracksOf(plan)};
  const double samples = std::max(1.0, static_cast<double>(parts.valid_samples));
  LaidPackets laid = layOut(plan, coded, samples, options, left_out);
  Draft draft{laid.packets, headerFor(plan, parts), {}};
  draft.header.payload_bytes = bytesOfPackets(draft.packets);
  if (options.layout != Layout::kProgressive) addIndex(laid, draft);
  return draft;
}

bool fits(const MosaicPlan& plan, const Draft& draft) {
  const uint64_t beside = draft.headerBytes() + draft.records.size();
  return plan.target.bytes >= beside && plan.target.bytes - beside >= draft.header.payload_bytes;
}

/// The draft with as many packets as fit the budget. A progressive stream is cut in a packet.
Draft draftWithin(const MosaicPlan& plan, const Parts& parts, const LayoutOptions& options) {
  Draft draft = draftOf(plan, parts, options, 0);
  if (options.layout == Layout::kProgressive || fits(plan, draft)) return draft;
  size_t least = 0, most = draftOf(plan, parts, {}, 0).packets.size();
  while (least < most) {
    const size_t middle = least + (most - least) / 2;
    if (fits(plan, draftOf(plan, parts, options, middle)))
      most = middle;
    else
      least = middle + 1;
  }
  return draftOf(plan, parts, options, most);
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

Status mergeParts(const MosaicPlan& plan, const MosaicFiles& files, const LayoutOptions& options,
                  const WriteAt& write) {
  const MosaicGrid grid = plan.grid();
  const Result<Parts> parts = readParts(plan, grid, files);
  if (!parts.ok()) return parts.status();
  if (Status status = checkCodewords(*parts, files); !status.ok()) return status;
  Draft draft = draftWithin(plan, *parts, options);
  StreamHeader& header = draft.header;
  size_t header_bytes = draft.headerBytes();
  if (plan.target.bytes < header_bytes) {
    return {TKS_USAGE, "A budget of " + std::to_string(plan.target.bytes) +
                           " bytes is too small: the header of this stream takes " +
                           std::to_string(header_bytes) + "."};
  }
  header.payload_bytes = std::min(header.payload_bytes, plan.target.bytes - header_bytes);
  header_bytes = draft.headerBytes();  // never more: a varint of a smaller number
  PayloadWriter payload(files, write, header_bytes, header.payload_bytes);
  const TrackCounts counts = trackCounts(header);
  for (const Packet& packet : draft.packets)
    if (Status status = payload.add(*parts, packet, counts); !status.ok()) return status;
  if (Status status = payload.flush(); !status.ok()) return status;
  if (!draft.records.empty()) {
    const Status records = write(header_bytes + header.payload_bytes, draft.records);
    if (!records.ok()) return records;
  }
  if (header.payload_crc) header.payload_crc = payload.crc();
  return write(0, writeHeader(header));
}

}  // namespace tetrakis::inline mosaic

// SPDX-License-Identifier: Apache-2.0
// The finished stream: header, index and the packets that fit.
#include <algorithm>
#include <cassert>
#include <cmath>

#include "encoder/encode_job.hpp"

namespace tetrakis {

namespace {

/// Before the first byte.
bool nothingLeft(const std::vector<EncodedTrack>& tracks) {
  return std::all_of(tracks.begin(), tracks.end(), [](const EncodedTrack& track) {
    return track.points.front().distortion == 0;
  });
}

}  // namespace

StreamHeader EncodeJob::makeHeader(uint64_t payload_bytes, bool lossless) const {
  StreamHeader header;
  header.payload_bytes = payload_bytes;
  header.lossless = lossless;
  header.triangles = options_.triangles;
  if (geometry_) {
    GeometryHeader& g = header.geometry.emplace();
    g.width = heights_->width;
    g.height = heights_->height;
    g.sample = static_cast<uint8_t>(heights_->sample);
    g.wavelet = geometry_->wavelet;
    g.regions = geometry_->regions;
    if (!geometry_->tracks.empty())
      g.planes = static_cast<uint8_t>(geometry_->tracks.front().planes);
    g.exact = geometry_->steps.exact;
    g.base = geometry_->steps.base;
    g.step = geometry_->steps.step;
    g.max_error = options_.max_error > 0 ? options_.max_error : header.lossless ? 0 : -1;
    header.layers = geometry_->layers;
    const auto text = [](const char* s) { return std::string(s ? s : ""); };
    header.metadata = {heights_->scale,     heights_->offset,     heights_->spacing_x,
                       heights_->spacing_y, text(heights_->unit), text(heights_->vertical_datum),
                       text(heights_->crs)};
  }
  if (texture_) header.texture = texture_->header;
  if (options_.index != 0) {
    for (const Packet& packet : packets_)
      header.index.push_back({packet.head(), packet.track.value_or(0), packet.quality});
  }
  return header;
}

/// Packets that begin behind the budget are not sent, and no index need list them.
void EncodeJob::keepWithinBudget() {
  if (!budgeted()) return;
  uint64_t begin = 0;
  size_t kept = 0;
  for (; kept < packets_.size() && begin < options_.bytes; ++kept) {
    begin += overheadOf(packets_[kept]) + packets_[kept].end - packets_[kept].begin;
  }
  packets_.resize(kept);
}

uint64_t EncodeJob::totalPayload() const {
  uint64_t total = 0;
  for (const Packet& packet : packets_) total += overheadOf(packet) + packet.end - packet.begin;
  return total;
}

/// The last packet of either track states that nothing is left, or there was nothing to send.
bool EncodeJob::restoresEverything() const {
  std::array<bool, kComponents> exact = {!geometry_ || nothingLeft(geometry_->tracks),
                                         !texture_ || nothingLeft(texture_->tracks)};
  for (const Packet& packet : packets_)
    exact[static_cast<size_t>(packet.component)] = packet.quality == 0;
  const bool restored = !geometry_ || geometry_->restoresSamples();
  const bool hidden = texture_ && texture_->header.hidden;
  return exact[0] && exact[1] && restored && !hidden;
}

/// All samples come back, header and all within the budget.
bool EncodeJob::isLossless() const {
  if (!restoresEverything()) return false;
  const uint64_t payload = totalPayload();
  return !budgeted() || writeHeader(makeHeader(payload, true)).size() + payload <= options_.bytes;
}

Result<std::vector<uint8_t>> EncodeJob::assemble() const {
  std::array<Codewords, kComponents> codewords;
  if (geometry_) codewords[0] = codewordsOf(geometry_->tracks);
  if (texture_) codewords[1] = codewordsOf(texture_->tracks);
  uint64_t room = UINT64_MAX >> 1;
  const bool lossless = isLossless();
  if (budgeted() && !lossless) {
    const size_t header_bytes = writeHeader(makeHeader(options_.bytes, false)).size();
    if (options_.bytes < header_bytes) {
      return Status(TKS_USAGE, "A budget of " + std::to_string(options_.bytes) +
                                   " bytes is too small: the header alone takes " +
                                   std::to_string(header_bytes) + ", the least that works.");
    }
    room = options_.bytes - header_bytes;
  }
  const uint64_t payload_bytes = std::min(room, totalPayload());
  assert(!lossless || payload_bytes == totalPayload());
  std::vector<uint8_t> stream = writeHeader(makeHeader(payload_bytes, lossless));
  const std::vector<uint8_t> payload = multiplex(packets_, codewords, payload_bytes);
  stream.insert(stream.end(), payload.begin(), payload.end());
  return stream;
}

}  // namespace tetrakis

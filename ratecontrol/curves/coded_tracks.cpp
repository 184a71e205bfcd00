// SPDX-License-Identifier: Apache-2.0
#include "ratecontrol/curves/coded_tracks.hpp"

#include <algorithm>
#include <cassert>

namespace tetrakis::inline curves {

Codewords codewordsOf(std::span<const EncodedTrack> tracks) {
  Codewords codewords;
  for (const EncodedTrack& track : tracks) codewords.push_back(track.codeword);
  return codewords;
}

double distortionAt(std::span<const RatePoint> points, uint64_t bytes) {
  const auto after = std::find_if(points.begin(), points.end(),
                                  [&](const RatePoint& point) { return point.bytes > bytes; });
  if (after == points.begin() || after == points.end()) return points.back().distortion;
  const RatePoint &a = *(after - 1), &b = *after;
  const double t = static_cast<double>(bytes - a.bytes) / static_cast<double>(b.bytes - a.bytes);
  return a.distortion + t * (b.distortion - a.distortion);
}

Codewords prefixAfter(const CodedTracks& coded, std::span<const Packet> packets, uint64_t bytes) {
  const Codewords all = codewordsOf(coded.tracks);
  const uint64_t most = bytesOf(coded.tracks);
  assert(!all.empty() && bytes <= most);
  if (all.size() == 1) return {all.front().first(bytes)};
  if (bytes == most) return all;
  Codewords cut(all.size());
  for (const Packet& packet : packets) {
    if (packet.component != coded.component) continue;
    assert(packet.track && *packet.track < all.size());
    const uint64_t taken = std::min(bytes, packet.length());
    cut[*packet.track] = all[*packet.track].first(packet.begin + taken);
    bytes -= taken;
    if (bytes == 0) break;
  }
  return cut;
}

}  // namespace tetrakis::inline curves

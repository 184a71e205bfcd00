// SPDX-License-Identifier: Apache-2.0
#include "encoder/combination/combined_part.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "ratecontrol/curves/component_curve.hpp"

namespace tetrakis::inline combination {

std::span<const uint8_t> behindHeader(std::span<const uint8_t> stream, const ParsedHeader& parsed) {
  const std::span<const uint8_t> behind = stream.subspan(parsed.bytes);
  return behind.first(std::min<uint64_t>(behind.size(), parsed.header.payload_bytes));
}

namespace {

/// What is left of a cut packet is a packet of its own, or nothing if it counts only when complete.
/// Errors fall faster at first: they lie below a line between both of its ends.
/// Returns whether there is such a packet.
bool endCut(std::vector<FoundPacket>& packets) {
  if (packets.empty() || !packets.back().isCut()) return false;
  FoundPacket& cut = packets.back();
  if (cut.head.whole || cut.bytes.empty()) {
    packets.pop_back();
    return false;
  }
  uint8_t before = 255;
  for (const FoundPacket& packet : std::span(packets).first(packets.size() - 1))
    if (packet.head.number == cut.head.number) before = packet.head.quality;
  const auto squares = [](uint8_t quality) { return rmseOf(quality) * rmseOf(quality); };
  const double share = static_cast<double>(cut.bytes.size()) / static_cast<double>(cut.head.length);
  const double left = squares(before) + share * (squares(cut.head.quality) - squares(before));
  cut.head.quality = std::min(before, qualityOf(std::sqrt(left)));
  cut.head.length = cut.bytes.size();
  return true;
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

}  // namespace

Status takePackets(CombinedPart& part, const std::vector<ComponentRange>& ranges) {
  const auto payload = behindHeader(part.bytes, part.parsed);
  Result<std::vector<FoundPacket>> packets =
      packetsIn(payload, part.parsed.bytes, trackCounts(part.parsed.header));
  if (!packets.ok()) return packets.status();
  part.packets = *std::move(packets);
  part.ends_cut = endCut(part.packets);
  part.is_whole = payload.size() == part.parsed.header.payload_bytes;
  part.slopes = slopesOf(part.packets, ranges);
  return {};
}

std::vector<PacketOrigin> combinedOrder(const std::vector<CombinedPart>& parts) {
  std::vector<size_t> next(parts.size(), 0);
  std::vector<PacketOrigin> order;
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

}  // namespace tetrakis::inline combination

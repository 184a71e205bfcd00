// SPDX-License-Identifier: Apache-2.0
#include "receiver/fetch_plan.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "base/length_unit.hpp"
#include "bitstream/track/regions.hpp"

namespace tetrakis::inline receiver {

namespace {

constexpr double kOpening = std::numeric_limits<double>::infinity();

/// The grid that the columns and rows of views count.
Extent gridOf(const StreamHeader& header) {
  return header.geometry ? header.geometry->shown() : header.texture->extent();
}

/// Pixels of a texel for a point with so many of a sample.
double texelsPixels(const StreamHeader& header, double pixels) {
  if (!header.texture) return pixels;
  return pixels * static_cast<double>(gridOf(header).samples()) /
         static_cast<double>(header.texture->extent().samples());
}

/// What a height error of 1 costs at a point beside a texel's error of 1. It moves the texture by
/// its parallax, and the texture's slope is the smaller the larger a texel appears.
double heightsCost(const StreamHeader& header, const SeenPoint& point) {
  return point.pixels * point.parallax / std::max(1.0, texelsPixels(header, point.pixels));
}

/// The mean point of the encoder's viewer of whom nothing is known: all of the ground, from 35
/// degrees above the horizon, in half of a picture of 768 x 512.
SeenPoint usualPoint(const StreamHeader& header) {
  constexpr double kPixels = 768 * 512 / 2.0, kSine = 0.574, kCosine = 0.819;
  const double pixels = kPixels / static_cast<double>(gridOf(header).samples());
  const Metadata& m = header.metadata;
  const double x = m.spacing_x > 0 ? m.spacing_x : m.spacing_y > 0 ? m.spacing_y : kUnknownSpacing;
  const double y = m.spacing_y > 0 ? m.spacing_y : x;
  const double metres = metresPerUnit(m.unit).value_or(1);
  return {pixels, pixels / kSine * kCosine * kCosine / (x * y) * metres * metres};
}

/// The share of a region's levels that a picture with so many pixels a sample shows: a level's
/// finest waves are 2^level samples long, and take two pixels. coarsest_unseen: finer levels than
/// the next are not decoded.
double shownShare(const Region& region, double pixels, int coarsest_unseen) {
  const int last = region.isBase() ? region.first_level + kRegionLevels - 1 : region.last_level;
  const double finest = std::max<double>(1 - std::log2(pixels) / 2, coarsest_unseen + 1);
  return std::clamp((last + 1 - finest) / (last + 1 - region.first_level), 0.0, 1.0);
}

/// Heights finer than a mip level with 20 samples a triangle are not decoded for a budget mesh.
int levelBelowMesh(const StreamHeader& header, uint32_t triangles) {
  if (triangles == 0) return 0;
  constexpr double kSamples = 20;
  const double most = static_cast<double>(gridOf(header).samples()) / (kSamples * triangles);
  return most < 4 ? 0 : static_cast<int>(std::floor(std::log2(most) / 2));
}

/// What errors of the tracks cost in one view beside what they cost on average.
class Costs {
 public:
  Costs(const StreamHeader& header, const Sighting& sighting)
      : header_(header),
        sighting_(sighting),
        usual_(usualPoint(header)),
        unseen_(levelBelowMesh(header, sighting.triangles)) {
    if (header.geometry) {
      for (const Region& region : regionsIn(*header.geometry))
        costs_[0].push_back(costOfHeights(region));
    }
    if (header.texture) {
      for (const Region& region : regionsIn(*header.texture))
        costs_[1].push_back(costOfTexture(region));
    }
  }

  bool holds(const PacketHead& packet) const { return packet.track < of(packet).size(); }
  double at(const PacketHead& packet) const { return of(packet)[packet.track]; }

 private:
  static std::vector<Region> regionsIn(const auto& component) {
    return regionsOf(component.width, component.height, component.regions.side_log2);
  }
  const std::vector<double>& of(const PacketHead& packet) const {
    return costs_[static_cast<size_t>(packet.component())];
  }

  double costOfHeights(const Region& region) const {
    if (sighting_.points.empty()) return shownShare(region, 1, unseen_);
    return meanOver(region, header_.geometry->extent(),
                    [&](const SeenPoint& point) {
                      return heightsCost(header_, point) *
                             shownShare(region, point.pixels, unseen_);
                    }) /
           heightsCost(header_, usual_);
  }

  double costOfTexture(const Region& region) const {
    if (sighting_.points.empty()) return 1;
    return meanOver(region, header_.texture->extent(),
                    [&](const SeenPoint& point) {
                      return point.pixels *
                             shownShare(region, texelsPixels(header_, point.pixels), 0);
                    }) /
           usual_.pixels;
  }

  /// Of the points that a region of a plane reaches, because its waves end beyond it; hidden ones
  /// count as 0.
  template <class Cost>
  double meanOver(const Region& region, Extent plane, Cost&& cost) const {
    const auto first = [](uint32_t begin, uint32_t side, uint32_t points) {
      return static_cast<uint32_t>(uint64_t{begin} * points / side);
    };
    const auto behind = [](uint32_t end, uint32_t side, uint32_t points) {
      return static_cast<uint32_t>((uint64_t{end} * points + side - 1) / side);
    };
    const auto& [columns, rows, points, triangles] = sighting_;
    double sum = 0;
    size_t count = 0;
    const uint32_t reach = region.isBase() ? 0 : uint32_t{1} << std::min(region.last_level, 24);
    const uint32_t x0 = first(region.x0 - std::min(reach, region.x0), plane.width, columns);
    const uint32_t y0 = first(region.y0 - std::min(reach, region.y0), plane.height, rows);
    const uint32_t x1 = behind(std::min(region.x1 + reach, plane.width), plane.width, columns);
    const uint32_t y1 = behind(std::min(region.y1 + reach, plane.height), plane.height, rows);
    for (uint32_t y = y0; y < y1; ++y) {
      for (uint32_t x = x0; x < x1; ++x, ++count) {
        const SeenPoint& point = points[size_t{y} * columns + x];
        if (point.pixels > 0) sum += cost(point);
      }
    }
    return count > 0 ? sum / static_cast<double>(count) : 0;
  }

  const StreamHeader& header_;
  const Sighting& sighting_;
  SeenPoint usual_;
  int unseen_;
  std::array<std::vector<double>, kComponents> costs_;
};

/// What a byte of a packet is worth.
struct Worth {
  double all = 0;    ///< to all sightings together
  double now = 0;    ///< to the first of them
  double slope = 0;  ///< as the index states it

  Worth least(const Worth& other) const {
    return {std::min(all, other.all), std::min(now, other.now), std::min(slope, other.slope)};
  }
};

/// A packet of the index.
struct PlacedPacket {
  size_t number = 0;
  uint64_t begin = 0, end = 0;  ///< bytes of the stream
  Worth worth;
};

/// Follows an index through the stream. What packets are worth does not rise within a track.
class IndexWalk {
 public:
  explicit IndexWalk(const StreamHeader& header, uint64_t begin)
      : header_(header), counts_(trackCounts(header)), place_(begin) {}

  /// Where the next packet begins.
  uint64_t place() const { return place_; }

  /// worth: of an entry without what came before.
  PlacedPacket take(const IndexEntry& entry, const Worth& worth) {
    const PacketHead& head = entry.packet;
    const auto component = static_cast<size_t>(head.component());
    const uint64_t length = head.head >> 2;
    const size_t before = headBytes(head, counts_[component].named).size();
    constexpr uint64_t kBehindAll = uint64_t{1} << 63;  // lengths are below 2^62
    const uint64_t end = std::min(place_ + before + length, kBehindAll);
    PlacedPacket packet = {number_++, place_, end, worth};
    place_ = end;
    if (head.track == 0 && opened_[component] < openingBytes(header_, head.component())) {
      opened_[component] += length;
      packet.worth = {kOpening, kOpening, kOpening};
      return packet;
    }
    const auto [last, is_new] = last_.try_emplace({head.component(), head.track}, worth);
    packet.worth = last->second = last->second.least(worth);
    return packet;
  }

 private:
  const StreamHeader& header_;
  TrackCounts counts_;
  uint64_t place_;
  size_t number_ = 0;
  std::array<uint64_t, kComponents> opened_{};
  std::map<std::pair<Component, uint32_t>, Worth> last_;
};

/// What helps more comes first; of what helps alike the greater slope, then the stream's order.
void sortByWorth(std::vector<PlacedPacket>& packets) {
  std::stable_sort(packets.begin(), packets.end(), [](const auto& a, const auto& b) {
    return std::pair(a.worth.all, a.worth.slope) > std::pair(b.worth.all, b.worth.slope);
  });
}

/// All packets, those first that help all sightings most.
Result<std::vector<PlacedPacket>> sortedPackets(const StreamHeader& header, uint64_t begin,
                                                std::span<const WeightedSighting> sightings) {
  std::vector<Costs> costs;
  costs.reserve(sightings.size());
  for (const WeightedSighting& s : sightings) costs.emplace_back(header, s.sighting);
  IndexWalk walk(header, begin);
  std::vector<PlacedPacket> packets;
  packets.reserve(header.index.size());
  for (const IndexEntry& entry : header.index) {
    if (walk.place() >= begin + header.payload_bytes) break;  // the index runs ahead of the packets
    const double slope = slopeOf(entry.slope);
    Worth worth{0, 0, slope};
    for (size_t i = 0; i < costs.size(); ++i) {
      if (!costs[i].holds(entry.packet))
        return Status(TKS_CORRUPT, "Corrupt stream: its index names a track that there is not.");
      const double here = slope * sightings[i].weight * costs[i].at(entry.packet);
      if (i == 0) worth.now = here;
      worth.all += here;
    }
    packets.push_back(walk.take(entry, worth));
  }
  sortByWorth(packets);
  return packets;
}

/// A range, and its place among those that were chosen.
struct RankedRange {
  FetchRange range;
  size_t rank = 0;
};

/// Neighbours become one, unless only one of them helps.
std::vector<FetchRange> merged(std::vector<RankedRange> ranges) {
  std::sort(ranges.begin(), ranges.end(), [](const RankedRange& a, const RankedRange& b) {
    return a.range.begin < b.range.begin;
  });
  std::vector<RankedRange> joined;
  for (const RankedRange& next : ranges) {
    if (joined.empty() || joined.back().range.end != next.range.begin ||
        (joined.back().range.gain > 0) != (next.range.gain > 0)) {
      joined.push_back(next);
      continue;
    }
    RankedRange& last = joined.back();
    last.range.end = next.range.end;
    last.range.gain = std::max(last.range.gain, next.range.gain);
    last.rank = std::min(last.rank, next.rank);
  }
  std::sort(joined.begin(), joined.end(),
            [](const RankedRange& a, const RankedRange& b) { return a.rank < b.rank; });
  std::vector<FetchRange> result;
  for (const RankedRange& r : joined) result.push_back(r.range);
  return result;
}

}  // namespace

Result<std::vector<FetchRange>> planFetch(const ParsedHeader& parsed,
                                          std::span<const WeightedSighting> sightings,
                                          const Missing& missing, uint64_t bytes) {
  const StreamHeader& header = parsed.header;
  const uint64_t end = parsed.bytes + header.payload_bytes;
  std::vector<PlacedPacket> packets = {{0, parsed.bytes, end, {1, 1, 1}}};
  if (!header.index.empty()) {
    auto sorted = sortedPackets(header, parsed.bytes, sightings);
    if (!sorted.ok()) return sorted.status();
    packets = std::move(*sorted);
  }
  std::vector<RankedRange> chosen;
  uint64_t left = bytes;
  for (const PlacedPacket& packet : packets) {
    if (left == 0) break;
    for (const ByteRange& gap : missing(packet.begin, std::min(packet.end, end))) {
      const uint64_t taken = std::min(left, gap.end - gap.begin);
      if (taken == 0) break;
      left -= taken;
      const double gain = std::min(packet.worth.now, std::numeric_limits<double>::max());
      chosen.push_back({{gap.begin, gap.begin + taken, gain}, chosen.size()});
    }
  }
  return merged(std::move(chosen));
}

Result<std::vector<size_t>> orderFor(const StreamHeader& header,
                                     std::span<const WeightedSighting> sightings) {
  const auto packets = sortedPackets(header, 0, sightings);
  if (!packets.ok()) return packets.status();
  std::vector<size_t> order;
  for (const PlacedPacket& packet : *packets) order.push_back(packet.number);
  for (size_t i = order.size(); i < header.index.size(); ++i) order.push_back(i);
  return order;
}

uint64_t planBytes(const StreamHeader& header) {
  uint64_t tracks = 0;
  for (const TrackCount& count : trackCounts(header)) tracks += count.tracks;
  constexpr uint64_t kTrack = sizeof(Region) + 2 * sizeof(double) + 96;  // in a map
  constexpr uint64_t kPacket = 3 * (sizeof(PlacedPacket) + sizeof(RankedRange));
  return tracks * kTrack + header.index.size() * kPacket;
}

}  // namespace tetrakis::inline receiver

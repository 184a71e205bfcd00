// SPDX-License-Identifier: Apache-2.0
#include "receiver/fetch_plan.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <utility>

#include "base/length_unit.hpp"
#include "bitstream/track/regions.hpp"
#include "ground/frame.hpp"

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
  const GroundFrame frame = knownFrame({.spacing_x = m.spacing_x, .spacing_y = m.spacing_y});
  const double metres = metresPerUnit(m.unit).value_or(1);
  const double area = frame.spacing_x * frame.spacing_y;
  return {pixels, pixels / kSine * kCosine * kCosine / area * metres * metres};
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

/// Ground of absurd spacing costs nothing.
double finite(double cost) {
  return std::isfinite(cost) ? cost : 0;
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
        costs_[0].push_back(finite(costOfHeights(region)));
    }
    if (header.texture) {
      for (const Region& region : regionsIn(*header.texture))
        costs_[1].push_back(finite(costOfTexture(region)));
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

/// What helps more comes first; of what helps alike the greater slope.
bool helpsMore(const Worth& a, const Worth& b) {
  return a.all != b.all ? a.all > b.all : a.slope > b.slope;
}

/// All packets in the stream's order.
Result<std::vector<PlacedPacket>> placedPackets(const StreamHeader& header, uint64_t begin,
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
  return packets;
}

/// A part of a packet that is missing, or bytes between two of them that are there.
struct Piece {
  uint64_t begin = 0, end = 0;
  Worth worth;
  bool is_missing = true;

  uint64_t size() const { return end - begin; }
  bool helps() const { return worth.now > 0; }
};

/// In the stream's order, without a gap between them.
std::vector<Piece> piecesOf(std::span<const PlacedPacket> packets, const Missing& missing,
                            uint64_t end) {
  std::vector<Piece> pieces;
  for (const PlacedPacket& packet : packets) {
    for (const ByteRange& gap : missing(packet.begin, std::min(packet.end, end))) {
      if (gap.begin == gap.end) continue;
      if (!pieces.empty() && pieces.back().end < gap.begin)
        pieces.push_back({pieces.back().end, gap.begin, {}, false});
      pieces.push_back({gap.begin, gap.end, packet.worth, true});
    }
  }
  return pieces;
}

/// Numbers of the missing pieces, those first that help most.
std::vector<uint32_t> rankedPieces(std::span<const Piece> pieces) {
  std::vector<uint32_t> order;
  for (uint32_t i = 0; i < pieces.size(); ++i)
    if (pieces[i].is_missing) order.push_back(i);
  std::sort(order.begin(), order.end(), [&](uint32_t i, uint32_t j) {
    const Worth &a = pieces[i].worth, &b = pieces[j].worth;
    return helpsMore(a, b) || (!helpsMore(b, a) && i < j);
  });
  return order;
}

/// Bytes of each piece, from its begin on.
using Choice = std::vector<uint64_t>;

Choice chooseFirst(std::span<const Piece> pieces, std::span<const uint32_t> order, uint64_t bytes) {
  Choice chosen(pieces.size());
  for (const uint32_t i : order) {
    chosen[i] = std::min(bytes, pieces[i].size());
    bytes -= chosen[i];
  }
  return chosen;
}

/// The pieces that are worth most where a byte costs `price`, and each run of pieces as much as
/// `request` bytes. A run goes on over pieces that are worth less, or are there, where that is
/// cheaper than to begin another one. The best choice, by dynamic programming.
Choice chooseRuns(std::span<const Piece> pieces, double price, double request) {
  // What the best choice gains from the pieces so far, if the last one is in a run and if not.
  double in = -std::numeric_limits<double>::infinity(), out = 0;
  std::vector<bool> goes_on(pieces.size()), ends(pieces.size());
  for (size_t i = 0; i < pieces.size(); ++i) {
    const double begun = out - price * request, before = std::max(in, begun);
    goes_on[i] = in >= begun;
    ends[i] = in > out;
    out = std::max(out, in);
    in = before + (pieces[i].worth.all - price) * static_cast<double>(pieces[i].size());
  }
  Choice chosen(pieces.size());
  bool is_in = in > out;
  for (size_t i = pieces.size(); i-- > 0;) {
    if (is_in) chosen[i] = pieces[i].size();
    is_in = is_in ? goes_on[i] : ends[i];
  }
  return chosen;
}

uint64_t bytesOf(const Choice& choice) {
  return std::accumulate(choice.begin(), choice.end(), uint64_t{0});
}

/// Runs at the lowest price for which they have no more than so many bytes. Nothing where the first
/// packet alone has more.
Choice chooseRequests(std::span<const Piece> pieces, std::span<const uint32_t> order,
                      const FetchLimits& limits) {
  const auto request = static_cast<double>(limits.request_bytes);
  const auto priced = [&](size_t rank) {
    constexpr double kBelow = 0.999;  // the piece itself, and those like it, are worth more
    return chooseRuns(pieces, kBelow * pieces[order[rank]].worth.all, request);
  };
  // Of pieces that help nobody none is worth a request.
  size_t fitting = 0, count = order.size();
  while (count > 0 && !(pieces[order[count - 1]].worth.all > 0)) --count;
  Choice best(pieces.size());
  while (fitting < count) {
    const size_t rank = fitting + (count - fitting) / 2;
    Choice choice = priced(rank);
    if (bytesOf(choice) > limits.bytes) {
      count = rank;
      continue;
    }
    best = std::move(choice);
    fitting = rank + 1;
  }
  return best;
}

/// Where no run is worth its request: one from the most helpful piece on, which ends with one that
/// helps as well.
Choice chooseOne(std::span<const Piece> pieces, std::span<const uint32_t> order, uint64_t bytes) {
  Choice chosen(pieces.size());
  if (order.empty()) return chosen;
  size_t end = order[0];
  for (size_t i = order[0]; i < pieces.size() && bytes > 0; ++i) {
    chosen[i] = std::min(bytes, pieces[i].size());
    bytes -= chosen[i];
    if (pieces[i].is_missing && pieces[i].helps() == pieces[order[0]].helps()) end = i + 1;
  }
  std::fill(chosen.begin() + static_cast<ptrdiff_t>(end), chosen.end(), 0);
  return chosen;
}

/// Runs go on with what helps, up to so many bytes: no request is left over for the last ones.
void growRuns(std::span<const Piece> pieces, std::span<const uint32_t> order, uint64_t bytes,
              Choice& chosen) {
  uint64_t left = bytes - bytesOf(chosen);
  for (const uint32_t i : order) {
    const bool follows = i > 0 && chosen[i - 1] == pieces[i - 1].size();
    if (chosen[i] > 0 || !follows || !pieces[i].helps()) continue;
    chosen[i] = std::min(left, pieces[i].size());
    left -= chosen[i];
  }
}

/// Openings are worth more than any request costs, and yet finite, so that sums are.
void boundOpenings(std::vector<PlacedPacket>& packets, const FetchLimits& limits) {
  double most = std::numeric_limits<double>::min();
  for (const PlacedPacket& packet : packets)
    if (packet.worth.all < kOpening) most = std::max(most, packet.worth.all);
  const double opening = 2 * most * (static_cast<double>(limits.request_bytes) + 2);
  for (PlacedPacket& packet : packets)
    if (packet.worth.all == kOpening) packet.worth = {opening, opening, opening};
}

/// A range, and the best place among the pieces of the plan that are in it.
struct RankedRange {
  FetchRange range;
  uint32_t rank = 0;

  void join(const RankedRange& next) {
    range.end = next.range.end;
    range.gain = std::max(range.gain, next.range.gain);
    rank = std::min(rank, next.rank);
  }
};

/// Chosen pieces in the stream's order; neighbours are one, unless only one of them helps.
std::vector<RankedRange> stretches(std::span<const Piece> pieces, std::span<const uint32_t> order,
                                   const Choice& chosen) {
  std::vector<uint32_t> ranks(pieces.size(), static_cast<uint32_t>(pieces.size()));
  for (uint32_t rank = 0; rank < order.size(); ++rank) ranks[order[rank]] = rank;
  std::vector<RankedRange> found;
  for (size_t i = 0; i < pieces.size(); ++i) {
    if (chosen[i] == 0) continue;
    const uint64_t begin = pieces[i].begin;
    const RankedRange next{{begin, begin + chosen[i], pieces[i].worth.now}, ranks[i]};
    const bool touches = !found.empty() && found.back().range.end == begin;
    if (touches && (found.back().range.gain > 0) == pieces[i].helps())
      found.back().join(next);
    else
      found.push_back(next);
  }
  return found;
}

/// Ranges that help go on over bytes that do not, where a request costs more than these. The most
/// helpful come first.
std::vector<FetchRange> rangesOf(std::span<const Piece> pieces, std::span<const uint32_t> order,
                                 const Choice& chosen, const FetchLimits& limits) {
  std::vector<RankedRange> joined;
  const std::vector<RankedRange> found = stretches(pieces, order, chosen);
  for (size_t i = 0; i < found.size(); ++i) {
    joined.push_back(found[i]);
    while (joined.back().range.gain > 0 && i + 2 < found.size()) {
      const FetchRange &between = found[i + 1].range, &next = found[i + 2].range;
      const bool touch = joined.back().range.end == between.begin && between.end == next.begin;
      if (!touch || between.end - between.begin > limits.request_bytes) break;
      joined.back().join(found[i + 1]);
      joined.back().join(found[i + 2]);
      i += 2;
    }
  }
  std::vector<FetchRange> ranked(pieces.size() + 1);
  for (const RankedRange& r : joined) ranked[r.rank] = r.range;
  std::erase_if(ranked, [](const FetchRange& range) { return range.begin == range.end; });
  return ranked;
}

}  // namespace

Result<std::vector<FetchRange>> planFetch(const ParsedHeader& parsed,
                                          std::span<const WeightedSighting> sightings,
                                          const Missing& missing, const FetchLimits& limits) {
  const StreamHeader& header = parsed.header;
  const uint64_t end = parsed.bytes + header.payload_bytes;
  std::vector<PlacedPacket> packets = {{0, parsed.bytes, end, {1, 1, 1}}};
  if (!header.index.empty()) {
    auto placed = placedPackets(header, parsed.bytes, sightings);
    if (!placed.ok()) return placed.status();
    packets = std::move(*placed);
  }
  boundOpenings(packets, limits);
  const std::vector<Piece> pieces = piecesOf(packets, missing, end);
  const std::vector<uint32_t> order = rankedPieces(pieces);
  if (limits.request_bytes == 0)
    return rangesOf(pieces, order, chooseFirst(pieces, order, limits.bytes), limits);
  Choice chosen = chooseRequests(pieces, order, limits);
  if (bytesOf(chosen) == 0) chosen = chooseOne(pieces, order, limits.bytes);
  growRuns(pieces, order, limits.bytes, chosen);
  return rangesOf(pieces, order, chosen, limits);
}

Result<std::vector<size_t>> orderFor(const StreamHeader& header,
                                     std::span<const WeightedSighting> sightings) {
  auto packets = placedPackets(header, 0, sightings);
  if (!packets.ok()) return packets.status();
  std::stable_sort(packets->begin(), packets->end(),
                   [](const auto& a, const auto& b) { return helpsMore(a.worth, b.worth); });
  std::vector<size_t> order;
  for (const PlacedPacket& packet : *packets) order.push_back(packet.number);
  for (size_t i = order.size(); i < header.index.size(); ++i) order.push_back(i);
  return order;
}

uint64_t planBytes(const StreamHeader& header) {
  uint64_t tracks = 0;
  for (const TrackCount& count : trackCounts(header)) tracks += count.tracks;
  constexpr uint64_t kTrack = sizeof(Region) + 2 * sizeof(double) + 96;  // in a map
  constexpr uint64_t kPiece = sizeof(Piece) + 2 * sizeof(uint64_t) + 2 * sizeof(uint32_t) +
                              2 * sizeof(RankedRange) + sizeof(FetchRange);
  constexpr uint64_t kPacket = sizeof(PlacedPacket) + 4 * kPiece;  // what is there lies between
  return tracks * kTrack + header.index.size() * kPacket;
}

}  // namespace tetrakis::inline receiver

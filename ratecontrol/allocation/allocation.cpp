// SPDX-License-Identifier: Apache-2.0
#include "ratecontrol/allocation/allocation.hpp"

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace tetrakis::inline allocation {

namespace {

/// The squared error of one component while its packets are taken.
class FallingError {
 public:
  explicit FallingError(const ComponentCurve* curve) : curve_(curve) {}

  void take(const Packet& packet) { bytes_ += packet.length(); }

  double distortion() {
    if (curve_ == nullptr || curve_->points.empty()) return 0;
    const std::vector<RatePoint>& points = curve_->points;
    while (at_ + 1 < points.size() && points[at_ + 1].bytes <= bytes_) ++at_;
    const RatePoint& a = points[at_];
    if (at_ + 1 == points.size()) return a.distortion;
    const RatePoint& b = points[at_ + 1];
    const double rest =
        static_cast<double>(b.bytes - bytes_) / static_cast<double>(b.bytes - a.bytes);
    return b.distortion + (a.distortion - b.distortion) * rest;
  }

 private:
  const ComponentCurve* curve_;
  size_t at_ = 0;
  uint64_t bytes_ = 0;
};

/// Packets of one component that share a slope.
struct Pool {
  size_t first = 0, count = 0;
  double removed = 0, bytes = 0;

  double slope() const { return removed / bytes; }
};

/// Makes slopes fall along the packets, each as steep as possible: the concave hull of the removed
/// error (pool adjacent violators).
void settleSlopes(std::span<Packet* const> packets, const std::vector<double>& removed) {
  std::vector<Pool> pools;
  for (size_t i = 0; i < packets.size(); ++i) {
    Pool pool = {i, 1, removed[i], static_cast<double>(packets[i]->length())};
    while (!pools.empty() && pools.back().slope() <= pool.slope()) {
      const Pool& before = pools.back();
      pool = {before.first, before.count + pool.count, before.removed + pool.removed,
              before.bytes + pool.bytes};
      pools.pop_back();
    }
    pools.push_back(pool);
  }
  for (const Pool& pool : pools)
    for (Packet* const packet : packets.subspan(pool.first, pool.count))
      packet->slope = pool.slope();
}

}  // namespace

void stateSlopes(std::span<Packet> packets,
                 const std::array<const ComponentCurve*, kComponents>& curves,
                 const PairErrors* errors) {
  std::array<FallingError, kComponents> falling = {FallingError(curves[0]),
                                                   FallingError(curves[1])};
  const auto error = [&] {
    const double heights = falling[0].distortion(), texture = falling[1].distortion();
    if (errors == nullptr) return heights + texture;
    return errors->at(errors->heightsAt(heights), errors->textureAt(texture));
  };
  std::array<std::vector<Packet*>, kComponents> of;
  std::array<std::vector<double>, kComponents> removed;
  double before = error();
  for (Packet& packet : packets) {
    const auto component = static_cast<size_t>(packet.component);
    falling[component].take(packet);
    const double after = error();
    of[component].push_back(&packet);
    removed[component].push_back(std::max(0.0, before - after));
    before = after;
  }
  for (size_t i = 0; i < kComponents; ++i) settleSlopes(of[i], removed[i]);
}

namespace {

/// Steps of the stated quality, of 0.75 dB each, that joined packets may span. More of them save
/// bytes of heads, and state qualities of prefixes less exactly.
constexpr int kQualitySteps = 2;

/// Follows one component through the points of its curve.
class Progress {
 public:
  Progress(const ComponentCurve& curve, std::vector<PairErrors::Place> places)
      : curve_(curve), places_(std::move(places)), next_(curve.packets.begin()) {}

  bool done() const { return at_ + 1 >= curve_.points.size(); }
  const PairErrors::Place& place() const { return places_[worthFrom()]; }

  /// The steepest slope to the point 1, 2, 4, ... places further on; error: the error at a place.
  template <class Error>
  double slope(Error&& error) const {
    double steepest = -std::numeric_limits<double>::infinity();
    const size_t from = std::min(worthFrom(), curve_.points.size() - 2);
    const double now = error(places_[from]);
    for (size_t step = 1;; step *= 2) {
      const size_t to = std::min(from + step, curve_.points.size() - 1);
      const auto bytes = static_cast<double>(curve_.points[to].bytes - curve_.points[from].bytes);
      steepest = std::max(steepest, (now - error(places_[to])) / bytes);
      if (to + 1 == curve_.points.size()) return steepest;
    }
  }

  /// Takes the packets up to the next point.
  void advance(std::vector<Packet>& order) {
    const uint64_t end = curve_.points[++at_].bytes;
    for (; sent_ < end && next_ != curve_.packets.end(); ++next_) {
      sent_ += next_->length();
      order.push_back(*next_);
    }
    assert(sent_ == end);
  }

 private:
  /// The opening has the slope of the packets behind it, which need it.
  size_t worthFrom() const { return std::max(at_, curve_.opened); }

  const ComponentCurve& curve_;
  std::vector<PairErrors::Place> places_;  ///< of the points
  std::vector<Packet>::const_iterator next_;
  size_t at_ = 0;
  uint64_t sent_ = 0;
};

double meanSlope(const Packet& a, const Packet& b) {
  const auto bytes_a = static_cast<double>(a.length()), bytes_b = static_cast<double>(b.length());
  return (a.slope * bytes_a + b.slope * bytes_b) / (bytes_a + bytes_b);
}

}  // namespace

std::vector<Packet> allocate(const std::array<ComponentCurve, kComponents>& curves,
                             const PairErrors& errors) {
  std::vector<PairErrors::Place> heights, textures;
  for (const RatePoint& p : curves[0].points) heights.push_back(errors.heightsAt(p.distortion));
  for (const RatePoint& p : curves[1].points) textures.push_back(errors.textureAt(p.distortion));
  Progress geometry(curves[0], std::move(heights)), texture(curves[1], std::move(textures));
  std::vector<Packet> order;
  using Place = PairErrors::Place;
  while (!geometry.done() || !texture.done()) {
    bool take_geometry = texture.done();
    if (!geometry.done() && !texture.done()) {
      const double g =
          geometry.slope([&](const Place& place) { return errors.at(place, texture.place()); });
      const double t =
          texture.slope([&](const Place& place) { return errors.at(geometry.place(), place); });
      take_geometry = g >= t;
    }
    (take_geometry ? geometry : texture).advance(order);
  }
  return order;
}

std::vector<Packet> joinNeighbours(std::span<const Packet> packets) {
  std::vector<Packet> joined;
  // The qualities that each component states ahead of its last packet, and with it.
  std::array<int, kComponents> before = {511, 511}, stated = {511, 511};
  for (const Packet& packet : packets) {
    const auto component = static_cast<size_t>(packet.component);
    const bool same_track = !joined.empty() && joined.back().component == packet.component &&
                            joined.back().track == packet.track;
    if (same_track && !joined.back().whole && !packet.whole &&
        before[component] - packet.quality <= kQualitySteps) {
      Packet& last = joined.back();
      assert(last.end == packet.begin);
      last.slope = meanSlope(last, packet);
      last.end = packet.end;
      last.quality = packet.quality;
    } else {
      before[component] = stated[component];
      joined.push_back(packet);
    }
    stated[component] = packet.quality;
  }
  return joined;
}

}  // namespace tetrakis::inline allocation

// SPDX-License-Identifier: Apache-2.0
#include "ratecontrol/allocation/packet_slopes.hpp"

#include <algorithm>
#include <cstdint>
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

}  // namespace tetrakis::inline allocation

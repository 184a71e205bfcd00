// SPDX-License-Identifier: Apache-2.0
#include "codec/wavelet/choice/bridge_choice.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <utility>

#include "codec/wavelet/bridges.hpp"
#include "codec/wavelet/choice/bridge_fill.hpp"
#include "codec/wavelet/choice/compared_steps.hpp"
#include "codec/wavelet/choice/typical_plane.hpp"

namespace tetrakis::inline choice {

namespace {

/// The reaches that are tried. More of them find better bridges, and take the time of a transform
/// of the typical parts each.
constexpr std::array<uint8_t, 7> kReaches = {1, 2, 4, 8, 16, 64, kBridgeAll};
/// Bridges have to take this share of the bits: estimates are no better than that. A larger share
/// takes bridges that lose bytes, a smaller one misses some that gain.
constexpr double kClearly = 0.98;
/// The bits that preferred bridges may take over the best ones. A larger number gives more streams
/// late masks, at as many more bytes.
constexpr double kNearly = 1.01;
/// How many times the bits the target may take for the sake of prefixes. A larger number helps
/// prefixes, and costs the target bytes.
constexpr double kMostAtTarget = 1;
/// Bits of a bridge in the header.
constexpr double kBridgeBits = 8;
/// A reach is tried if it lifts one void more for this number of valid samples. A larger number
/// takes time for voids that save next to nothing.
constexpr size_t kFewestBridged = 1024;

CostAtStep costsOf(const TypicalPlane& plane) {
  return [&](double step) { return plane.cost(step); };
}

double stepOf(const TypicalPlane& plane, const BridgeTarget& target) {
  if (target.purpose == Purpose::kLossless) return 0;
  if (target.mean_square > 0) return std::sqrt(12 * target.mean_square);
  return plane.step(8 * static_cast<double>(target.bytes));
}

/// What bridges are held against, and the plane that they go over.
struct Unbridged {
  TypicalPlane plain;
  ComparedSteps steps;
  std::vector<int32_t> filled;

  Unbridged(const PlaneView<const int32_t>& plane, int bits, const BridgeTarget& target,
            const std::vector<uint8_t>& mask, size_t valid)
      : plain(plane, bits, target.purpose),
        steps(costsOf(plain), stepOf(plain, target), static_cast<double>(valid)),
        filled(bridged(plane, liftedSamples(mask, plane.extent(), target.most))) {}
};

/// A reach that does not lose, or that may be needed, and its share of the bits without bridges.
struct Tried {
  uint8_t reach;
  double ratio;
  bool pays;  ///< at the target, too
};

/// The first that is preferred of those that nearly come up to the best; else the best, if it
/// clearly pays. tried: the best first.
template <class Lift>
uint8_t chosenOf(std::span<const Tried> tried, const BridgeTarget& target, const Lift& lift) {
  if (tried.empty()) return 0;
  const double best = tried.front().ratio;
  for (const auto& [reach, ratio, pays] : tried) {
    const bool suits = target.needed || ratio <= kNearly * best;
    if (target.preferred && suits && target.preferred(lift(reach))) return reach;
  }
  return best < kClearly ? tried.front().reach : 0;
}

}  // namespace

BridgedPlane chooseBridges(const PlaneView<const int32_t>& plane, int bits,
                           const BridgeTarget& target) {
  const Extent extent = plane.extent();
  const size_t valid = markedIn(extent, plane.valid);
  if (valid == extent.samples() || valid == 0) return {};
  const std::vector<uint8_t> mask(plane.valid.bytes().begin(), plane.valid.bytes().end());
  const auto lift = [&](uint8_t reach) { return liftedSamples(mask, extent, reach); };
  std::optional<Unbridged> unbridged;  // as soon as there is anything to bridge
  std::vector<Tried> tried;
  size_t before = valid + valid / kFewestBridged;
  for (const uint8_t reach : kReaches) {
    if (reach > target.most) break;
    const std::vector<uint8_t> lifted = lift(reach);
    const size_t marked = markedIn(extent, lifted);
    if (marked <= before) continue;
    before = marked;
    if (!unbridged) unbridged.emplace(plane, bits, target, mask, valid);
    const ComparedSteps& steps = unbridged->steps;
    const TypicalPlane way({unbridged->filled, extent, lifted}, bits, target.purpose, plane.valid);
    const bool pays = steps.ratioAtTarget(costsOf(way), kBridgeBits) <= kMostAtTarget;
    if (!pays && !target.needed) continue;
    const double ratio = steps.ratio(costsOf(way), kBridgeBits);
    if (ratio < 1 || target.needed) tried.push_back({reach, ratio, pays});
  }
  std::stable_sort(tried.begin(), tried.end(), [](const Tried& a, const Tried& b) {
    return a.pays != b.pays ? a.pays : a.ratio < b.ratio;
  });
  const uint8_t reach = chosenOf(tried, target, lift);
  if (reach == 0) return {};
  return {reach, lift(reach), std::move(unbridged->filled)};
}

}  // namespace tetrakis::inline choice

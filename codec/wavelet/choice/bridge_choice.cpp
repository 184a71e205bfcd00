// SPDX-License-Identifier: Apache-2.0
#include "codec/wavelet/choice/bridge_choice.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <limits>
#include <optional>
#include <span>
#include <utility>

#include "codec/wavelet/choice/plane_cost.hpp"
#include "codec/wavelet/choice/typical_plane.hpp"
#include "codec/wavelet/morphology.hpp"

namespace tetrakis::inline choice {

// Voids get the means of coarser and coarser squares of the samples around, interpolated (pull and
// push: Gortler et al., The Lumigraph, SIGGRAPH 1996), and are then relaxed towards the surface of
// least curvature (Briggs, Machine contouring using minimum curvature, Geophysics 39, 1974), which
// leaves the smallest details where terrain is smooth.

namespace {

/// Sweeps that smooth the values at voids on each level. More of them make coefficients beside
/// voids smaller, and take time.
constexpr int kSweeps = 12;

/// A plane of which some values are known.
struct Known {
  Extent extent;
  std::vector<float> values;
  std::vector<uint8_t> known;
};

/// The means of the known values in squares of two by two.
Known pulled(const Known& fine) {
  const Extent extent = {(fine.extent.width + 1) / 2, (fine.extent.height + 1) / 2};
  Known coarse{extent, std::vector<float>(extent.samples()),
               std::vector<uint8_t>(extent.samples())};
  for (uint32_t y = 0; y < extent.height; ++y) {
    for (uint32_t x = 0; x < extent.width; ++x) {
      float sum = 0;
      int count = 0;
      for (uint32_t v = 2 * y; v < std::min(2 * y + 2, fine.extent.height); ++v) {
        for (uint32_t u = 2 * x; u < std::min(2 * x + 2, fine.extent.width); ++u) {
          const size_t i = size_t{v} * fine.extent.width + u;
          if (!fine.known[i]) continue;
          sum += fine.values[i];
          ++count;
        }
      }
      if (count == 0) continue;
      const size_t i = size_t{y} * extent.width + x;
      coarse.values[i] = sum / static_cast<float>(count);
      coarse.known[i] = 1;
    }
  }
  return coarse;
}

/// The squares that a sample lies between, and the share of the second.
struct Between {
  uint32_t first, second;
  float share;
};

Between betweenSquares(uint32_t sample, uint32_t squares) {
  const uint32_t near = sample / 2;
  const bool after = sample % 2 == 1;
  if (after) return {near, std::min(near + 1, squares - 1), 0.25F};
  return {near > 0 ? near - 1 : 0, near, 0.75F};
}

/// Fills what is not known from coarser means, all of which are.
void push(const Known& coarse, Known& fine) {
  const uint32_t width = coarse.extent.width;
  for (uint32_t y = 0; y < fine.extent.height; ++y) {
    const Between v = betweenSquares(y, coarse.extent.height);
    const float* const above = coarse.values.data() + size_t{v.first} * width;
    const float* const below = coarse.values.data() + size_t{v.second} * width;
    for (uint32_t x = 0; x < fine.extent.width; ++x) {
      const size_t i = size_t{y} * fine.extent.width + x;
      if (fine.known[i]) continue;
      const Between u = betweenSquares(x, width);
      const float top = std::lerp(above[u.first], above[u.second], u.share);
      const float bottom = std::lerp(below[u.first], below[u.second], u.share);
      fine.values[i] = std::lerp(top, bottom, v.share);
    }
  }
}

/// Fills all that is not known. At least one value is.
void pullAndPush(Known& plane) {
  if (std::find(plane.known.begin(), plane.known.end(), uint8_t{0}) == plane.known.end()) return;
  Known coarse = pulled(plane);
  pullAndPush(coarse);
  push(coarse, plane);
}

/// The value that makes the biharmonic operator of the plane 0 at a sample, if it has two samples
/// on each side; else the value that is there.
float relaxed(const Known& plane, size_t i) {
  const auto [width, height] = plane.extent;
  const size_t x = i % width, y = i / width;
  const float* const at = plane.values.data() + i;
  if (x < 2 || y < 2 || x + 2 >= width || y + 2 >= height) return *at;
  const auto row = static_cast<ptrdiff_t>(width);
  const float near = at[-1] + at[1] + at[-row] + at[row];
  const float diagonal = at[-row - 1] + at[-row + 1] + at[row - 1] + at[row + 1];
  const float far = at[-2] + at[2] + at[-2 * row] + at[2 * row];
  return (8 * near - 2 * diagonal - far) / 20;
}

Known knownOf(const PlaneView<const int32_t>& plane) {
  const std::span<const uint8_t> valid = plane.valid.bytes();
  Known known{plane.extent(), std::vector<float>(valid.size()), {valid.begin(), valid.end()}};
  for (size_t i = 0; i < valid.size(); ++i) {
    if (valid[i] != 0) known.values[i] = static_cast<float>(plane.data[i]);
  }
  return known;
}

/// Calls for each place of a mask that is marked, in order.
template <class Call>
void forEachMarked(const std::vector<uint8_t>& marks, const Call& call) {
  const uint8_t *const begin = marks.data(), *const end = begin + marks.size();
  const auto next = [&](const uint8_t* from) {
    return from == end
               ? nullptr
               : static_cast<const uint8_t*>(std::memchr(from, 1, static_cast<size_t>(end - from)));
  };
  for (const uint8_t* at = next(begin); at != nullptr; at = next(at + 1))
    call(static_cast<size_t>(at - begin));
}

}  // namespace

std::vector<int32_t> bridged(const PlaneView<const int32_t>& plane, Mask lifted) {
  assert(!plane.valid.all());
  std::vector<int32_t> filled(plane.values().begin(), plane.values().end());
  std::vector<uint8_t> bridges(filled.size());
  int32_t least = std::numeric_limits<int32_t>::max(), most = std::numeric_limits<int32_t>::min();
  for (size_t i = 0; i < filled.size(); ++i) {
    bridges[i] = lifted[i] && !plane.valid[i];
    if (!plane.valid[i]) continue;
    least = std::min(least, filled[i]);
    most = std::max(most, filled[i]);
  }
  if (least > most) return filled;  // nothing is valid
  Known smooth = knownOf(plane);
  pullAndPush(smooth);
  const auto lowest = static_cast<float>(least), highest = static_cast<float>(most);
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    forEachMarked(bridges, [&](size_t i) {
      smooth.values[i] = std::clamp(relaxed(smooth, i), lowest, highest);
    });
  }
  forEachMarked(bridges, [&](size_t i) {
    const auto value = static_cast<int32_t>(std::lround(smooth.values[i]));
    filled[i] = std::clamp(value, least, most);
  });
  return filled;
}

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

// SPDX-License-Identifier: Apache-2.0
// The library against the reference decoder (agreement.hpp): forests of many shapes.
#include <array>
#include <random>
#include <utility>

#include "base/forest.hpp"
#include "tests/conformance/agreement.hpp"

namespace tetrakis::test {
namespace {

using Sides = std::vector<uint32_t>;

/// Patches by their corners, from the north-west one on: sides between the same two are glued.
Sides glued(const std::vector<std::array<int, 4>>& corners) {
  const auto end = [&](size_t side, size_t after) {
    return corners[side / 4][(side % 4 + after) % 4];
  };
  Sides sides(4 * corners.size(), TKS_BORDER);
  for (uint32_t a = 0; a < sides.size(); ++a) {
    for (uint32_t b = 0; b < sides.size(); ++b)
      if (end(a, 0) == end(b, 1) && end(a, 1) == end(b, 0)) sides[a] = b;
  }
  return sides;
}

/// A cube, two squares that are an octahedron, a torus, four patches of a plane; the same with a
/// seam that is left open; a cylinder; sides beside one corner that are glued; five patches around
/// a corner.
const Sides kForests[] = {
    glued({{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}),
    {5, 4, 7, 6, 1, 0, 3, 2},
    {2, 3, 0, 1},
    glued({{0, 1, 4, 3}, {1, 2, 5, 4}, {7, 4, 5, 8}, {6, 3, 4, 7}}),
    glued({{0, 1, 4, 3}, {11, 2, 5, 4}, {7, 4, 5, 8}, {6, 3, 4, 7}}),
    {TKS_BORDER, 3, TKS_BORDER, 1},
    {3, TKS_BORDER, TKS_BORDER, 0},
    glued({{0, 1, 2, 3}, {4, 0, 3, 5}, {6, 7, 0, 4}, {8, 9, 7, 0}, {0, 8, 10, 1}})};

/// Any sides glued to any others.
Sides shuffled(uint32_t patches, uint32_t seed) {
  std::mt19937 random(seed);
  Sides order(size_t{4} * patches), sides(order.size(), TKS_BORDER);
  for (uint32_t i = 0; i < order.size(); ++i) order[i] = i;
  for (size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[random() % i]);
  const size_t borders = random() % 3;
  for (size_t i = 0; i + 1 + borders < order.size(); i += 2) {
    sides[order[i]] = order[i + 1];
    sides[order[i + 1]] = order[i];
  }
  return sides;
}

/// The raster of a pattern, of which patches have the samples that they share.
struct Surface {
  Forest forest;
  Raster raster;

  Surface(int depth, const Sides& sides, Pattern pattern, tks_sample sample = TKS_I16)
      : forest(depth, sides),
        raster(make({pattern, forest.raster().width, forest.raster().height, 1, sample, 3})) {
    forest.forEachShared(forest.side() - 1, [&](const auto& to, const auto& from) {
      const size_t size = tks_sample_bytes(sample);
      const auto at = [&](const auto& place) {
        return raster.data.data() +
               size * ((size_t{place.patch} * forest.side() + size_t(place.y)) * forest.side() +
                       size_t(place.x));
      };
      std::memcpy(at(to), at(from), size);
    });
  }
  Bytes encoded(const tks_encode_options& options) const {
    tks_heights heights = raster.heights();
    heights.domain = TKS_DOMAIN_FOREST;
    heights.forest = {static_cast<uint32_t>(forest.depth()), forest.patches(),
                      forest.sides().data()};
    return encodeHeights(heights, options);
  }
};

TEST(ReferenceForest, AgreesOnEveryByteOfSmallStreams) {
  for (const Sides& sides : kForests) {
    SCOPED_TRACE(&sides - kForests);
    const Surface surface(3, sides, Pattern::kRidges);
    for (const tks_encode_options& options : {lossless(), budget(200), within(9)}) {
      const Bytes stream = surface.encoded(options);
      expectAgreementOnPrefixes(stream, stream.size());
      if (HasFatalFailure()) return;
    }
  }
}

TEST(ReferenceForest, AgreesOnAllDepthsTypesAndTargets) {
  constexpr tks_sample kTypes[] = {TKS_U8, TKS_I16, TKS_I32, TKS_F32};
  for (const Sides& sides : kForests) {
    const auto shape = static_cast<size_t>(&sides - kForests);
    for (const int depth : {1, 2, 4, 5}) {
      const tks_sample sample = kTypes[(shape + static_cast<size_t>(depth)) % 4];
      SCOPED_TRACE(std::to_string(shape) + " depth " + std::to_string(depth));
      const Surface surface(depth, sides, Pattern::kRidges, sample);
      for (const tks_encode_options& options : {lossless(), budget(400), within(9)}) {
        expectAgreementOnPrefixes(surface.encoded(options), 4);
        if (HasFatalFailure()) return;
      }
    }
  }
}

TEST(ReferenceForest, AgreesOnAnySidesGluedToAnyOthers) {
  for (uint32_t seed = 0; seed < 30; ++seed) {
    SCOPED_TRACE(seed);
    for (const int depth : {2, 4}) {
      const Surface surface(depth, shuffled(1 + seed % 5, seed), Pattern::kExtreme, TKS_U8);
      for (const tks_encode_options& options : {lossless(), budget(300)}) {
        expectAgreementOnPrefixes(surface.encoded(options), 4);
        if (HasFatalFailure()) return;
      }
    }
  }
}

/// Any value in any byte of the header.
TEST(ReferenceForest, AgreesOnDamagedHeaders) {
  for (const Sides& sides : kForests) {
    const Bytes good = Surface(2, sides, Pattern::kRidges).encoded(within(3));
    const size_t header = static_cast<size_t>(Stream(good).info().header_bytes);
    for (size_t at = 0; at < header; ++at) {
      for (const int value : {0, 1, 2, 3, 4, 5, 6, 7, 127, 255, good[at] + 1, good[at] - 1}) {
        Bytes damaged = good;
        damaged[at] = static_cast<uint8_t>(value);
        sealHeader(damaged);
        SCOPED_TRACE("byte " + std::to_string(at) + " := " + std::to_string(value));
        expectAgreement(damaged);
        if (HasFatalFailure()) return;
      }
    }
  }
}

}  // namespace
}  // namespace tetrakis::test

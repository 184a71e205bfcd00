// SPDX-License-Identifier: Apache-2.0
// The library against the reference decoder (agreement.hpp): forests of many shapes.
#include <array>
#include <random>
#include <utility>

#include "base/forest.hpp"
#include "bitstream/stream/glue.hpp"
#include "conformance/reference_decoder/wavelet.hpp"
#include "conformance/samples/header_parts.hpp"
#include "tests/conformance/agreement.hpp"
#include "tests/support/forest_raster.hpp"

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

TEST(ReferenceForest, AgreesOnEveryByteOfSmallStreams) {
  for (const Sides& sides : kForests) {
    SCOPED_TRACE(&sides - kForests);
    const ForestRaster surface(Forest(2, sides), {Pattern::kRidges, 0, 0, 1, TKS_I16, 3});
    for (const tks_encode_options& options : {lossless(), budget(100), within(9)}) {
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
      const ForestRaster surface(Forest(depth, sides), {Pattern::kRidges, 0, 0, 1, sample, 3});
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
      const ForestRaster surface(Forest(depth, shuffled(1 + seed % 5, seed)),
                                 {Pattern::kExtreme, 0, 0, 1, TKS_U8, 3});
      for (const tks_encode_options& options : {lossless(), budget(300)}) {
        expectAgreementOnPrefixes(surface.encoded(options), 4);
        if (HasFatalFailure()) return;
      }
    }
  }
}

TEST(ReferenceForest, AgreesOnTextures) {
  for (const Sides& sides : kForests) {
    for (uint32_t channels = 1; channels <= 4; ++channels) {
      for (const Pattern pattern : {Pattern::kRidges, Pattern::kSteps}) {
        const tks_sample sample = channels == 2 ? TKS_U16 : TKS_U8;
        const ForestRaster surface(Forest(3, sides), {pattern, 0, 0, channels, sample, 8});
        for (const tks_encode_options& options : {lossless(), budget(400)})
          expectAgreementOnPrefixes(surface.encodedTexels(options), 8);
        if (HasFatalFailure()) return;
      }
    }
  }
}

/// A stream of one component on a grid that says that it is on a forest: codewords mean something
/// else then, but they are as sound as before.
Bytes onForest(const Bytes& stream, int depth, const Sides& sides) {
  HeaderParts component = componentOfStream(stream);
  Bytes& fields = component.fields;
  size_t end = kDomainByte + 2;
  for (int i = 0; i < 2; ++i) takeVarint(fields, end);
  Bytes domain = {2, static_cast<uint8_t>(depth)};
  putVarint(sides.size() / 4, domain);
  const std::string glue = encodeGlue(sides);
  putVarint(glue.size(), domain);
  domain.insert(domain.end(), glue.begin(), glue.end());
  const auto begin = fields.begin() + kDomainByte + 1;
  fields.insert(fields.erase(begin, fields.begin() + static_cast<ptrdiff_t>(end)), domain.begin(),
                domain.end());
  return withComponent(stream, component);
}

constexpr uint32_t kSide = 17, kPatches = 3;

void expectAgreementOnForests(const Bytes& stream) {
  for (uint32_t seed = 0; seed < 3; ++seed)
    expectAgreementOnPrefixes(onForest(stream, 4, shuffled(kPatches, seed)), 6);
}

TEST(ReferenceForest, AgreesOnHeightsOfGrids) {
  for (const Pattern pattern : kPatterns) {
    for (const tks_sample sample : {TKS_U8, TKS_I16, TKS_U32, TKS_F32}) {
      SCOPED_TRACE(std::to_string(static_cast<int>(pattern)) + " type " + std::to_string(sample));
      const Raster raster = make({pattern, kSide, kSide * kPatches, 1, sample, 5});
      for (const tks_encode_options& options : {lossless(), budget(300), within(5)})
        expectAgreementOnForests(encodeHeights(raster.heights(), options));
      if (HasFatalFailure()) return;
    }
  }
}

TEST(ReferenceForest, AgreesBesideVoids) {
  for (const samples::VoidShape shape : samples::kVoidShapes) {
    Raster raster = make({Pattern::kRidges, kSide, kSide * kPatches, 1, TKS_I16, 3});
    const auto valid = samples::validity(shape, raster.width, raster.height);
    for (size_t i = 0; i < valid.size(); ++i) {
      const int16_t nodata = 77;
      if (!valid[i]) std::memcpy(raster.data.data() + 2 * i, &nodata, sizeof nodata);
    }
    tks_heights heights = raster.heights();
    heights.has_nodata = 1;
    heights.nodata = 77;
    for (const tks_encode_options& options : {lossless(), within(500)})
      expectAgreementOnForests(encodeHeights(heights, options));
    if (HasFatalFailure()) return;
  }
}

/// With a late mask and a map of priorities, of any bytes; with each part alone that says more.
TEST(ReferenceForest, AgreesOnPartsThatNoEncoderWrites) {
  const Raster raster = make({Pattern::kRidges, kSide, kSide * kPatches, 1, TKS_F32, 5});
  const Bytes map = {4, 0x13, 0x57, 0x9b, 0xdf, 0x24, 0x68}, lines = {0x80, 0, 0};
  for (const tks_encode_options& options : {lossless(), budget(400), within(5)}) {
    const Bytes good = encodeHeights(raster.heights(), options);
    using Part = std::pair<uint64_t, Bytes>;
    const std::vector<std::vector<Part>> added = {{{2, map}},
                                                  {{3, {20}}, {5, {0, 30}}},
                                                  {{2, map}, {3, {9}}, {5, {0, 0}}},
                                                  {{3, {20}}, {5, {1, 30}}},
                                                  {{3, {20}}},
                                                  {{3, {20}}, {4, {3}}},
                                                  {{8, {5, 2}}},
                                                  {{1, lines}}};
    for (const std::vector<Part>& parts : added) {
      SCOPED_TRACE(&parts - added.data());
      HeaderParts component = componentOfStream(good);
      for (const auto& [kind, bytes] : parts) component.add(kind, bytes);
      expectAgreementOnForests(withComponent(good, component));
      if (HasFatalFailure()) return;
    }
  }
}

TEST(ReferenceForest, AgreesOnTexturesOfGrids) {
  for (const Pattern pattern : kPatterns) {
    for (uint32_t channels = 1; channels <= 4; ++channels) {
      SCOPED_TRACE(std::to_string(static_cast<int>(pattern)) + " channels " +
                   std::to_string(channels));
      Raster raster = make({pattern, kSide, kSide * kPatches, channels, TKS_U8, 5});
      for (const tks_encode_options& options : {lossless(), budget(700)})
        expectAgreementOnForests(encode(nullptr, &raster, options));
      if (channels % 2 == 1) continue;
      samples::cutOut(raster,
                      samples::validity(samples::VoidShape::kCoast, raster.width, raster.height));
      for (const tks_encode_options& options : {lossless(), budget(700)})
        expectAgreementOnForests(encode(nullptr, &raster, options));
      if (HasFatalFailure()) return;
    }
  }
}

/// Four patches of a plane are lifted as the plane is, at borders, across sides and at the corner,
/// on levels whose patches are larger than the filter reaches.
TEST(ReferenceForest, LiftsPatchesOfAPlaneAsThePlane) {
  constexpr int kDepth = 5, kWidth = (2 << kDepth) + 1, kPatch = (1 << kDepth) + 1;
  const std::vector<int> sides = {0, 7, 8, 3, 4, 5, 12, 1, 2, 15, 10, 11, 6, 13, 14, 9};
  for (const int filter : {0, 1, 3, 4}) {
    reference::WaveletHeader of_grid;
    of_grid.filters.fill(filter);
    of_grid.sampleBits = 16;
    reference::WaveletHeader of_forest = of_grid;
    of_forest.domain.forest = reference::Forest(kDepth, sides);
    reference::Plane grid{kWidth, kWidth, {}}, forest{kPatch, 4 * kPatch, {}};
    for (uint32_t i = 0; i < kWidth * kWidth; ++i)
      grid.values.push_back(int(samples::hash(i, 1, 7) % 4096) - 2048);
    const auto fromGrid = [&] {
      std::vector<int32_t> values;
      for (int i = 0; i < 4 * kPatch * kPatch; ++i) {
        const int patch = i / kPatch / kPatch, x = i % kPatch, y = i / kPatch % kPatch;
        values.push_back(grid.at(patch % 2 * (kPatch - 1) + x, patch / 2 * (kPatch - 1) + y));
      }
      return values;
    };
    forest.values = fromGrid();
    for (int level = 2; level >= 1; --level) {
      const int step = 1 << (level - 1);
      reference::synthesiseJointly(of_grid, {level, step, step}, grid);
      reference::synthesiseJointly(of_forest, {level, step, step}, forest);
      of_forest.domain.forest.share(forest.values);
      ASSERT_EQ(forest.values, fromGrid()) << "filter " << filter << ", level " << level;
    }
  }
}

/// Any value in any byte of the header.
TEST(ReferenceForest, AgreesOnDamagedHeaders) {
  for (const Sides& sides : kForests) {
    const Bytes good =
        ForestRaster(Forest(2, sides), {Pattern::kRidges, 0, 0, 1, TKS_I16, 3}).encoded(within(3));
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

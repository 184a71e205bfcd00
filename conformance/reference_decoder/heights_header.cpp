// SPDX-License-Identifier: Apache-2.0
// Reference decoder: what a header says of heights (docs/FORMAT.md, section 2).
#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "conformance/reference_decoder/parts.hpp"
#include "conformance/reference_decoder/regions.hpp"

namespace tetrakis::reference {
namespace {

/// Whether a value is an integer of the type.
bool holds(int sample, double value) {
  constexpr double kLeast[] = {0, -128, 0, -32768, 0, -2147483648.0};
  constexpr double kLargest[] = {255, 127, 65535, 32767, 4294967295.0, 2147483647};
  return value >= kLeast[sample] && value <= kLargest[sample] && value == std::floor(value);
}

/// FORMAT 2, Value table.
void readTable(Reader& in, Layers& layers) {
  constexpr int64_t kMostRise = 1 << 28;
  layers.tableBytes = in.varint(1, INT64_MAX);
  layers.tableValues = static_cast<uint32_t>(in.varint(2, 1 << 20));
  layers.tableAfter = in.varint(0, INT64_MAX);
  const int count = in.u8(0, 64);
  TableKnot knot;
  for (int i = 0; i < count; ++i) {
    const int64_t most = int64_t{layers.tableValues} - 1 - knot.place, least = i > 0 ? 1 : 0;
    if (most < least) in.fail(Outcome::kCorrupt);
    knot.place += static_cast<int64_t>(in.varint(least, std::max(least, most)));
    knot.rise += in.zigzag(2 * kMostRise);
    if (std::abs(knot.rise) > kMostRise) in.fail(Outcome::kCorrupt);
    layers.tableKnots.push_back(knot);
  }
}

/// FORMAT 2, Corrections.
void readCorrections(Reader& in, Layers& layers) {
  layers.corrections = in.u8(1, 4);
  const uint64_t least = std::max(layers.tableAfter, layers.validityAfter);
  layers.coefficientBytes = in.varint(least, INT64_MAX);
  if (layers.corrections == 1) layers.correctionStep = static_cast<uint32_t>(in.varint(1, 1 << 26));
  if (layers.corrections == 3) {
    layers.relativeStep = in.f64();
    layers.relativeQuarters = in.u8(1, 4);
    if (layers.relativeStep <= 0) in.fail(Outcome::kCorrupt);
  }
  if (layers.corrections == 4) layers.facetUnit = in.u8(1, 254);
}

/// FORMAT 2, Base mesh.
BaseMeshHeader readBaseMesh(Reader& in) {
  BaseMeshHeader mesh;
  mesh.bits = in.u8(1, 20);
  mesh.cell = in.f64();
  if (mesh.cell <= 0) in.fail(Outcome::kCorrupt);
  for (double& value : mesh.origin) value = in.f64();
  mesh.corners = restOf(in);
  return mesh;
}

/// FORMAT 8.1.2, "Masks of regions": whether the grid and the other tools allow them.
bool suitsRegionMasks(const GeometryHeader& geometry, const Layers& layers) {
  const Domain& domain = geometry.wavelet.domain;
  const int levels = 3 * groupsOf(geometry.width, geometry.height, geometry.regions.log2);
  const bool grid = domain.forest.isGrid() && !domain.ring();
  return grid && levels > 0 && std::min(geometry.width, geometry.height) > 2ll << levels &&
         geometry.frames.count == 0 && layers.bridge == 0 && !layers.lateMask &&
         layers.flatBytes == 0;
}

/// Whether such heights may have the layers.
bool suits(const GeometryHeader& geometry, const Layers& layers) {
  const bool integer = geometry.sample != kF32, direct = geometry.planes == kStoredPlanes;
  const bool table = layers.tableBytes > 0, ground = layers.bridge > 0 || layers.lateMask;
  if (layers.corrections == 4 && integer) return false;
  if (table && layers.corrections % 2 == 1) return false;
  if (table && layers.corrections == 4) return false;
  if (layers.bridge > 0 && layers.lateMask) return false;
  if (ground && layers.validityBytes == 0) return false;
  if (layers.flatBytes > 0 && uint64_t(geometry.width) * uint64_t(geometry.height) > 1u << 31)
    return false;
  if (hasTooManyTiles(geometry)) return false;
  if (layers.regionMasks && !suitsRegionMasks(geometry, layers)) return false;
  const bool all_lifted = layers.lateMask && layers.liftedBytes == 0;
  const bool holes = !direct && layers.validityBytes > 0 && !all_lifted;
  const auto& filters = geometry.wavelet.filters;
  const bool long_filter = std::any_of(std::begin(filters), std::end(filters),
                                       [](int filter) { return filter == 2 || filter == 5; });
  if (!geometry.wavelet.domain.forest.isGrid() &&
      (holes || layers.bridge > 0 || !suitsForest(geometry) ||
       (layers.flatBytes > 0 && long_filter)))
    return false;
  const bool others = layers.flatBytes > 0 || ground || geometry.regions.log2 > 0 ||
                      geometry.priorities.tileLog2 > 0;
  if (direct && (others || (layers.corrections != 0 && layers.corrections != 2))) return false;
  if (direct && !geometry.drawn && (table || layers.corrections > 0)) return false;
  if (integer && std::isinf(layers.nodata)) return false;
  return !integer || layers.validityBytes == 0 ||
         (layers.hasNodata && holds(geometry.sample, layers.nodata));
}

/// FORMAT 2, parts 3 to 9 of heights.
Layers readLayers(Parts& parts) {
  Layers layers;
  parts.take(3, [&](Reader& p) {
    layers.validityBytes = p.varint(1, INT64_MAX);
    if (!p.ends()) layers.regionMasks = p.u8(0, 1) == 1;
  });
  parts.take(4, [&](Reader& p) { layers.bridge = p.u8(1, 255); });
  layers.lateMask = parts.take(5, [&](Reader& p) {
    layers.liftedBytes = p.varint(0, INT64_MAX);
    layers.validityAfter = p.varint(0, INT64_MAX);
  });
  layers.hasNodata = parts.take(6, [&](Reader& p) { layers.nodata = p.f64(true); });
  parts.take(7, [&](Reader& p) { readTable(p, layers); });
  parts.take(8, [&](Reader& p) {
    layers.flatBytes = p.varint(1, INT64_MAX);
    layers.flatAreas = static_cast<uint32_t>(p.varint(1, 65535));
  });
  parts.take(9, [&](Reader& p) { readCorrections(p, layers); });
  return layers;
}

}  // namespace

/// FORMAT 2, Heights.
void readHeights(Reader& in, const Domain& domain, RegionHeader regions, Stream& stream) {
  GeometryHeader& g = stream.geometry.emplace();
  g.width = domain.width;
  g.height = domain.height;
  g.regions = regions;
  g.sample = in.u8(0, 6);
  const int coding = in.u8(0, 2);
  g.base = in.f64();
  g.step = in.f64();
  if (g.step <= 0) in.fail(Outcome::kCorrupt);
  g.drawn = coding == 1;
  readWavelet(in, coding, g);
  Parts parts(in);
  readCoding(parts, g);
  stream.layers = readLayers(parts);
  parts.take(10, [&](Reader& p) { g.baseMesh = readBaseMesh(p); });
  parts.take(11, [&](Reader& p) { g.frames = readFrames(p, true); });
  parts.take(12, [&](Reader& p) { g.frames.reference = p.varint(1, INT64_MAX / 2); });
  parts.take(64, [](Reader& p) {
    p.u8(0, 1);              // exact
    if (!p.ends()) p.f64();  // max_error
  });
  parts.end();
  g.wavelet.domain = domain;
  const Forest& forest = domain.forest;
  if (g.baseMesh.bits > 0 && (forest.isGrid() || forest.depth() > 8)) stream.suits = false;
  if (!suits(g, stream.layers)) stream.suits = false;
  const Layers& layers = stream.layers;
  const bool others =
      layers.lateMask || layers.tableBytes > 0 || layers.flatBytes > 0 || layers.corrections > 0;
  if (g.frames.count > 0 && (others || !suitsFrames(g))) stream.suits = false;
  if (!g.frames.suits()) stream.suits = false;
}

FramesHeader readFrames(Reader& in, bool scaled) {
  FramesHeader frames;
  frames.count = in.u8(1, 32);
  frames.filter = in.u8(0, 2);
  if (!scaled || in.ends()) return frames;
  for (int t = 0; t < frames.count; ++t) {
    FrameScale& scale = frames.scales.emplace_back();
    scale.offset = in.zigzag(1 << 26);
    scale.shift = in.u8(0, 24);
  }
  return frames;
}

}  // namespace tetrakis::reference

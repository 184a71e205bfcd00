// SPDX-License-Identifier: Apache-2.0
#include "apps/tools/synth/surfaces/synth_surface.hpp"

#include <algorithm>
#include <cassert>
#include <unordered_map>

#include "apps/tools/synth/surfaces/atlas.hpp"
#include "apps/tools/synth/surfaces/shape.hpp"

namespace tetrakis::tools {
namespace {

TriangleMesh shapeOf(const SynthSurfaceOptions& options) {
  switch (options.kind) {
    case SynthSurfaceKind::kBlob:
      return synth::blob(options.triangles, options.seed);
    case SynthSurfaceKind::kKnot:
      return synth::knot(options.triangles, options.seed);
    case SynthSurfaceKind::kScan:
      break;
  }
  return synth::scan(options.triangles, options.seed);
}

/// A vertex for each chart that meets a point.
MeshFile meshOf(const TriangleMesh& shape, const synth::Atlas& atlas) {
  MeshFile mesh;
  std::unordered_map<uint64_t, uint32_t> numbers;
  for (size_t i = 0; i < shape.triangles.size(); ++i) {
    for (size_t k = 0; k < 3; ++k) {
      const uint32_t point = shape.triangles[i][k];
      const auto [found, is_new] = numbers.try_emplace(uint64_t{point} << 32 | atlas.charts[i],
                                                       static_cast<uint32_t>(numbers.size()));
      mesh.triangles.push_back(found->second);
      if (!is_new) continue;
      for (const double axis : shape.points[point])
        mesh.positions.push_back(static_cast<float>(axis));
      for (const double axis : atlas.places[3 * i + k])
        mesh.texcoords.push_back(static_cast<float>(axis));
    }
  }
  return mesh;
}

/// A power of two with some texels to a triangle.
uint32_t textureSide(size_t triangles) {
  constexpr uint32_t kLeast = 64, kMost = 4096, kTexels = 16;
  uint32_t side = kLeast;
  while (side < kMost && uint64_t{side} * side < kTexels * triangles) side *= 2;
  return side;
}

}  // namespace

SynthSurface synthesizeSurface(const SynthSurfaceOptions& options) {
  assert(options.triangles >= 20);
  constexpr synth::ChartLimits kWide{0.5, ~size_t{0}};
  constexpr double kScanCosine = 0.7;
  constexpr size_t kScanCharts = 80;
  const TriangleMesh shape = shapeOf(options);
  const bool is_scan = options.kind == SynthSurfaceKind::kScan;
  const synth::ChartLimits limits =
      is_scan ? synth::ChartLimits{kScanCosine, shape.triangles.size() / kScanCharts + 1} : kWide;
  const synth::Atlas atlas = synth::unwrap(shape, limits);
  return {meshOf(shape, atlas),
          synth::paint(shape, atlas, textureSide(shape.triangles.size()), options.seed)};
}

}  // namespace tetrakis::tools

// SPDX-License-Identifier: Apache-2.0
// Meshes round a globe through the C interface.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "api/globe.hpp"
#include "api/guarded.hpp"
#include "api/memory.hpp"
#include "api/written.hpp"
#include "base/coordinates.hpp"
#include "codec/cube/cube_sphere.hpp"
#include "codec/mesh/globe/bends.hpp"
#include "codec/mesh/globe/globe_mesh.hpp"
#include "codec/mesh/globe/globe_places.hpp"

namespace tetrakis::inline api {

Result<tks_globe> takeGlobe(const tks_globe* given) {
  if (given == nullptr) return Status(TKS_USAGE, "The globe is missing.");
  tks_globe globe{};
  const Status status = takeSized("the globe", *given, offsetof(tks_globe, degrees), globe);
  if (!status.ok()) return status;
  if (globe.degrees == 0) globe.degrees = 1;
  if (globe.exaggeration == 0) globe.exaggeration = 1;
  const auto length = [](double axis) { return std::isfinite(axis) && axis > 0; };
  if (!length(globe.semi_major) || !length(globe.semi_minor))
    return Status(TKS_USAGE, "The axes of a globe are above 0.");
  if (!std::isfinite(globe.degrees) || !std::isfinite(globe.exaggeration))
    return Status(TKS_USAGE, "A number of the globe is not finite.");
  return globe;
}

Result<GlobePlaces> placesOn(const tks_globe& globe, const std::string& what,
                             const Placement& place, Extent grid) {
  const GeoTransform& t = place.transform;
  const ColumnsRound round = place.has_transform
                                 ? columnsRound({grid.width, grid.height, t.data()}, globe.degrees)
                                 : ColumnsRound::kNo;
  if (round != ColumnsRound::kOnce || !(std::abs(t[5]) > 0))
    return Status(TKS_USAGE, "The columns of " + what + " do not go once round a globe.");
  // A geotransform is that of the outer corners of samples.
  const GlobeAxis longitudes{(t[0] + 0.5 * t[1]) * globe.degrees, t[1] * globe.degrees, grid.width};
  const GlobeAxis latitudes{(t[3] + 0.5 * t[5]) * globe.degrees, t[5] * globe.degrees, grid.height};
  GlobePlaces places(longitudes, latitudes, spheroidOf(globe));
  if (!places.onGlobe()) return Status(TKS_USAGE, "Rows of " + what + " lie beyond a pole.");
  return places;
}

double metresPerHeight(const tks_globe& globe, const StreamHeader& header) {
  return metresPerUnit(header.metadata.unit).value_or(1) * globe.exaggeration;
}

Status checkCube(const Forest& forest) {
  if (std::equal(forest.sides().begin(), forest.sides().end(), kCubeSides.begin(),
                 kCubeSides.end()))
    return {};
  return {TKS_USAGE, "The patches of the heights are not those of a globe on a cube."};
}

namespace {

class GlobeCall {
 public:
  GlobeCall(tks_decoder& decoder, tks_mesh_kind kind, uint32_t max_triangles)
      : decoder_(decoder), kind_(kind), max_triangles_(max_triangles) {}

  Status run(const tks_globe* given, tks_globe_mesh& out) {
    const StreamHeader& header = decoder_.parsed.header;
    if (!header.geometry) return noHeights();
    const Result<tks_globe> globe = takeGlobe(given);
    if (!globe.ok()) return globe.status();
    if (header.geometry->wavelet.forest != nullptr) return runOnCube(*globe, out);
    const Result<GlobePlaces> places =
        placesOn(*globe, "the heights", header.georeference.heights, header.geometry->shown());
    if (!places.ok()) return places.status();
    const std::vector<float> areas = places->rowAreas();
    Result<SurfaceMesh> surface = surfaceMesh(decoder_, kind_, max_triangles_, areas);
    if (!surface.ok()) return surface.status();
    if (Status status = checkSize(*surface); !status.ok()) return status;
    if (Status status = bend(*surface); !status.ok()) return status;
    GlobeMesh mesh = closedRound(surface->mesh, surface->heights, places->grid());
    if (places->mirrored())
      for (size_t t = 0; t < mesh.triangles.size(); t += 3)
        std::swap(mesh.triangles[t + 1], mesh.triangles[t + 2]);
    const double metres = metresPerHeight(*globe, header);
    give(mesh.heights, mesh.triangles, out, [&](size_t v) {
      const GridPlace& place = mesh.places[v];
      return GlobeVertex{places->at(place, mesh.heights[v] * metres), place.column, place.row};
    });
    return {};
  }

 private:
  /// The mesh of a cube, patch by patch. A vertex on a side lies where its sample's owner lies.
  Status runOnCube(const tks_globe& globe, tks_globe_mesh& out) {
    const Forest& forest = *decoder_.parsed.header.geometry->wavelet.forest;
    if (Status status = checkCube(forest); !status.ok()) return status;
    const bool budget = kind_ == TKS_MESH_BUDGET;
    const auto depth = static_cast<uint32_t>(forest.depth());
    const uint32_t level = cubeBendLevel(depth, budget ? max_triangles_ : 0);
    const uint64_t bends = uint64_t{kCubePatches} << level;
    constexpr uint64_t kVertex = 160;
    const uint64_t chosen = budget && max_triangles_ > 0
                                ? std::min<uint64_t>(max_triangles_, forest.raster().samples())
                                : forest.raster().samples();
    const Result<ForestSurface> surface =
        forestSurface(decoder_, {kind_, max_triangles_, level, true}, kVertex * (bends + chosen));
    if (!surface.ok()) return surface.status();
    const double metres = metresPerHeight(globe, decoder_.parsed.header);
    const CubeSpheroid cube(forest, spheroidOf(globe));
    give(surface->heights, surface->mesh.triangles, out, [&](size_t v) {
      const uint32_t sample = surface->mesh.vertices[v], side = forest.side();
      return GlobeVertex{cube.at(sample, surface->heights[v] * metres),
                         static_cast<double>(sample % side), static_cast<double>(sample / side)};
    });
    return {};
  }

  /// With the vertices of coarse levels, which are few beside the triangles that are asked for.
  Status checkSize(const SurfaceMesh& surface) const {
    constexpr uint64_t kVertex = 240;
    const uint64_t bends = surface.lattice.firstOf(levelOf(surface));
    const tks_part part = kind_ == TKS_MESH_CODED ? TKS_PART_CODED_MESH : TKS_PART_BUDGET_MESH;
    return checkBytes(decoder_, {part, {}, max_triangles_},
                      kOnceBytes + kVertex * (surface.mesh.vertices.size() + bends));
  }

  uint32_t levelOf(const SurfaceMesh& surface) const {
    return bendLevel(surface.lattice, kind_ == TKS_MESH_BUDGET ? max_triangles_ : 0);
  }

  Status bend(SurfaceMesh& surface) {
    Mask valid;
    if (decoder_.parsed.header.layers.validity_bytes > 0) {
      const Result<const DecodedGeometry*> geometry = decodedGeometry(decoder_);
      if (!geometry.ok()) return geometry.status();
      valid = (*geometry)->valid;
    }
    addBends(surface.lattice, surface.inserted, levelOf(surface), valid, surface.mesh,
             surface.heights);
    return {};
  }

  struct GlobeVertex {
    std::array<double, 3> position;
    double column, row;
  };

  /// vertex(v): where it lies.
  template <class Vertex>
  static void give(std::span<const float> heights, std::span<const uint32_t> triangles,
                   tks_globe_mesh& out, const Vertex& vertex) {
    out.vertex_count = static_cast<uint32_t>(heights.size());
    out.triangle_count = static_cast<uint32_t>(triangles.size() / 3);
    out.position = allocate<double>(3 * heights.size());
    out.pixel = allocate<double>(2 * heights.size());
    out.height = allocate<float>(heights.size());
    out.triangles = allocate<uint32_t>(triangles.size());
    for (size_t v = 0; v < heights.size(); ++v) {
      const GlobeVertex at = vertex(v);
      std::copy(at.position.begin(), at.position.end(), out.position + 3 * v);
      out.pixel[2 * v] = at.column + 0.5;
      out.pixel[2 * v + 1] = at.row + 0.5;
    }
    std::copy(heights.begin(), heights.end(), out.height);
    std::copy(triangles.begin(), triangles.end(), out.triangles);
  }

  tks_decoder& decoder_;
  tks_mesh_kind kind_;
  uint32_t max_triangles_;
};

}  // namespace
}  // namespace tetrakis::inline api

tks_status tks_decode_globe(tks_decoder* decoder, tks_mesh_kind kind, uint32_t max_triangles,
                            const tks_globe* globe, tks_globe_mesh* out) {
  if (out == nullptr) return tetrakis::keeping(decoder, tetrakis::outputMissing);
  if (decoder == nullptr) return TKS_USAGE;
  *out = {};
  const tks_status status = tetrakis::keeping(
      decoder, [&] { return tetrakis::GlobeCall(*decoder, kind, max_triangles).run(globe, *out); });
  if (status != TKS_OK) tks_free_globe_mesh(out);
  return status;
}

void tks_free_globe_mesh(tks_globe_mesh* mesh) {
  if (mesh == nullptr) return;
  std::free(mesh->position);
  std::free(mesh->pixel);
  std::free(mesh->height);
  std::free(mesh->triangles);
  *mesh = {};
}

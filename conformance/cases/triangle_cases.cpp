// SPDX-License-Identifier: Apache-2.0
// Objects whose triangles are coded as they are.
#include <array>

#include "codec/remesh/half_edges.hpp"
#include "codec/trianglemesh/triangle_encoder.hpp"
#include "conformance/cases/cases.hpp"
#include "conformance/cases/crafted_streams.hpp"

namespace tetrakis::conformance {
namespace {

/// Points and triangles, with three places on a texture for each triangle or none.
struct Mesh {
  std::vector<Point> points;
  std::vector<Triangle> triangles;
  std::vector<std::array<std::array<float, 2>, 3>> texcoords;

  TriangleMeshHeader encoded(uint32_t places, uint8_t texcoord_fraction = 0) const {
    return TriangleEncoder({points, triangles, gluedSides(triangles).opposite, texcoords},
                           texcoord_fraction)
        .encode(places);
  }
};

/// `across` times `along` squares, each of two triangles, whose columns go round and whose rows go
/// round or end. columns: of points; those behind the last one are those from the first one on.
Mesh tube(uint32_t across, uint32_t along, bool closed) {
  Mesh mesh;
  const uint32_t rows = closed ? along : along + 1;
  for (uint32_t y = 0; y < rows; ++y) {
    for (uint32_t x = 0; x < across; ++x) {
      constexpr double kRound[4][2] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};  // no trigonometry
      const auto at = [&](uint32_t i, uint32_t of, size_t axis) {
        const uint32_t quarter = 4 * i / of;
        const double part = 4.0 * i / of - quarter;
        return (1 - part) * kRound[quarter][axis] + part * kRound[(quarter + 1) % 4][axis];
      };
      const double radius = 70 + 31 * at(x, across, 0);
      mesh.points.push_back(
          {radius * at(y, rows, 0) - 1000, radius * at(y, rows, 1) + 0.25, 31 * at(x, across, 1)});
    }
  }
  for (uint32_t y = 0; y < along; ++y) {
    for (uint32_t x = 0; x < across; ++x) {
      const auto point = [&](uint32_t i, uint32_t j) {
        return (y + j) % rows * across + (x + i) % across;
      };
      const auto texcoord = [&](uint32_t i, uint32_t j) {
        return std::array{static_cast<float>(x + i) / 4, static_cast<float>(y + j) / 8};
      };
      mesh.triangles.push_back({point(0, 0), point(1, 0), point(1, 1)});
      mesh.texcoords.push_back({texcoord(0, 0), texcoord(1, 0), texcoord(1, 1)});
      mesh.triangles.push_back({point(0, 0), point(1, 1), point(0, 1)});
      mesh.texcoords.push_back({texcoord(0, 0), texcoord(1, 1), texcoord(0, 1)});
    }
  }
  return mesh;
}

VectorCase plainCase() {
  Mesh mesh = tube(9, 8, true);
  mesh.texcoords.clear();
  StreamHeader header;
  header.triangle_mesh = mesh.encoded(1 << 11);
  header.metadata.unit = "mm";
  header.georeference.description = "a ring";
  return crafted("triangles_144", "triangles as they are, with a hole and no texture",
                 writeHeader(header));
}

/// One that is beside the other, mirrored on the texture, and of a single triangle.
VectorCase paintedCase() {
  Mesh mesh = tube(8, 5, false);
  for (size_t t = 0; t < 30; ++t)
    for (auto& texcoord : mesh.texcoords[t]) texcoord[0] = 1 - texcoord[0];
  const auto first = static_cast<uint32_t>(mesh.points.size());
  mesh.points.insert(mesh.points.end(), {{0, 0, 0}, {200, 1, 2}, {3, 150, -4}});
  mesh.triangles.push_back({first, first + 1, first + 2});
  mesh.texcoords.push_back({{{-3.5f, 0.25f}, {2.5f, 0.25f}, {0.5f, 17}}});
  StreamHeader header = textureHeader(20, 16, 3, TKS_U8, 8);
  header.triangle_mesh = mesh.encoded(1 << 9, 7);
  return crafted("triangles_textured_81", "triangles, open and in two pieces, under a texture",
                 streamOf(header, noise(90, 241)));
}

/// The finest grid, and the shortest mesh.
VectorCase oneCase() {
  Mesh mesh{{{1e6, -2e6, 3e6}, {1e6 + 1, -2e6, 3e6}, {1e6, -2e6, 3e6 + 0.5}}, {{0, 1, 2}}, {}};
  StreamHeader header;
  header.triangle_mesh = mesh.encoded(1 << 20);
  return crafted("triangles_1", "one triangle on the finest grid", writeHeader(header));
}

VectorCase unsoundCase() {
  StreamHeader header = textureHeader(9, 9, 1, TKS_U8, 8);
  const Bytes code = noise(200, 242);
  header.triangle_mesh = {50, 12, 0.5, {1, -2, 3}, 10, 10, {0, 0}, {code.begin(), code.end()}};
  return crafted("triangles_unsound_50", "a codeword that is not one of triangles",
                 streamOf(header, noise(60, 243)));
}

}  // namespace

std::vector<VectorCase> triangleCases() {
  return {plainCase(), paintedCase(), oneCase(), unsoundCase()};
}

}  // namespace tetrakis::conformance

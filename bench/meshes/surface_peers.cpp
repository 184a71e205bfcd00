// SPDX-License-Identifier: Apache-2.0
#include "bench/meshes/surface_peers.hpp"

#include <draco/compression/decode.h>
#include <draco/compression/encode.h>
#include <draco/mesh/mesh.h>
#include <meshoptimizer.h>

#include <algorithm>
#include <array>
#include <cfloat>
#include <cmath>
#include <memory>
#include <utility>

#include "codec/remesh/mesh_distance.hpp"

namespace tetrakis::bench {
namespace {

using draco::GeometryAttribute;

constexpr uint32_t kFewest = 250, kMost = 120000;        ///< triangles
constexpr uint32_t kCoarsestBits = 8, kFinestBits = 12;  ///< of positions

std::vector<std::array<float, 3>> floatsOf(const TriangleMesh& mesh) {
  std::vector<std::array<float, 3>> points;
  for (const Point& p : mesh.points)
    points.push_back(
        {static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2])});
  return points;
}

/// Numbers of points of the simplified mesh; whatever error that makes.
std::vector<uint32_t> simplified(const TriangleMesh& mesh,
                                 const std::vector<std::array<float, 3>>& points, uint32_t budget) {
  std::vector<uint32_t> corners;
  for (const Triangle& t : mesh.triangles) corners.insert(corners.end(), t.begin(), t.end());
  if (budget >= mesh.triangles.size()) return corners;
  std::vector<uint32_t> fewer(corners.size());
  fewer.resize(meshopt_simplify(fewer.data(), corners.data(), corners.size(), points[0].data(),
                                points.size(), sizeof points[0], size_t{3} * budget, FLT_MAX));
  return fewer;
}

/// With the points that triangles name.
std::unique_ptr<draco::Mesh> dracoMesh(const std::vector<std::array<float, 3>>& points,
                                       const std::vector<uint32_t>& corners) {
  std::vector<uint32_t> numbers(points.size(), UINT32_MAX), used;
  for (const uint32_t corner : corners) {
    if (numbers[corner] != UINT32_MAX) continue;
    numbers[corner] = static_cast<uint32_t>(used.size());
    used.push_back(corner);
  }
  auto mesh = std::make_unique<draco::Mesh>();
  mesh->set_num_points(static_cast<uint32_t>(used.size()));
  GeometryAttribute attribute;
  attribute.Init(GeometryAttribute::POSITION, nullptr, 3, draco::DT_FLOAT32, false,
                 sizeof points[0], 0);
  const int id = mesh->AddAttribute(attribute, true, mesh->num_points());
  for (uint32_t i = 0; i < used.size(); ++i)
    mesh->attribute(id)->SetAttributeValue(draco::AttributeValueIndex(i), points[used[i]].data());
  for (size_t i = 0; i < corners.size(); i += 3)
    mesh->AddFace({draco::PointIndex(numbers[corners[i]]),
                   draco::PointIndex(numbers[corners[i + 1]]),
                   draco::PointIndex(numbers[corners[i + 2]])});
  return mesh;
}

Result<TriangleMesh> decoded(const draco::EncoderBuffer& coded) {
  draco::DecoderBuffer buffer;
  buffer.Init(coded.data(), coded.size());
  draco::Decoder decoder;
  auto result = decoder.DecodeMeshFromBuffer(&buffer);
  if (!result.ok()) return Status(TKS_MISMATCH, result.status().error_msg_string());
  const draco::Mesh& mesh = *result.value();
  const auto* positions = mesh.GetNamedAttribute(GeometryAttribute::POSITION);
  TriangleMesh out;
  for (draco::PointIndex i(0); i < mesh.num_points(); ++i) {
    std::array<float, 3> value{};
    positions->GetMappedValue(i, value.data());
    out.points.push_back({value[0], value[1], value[2]});
  }
  for (draco::FaceIndex f(0); f < mesh.num_faces(); ++f) {
    const auto& face = mesh.face(f);
    out.triangles.push_back({face[0].value(), face[1].value(), face[2].value()});
  }
  return out;
}

/// A mesh to measure others against.
struct Original {
  TriangleTree tree;
  double diagonal;
};

Result<PeerCoding> codeDraco(const Original& original, const draco::Mesh& mesh, uint32_t bits) {
  constexpr double kUnit = 1e-4;
  draco::Encoder encoder;
  encoder.SetSpeedOptions(0, 0);
  encoder.SetEncodingMethod(draco::MESH_EDGEBREAKER_ENCODING);
  encoder.SetAttributeQuantization(GeometryAttribute::POSITION, static_cast<int>(bits));
  draco::EncoderBuffer buffer;
  const draco::Status status = encoder.EncodeMeshToBuffer(mesh, &buffer);
  if (!status.ok()) return Status(TKS_MISMATCH, status.error_msg_string());
  const Result<TriangleMesh> received = decoded(buffer);
  if (!received.ok()) return received.status();
  const TriangleTree tree(*received);
  const MeshDistance distance = meshDistance(original.tree, tree);
  return PeerCoding{
      mesh.num_faces(),
      bits,
      {distance.error / original.diagonal / kUnit, static_cast<double>(buffer.size())}};
}

/// From the most triangles down.
std::vector<uint32_t> budgetsOf(const TriangleMesh& mesh, uint32_t sizes) {
  const auto all = static_cast<uint32_t>(mesh.triangles.size());
  const double most = std::min(all, kMost), fewest = std::min(all, kFewest);
  std::vector<uint32_t> budgets;
  for (uint32_t i = 0; i < sizes; ++i) {
    const double share = sizes > 1 ? double{1} * i / (sizes - 1) : 0;
    budgets.push_back(static_cast<uint32_t>(most * std::pow(fewest / most, share)));
  }
  budgets.erase(std::unique(budgets.begin(), budgets.end()), budgets.end());
  return budgets;
}

}  // namespace

Result<std::vector<PeerCoding>> surfacePeers(const TriangleMesh& mesh, uint32_t sizes) {
  const Original original{TriangleTree(mesh), diagonal(mesh)};
  const std::vector<std::array<float, 3>> points = floatsOf(mesh);
  std::vector<PeerCoding> codings;
  for (const uint32_t budget : budgetsOf(mesh, sizes)) {
    const auto simple = dracoMesh(points, simplified(mesh, points, budget));
    for (uint32_t bits = kCoarsestBits; bits <= kFinestBits; ++bits) {
      Result<PeerCoding> coding = codeDraco(original, *simple, bits);
      if (!coding.ok()) return coding.status();
      codings.push_back(std::move(*coding));
    }
  }
  return codings;
}

}  // namespace tetrakis::bench

// SPDX-License-Identifier: Apache-2.0
#include "bench/meshes/surface_peers.hpp"

#include <draco/compression/decode.h>
#include <draco/compression/encode.h>
#include <draco/mesh/mesh.h>

#include <array>
#include <map>
#include <memory>
#include <utility>

namespace tetrakis::bench {
namespace {

using draco::GeometryAttribute;

/// Of positions: the finer ones are for the small errors that go with a texture.
constexpr uint32_t kCoarsestBits = 8, kFinestBits = 12, kMoreBits = 2;
constexpr int kTexcoordBits = 11;

template <size_t N>
void addAttribute(draco::Mesh& mesh, GeometryAttribute::Type type,
                  const std::vector<std::array<float, N>>& values) {
  GeometryAttribute attribute;
  attribute.Init(type, nullptr, N, draco::DT_FLOAT32, false, sizeof values[0], 0);
  const int id = mesh.AddAttribute(attribute, true, mesh.num_points());
  for (uint32_t i = 0; i < values.size(); ++i)
    mesh.attribute(id)->SetAttributeValue(draco::AttributeValueIndex(i), values[i].data());
}

/// Places that points share are one value, so that seams of textures leave the surface closed.
std::unique_ptr<draco::Mesh> dracoMesh(const FloatMesh& from) {
  auto mesh = std::make_unique<draco::Mesh>();
  mesh->set_num_points(static_cast<uint32_t>(from.points.size()));
  addAttribute(*mesh, GeometryAttribute::POSITION, from.points);
  if (!from.texcoords.empty()) addAttribute(*mesh, GeometryAttribute::TEX_COORD, from.texcoords);
  for (size_t i = 0; i < from.corners.size(); i += 3)
    mesh->AddFace({draco::PointIndex(from.corners[i]), draco::PointIndex(from.corners[i + 1]),
                   draco::PointIndex(from.corners[i + 2])});
  if (!from.texcoords.empty()) mesh->DeduplicateAttributeValues();
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

Result<PeerCoding> codeDraco(const SurfaceModel& model, const draco::Mesh& mesh, uint32_t bits) {
  draco::Encoder encoder;
  encoder.SetSpeedOptions(0, 0);
  encoder.SetEncodingMethod(draco::MESH_EDGEBREAKER_ENCODING);
  encoder.SetAttributeQuantization(GeometryAttribute::POSITION, static_cast<int>(bits));
  encoder.SetAttributeQuantization(GeometryAttribute::TEX_COORD, kTexcoordBits);
  draco::EncoderBuffer buffer;
  const draco::Status status = encoder.EncodeMeshToBuffer(mesh, &buffer);
  if (!status.ok()) return Status(TKS_MISMATCH, status.error_msg_string());
  const Result<TriangleMesh> received = decoded(buffer);
  if (!received.ok()) return received.status();
  return PeerCoding{
      mesh.num_faces(), bits, {errorOf(model, *received), static_cast<double>(buffer.size())}};
}

}  // namespace

Result<std::vector<PeerCoding>> surfacePeers(const SurfaceModel& model, const FloatMesh& mesh,
                                             uint32_t sizes) {
  std::vector<PeerCoding> codings;
  const uint32_t more = mesh.texcoords.empty() ? 0 : kMoreBits;
  for (const uint32_t budget : budgetsOf(mesh, sizes)) {
    const auto simple = dracoMesh(simplified(mesh, budget));
    for (uint32_t bits = kCoarsestBits + more; bits <= kFinestBits + more; ++bits) {
      Result<PeerCoding> coding = codeDraco(model, *simple, bits);
      if (!coding.ok()) return coding.status();
      codings.push_back(std::move(*coding));
    }
  }
  return codings;
}

std::vector<ErrorCurve> curvesOf(const std::vector<PeerCoding>& codings) {
  std::map<uint32_t, ErrorCurve> by_bits;
  for (const PeerCoding& coding : codings) by_bits[coding.bits].push_back(coding.point);
  std::vector<ErrorCurve> curves;
  for (auto& [bits, curve] : by_bits) curves.push_back(std::move(curve));
  return curves;
}

}  // namespace tetrakis::bench

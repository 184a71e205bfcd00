// SPDX-License-Identifier: Apache-2.0
#include "apps/tools/compression/draco_mesh.hpp"

#include <draco/compression/decode.h>
#include <draco/compression/encode.h>
#include <draco/mesh/mesh.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace tetrakis::tools {
namespace {

using draco::GeometryAttribute;

int addAttribute(GeometryAttribute::Type type, std::span<const float> values, uint8_t size,
                 draco::Mesh& out) {
  GeometryAttribute attribute;
  attribute.Init(type, nullptr, size, draco::DT_FLOAT32, false, size * sizeof(float), 0);
  const int id = out.AddAttribute(attribute, true, out.num_points());
  for (uint32_t i = 0; i < out.num_points(); ++i)
    out.attribute(id)->SetAttributeValue(draco::AttributeValueIndex(i), &values[size_t{i} * size]);
  return id;
}

/// Draco has one step for the three axes: so many bits over the longest that it is the finest
/// needed. Its coder has a counter for each of these steps, and so takes no more than some.
Result<int> positionBits(const MeshBounds& bounds) {
  constexpr double kFewest = 1, kMost = 24, kLargest = std::numeric_limits<float>::max();
  const PositionSteps steps = positionSteps(bounds);
  double longest = 0, step = 0;
  for (size_t axis = 0; axis < 3; ++axis)
    longest = std::max(longest, double{bounds.high[axis]} - bounds.low[axis]);
  for (const double one : {steps.horizontal, steps.vertical})
    if (one > 0) step = step > 0 ? std::min(step, one) : one;
  const double bits =
      step > 0 ? std::max(std::ceil(std::log2(longest / step + 1)), kFewest) : kFewest;
  // Draco counts the steps of a unit in floats, and the length too.
  const bool counts = longest <= kLargest && std::exp2(bits) <= kLargest * longest;
  if (!(bits <= kMost) || (longest > 0 && !counts)) {
    return Status(TKS_LIMIT,
                  "Draco cannot hold positions that span so many of their steps: write the mesh "
                  "uncompressed");
  }
  return static_cast<int>(bits);
}

/// Decoded again: glTF wants the bounds and the counts of what decoders give.
Status describe(DracoMesh& out) {
  draco::DecoderBuffer buffer;
  buffer.Init(reinterpret_cast<const char*>(out.bytes.data()), out.bytes.size());
  auto decoded = draco::Decoder().DecodeMeshFromBuffer(&buffer);
  if (!decoded.ok()) return {TKS_LIMIT, "Draco cannot read what it wrote: write it uncompressed"};
  const draco::Mesh& mesh = *decoded.value();
  const auto* positions = mesh.GetAttributeByUniqueId(out.position);
  std::vector<float> values(3 * size_t{mesh.num_points()});
  for (draco::PointIndex i(0); i < mesh.num_points(); ++i)
    positions->GetMappedValue(i, &values[3 * size_t{i.value()}]);
  out.vertices = mesh.num_points();
  out.triangles = mesh.num_faces();
  if (out.vertices == 0 || out.triangles == 0)
    return {TKS_LIMIT, "Draco leaves nothing of a mesh without area: write it uncompressed"};
  out.bounds = meshBounds(values);
  return {};
}

}  // namespace

Result<DracoMesh> encodeDraco(const MeshArrays& arrays) {
  constexpr int kNormalBits = 8, kTexcoordBits = 16;
  const Result<int> bits = positionBits(meshBounds(arrays.positions));
  if (!bits.ok()) return bits.status();
  draco::Mesh mesh;
  mesh.set_num_points(static_cast<uint32_t>(arrays.positions.size() / 3));
  const int position = addAttribute(GeometryAttribute::POSITION, arrays.positions, 3, mesh);
  const int normal = addAttribute(GeometryAttribute::NORMAL, arrays.normals, 3, mesh);
  const int texcoord = arrays.texcoords.empty()
                           ? -1
                           : addAttribute(GeometryAttribute::TEX_COORD, arrays.texcoords, 2, mesh);
  const std::span<const uint32_t> corners = arrays.triangles;
  for (size_t i = 0; i < corners.size(); i += 3)
    mesh.AddFace({draco::PointIndex(corners[i]), draco::PointIndex(corners[i + 1]),
                  draco::PointIndex(corners[i + 2])});
  draco::Encoder encoder;
  encoder.SetAttributeQuantization(GeometryAttribute::POSITION, *bits);
  encoder.SetAttributeQuantization(GeometryAttribute::NORMAL, kNormalBits);
  encoder.SetAttributeQuantization(GeometryAttribute::TEX_COORD, kTexcoordBits);
  encoder.SetSpeedOptions(0, 0);
  draco::EncoderBuffer buffer;
  if (const auto status = encoder.EncodeMeshToBuffer(mesh, &buffer); !status.ok())
    return Status(TKS_LIMIT, "Draco: " + status.error_msg_string());
  DracoMesh out;
  const auto* data = reinterpret_cast<const std::byte*>(buffer.data());
  out.bytes.assign(data, data + buffer.size());
  out.position = mesh.attribute(position)->unique_id();
  out.normal = mesh.attribute(normal)->unique_id();
  if (texcoord >= 0) out.texcoord = mesh.attribute(texcoord)->unique_id();
  if (const Status status = describe(out); !status.ok()) return status;
  return out;
}

}  // namespace tetrakis::tools

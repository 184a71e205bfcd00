// SPDX-License-Identifier: Apache-2.0
#include "apps/tools/compression/meshopt_mesh.hpp"

#include <meshoptimizer.h>

#include <algorithm>
#include <cmath>

namespace tetrakis::tools {
namespace {

constexpr uint32_t kUnused = ~0u;

/// Positions, normals and texture coordinates in the order of first use.
struct Ordered {
  std::vector<float> positions, normals, texcoords;
  std::vector<uint32_t> triangles;
  size_t vertices = 0;
};

std::vector<float> inOrder(std::span<const float> values, size_t size,
                           const std::vector<uint32_t>& places, size_t count) {
  std::vector<float> ordered(count * size);
  for (size_t i = 0; i < places.size() && !values.empty(); ++i)
    if (places[i] != kUnused)
      std::copy_n(&values[i * size], size, &ordered[size_t{places[i]} * size]);
  return ordered;
}

Ordered order(const MeshArrays& mesh) {
  const size_t all = mesh.positions.size() / 3, corners = mesh.triangles.size();
  Ordered out;
  out.triangles.resize(corners);
  meshopt_optimizeVertexCacheStrip(out.triangles.data(), mesh.triangles.data(), corners, all);
  std::vector<uint32_t> places(all);
  out.vertices =
      meshopt_optimizeVertexFetchRemap(places.data(), out.triangles.data(), corners, all);
  for (uint32_t& corner : out.triangles) corner = places[corner];
  out.positions = inOrder(mesh.positions, 3, places, out.vertices);
  out.normals = inOrder(mesh.normals, 3, places, out.vertices);
  if (!mesh.texcoords.empty()) out.texcoords = inOrder(mesh.texcoords, 2, places, out.vertices);
  return out;
}

template <class T>
MeshoptStream encodeVertices(const std::vector<T>& items, size_t count, size_t stride) {
  MeshoptStream stream{{}, count, stride};
  stream.bytes.resize(meshopt_encodeVertexBufferBound(count, stride));
  stream.bytes.resize(meshopt_encodeVertexBuffer(reinterpret_cast<uint8_t*>(stream.bytes.data()),
                                                 stream.bytes.size(), items.data(), count, stride));
  return stream;
}

/// Exponent e of the step 2^e: the largest that is no coarser than `step`, but so that `most` fits
/// into a mantissa of 24 bits with its sign. The filter takes -100 to 100.
int stepExponent(double step, double most) {
  constexpr int kMantissa = 22, kLimit = 100;
  const int least = most > 0 ? std::ilogb(most) - kMantissa + 1 : -kLimit;
  const int fine = step > 0 ? std::ilogb(step) : least;
  return std::clamp(std::max(fine, least), -kLimit, kLimit);
}

/// The EXPONENTIAL filter: exponent in the high 8 bits, mantissa in the low 24, both signed.
MeshoptStream encodePositions(std::vector<float>& positions) {
  const MeshBounds bounds = meshBounds(positions);
  const PositionSteps steps = positionSteps(bounds);
  std::vector<uint32_t> items(positions.size());
  for (size_t axis = 0; axis < 3; ++axis) {
    const double most = std::max(std::abs(bounds.low[axis]), std::abs(bounds.high[axis]));
    const int e = stepExponent(axis == 1 ? steps.vertical : steps.horizontal, most);
    for (size_t i = axis; i < positions.size(); i += 3) {
      const auto mantissa = static_cast<int32_t>(std::round(std::ldexp(positions[i], -e)));
      items[i] = static_cast<uint32_t>(e) << 24 | (static_cast<uint32_t>(mantissa) & 0xffffff);
      positions[i] = static_cast<float>(std::ldexp(mantissa, e));
    }
  }
  return encodeVertices(items, positions.size() / 3, 12);
}

MeshoptStream encodeNormals(const std::vector<float>& normals) {
  constexpr int kBits = 8;
  const size_t count = normals.size() / 3;
  std::vector<float> padded(4 * count, 0);
  for (size_t i = 0; i < count; ++i) std::copy_n(&normals[3 * i], 3, &padded[4 * i]);
  std::vector<uint8_t> items(4 * count);
  meshopt_encodeFilterOct(items.data(), count, 4, kBits, padded.data());
  return encodeVertices(items, count, 4);
}

MeshoptStream encodeTexcoords(const std::vector<float>& texcoords) {
  std::vector<uint16_t> items(texcoords.size());
  std::transform(texcoords.begin(), texcoords.end(), items.begin(), [](float value) {
    return static_cast<uint16_t>(std::lround(std::clamp(value, 0.0F, 1.0F) * 65535));
  });
  return encodeVertices(items, items.size() / 2, 4);
}

MeshoptStream encodeTriangles(const Ordered& mesh) {
  constexpr size_t kMaxShort = 65535;
  const size_t corners = mesh.triangles.size();
  MeshoptStream stream{{}, corners, mesh.vertices <= kMaxShort ? size_t{2} : size_t{4}};
  stream.bytes.resize(meshopt_encodeIndexBufferBound(corners, mesh.vertices));
  stream.bytes.resize(meshopt_encodeIndexBuffer(reinterpret_cast<uint8_t*>(stream.bytes.data()),
                                                stream.bytes.size(), mesh.triangles.data(),
                                                corners));
  return stream;
}

}  // namespace

MeshoptMesh encodeMeshopt(const MeshArrays& arrays) {
  meshopt_encodeVertexVersion(0);  // those of the extension
  meshopt_encodeIndexVersion(1);
  Ordered mesh = order(arrays);
  MeshoptMesh out;
  out.positions = encodePositions(mesh.positions);
  out.bounds = meshBounds(mesh.positions);
  out.normals = encodeNormals(mesh.normals);
  if (!mesh.texcoords.empty()) out.texcoords = encodeTexcoords(mesh.texcoords);
  out.triangles = encodeTriangles(mesh);
  return out;
}

}  // namespace tetrakis::tools

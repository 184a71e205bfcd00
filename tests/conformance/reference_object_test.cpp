// SPDX-License-Identifier: Apache-2.0
// The library against the reference decoder (agreement.hpp): objects, whose heights lie over a base
// mesh, and the glue of their forests.
#include <algorithm>
#include <memory>
#include <random>
#include <string>
#include <utility>

#include "base/forest.hpp"
#include "bitstream/stream/glue.hpp"
#include "codec/basemesh/base_mesh.hpp"
#include "conformance/samples/header_parts.hpp"
#include "tests/conformance/agreement.hpp"
#include "tests/support/forest_raster.hpp"
#include "tests/support/forest_shapes.hpp"

namespace tetrakis::test {
namespace {

constexpr uint64_t kBaseMeshPart = 10;

/// Two squares side by side, and a third one apart.
ForestShape twoComponents() {
  ForestShape shape = planeShape(1, 2);
  shape.sides.insert(shape.sides.end(), 4, Forest::kBorder);
  return shape;
}

std::vector<ForestShape> shapes() {
  std::vector<ForestShape> all = forestShapes();
  all.push_back(twoComponents());
  return all;
}

struct Object {
  ForestRaster surface;
  std::vector<int32_t> corners;
  uint32_t bits;

  /// Corners anywhere in the grid: near each other, or not.
  Object(const ForestShape& shape, int depth, uint32_t position_bits, uint32_t seed)
      : surface(Forest(depth, shape.sides), {Pattern::kRidges, 0, 0, 1, TKS_I16, 3}),
        bits(position_bits) {
    std::mt19937 random(seed);
    const auto most = static_cast<int32_t>((1u << bits) - 1);
    const uint32_t spread = seed % 2 == 0 ? 20 : 1u << bits;
    for (const uint32_t owner : cornerOwners(surface.forest)) {
      for (uint32_t axis = 0; axis < 3; ++axis) {
        if (corners.size() / 3 > owner) {
          corners.push_back(corners[3 * owner + axis]);
          continue;
        }
        const int32_t before = corners.size() < 3 ? most / 2 : corners[corners.size() - 3];
        const auto step =
            static_cast<int32_t>(random() % spread) - static_cast<int32_t>(spread / 2);
        corners.push_back(std::clamp(before + step, 0, most));
      }
    }
  }

  Bytes encoded(const tks_encode_options& options) const {
    tks_heights heights = surface.heights();
    heights.scale = 1;
    heights.base_mesh = {bits, 0.3, {-1.7, 1e6, 0.1}, corners.data()};
    return encodeHeights(heights, options);
  }
};

void expectSameBase(const tks_base_mesh& told, const reference::Object& object) {
  ASSERT_EQ(told.position_bits, static_cast<uint32_t>(object.bits));
  ASSERT_EQ(told.cell, object.cell);
  for (size_t axis = 0; axis < 3; ++axis) ASSERT_EQ(told.origin[axis], object.origin[axis]);
  for (size_t corner = 0; corner < object.corners.size(); ++corner) {
    for (size_t axis = 0; axis < 3; ++axis)
      ASSERT_EQ(told.corners[3 * corner + axis], object.corners[corner][axis]) << corner;
  }
}

bool sameBits(double a, double b) {
  return a == b || (std::isnan(a) && std::isnan(b));
}

/// Both decoders on the same bytes: where the vertices of all meshes lie. seen: counts them.
void expectSameObject(Prefix prefix, uint32_t* seen = nullptr) {
  expectAgreement(prefix);
  if (::testing::Test::HasFatalFailure()) return;
  const tks_limits limits = smallLimits();
  const auto object = reference::decodeObject(prefix, limits.max_samples);
  Stream stream(prefix, &limits);
  const bool has_base = stream.status() == TKS_OK && stream.info().base_mesh.position_bits > 0;
  ASSERT_EQ(has_base, object.has_value());
  if (!object) return;
  expectSameBase(stream.info().base_mesh, *object);
  for (const tks_mesh_kind kind : {TKS_MESH_BUDGET, TKS_MESH_CODED}) {
    tks_object_mesh mesh = {};
    const tks_status status = tks_decode_object(stream.get(), kind, 0, &mesh);
    ASSERT_TRUE(status == TKS_OK || (seen == nullptr && status == TKS_LIMIT))
        << tks_message(stream.get());
    for (uint32_t v = 0; v < mesh.vertex_count; ++v) {
      const auto x = static_cast<size_t>(mesh.pixel[2 * v]),
                 y = static_cast<size_t>(mesh.pixel[2 * v + 1]);
      const auto place =
          reference::placeOf(*object, y * stream.info().width + x, double{mesh.height[v]});
      for (size_t axis = 0; axis < 3; ++axis)
        ASSERT_TRUE(sameBits(mesh.position[3 * v + axis], place[axis])) << v;
    }
    if (seen != nullptr) *seen += mesh.vertex_count;
    tks_free_object_mesh(&mesh);
  }
}

TEST(ReferenceObject, AgreesOnEveryShape) {
  for (const ForestShape& shape : shapes()) {
    for (const auto& [depth, bits] : {std::pair(1, 1u), {1, 20u}, {2, 7u}, {3, 12u}, {4, 20u}}) {
      SCOPED_TRACE(shape.name + ", depth " + std::to_string(depth));
      const Bytes bytes = Object(shape, depth, bits, bits).encoded(within(9));
      const auto header = static_cast<size_t>(Stream(bytes).info().header_bytes);
      for (const size_t size : {bytes.size(), (bytes.size() + header) / 2}) {
        uint32_t seen = 0;
        expectSameObject(Prefix(bytes).first(size), &seen);
        if (HasFatalFailure()) return;
        EXPECT_GT(seen, 0u);
      }
    }
  }
}

TEST(ReferenceObject, AgreesOnTheFinestPatches) {
  expectSameObject(Object(coneShape(), TKS_MOST_OBJECT_DEPTH, 20, 5).encoded(budget(300)));
}

/// The stream with that codeword of corners.
Bytes withCorners(const Bytes& stream, const Bytes& code, size_t fields) {
  HeaderParts body = bodyOf(stream);
  Bytes& component = body.find(kComponentKind)->bytes;
  // The part is found by its bytes, since the domain of a forest is of any length.
  const HeaderParts parts = partsOf(component, fields);
  HeaderParts changed = parts;
  HeaderPart* part = changed.find(kBaseMeshPart);
  size_t at = 1;
  for (int i = 0; i < 4; ++i) at += size_t{1} + part->bytes[at];
  part->bytes.resize(at);
  part->bytes.insert(part->bytes.end(), code.begin(), code.end());
  component = changed.bytes();
  return withBody(stream, body);
}

/// Bytes of heights on a forest before their parts.
size_t fieldsOf(const Bytes& stream) {
  HeaderParts body = bodyOf(stream);
  const Bytes& bytes = body.find(kComponentKind)->bytes;
  size_t at = kDomainByte + 3;  // domain, domain_kind, depth
  takeVarint(bytes, at);
  const auto glue = static_cast<size_t>(takeVarint(bytes, at));
  at += glue + 2;  // sample, coding
  for (int i = 0; i < 2; ++i) at += size_t{1} + bytes[at];
  const size_t wavelet = at;
  at += kFractionByte + 2;
  if (bytes[wavelet + kFractionByte] == 0) takeVarint(bytes, ++at);
  return at;
}

/// Cut, and of any bytes: each is the codeword of some corners.
TEST(ReferenceObject, AgreesOnAnyCodewordOfCorners) {
  std::mt19937 random(3);
  for (const ForestShape& shape : shapes()) {
    const Bytes good = Object(shape, 2, 11, 8).encoded(within(9));
    for (size_t size = 0; size < 40; size += 1 + size / 8) {
      SCOPED_TRACE(shape.name + ", " + std::to_string(size));
      Bytes code(size);
      for (uint8_t& byte : code) byte = static_cast<uint8_t>(random());
      expectSameObject(withCorners(good, code, fieldsOf(good)));
      if (HasFatalFailure()) return;
    }
  }
}

/// Any value in any byte of the header.
TEST(ReferenceObject, AgreesOnDamagedHeaders) {
  int decoded = 0, corrupt = 0;
  for (const ForestShape& shape : {torusShape(), cubeShape(), twoComponents()}) {
    const Bytes good = Object(shape, 2, 9, 6).encoded(within(3));
    const size_t header = static_cast<size_t>(Stream(good).info().header_bytes);
    for (size_t at = 0; at < header; ++at) {
      for (const int value : {0, 1, 2, 3, 7, 10, 64, 127, 255, good[at] + 1, good[at] - 1}) {
        Bytes damaged = good;
        damaged[at] = static_cast<uint8_t>(value);
        sealHeader(damaged);
        SCOPED_TRACE("byte " + std::to_string(at) + " := " + std::to_string(value));
        expectSameObject(damaged);
        if (HasFatalFailure()) return;
        const tks_status status = Stream(damaged).status();
        decoded += status == TKS_OK;
        corrupt += status == TKS_CORRUPT;
      }
    }
  }
  EXPECT_GT(decoded, 100);
  EXPECT_GT(corrupt, 100);
}

/// A stream of heights whose forest has that glue.
Bytes withGlue(const Bytes& stream, uint32_t patches, const Bytes& glue) {
  HeaderParts body = bodyOf(stream);
  Bytes& bytes = body.find(kComponentKind)->bytes;
  size_t end = kDomainByte + 3;
  takeVarint(bytes, end);
  const auto old = static_cast<size_t>(takeVarint(bytes, end));
  Bytes told;
  putVarint(patches, told);
  putVarint(glue.size(), told);
  told.insert(told.end(), glue.begin(), glue.end());
  const auto begin = bytes.begin() + kDomainByte + 3;
  bytes.insert(bytes.erase(begin, bytes.begin() + static_cast<ptrdiff_t>(end + old)), told.begin(),
               told.end());
  return withBody(stream, body);
}

/// Cut, damaged, and of any bytes.
TEST(ReferenceObject, AgreesOnAnyGlue) {
  std::mt19937 random(4);
  const Bytes good = Object(cubeShape(), 1, 9, 6).encoded(within(3));
  int decoded = 0, corrupt = 0;
  for (uint32_t trial = 0; trial < 600; ++trial) {
    SCOPED_TRACE(trial);
    const uint32_t patches = 1 + trial % 7;
    Bytes glue(random() % 14);
    for (uint8_t& byte : glue) byte = static_cast<uint8_t>(random());
    const Bytes made = withGlue(good, patches, glue);
    expectSameObject(made);
    if (HasFatalFailure()) return;
    const tks_status status = Stream(made).status();
    decoded += status == TKS_OK;
    corrupt += status == TKS_CORRUPT;
  }
  EXPECT_GT(decoded, 20);
  EXPECT_GT(corrupt, 20);
}

}  // namespace
}  // namespace tetrakis::test

// SPDX-License-Identifier: Apache-2.0
// Objects through the C interface, for tests: encodeMesh() makes streams, decodedMesh() meshes of
// them.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "tests/support/given_mesh.hpp"
#include "tests/support/stream_fixture.hpp"

namespace tetrakis::test {

struct Encoded {
  Bytes stream;
  tks_object_report report{};
};

inline Encoded encodeMesh(const tks_triangle_mesh& mesh, const tks_encode_options& options,
                          const tks_image* image = nullptr) {
  Encoded out;
  out.report.size = sizeof out.report;
  tks_buffer buffer{};
  std::array<char, 300> message{};
  EXPECT_EQ(tks_encode_object(&mesh, image, &options, &out.report, &buffer, message.data(),
                              message.size()),
            TKS_OK)
      << message.data();
  out.stream.assign(buffer.data, buffer.data + buffer.size);
  tks_free_buffer(&buffer);
  return out;
}

inline Encoded encodeMesh(const TriangleMesh& mesh, const tks_encode_options& options,
                          tks_object_kind kind = TKS_OBJECT_AUTO) {
  const GivenMesh from(mesh);
  tks_triangle_mesh given = from.given();
  given.kind = kind;
  return encodeMesh(given, options);
}

struct Closer {
  void operator()(tks_decoder* decoder) const { tks_close(decoder); }
};
using OpenedStream = std::unique_ptr<tks_decoder, Closer>;

inline OpenedStream opened(const Bytes& stream, size_t length) {
  tks_decoder* decoder = nullptr;
  tks_open(stream.data(), length, nullptr, &decoder, nullptr, 0);
  return OpenedStream(decoder);
}

inline uint64_t headerBytes(const Bytes& stream) {
  tks_info info{};
  info.size = sizeof info;
  EXPECT_EQ(tks_get_info(opened(stream, stream.size()).get(), &info), TKS_OK);
  return info.header_bytes;
}

struct DecodedMesh {
  std::vector<std::array<double, 3>> points;
  std::vector<std::array<double, 2>> pixels, texcoords;
  std::vector<uint32_t> triangles;
};

inline DecodedMesh decodedMesh(tks_decoder* decoder, tks_mesh_kind kind, uint32_t most) {
  tks_object_mesh mesh{};
  EXPECT_EQ(tks_decode_object(decoder, kind, most, &mesh), TKS_OK) << tks_message(decoder);
  DecodedMesh out;
  for (uint32_t v = 0; v < mesh.vertex_count; ++v) {
    out.points.push_back(
        {mesh.position[3 * v], mesh.position[3 * v + 1], mesh.position[3 * v + 2]});
    if (mesh.pixel != nullptr) out.pixels.push_back({mesh.pixel[2 * v], mesh.pixel[2 * v + 1]});
    if (mesh.texcoord != nullptr)
      out.texcoords.push_back({mesh.texcoord[2 * v], mesh.texcoord[2 * v + 1]});
  }
  out.triangles.assign(mesh.triangles, mesh.triangles + 3 * size_t{mesh.triangle_count});
  tks_free_object_mesh(&mesh);
  return out;
}

}  // namespace tetrakis::test

// SPDX-License-Identifier: Apache-2.0
// Streams of objects that begin with a sketch: it is shown until the header is there.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "tests/support/coded_object.hpp"
#include "tests/support/triangle_meshes.hpp"
#include "tetrakis/components.h"

namespace tetrakis::test {
namespace {

constexpr uint64_t kSketch = 900;

Encoded sketched(const TriangleMesh& mesh, const tks_encode_options& options, tks_object_kind kind,
                 uint64_t sketch = kSketch) {
  const GivenMesh given(mesh);
  tks_triangle_mesh as_given = given.given();
  as_given.kind = kind;
  as_given.sketch_bytes = sketch;
  return encodeMesh(as_given, options);
}

tks_info infoOf(const tks_decoder* decoder) {
  tks_info info{};
  info.size = sizeof info;
  EXPECT_EQ(tks_get_info(decoder, &info), TKS_OK);
  return info;
}

/// The root mean square distance of the mesh's points from the unit sphere.
double errorOf(tks_decoder* decoder) {
  double sum = 0;
  const DecodedMesh mesh = decodedMesh(decoder, TKS_MESH_CODED, 0);
  for (const auto& p : mesh.points)
    sum += std::pow(std::sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]) - 1, 2);
  return std::sqrt(sum / static_cast<double>(mesh.points.size()));
}

class Sketches : public testing::TestWithParam<tks_object_kind> {
 protected:
  static void SetUpTestSuite() {
    for (const tks_object_kind kind : {TKS_OBJECT_RESAMPLED, TKS_OBJECT_TRIANGLES})
      coded_[kind] = sketched(made::sphere(4), budget(4000), kind);
  }
  const Encoded& coded() const { return coded_[GetParam()]; }
  const std::vector<uint8_t>& stream() const { return coded().stream; }

 private:
  static inline Encoded coded_[3];
};

TEST_P(Sketches, StayWithinTheBudget) {
  EXPECT_LE(stream().size(), 4000u);
  EXPECT_GT(coded().report.sketch_bytes, kSketch / 2);
  EXPECT_LE(coded().report.sketch_bytes, kSketch);
  EXPECT_EQ(coded().report.kind, GetParam());
}

TEST_P(Sketches, AreShownUntilTheHeaderIsThere) {
  const OpenedStream whole = opened(stream(), stream().size());
  const tks_info all = infoOf(whole.get());
  EXPECT_EQ(all.shows_sketch, 0);
  EXPECT_LT(all.least_bytes, 700u);
  EXPECT_GT(all.header_bytes, kSketch / 2);
  EXPECT_EQ(tks_verify(whole.get()), TKS_OK);
  double last = 1;
  for (size_t length = all.least_bytes; length <= stream().size(); length += 37) {
    const OpenedStream decoder = opened(stream(), length);
    const tks_info info = infoOf(decoder.get());
    EXPECT_EQ(info.shows_sketch, length < all.header_bytes) << length;
    EXPECT_EQ(info.available_bytes, length);
    EXPECT_EQ(info.stream_bytes, stream().size());
    EXPECT_EQ(info.header_bytes, all.header_bytes);
    EXPECT_EQ(info.least_bytes, all.least_bytes);
    EXPECT_EQ(tks_verify(decoder.get()), length < stream().size() ? TKS_TRUNCATED : TKS_OK);
    last = errorOf(decoder.get());
  }
  EXPECT_LT(last, 0.2 * errorOf(opened(stream(), all.least_bytes).get()));
}

TEST_P(Sketches, NeedTheirHeader) {
  uint64_t least = 0;
  ASSERT_EQ(tks_header_bytes(stream().data(), stream().size(), &least), TKS_OK);
  for (size_t length = 0; length < least; ++length) {
    tks_decoder* decoder = nullptr;
    EXPECT_EQ(tks_open(stream().data(), length, nullptr, &decoder, nullptr, 0), TKS_TRUNCATED);
    uint64_t needed = 0;
    EXPECT_EQ(tks_header_bytes(stream().data(), length, &needed), TKS_TRUNCATED) << length;
    EXPECT_GT(needed, length);
    EXPECT_LE(needed, least) << length;
  }
  std::string message(200, ' ');
  tks_decoder* decoder = nullptr;
  tks_open(stream().data(), least - 1, nullptr, &decoder, message.data(), message.size());
  EXPECT_NE(message.find(std::to_string(least)), std::string::npos) << message;
}

/// Whatever came before, a decoder is that of all bytes.
TEST_P(Sketches, GiveWayWhileBytesAreAppended) {
  const size_t least = infoOf(opened(stream(), stream().size()).get()).least_bytes;
  for (const size_t step : {1u, 61u, 700u, 4000u}) {
    std::vector<uint8_t> first(stream().begin(), stream().begin() + static_cast<ptrdiff_t>(least));
    const OpenedStream decoder = opened(first, least);
    for (size_t at = least; at < stream().size(); at += step) {
      const size_t size = std::min(step, stream().size() - at);
      ASSERT_EQ(tks_append(decoder.get(), stream().data() + at, size), TKS_OK)
          << tks_message(decoder.get());
      first.assign(first.size(), 0);  // the decoder has its own
      if (step == 1 && at % 97 != 0) continue;
      const OpenedStream anew = opened(stream(), at + size);
      const tks_info grown = infoOf(decoder.get()), info = infoOf(anew.get());
      ASSERT_EQ(grown.shows_sketch, info.shows_sketch) << at;
      ASSERT_EQ(grown.available_bytes, info.available_bytes);
      ASSERT_EQ(grown.stream_bytes, info.stream_bytes);
      ASSERT_TRUE(decodedMesh(decoder.get(), TKS_MESH_CODED, 0).points ==
                  decodedMesh(anew.get(), TKS_MESH_CODED, 0).points)
          << at;
    }
    EXPECT_EQ(tks_verify(decoder.get()), TKS_OK) << tks_message(decoder.get());
    EXPECT_EQ(infoOf(decoder.get()).packets,
              infoOf(opened(stream(), stream().size()).get()).packets);
  }
}

TEST_P(Sketches, TakeBytesInTheirOrder) {
  const tks_info all = infoOf(opened(stream(), stream().size()).get());
  const OpenedStream decoder = opened(stream(), all.least_bytes);
  EXPECT_EQ(tks_put(decoder.get(), all.least_bytes + 1, stream().data(), 5), TKS_USAGE);
  EXPECT_EQ(tks_put(decoder.get(), 3, stream().data() + 3, 9), TKS_OK) << "they are there";
  EXPECT_EQ(tks_put(decoder.get(), 20, stream().data() + 20, stream().size() - 20), TKS_OK);
  EXPECT_EQ(infoOf(decoder.get()).shows_sketch, 0);
  EXPECT_EQ(tks_verify(decoder.get()), TKS_OK);
}

TEST_P(Sketches, OfDamagedBytesAreSafe) {
  for (size_t at = 4; at < 1200; at += 3) {
    std::vector<uint8_t> damaged = stream();
    damaged[at] ^= static_cast<uint8_t>(1 + at % 255);
    tks_decoder* decoder = nullptr;
    const size_t length = at % 2 == 0 ? kSketch : stream().size();
    if (tks_open(damaged.data(), length, nullptr, &decoder, nullptr, 0) != TKS_OK) continue;
    const OpenedStream owned(decoder);
    const bool claims_more = at >= 7 && at <= 8;  // the size of the header
    EXPECT_TRUE(length < stream().size() || claims_more) << "the checksum sees it: " << at;
    tks_object_mesh mesh{};
    tks_decode_object(decoder, TKS_MESH_BUDGET, 500, &mesh);
    tks_free_object_mesh(&mesh);
    tks_append(decoder, damaged.data() + length, damaged.size() - length);
    infoOf(decoder);
  }
}

TEST_P(Sketches, OutliveCombining) {
  const tks_combined one{sizeof(tks_combined), stream().data(), stream().size(), "scan", 0};
  tks_buffer out{};
  ASSERT_EQ(tks_combine(&one, 1, nullptr, &out, nullptr, 0), TKS_OK);
  const std::vector<uint8_t> combined(out.data, out.data + out.size);
  tks_free_buffer(&out);
  const tks_info info = infoOf(opened(combined, kSketch).get());
  EXPECT_EQ(info.shows_sketch, 1);
  EXPECT_EQ(info.stream_bytes, combined.size());
}

INSTANTIATE_TEST_SUITE_P(Kinds, Sketches,
                         testing::Values(TKS_OBJECT_RESAMPLED, TKS_OBJECT_TRIANGLES),
                         [](const auto& kind) {
                           return kind.param == TKS_OBJECT_TRIANGLES ? "Triangles" : "Resampled";
                         });

TEST(ObjectSketches, AreThereWhereTheHeaderComesLate) {
  tks_encode_options exact{};
  exact.size = sizeof exact;
  exact.max_error = 1e-5;
  const Encoded late = sketched(made::sphere(6), exact, TKS_OBJECT_TRIANGLES, 0);
  EXPECT_GT(late.stream.size(), 32000u);
  EXPECT_GT(late.report.sketch_bytes, 0u);
  EXPECT_LE(32 * late.report.sketch_bytes, late.stream.size());
  const Encoded none = sketched(made::sphere(6), exact, TKS_OBJECT_TRIANGLES, TKS_NO_SKETCH);
  EXPECT_EQ(none.report.sketch_bytes, 0u);
  EXPECT_LT(none.stream.size(), late.stream.size());
  EXPECT_LT(late.stream.size(), none.stream.size() + late.report.sketch_bytes + 9);
  const Encoded small = sketched(made::sphere(4), budget(4000), TKS_OBJECT_AUTO, 0);
  EXPECT_EQ(small.report.sketch_bytes, 0u);
}

TEST(ObjectSketches, ThatCannotBeAreASentence) {
  const GivenMesh sphere(made::sphere(3));
  tks_triangle_mesh mesh = sphere.given();
  mesh.kind = TKS_OBJECT_RESAMPLED;
  for (const uint64_t bytes : {1u, 1990u, 2000u, 5000u}) {
    mesh.sketch_bytes = bytes;
    tks_encode_options options = budget(2000);
    tks_buffer out{};
    std::vector<char> message(300);
    EXPECT_EQ(
        tks_encode_object(&mesh, nullptr, &options, nullptr, &out, message.data(), message.size()),
        TKS_USAGE)
        << bytes;
    EXPECT_NE(message[0], 0);
    EXPECT_EQ(out.data, nullptr);
  }
}

}  // namespace
}  // namespace tetrakis::test

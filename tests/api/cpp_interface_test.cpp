// SPDX-License-Identifier: Apache-2.0
// The C++ interface: it owns what it gets, moves, and reports every failure as a Status.
#include "tetrakis/tetrakis.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

namespace tetrakis::test {
namespace {

static_assert(!std::is_copy_constructible_v<Buffer> &&
              std::is_nothrow_move_constructible_v<Buffer>);
static_assert(!std::is_copy_constructible_v<Mesh> && std::is_nothrow_move_constructible_v<Mesh>);
static_assert(!std::is_copy_constructible_v<Decoder> && std::is_move_constructible_v<Decoder>);

constexpr uint32_t kWidth = 21, kHeight = 13;

std::vector<int16_t> waves() {
  std::vector<int16_t> samples;
  for (uint32_t i = 0; i < kWidth * kHeight; ++i)
    samples.push_back(static_cast<int16_t>(300 * std::sin(i % kWidth / 3.0) - 2.0 * i));
  return samples;
}

Result<Buffer> encodeWaves(const std::vector<int16_t>& samples) {
  tks_heights heights = makeHeights();
  heights.width = kWidth;
  heights.height = kHeight;
  heights.sample = TKS_I16;
  heights.data = samples.data();
  tks_encode_options options = makeEncodeOptions();
  options.lossless = 1;
  return encode(&heights, nullptr, options);
}

TEST(CppInterface, RoundTripThroughMovedObjects) {
  const std::vector<int16_t> samples = waves();
  Result<Buffer> stream = encodeWaves(samples);
  ASSERT_TRUE(stream) << stream.status().message();
  const Buffer buffer = std::move(*stream);
  Result<Decoder> opened = Decoder::open(buffer.bytes());
  ASSERT_TRUE(opened) << opened.status().message();
  Decoder decoder = std::move(*opened);
  EXPECT_EQ(decoder.info().width, kWidth);
  EXPECT_TRUE(decoder.verify().ok());
  const Result<std::vector<std::byte>> heights = decoder.heights();
  ASSERT_TRUE(heights) << heights.status().message();
  ASSERT_EQ(heights->size(), samples.size() * sizeof(int16_t));
  EXPECT_EQ(std::memcmp(heights->data(), samples.data(), heights->size()), 0);
}

TEST(CppInterface, RangesArePutAtOnce) {
  const std::vector<int16_t> samples = waves();
  const Result<Buffer> stream = encodeWaves(samples);
  ASSERT_TRUE(stream);
  const std::span<const uint8_t> bytes = stream->bytes();
  const size_t middle = bytes.size() * 2 / 3, first = bytes.size() / 2;
  Result<Decoder> decoder = Decoder::open(bytes.first(first));
  ASSERT_TRUE(decoder);
  const tks_range ranges[] = {{first, middle - first, 0}, {middle, bytes.size() - middle, 0}};
  const uint8_t* const data[] = {bytes.data() + first, bytes.data() + middle};
  EXPECT_EQ(decoder->put(ranges, std::span(data).first(1)).code(), TKS_USAGE);
  ASSERT_TRUE(decoder->put(ranges, data).ok());
  EXPECT_EQ(decoder->info().available_bytes, bytes.size());
  EXPECT_TRUE(decoder->verify().ok());
}

TEST(CppInterface, MeshesStayInsideTheGrid) {
  const std::vector<int16_t> samples = waves();
  const Result<Buffer> stream = encodeWaves(samples);
  ASSERT_TRUE(stream);
  Result<Decoder> decoder = Decoder::open(stream->bytes());
  ASSERT_TRUE(decoder);
  for (const uint32_t triangles : {0u, 40u, 100u}) {
    Result<Mesh> made = decoder->budgetMesh(triangles);
    ASSERT_TRUE(made) << made.status().message();
    Mesh mesh = std::move(*made);
    if (triangles > 0) {
      EXPECT_LE(mesh.triangleCount(), triangles);
    }
    EXPECT_EQ(mesh.triangles().size(), size_t{3} * mesh.triangleCount());
    EXPECT_EQ(mesh.heights().size(), mesh.gridIndices().size());
    for (const uint32_t vertex : mesh.triangles()) EXPECT_LT(vertex, mesh.vertexCount());
    for (const uint32_t sample : mesh.gridIndices()) EXPECT_LT(sample, kWidth * kHeight);
  }
  EXPECT_TRUE(decoder->codedMesh());
}

TEST(CppInterface, FailuresCarryCodeAndSentence) {
  const Result<Buffer> nothing = encode(nullptr, nullptr, makeEncodeOptions());
  ASSERT_FALSE(nothing);
  EXPECT_EQ(nothing.status().code(), TKS_USAGE);
  EXPECT_NE(nothing.status().message(), "");
  const std::vector<uint8_t> noise(100, 0x5a);
  const Result<Decoder> corrupt = Decoder::open(noise);
  ASSERT_FALSE(corrupt);
  EXPECT_EQ(corrupt.status().code(), TKS_CORRUPT);
  EXPECT_NE(corrupt.status().message(), "");
  const Result<Decoder> empty = Decoder::open({});
  ASSERT_FALSE(empty);
  EXPECT_EQ(empty.status().code(), TKS_TRUNCATED);
}

TEST(CppInterface, DecoderRefusesWhatTheStreamLacks) {
  const std::vector<int16_t> samples = waves();
  const Result<Buffer> stream = encodeWaves(samples);
  ASSERT_TRUE(stream);
  Result<Decoder> decoder = Decoder::open(stream->bytes());
  ASSERT_TRUE(decoder);
  const Result<std::vector<std::byte>> texture = decoder->texture();
  ASSERT_FALSE(texture);
  EXPECT_EQ(texture.status().code(), TKS_USAGE);
  tks_limits limits = makeLimits();
  limits.max_samples = 4;
  const Result<Decoder> limited = Decoder::open(stream->bytes(), limits);
  ASSERT_FALSE(limited);
  EXPECT_EQ(limited.status().code(), TKS_LIMIT);
}

}  // namespace
}  // namespace tetrakis::test

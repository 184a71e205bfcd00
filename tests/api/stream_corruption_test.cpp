// SPDX-License-Identifier: Apache-2.0
// The trust contract: whatever the bytes are, every decoding function returns TKS_OK with fully
// written outputs, or an error with untouched ones.
#include "conformance/samples/header_seal.hpp"
#include "conformance/samples/void_masks.hpp"
#include "tests/support/stream_fixture.hpp"

namespace tetrakis::test {
namespace {

using samples::make;
using samples::Pattern;
using samples::Raster;

using DecodeSamples = tks_status (*)(tks_decoder*, void*, size_t);

/// Decodes twice over different fill bytes: what is written does not depend on what was there.
void expectAllOrNothing(const Stream& stream, DecodeSamples decode, size_t size) {
  std::vector<std::byte> first(size, std::byte{0x00}), second(size, std::byte{0xa5});
  const tks_status status = decode(stream.get(), first.data(), size);
  EXPECT_EQ(decode(stream.get(), second.data(), size), status);
  if (status == TKS_OK) {
    EXPECT_TRUE(first == second);
  } else {
    EXPECT_TRUE(second == std::vector<std::byte>(size, std::byte{0xa5}));
    EXPECT_STRNE(tks_message(stream.get()), "");
  }
}

void expectSoundMesh(const Stream& stream, tks_mesh_kind kind) {
  tks_mesh mesh = {};
  if (tks_decode_mesh(stream.get(), kind, 40, &mesh) == TKS_OK) {
    const uint64_t samples = uint64_t{stream.info().width} * stream.info().height;
    for (uint32_t i = 0; i < mesh.vertex_count; ++i) EXPECT_LT(mesh.grid_index[i], samples);
    for (uint32_t i = 0; i < 3 * mesh.triangle_count; ++i) {
      EXPECT_LT(mesh.triangles[i], mesh.vertex_count);
    }
  } else {
    EXPECT_EQ(mesh.vertex_count, 0u);
    EXPECT_EQ(mesh.triangles, nullptr);
  }
  tks_free_mesh(&mesh);
}

/// Returns whether the damaged bytes still open.
bool expectCleanReturn(Prefix bytes) {
  const tks_limits limits = smallLimits();
  const Stream stream(bytes, &limits);
  if (stream.status() != TKS_OK) {
    EXPECT_EQ(stream.get(), nullptr);
    EXPECT_FALSE(stream.message().empty());
    return false;
  }
  if (stream.info().has_heights) {
    expectAllOrNothing(stream, tks_decode_heights, stream.heightsBytes());
    expectSoundMesh(stream, TKS_MESH_CODED);
    expectSoundMesh(stream, TKS_MESH_BUDGET);
  }
  if (stream.info().has_texture) {
    expectAllOrNothing(stream, tks_decode_texture, stream.textureBytes());
  }
  tks_verify(stream.get());
  return true;
}

/// With the header's checksum as it was, and repaired. Some damage must pass for a stream.
void expectSurvivesEveryDamagedByte(const Bytes& bytes) {
  const size_t header = static_cast<size_t>(Stream(bytes).info().header_bytes);
  size_t opened = 0;
  for (size_t at = 0; at < bytes.size(); ++at) {
    for (const int flip : {0x01, 0x10, 0x80, 0xff}) {
      SCOPED_TRACE("byte " + std::to_string(at) + " xor " + std::to_string(flip));
      Bytes damaged = bytes;
      damaged[at] = static_cast<uint8_t>(damaged[at] ^ flip);
      opened += expectCleanReturn(damaged);
      if (at >= header) continue;
      sealHeader(damaged);
      opened += expectCleanReturn(damaged);
    }
  }
  EXPECT_GT(opened, bytes.size() - header);
}

TEST(StreamCorruption, EveryByteOfHeights) {
  const Raster heights = make({Pattern::kRidges, 13, 9, 1, TKS_I16});
  expectSurvivesEveryDamagedByte(encode(&heights, nullptr, lossless()));
}

TEST(StreamCorruption, EveryByteOfTexture) {
  const Raster image = make({Pattern::kRidges, 9, 8, 4, TKS_U8});
  expectSurvivesEveryDamagedByte(encode(nullptr, &image, lossless()));
}

TEST(StreamCorruption, EveryByteOfCutout) {
  Raster image = make({Pattern::kRidges, 9, 8, 4, TKS_U8});
  samples::cutOut(image, samples::validity(samples::VoidShape::kCoast, 9, 8));
  for (const tks_encode_options& options : {lossless(), budget(200)}) {
    const Bytes bytes = encode(nullptr, &image, options);
    ASSERT_NE(Stream(bytes).info().texture_cutout, 0);
    expectSurvivesEveryDamagedByte(bytes);
  }
}

TEST(StreamCorruption, EveryByteOfJointIndexedStream) {
  const Raster heights = make({Pattern::kSteps, 11, 10, 1, TKS_F32});
  const Raster image = make({Pattern::kRidges, 7, 9, 3, TKS_U16});
  tks_encode_options options = lossless();
  options.index = 1;
  expectSurvivesEveryDamagedByte(encode(&heights, &image, options));
}

/// Header of one stream, payload of noise.
TEST(StreamCorruption, NoiseBehindTheHeader) {
  const Raster heights = make({Pattern::kRidges, 20, 15, 1, TKS_I16});
  const Raster image = make({Pattern::kRidges, 12, 11, 3, TKS_U8});
  const Bytes bytes = encode(&heights, &image, lossless());
  const size_t header = static_cast<size_t>(Stream(bytes).info().header_bytes);
  for (uint32_t seed = 0; seed < 200; ++seed) {
    Bytes noise = bytes;
    for (size_t at = header; at < noise.size(); ++at) {
      noise[at] = static_cast<uint8_t>(samples::hash(static_cast<uint32_t>(at), 0, seed));
    }
    SCOPED_TRACE("seed " + std::to_string(seed));
    expectCleanReturn(noise);
  }
}

TEST(StreamCorruption, NoiseIsNoStream) {
  for (uint32_t size = 0; size < 300; ++size) {
    Bytes noise(size);
    for (uint32_t at = 0; at < size; ++at) {
      noise[at] = static_cast<uint8_t>(samples::hash(at, size, 99));
    }
    EXPECT_FALSE(expectCleanReturn(noise));
  }
}

/// Streams that promise something: any damage is found, and what they hold decodes all the same.
TEST(Verify, FindsEveryDamagedByteBehindTheHeader) {
  const Raster ridges = make({Pattern::kRidges, 40, 30, 1, TKS_I16, 5});
  const Raster photograph = make({Pattern::kRidges, 20, 30, 3, TKS_U8, 5});
  tks_encode_options windows = inRegions(lossless());
  windows.index = TKS_INDEX_WINDOWS;
  for (const tks_encode_options& options : {lossless(), within(3), windows}) {
    const Bytes bytes = encode(&ridges, &photograph, options);
    const Stream whole(bytes);
    EXPECT_EQ(tks_verify(whole.get()), TKS_OK) << tks_message(whole.get());
    for (size_t i = whole.info().header_bytes; i < bytes.size(); ++i) {
      Bytes damaged = bytes;
      damaged[i] ^= static_cast<uint8_t>(1u << i % 8);
      const Stream stream(damaged);
      if (stream.status() == TKS_CORRUPT) continue;
      EXPECT_EQ(tks_verify(stream.get()), TKS_CORRUPT) << i;
      EXPECT_STRNE(tks_message(stream.get()), "");
    }
  }
}

}  // namespace
}  // namespace tetrakis::test

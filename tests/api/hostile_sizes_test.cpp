// SPDX-License-Identifier: Apache-2.0
// Streams of a few bytes that declare the largest planes there are: they open, windows and levels
// of what was never sent take next to nothing, and the rest is refused before it is allocated.
#include <functional>

#include "bitstream/stream/header.hpp"
#include "tests/support/allocation_count.hpp"
#include "tests/support/hostile_streams.hpp"
#include "tests/support/stream_fixture.hpp"

namespace tetrakis::test {
namespace {

constexpr uint64_t kLimit = uint64_t{256} << 20;

tks_limits limitsOf(uint64_t memory) {
  tks_limits limits = {};
  limits.size = sizeof limits;
  limits.max_samples = limits.max_texels = uint64_t{1} << 32;
  limits.max_memory = memory;
  return limits;
}

/// The coarsest level that fits into a small array.
uint32_t levelFor(uint32_t width, uint32_t height) {
  uint32_t level = 0;
  while ((uint64_t{width} >> level) * (uint64_t{height} >> level) > 1 << 16) ++level;
  return level;
}

TEST(HostileSizes, OpenInNoMemory) {
  const tks_limits limits = limitsOf(kLimit);
  for (const HostileStream& hostile : hostileStreams()) {
    EXPECT_LT(hostile.bytes.size(), 256u) << hostile.name;
    const uint64_t peak = peakBytes([&] {
      Stream stream(hostile.bytes, &limits);
      EXPECT_EQ(stream.status(), TKS_OK) << hostile.name << stream.message();
      tks_verify(stream.get());
    });
    EXPECT_LT(peak, 64u << 10) << hostile.name;
  }
}

/// Whatever is asked stays within the limit: done or refused.
TEST(HostileSizes, AnswerWithinTheLimit) {
  const tks_limits limits = limitsOf(kLimit);
  for (const HostileStream& hostile : hostileStreams()) {
    Stream stream(hostile.bytes, &limits);
    ASSERT_EQ(stream.status(), TKS_OK) << hostile.name << stream.message();
    const auto expectBounded = [&](const std::function<tks_status()>& call) {
      tks_status status = TKS_OK;
      EXPECT_LE(peakBytes([&] { status = call(); }), kLimit) << hostile.name;
      EXPECT_TRUE(status == TKS_OK || status == TKS_LIMIT)
          << hostile.name << ": " << tks_message(stream.get());
      EXPECT_TRUE(status == TKS_LIMIT || !hostile.sent) << hostile.name;
    };
    const tks_info& info = stream.info();
    const tks_window window = {1000, 1000, 8, 8};
    std::vector<float> heights(64);
    std::vector<uint64_t> texels(64);
    tks_mesh mesh = {};
    if (info.has_heights) {
      expectBounded([&] {
        return tks_decode_surface_window(stream.get(), &window, heights.data(), heights.size());
      });
      expectBounded([&] { return tks_decode_mesh(stream.get(), TKS_MESH_CODED, 0, &mesh); });
      const uint32_t level = levelFor(info.width, info.height);
      EXPECT_EQ(tks_set_levels(stream.get(), level, 0), TKS_OK);
      std::vector<float> coarse(size_t{(info.width - 1) >> level} + 1);
      coarse.resize(coarse.size() * (((info.height - 1) >> level) + 1));
      // A level of a drawing takes no more than its samples.
      const bool drawn = hostile.name.starts_with("heights drawn,");
      expectBounded([&] {
        const tks_status status = tks_decode_surface(stream.get(), coarse.data(), coarse.size());
        return drawn && status == TKS_OK ? TKS_LIMIT : status;
      });
    }
    if (info.has_texture) {
      const size_t bytes = 64 * info.texture_channels * tks_sample_bytes(info.texture_sample);
      expectBounded(
          [&] { return tks_decode_texture_window(stream.get(), &window, texels.data(), bytes); });
    }
  }
}

/// A few bytes declare more regions than memory holds: they open, and no call lists them.
TEST(HostileSizes, RegionsBeyondMemoryAreNotListed) {
  tks_limits limits = limitsOf(kLimit);
  limits.max_samples = uint64_t{1} << 40;
  StreamHeader header;
  GeometryHeader& heights = header.geometry.emplace();
  heights.width = heights.height = 1 << 20;
  heights.regions.side_log2 = 4;
  heights.planes = 8;
  header.payload_bytes = 4;
  Bytes bytes = writeHeader(header);
  bytes.insert(bytes.end(), {4, 0, 0, 77});  // a byte of the base
  Stream stream(bytes, &limits);
  ASSERT_EQ(stream.status(), TKS_OK) << stream.message();
  const tks_window window = {1000, 1000, 8, 8};
  std::vector<float> samples(64);
  tks_status status = TKS_OK;
  const uint64_t peak = peakBytes([&] {
    status = tks_decode_surface_window(stream.get(), &window, samples.data(), samples.size());
  });
  EXPECT_EQ(status, TKS_LIMIT) << tks_message(stream.get());
  EXPECT_LT(peak, 1u << 20);
}

/// Everything of a plane of which nothing was sent looks as at any other size.
TEST(HostileSizes, UnsentPlanesAreAllAlike) {
  for (const HostileStream& hostile : hostileStreams(100, 70)) {
    if (hostile.sent) continue;
    Stream stream(hostile.bytes);
    ASSERT_EQ(stream.status(), TKS_OK) << hostile.name << stream.message();
    const auto expectAlike = [&](const std::vector<std::byte>& samples, size_t step) {
      for (size_t i = step; i < samples.size(); ++i)
        ASSERT_EQ(samples[i], samples[i - step]) << hostile.name << " at " << i;
    };
    expectAlike(stream.heights(), tks_sample_bytes(stream.info().sample));
    expectAlike(stream.texture(),
                stream.info().texture_channels * tks_sample_bytes(stream.info().texture_sample));
  }
}

}  // namespace
}  // namespace tetrakis::test

// SPDX-License-Identifier: Apache-2.0
// Any prefix decodes, and quality does not fall when bytes are added: never at packet ends, by at
// most 0.03 dB inside a packet. Tested at every byte of small streams.
#include <cmath>
#include <limits>

#include "tests/stream_fixture.hpp"

namespace tetrakis::test {
namespace {

using samples::make;
using samples::Pattern;
using samples::Raster;

/// 10 log10(kDip) = 0.03 dB.
constexpr double kDip = 1.006931668851804;

/// One prefix: its squared errors and whether it ends between packets.
struct Step {
  size_t bytes = 0;
  bool packet_end = false;
  double heights = 0, texture = 0;
};

/// Every prefix from the header's end on. The last prefix before another packet begins, head and
/// all, decodes to what the packets before it hold.
std::vector<Step> walk(const Bytes& bytes, const Raster* heights, const Raster* image) {
  const Stream whole(bytes);
  EXPECT_EQ(whole.status(), TKS_OK) << whole.message();
  std::vector<Step> steps;
  uint64_t packets = 0;
  for (size_t size = whole.info().header_bytes; size <= bytes.size(); ++size) {
    Stream stream(Prefix(bytes).first(size));
    EXPECT_EQ(stream.status(), TKS_OK) << size << " bytes: " << stream.message();
    if (stream.status() != TKS_OK) break;
    if (!steps.empty()) steps.back().packet_end = stream.info().packets > packets;
    packets = stream.info().packets;
    steps.push_back({size, size == bytes.size(),
                     heights ? squaredError(*heights, stream.heights()) : 0,
                     image ? squaredError(*image, stream.texture()) : 0});
  }
  return steps;
}

/// Errors in the order of the prefixes never break the promise. `track` is Step::heights or
/// texture.
void expectNoFall(const std::vector<Step>& steps, double Step::*track) {
  double best = std::numeric_limits<double>::infinity();
  double best_end = best;
  double deepest = 1;
  size_t where = 0;
  for (const Step& step : steps) {
    const double error = step.*track;
    if (step.packet_end) {
      EXPECT_LE(error, best_end) << "at the packet end after " << step.bytes << " bytes";
      best_end = std::min(best_end, error);
    }
    if (error > best * deepest) {
      deepest = error / best;
      where = step.bytes;
    }
    best = std::min(best, error);
  }
  EXPECT_LE(deepest, kDip) << "a dip of " << 10 * std::log10(deepest) << " dB after " << where
                           << " of " << steps.back().bytes << " bytes";
}

void expectProgress(const Raster* heights, const Raster* image, const tks_encode_options& options) {
  const Bytes bytes = encode(heights, image, options);
  ASSERT_FALSE(bytes.empty());
  const std::vector<Step> steps = walk(bytes, heights, image);
  ASSERT_FALSE(steps.empty());
  size_t ends = 0;
  for (const Step& step : steps) ends += step.packet_end;
  EXPECT_GE(ends, 2u);
  if (heights) expectNoFall(steps, &Step::heights);
  if (image) expectNoFall(steps, &Step::texture);
  if (options.lossless) {
    EXPECT_EQ(steps.back().heights, 0);
    EXPECT_EQ(steps.back().texture, 0);
  }
}

TEST(StreamPrefix, HeightsImproveAtEveryByte) {
  const Raster ridges = make({Pattern::kRidges, 33, 33, 1, TKS_I16});
  expectProgress(&ridges, nullptr, lossless());
  const Raster metres = make({Pattern::kRidges, 21, 34, 1, TKS_F32});
  expectProgress(&metres, nullptr, lossless());
  const Raster steps = make({Pattern::kSteps, 29, 17, 1, TKS_U8});
  expectProgress(&steps, nullptr, lossless());
}

TEST(StreamPrefix, TextureImprovesAtEveryByte) {
  const Raster colour = make({Pattern::kRidges, 24, 24, 3, TKS_U8});
  expectProgress(nullptr, &colour, lossless());
  const Raster grey = make({Pattern::kSteps, 31, 20, 1, TKS_U8});
  expectProgress(nullptr, &grey, lossless());
}

TEST(StreamPrefix, JointStreamImprovesAtEveryByte) {
  const Raster heights = make({Pattern::kRidges, 33, 33, 1, TKS_I16});
  const Raster image = make({Pattern::kRidges, 24, 24, 3, TKS_U8});
  expectProgress(&heights, &image, budget(1800));
}

/// Too few bytes for the header: TKS_TRUNCATED with the number of bytes that it takes.
TEST(StreamPrefix, ShortHeaderSaysWhatItNeeds) {
  const Raster heights = make({Pattern::kRidges, 9, 9, 1, TKS_I16});
  const Bytes bytes = encode(&heights, nullptr, lossless());
  const size_t header = static_cast<size_t>(Stream(bytes).info().header_bytes);
  ASSERT_GT(header, 8u);
  for (size_t size = 0; size < header; ++size) {
    const Stream stream(Prefix(bytes).first(size));
    EXPECT_EQ(stream.status(), TKS_TRUNCATED) << size << " bytes: " << stream.message();
    EXPECT_NE(stream.message().find_first_of("0123456789"), std::string::npos);
  }
  EXPECT_EQ(Stream(Prefix(bytes).first(header)).status(), TKS_OK);
}

/// What a stream says of itself at the header's end, inside, and at its own end.
TEST(StreamPrefix, InfoFollowsTheBytes) {
  const Raster heights = make({Pattern::kRidges, 33, 33, 1, TKS_I16});
  const Raster image = make({Pattern::kRidges, 24, 24, 3, TKS_U8});
  const Bytes bytes = encode(&heights, &image, lossless());
  const size_t header = static_cast<size_t>(Stream(bytes).info().header_bytes);
  for (size_t size = header; size <= bytes.size(); size += 13) {
    const Stream stream(Prefix(bytes).first(size));
    const tks_info& info = stream.info();
    EXPECT_EQ(info.available_bytes, size);
    EXPECT_EQ(info.stream_bytes, bytes.size());
    EXPECT_EQ(info.header_bytes, header);
    EXPECT_LE(info.geometry_bytes + info.texture_bytes, size - header);
    EXPECT_EQ(tks_verify(stream.get()), size == bytes.size() ? TKS_OK : TKS_TRUNCATED);
  }
}

/// The errors that packets state are those of the decoded samples, rounded up to an eighth of an
/// octave, without the original at hand.
TEST(StreamPrefix, StatedErrorsAreTrue) {
  const double kStep = std::exp2(1.0 / 8) * (1 + 1e-9);
  const Raster heights = make({Pattern::kRidges, 65, 65, 1, TKS_I16});
  const Raster image = make({Pattern::kRidges, 64, 64, 3, TKS_U8});
  const Bytes bytes = encode(&heights, &image, lossless());
  int stated = 0;
  for (const Step& step : walk(bytes, &heights, &image)) {
    if (!step.packet_end) continue;
    const Stream stream(Prefix(bytes).first(step.bytes));
    SCOPED_TRACE("after " + std::to_string(step.bytes) + " bytes");
    if (const double rmse = stream.info().heights_rmse; rmse >= 0) {
      const double measured = std::sqrt(step.heights / (65 * 65));
      EXPECT_GE(rmse * (1 + 1e-9), measured);
      EXPECT_LE(rmse, measured * kStep);
      ++stated;
    }
    if (const double psnr = stream.info().texture_psnr; psnr >= 0 && step.texture > 0) {
      const double rmse = 255 / std::pow(10, psnr / 20);
      const double measured = std::sqrt(step.texture / (64 * 64 * 3));
      EXPECT_GE(rmse * (1 + 1e-9), measured);
      EXPECT_LE(rmse, measured * kStep);
      ++stated;
    }
  }
  EXPECT_GE(stated, 4);
  EXPECT_EQ(Stream(bytes).info().heights_rmse, 0);
  EXPECT_TRUE(std::isinf(Stream(bytes).info().texture_psnr));
}

}  // namespace
}  // namespace tetrakis::test

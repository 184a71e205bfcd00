// SPDX-License-Identifier: Apache-2.0
// Any prefix decodes, and quality does not fall when bytes are added: never at packet ends, by at
// most 0.03 dB inside a packet. Tested at every byte of small streams.
#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/support/stream_fixture.hpp"

namespace tetrakis::test {
namespace {

using samples::make;
using samples::Pattern;
using samples::Raster;

/// 10 log10(kDip) = 0.03 dB.
constexpr double kDip = 1.006931668851804;
/// 0.06 dB: what falls is an error that the encoder did not weigh.
constexpr double kVisualDip = 1.0139;

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
void expectNoFall(const std::vector<Step>& steps, double Step::*track, double deepest_dip) {
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
  EXPECT_LE(deepest, deepest_dip) << "a dip of " << 10 * std::log10(deepest) << " dB after "
                                  << where << " of " << steps.back().bytes << " bytes";
}

void expectProgress(const Bytes& bytes, const Raster* heights, const Raster* image,
                    const tks_encode_options& options) {
  ASSERT_FALSE(bytes.empty());
  const std::vector<Step> steps = walk(bytes, heights, image);
  ASSERT_FALSE(steps.empty());
  size_t ends = 0;
  for (const Step& step : steps) ends += step.packet_end;
  EXPECT_GE(ends, 2u);
  const double dip = options.weights == TKS_WEIGHTS_VISUAL ? kVisualDip : kDip;
  if (heights) expectNoFall(steps, &Step::heights, dip);
  if (image) expectNoFall(steps, &Step::texture, dip);
  if (options.lossless) {
    EXPECT_EQ(steps.back().heights, 0);
    EXPECT_EQ(steps.back().texture, 0);
  }
}

void expectProgress(const Raster* heights, const Raster* image, const tks_encode_options& options) {
  expectProgress(encode(heights, image, options), heights, image, options);
}

TEST(StreamPrefix, HeightsImproveAtEveryByte) {
  const Raster ridges = make({Pattern::kRidges, 33, 33, 1, TKS_I16});
  expectProgress(&ridges, nullptr, lossless());
  const Raster metres = make({Pattern::kRidges, 21, 34, 1, TKS_F32});
  expectProgress(&metres, nullptr, lossless());
  const Raster steps = make({Pattern::kSteps, 29, 17, 1, TKS_U8});
  expectProgress(&steps, nullptr, lossless());
}

/// Where the encoder no longer looks at every byte.
TEST(StreamPrefix, LargerTexturesImproveAtEveryByte) {
  const Raster colour = make({Pattern::kRidges, 45, 38, 3, TKS_U8, 3});
  expectProgress(nullptr, &colour, lossless());
  tks_encode_options visual = budget(1000);
  visual.weights = TKS_WEIGHTS_VISUAL;
  expectProgress(nullptr, &colour, visual);
}

/// A drawing, of three colours, of a few samples more than the encoder measures closely
/// (kSmallSamples). Each decoder of a drawing begins with models of a megabyte, so that larger ones
/// take long.
TEST(StreamPrefix, DrawingsImproveAtEveryByte) {
  Raster drawing = make({Pattern::kSteps, 76, 72, 3, TKS_U8, 3});
  for (size_t i = 0; i < drawing.data.size(); i += 3) {
    const auto third = std::to_integer<uint32_t>(drawing.data[i]) * 3 / 256;
    for (uint32_t c = 0; c < 3; ++c) drawing.data[i + c] = std::byte(third * (60 + 20 * c));
  }
  const Bytes bytes = encode(nullptr, &drawing, lossless());
  ASSERT_TRUE(Stream(bytes).info().texture_drawn);
  expectProgress(bytes, nullptr, &drawing, lossless());
}

/// In larger planes as well bytes of the last bit-plane count as they come, and the inverse rounds
/// in time: errors fall to nothing without a cliff.
TEST(StreamPrefix, LosslessHeightsHaveNoCliffBeforeTheLastByte) {
  Raster coast = make({Pattern::kRidges, 200, 180, 1, TKS_U8});
  for (std::byte& height : coast.data) height = std::max(height, std::byte{120});
  for (const Raster& heights : {make({Pattern::kRidges, 200, 180, 1, TKS_I16}),
                                make({Pattern::kRidges, 200, 180, 1, TKS_U8}), coast}) {
    const Bytes bytes = encode(&heights, nullptr, lossless());
    const auto errorWithout = [&](size_t missing) {
      Stream stream(Prefix(bytes).first(bytes.size() - missing));
      return squaredError(heights, stream.heights());
    };
    const double before = errorWithout(bytes.size() / 32);
    EXPECT_LT(errorWithout(bytes.size() / 128), before * 0.7);
    EXPECT_LT(errorWithout(bytes.size() / 512), before * 0.2);
  }
}

/// The last bytes of a photograph are of its finest level, and each of few texels.
TEST(StreamPrefix, LosslessTexturesHaveNoCliffBeforeTheLastByte) {
  const Raster image = make({Pattern::kRidges, 240, 200, 3, TKS_U8});
  const Bytes bytes = encode(nullptr, &image, lossless());
  const auto errorWithout = [&](size_t missing) {
    Stream stream(Prefix(bytes).first(bytes.size() - missing));
    return squaredError(image, stream.texture());
  };
  EXPECT_LT(errorWithout(bytes.size() / 512), errorWithout(bytes.size() / 32) * 0.15);
  EXPECT_LT(errorWithout(bytes.size() / 4096), errorWithout(bytes.size() / 32) * 0.03);
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

/// How far the errors that packets state are from those measured: extremes of measured / stated.
struct Honesty {
  double low = std::numeric_limits<double>::infinity(), high = 0;
  size_t low_at = 0, high_at = 0;
  int stated = 0;

  void add(double measured, double rmse, size_t bytes) {
    ++stated;
    if (measured / rmse < low) low = measured / rmse, low_at = bytes;
    if (measured / rmse > high) high = measured / rmse, high_at = bytes;
  }
  /// Stated errors are rounded up to an eighth of an octave: not less than measured, not much more.
  void expectTrue() const {
    EXPECT_GE(stated, 3);
    EXPECT_LE(high, 1 + 1e-9) << "after " << high_at << " bytes";
    EXPECT_GE(low, std::exp2(-1.0 / 8) * (1 - 1e-9)) << "after " << low_at << " bytes";
  }
};

/// Bytes of the prefixes that end between packets; the last is the whole stream.
std::vector<size_t> packetEnds(const Bytes& bytes) {
  std::vector<size_t> ends;
  uint64_t packets = 0;
  for (size_t size = Stream(bytes).info().header_bytes; size <= bytes.size(); ++size) {
    const uint64_t now = Stream(Prefix(bytes).first(size)).info().packets;
    if (now > packets) ends.push_back(size - 1);
    packets = now;
  }
  ends.push_back(bytes.size());
  return ends;
}

/// A reader knows the error of a prefix without the original.
TEST(StreamPrefix, StatedErrorsAreTrue) {
  const Raster heights = make({Pattern::kRidges, 65, 65, 1, TKS_I16});
  const Raster image = make({Pattern::kRidges, 64, 64, 3, TKS_U8});
  const Bytes bytes = encode(&heights, &image, lossless());
  Honesty of_heights, of_texture;
  for (const size_t end : packetEnds(bytes)) {
    Stream stream(Prefix(bytes).first(end));
    const double h = std::sqrt(squaredError(heights, stream.heights()) / (65 * 65));
    const double t = std::sqrt(squaredError(image, stream.texture()) / (64 * 64 * 3));
    const double rmse = stream.info().heights_rmse, psnr = stream.info().texture_psnr;
    if (rmse > 0) of_heights.add(h, rmse, end);
    if (psnr >= 0 && psnr < HUGE_VAL) of_texture.add(t, 255 / std::pow(10, psnr / 20), end);
    EXPECT_TRUE(rmse != 0 || h == 0) << "after " << end << " bytes";
    EXPECT_TRUE(psnr < HUGE_VAL || t == 0) << "after " << end << " bytes";
  }
  of_heights.expectTrue();
  of_texture.expectTrue();
  EXPECT_EQ(Stream(bytes).info().heights_rmse, 0);
  EXPECT_EQ(Stream(bytes).info().texture_psnr, HUGE_VAL);
}

/// Of planes that are too large to measure every prefix: what rounding loses counts, too.
TEST(StreamPrefix, StatedErrorsOfLargePlanesAreNotTooSmall) {
  const Raster heights = make({Pattern::kRidges, 150, 140, 1, TKS_I16});
  const Raster image = make({Pattern::kRidges, 90, 80, 3, TKS_U8});
  for (const uint32_t side : {1u, 64u}) {
    const double most = side == 1 ? 1.35 : 1.7;  // fewer points of tracks together are measured
    tks_encode_options options = lossless();
    options.regions = side;
    const Bytes bytes = encode(&heights, &image, options);
    for (size_t part = 4; part < 40; part += 3) {
      Stream stream(Prefix(bytes).first(bytes.size() * part / 40));
      const double h = std::sqrt(squaredError(heights, stream.heights()) / (150 * 140));
      const double t = std::sqrt(squaredError(image, stream.texture()) / (90 * 80 * 3));
      const double psnr = stream.info().texture_psnr;
      EXPECT_LE(h, most * stream.info().heights_rmse) << part << ", regions of " << side;
      EXPECT_LE(t, most * 255 / std::pow(10, psnr / 20)) << part << ", regions of " << side;
    }
  }
}

/// Root mean square over the samples that are not nodata.
double groundError(const std::vector<float>& truth, Stream& stream, float nodata) {
  const std::vector<std::byte> bytes = stream.heights();
  std::vector<float> decoded(truth.size());
  EXPECT_EQ(bytes.size(), decoded.size() * sizeof(float));
  std::memcpy(decoded.data(), bytes.data(), bytes.size());
  double sum = 0, count = 0;
  for (size_t i = 0; i < truth.size(); ++i) {
    if (truth[i] == nodata) continue;
    sum += std::pow(double{truth[i]} - double{decoded[i]}, 2);
    ++count;
  }
  return std::sqrt(sum / count);
}

/// What rounding to a bound leaves is stated, and samples that are void count in nothing.
TEST(StreamPrefix, StatedErrorsOfBoundsAndStepsAreTrue) {
  constexpr float kNodata = -9999;
  constexpr uint32_t kSide = 150;
  std::vector<float> samples(size_t{kSide} * kSide);
  for (size_t i = 0; i < samples.size(); ++i) {
    const double x = double(i % kSide), y = double(i / kSide);
    const double rough = double(i * 2654435761U % 1000) / 1e4;
    samples[i] = x + y < 100 ? kNodata
                             : static_cast<float>(90 * std::sin(x / 19) * std::cos(y / 23) + rough);
  }
  tks_heights heights = {};
  heights.size = sizeof heights;
  heights.width = heights.height = kSide;
  heights.sample = TKS_F32;
  heights.data = samples.data();
  heights.scale = 1;
  heights.has_nodata = 1;
  heights.nodata = double{kNodata};
  for (const double bound : {0.003, 0.02, 0.3, 4.0}) {
    for (const uint32_t side : {1u, 64u}) {
      Stream stream(encodeHeights(heights, inRegions(within(bound), side)));
      const double truth = groundError(samples, stream, kNodata),
                   stated = stream.info().heights_rmse;
      EXPECT_LE(truth, 1.01 * stated) << bound << ", regions of " << side;
      EXPECT_GE(1.2 * truth, stated) << bound << ", regions of " << side;
    }
  }
  heights.step = 0.5;
  tks_encode_options sharp = lossless();
  sharp.lossless = 0;
  sharp.psnr = 55;
  Stream stream(encodeHeights(heights, sharp));
  EXPECT_LE(groundError(samples, stream, kNodata), 1.01 * stream.info().heights_rmse);
}

}  // namespace
}  // namespace tetrakis::test

// SPDX-License-Identifier: Apache-2.0
// Streams in regions, through the C interface: they restore, they may be cut anywhere, and windows
// hold what the whole holds there.
#include <cmath>

#include "conformance/samples/header_seal.hpp"
#include "conformance/samples/void_masks.hpp"
#include "tests/support/peak_memory.hpp"
#include "tests/support/stream_fixture.hpp"
#include "tests/support/window_checks.hpp"

namespace tetrakis::test {
namespace {

using samples::make;
using samples::Pattern;
using samples::Raster;

/// 16-bit heights of which some are void.
struct Coast {
  explicit Coast(samples::VoidShape shape) : raster(make({Pattern::kRidges, 70, 45, 1, TKS_I16})) {
    const auto valid = samples::validity(shape, 70, 45);
    const int16_t nodata = -7;
    for (size_t i = 0; i < valid.size(); ++i)
      if (!valid[i]) std::memcpy(raster.data.data() + 2 * i, &nodata, sizeof nodata);
  }
  tks_heights heights() const {
    tks_heights h = raster.heights();
    h.has_nodata = 1;
    h.nodata = -7;
    return h;
  }
  Raster raster;
};

/// Coefficients that a camera does not look at come later; windows know nothing of that.
TEST(RegionStream, WindowsFitWhereCamerasWereTold) {
  const tks_camera corner = {nullptr, {-300, 3000, -200}, {-300, 0, -200}, {0, 0, -1}, 10, 128, 128,
                             1};
  const Raster surface = make({Pattern::kRidges, 71, 50, 1, TKS_U8});
  const Raster picture = make({Pattern::kRidges, 60, 80, 3, TKS_U8});
  for (const uint32_t side : {1u, 16u, 32u}) {
    for (tks_encode_options options : {lossless(), budget(2500)}) {
      options.regions = side;
      const Bytes alike = encode(&surface, &picture, options);
      options.cameras = &corner;
      options.camera_count = 1;
      const Bytes told = encode(&surface, &picture, options);
      EXPECT_NE(told, alike);
      expectWindows(told);
      if (options.lossless == 0) continue;
      Stream stream(told);
      EXPECT_EQ(stream.heights(), surface.data);
      EXPECT_EQ(stream.texture(), picture.data);
    }
  }
}

TEST(RegionStream, RestoresAndItsWindowsFit) {
  for (const tks_sample sample : {TKS_U8, TKS_I16, TKS_U32, TKS_F32}) {
    for (const auto& [width, height] : {std::pair{24u, 24u}, {50u, 35u}, {130u, 5u}}) {
      const Raster heights = make({Pattern::kRidges, width, height, 1, sample});
      for (const uint32_t side : {16u, 32u}) {
        const Bytes bytes = encode(&heights, nullptr, inRegions(lossless(), side));
        Stream stream(bytes);
        EXPECT_TRUE(stream.heights() == heights.data);
        EXPECT_TRUE(stream.info().lossless);
        EXPECT_EQ(stream.info().regions, width >= side + side / 2 ? side : 0);
        EXPECT_EQ(tks_verify(stream.get()), TKS_OK);
        expectWindows(bytes);
      }
    }
  }
}

/// Of drawings the encoder decodes every prefix, and each decoder begins with models of a megabyte:
/// small planes of many regions.
TEST(RegionStream, CutOutsOverlaysAndDrawings) {
  constexpr uint32_t kWidth = 53, kHeight = 40;
  for (const uint32_t channels : {2u, 4u}) {
    for (const tks_encode_options& options : {lossless(), budget(1100)}) {
      Raster cut = make({Pattern::kRidges, kWidth, kHeight, channels, TKS_U8, 5});
      samples::cutOut(cut, samples::validity(samples::VoidShape::kCoast, kWidth, kHeight));
      expectWindows(encode(nullptr, &cut, inRegions(options)));
      Raster holes = make({Pattern::kRidges, kWidth, kHeight, channels, TKS_U8, 5});
      samples::cutOut(holes, samples::validity(samples::VoidShape::kHoles, kWidth, kHeight));
      expectWindows(encode(nullptr, &holes, inRegions(options)));
      Raster drawn_over = make({Pattern::kRidges, kWidth, kHeight, channels, TKS_U8, 5});
      samples::drawOver(drawn_over, samples::validity(samples::VoidShape::kCoast, kWidth, kHeight));
      expectWindows(encode(nullptr, &drawn_over, inRegions(options)));
      const Raster drawing = make({Pattern::kSteps, kWidth, kHeight, channels, TKS_U8, 5});
      expectWindows(encode(nullptr, &drawing, inRegions(options)));
      if (HasFatalFailure()) return;
    }
  }
}

TEST(RegionStream, VoidsAndCorrections) {
  for (const samples::VoidShape shape : samples::kVoidShapes) {
    const Coast coast(shape);
    const Bytes bytes = encodeHeights(coast.heights(), inRegions(lossless()));
    EXPECT_TRUE(Stream(bytes).heights() == coast.raster.data);
    expectWindows(bytes);
    expectWindows(encodeHeights(coast.heights(), inRegions(budget(1500))));
  }
  Raster thirds = make({Pattern::kRidges, 60, 50, 1, TKS_F32});
  for (size_t i = 0; i < 3000; ++i) {
    float v;
    std::memcpy(&v, thirds.data.data() + 4 * i, 4);
    v /= 3;
    std::memcpy(thirds.data.data() + 4 * i, &v, 4);
  }
  const Bytes bytes = encode(&thirds, nullptr, inRegions(lossless()));
  EXPECT_TRUE(Stream(bytes).heights() == thirds.data);
  expectWindows(bytes);
}

/// Most regions hold nothing but zeros, and sums of squares beside them need not come out as 0.
TEST(RegionStream, RestoresPlanesOfWhichMostIsFlat) {
  for (const tks_sample sample : {TKS_I16, TKS_F32}) {
    Raster raster = make({Pattern::kFlat, 64, 64, 1, sample});
    const Raster detail = make({Pattern::kExtreme, 13, 12, 1, TKS_U8});
    for (size_t i = 0; i < detail.data.size(); ++i) {
      const auto value = std::to_integer<int16_t>(detail.data[i]);
      const auto third = static_cast<float>(value) / 3;
      std::byte* at = raster.data.data() + (i / 13 * 64 + i % 13) * tks_sample_bytes(sample);
      if (sample == TKS_I16) std::memcpy(at, &value, sizeof value);
      if (sample == TKS_F32) std::memcpy(at, &third, sizeof third);
    }
    const Bytes bytes = encode(&raster, nullptr, inRegions(lossless()));
    EXPECT_TRUE(Stream(bytes).heights() == raster.data);
  }
}

TEST(RegionStream, MeetsItsTargets) {
  const Raster heights = make({Pattern::kRidges, 90, 70, 1, TKS_I16});
  const Raster image = make({Pattern::kRidges, 80, 100, 3, TKS_U8, 7});
  tks_encode_options psnr = inRegions(budget(0)), bound = psnr;
  psnr.psnr = 40;
  bound.max_error = 300;
  Stream good(encode(&heights, &image, psnr));
  const double mse = squaredError(heights, good.heights()) / (90 * 70);
  double low = 1e9, high = -1e9;
  for (size_t i = 0; i < 90 * 70; ++i) {
    low = std::min(low, sampleAt(heights.data, TKS_I16, i));
    high = std::max(high, sampleAt(heights.data, TKS_I16, i));
  }
  EXPECT_GE(10 * std::log10((high - low) * (high - low) / mse), 40);
  EXPECT_GE(10 * std::log10(255 * 255 / (squaredError(image, good.texture()) / (80 * 100 * 3))),
            40);
  const Bytes bounded = encode(&heights, nullptr, bound);
  EXPECT_LE(largestError(heights, Stream(bounded).heights()), 300);
  expectWindows(bounded);
  const Raster steep = make({Pattern::kRidges, 64, 64, 1, TKS_U16});
  bound.max_error = 1500;
  bound.regions = 1;
  expectWindows(encode(&steep, nullptr, bound));  // corrections of steps
  for (const uint64_t bytes : {600u, 3000u, 9000u}) {
    const Bytes cut = encode(&heights, &image, inRegions(budget(bytes)));
    EXPECT_LE(cut.size(), bytes);
    EXPECT_GT(cut.size(), bytes - 200);
    expectWindows(cut);
  }
}

TEST(RegionStream, BytesDoNotDependOnThreads) {
  const Raster heights = make({Pattern::kRidges, 50, 44, 1, TKS_I16});
  const Raster image = make({Pattern::kRidges, 30, 40, 3, TKS_U8, 7});
  for (tks_encode_options options : {lossless(), budget(2500)}) {
    for (const uint32_t side : {1u, 16u}) {
      options.threads = 1;
      const Bytes one = encode(&heights, &image, inRegions(options, side));
      for (const uint32_t threads : {2u, 5u}) {
        options.threads = threads;
        EXPECT_TRUE(encode(&heights, &image, inRegions(options, side)) == one);
        Stream a(one), b(one);
        tks_set_threads(b.get(), threads);
        EXPECT_TRUE(a.heights() == b.heights());
        EXPECT_TRUE(a.texture() == b.texture());
      }
    }
  }
}

/// Every prefix decodes; a prefix is never noticeably worse than a shorter one, down to an error of
/// one step, where the last bits of all regions have to come together.
TEST(RegionStream, ImprovesAtEveryByte) {
  const Raster heights = make({Pattern::kRidges, 41, 33, 1, TKS_I16});
  const Bytes bytes = encode(&heights, nullptr, inRegions(lossless()));
  double best = HUGE_VAL, deepest = 1;
  for (size_t size = Stream(bytes).info().header_bytes; size <= bytes.size(); ++size) {
    Stream stream(Prefix(bytes).first(size));
    ASSERT_EQ(stream.status(), TKS_OK);
    const double error = squaredError(heights, stream.heights());
    if (best > 41 * 33) deepest = std::max(deepest, error / best);
    best = std::min(best, error);
    EXPECT_EQ(tks_verify(stream.get()), size == bytes.size() ? TKS_OK : TKS_TRUNCATED);
  }
  EXPECT_EQ(best, 0);
  EXPECT_LE(10 * std::log10(deepest), 0.03);
}

/// Regions cost little: tracks of 256 samples, each with models of its own, against one track.
TEST(RegionStream, CostsLittle) {
  const Raster heights = make({Pattern::kRidges, 513, 513, 1, TKS_U16});
  const auto bytes = [&](uint32_t side) {
    return static_cast<double>(encode(&heights, nullptr, inRegions(lossless(), side)).size());
  };
  EXPECT_LT(bytes(256) / bytes(1), 1.01);
  EXPECT_LT(bytes(64) / bytes(1), 1.08);
}

TEST(RegionStream, RefusesWindowsThatAreNone) {
  const Raster heights = make({Pattern::kRidges, 40, 30, 1, TKS_I16});
  const Bytes bytes = encode(&heights, nullptr, inRegions(lossless()));
  const Stream stream(bytes);
  std::vector<std::byte> out(2 * 40 * 30);
  const auto status = [&](const tks_window& w) {
    return tks_decode_heights_window(stream.get(), &w, out.data(), size_t{2} * w.width * w.height);
  };
  EXPECT_EQ(status({0, 0, 40, 30}), TKS_OK);
  for (const tks_window& w : {tks_window{0, 0, 0, 5},
                              {0, 0, 5, 0},
                              {0, 0, 41, 1},
                              {39, 0, 2, 1},
                              {0, 29, 1, 2},
                              {0xffffffff, 0, 2, 1},
                              {1, 1, 0xffffffff, 1}}) {
    EXPECT_EQ(status(w), TKS_USAGE);
    EXPECT_STRNE(tks_message(stream.get()), "");
  }
  const tks_window w{0, 0, 4, 4};
  EXPECT_EQ(tks_decode_heights_window(stream.get(), &w, out.data(), 31), TKS_USAGE);
  EXPECT_EQ(tks_decode_heights_window(stream.get(), &w, nullptr, 32), TKS_USAGE);
  EXPECT_EQ(tks_decode_heights_window(stream.get(), nullptr, out.data(), 32), TKS_USAGE);
  EXPECT_EQ(tks_decode_heights_window(nullptr, &w, out.data(), 32), TKS_USAGE);
  EXPECT_EQ(tks_decode_texture_window(stream.get(), &w, out.data(), 16), TKS_USAGE);
  EXPECT_EQ(tks_decode_heights_window(stream.get(), &w, out.data(), 32), TKS_OK);
  ASSERT_EQ(tks_set_levels(stream.get(), 1, 0), TKS_OK);
  EXPECT_EQ(status({16, 11, 4, 4}), TKS_OK);
  EXPECT_EQ(status({17, 11, 4, 4}), TKS_USAGE);
  EXPECT_EQ(tks_set_threads(nullptr, 1), TKS_USAGE);
}

TEST(RegionStream, RefusesSidesThatAreNone) {
  const Raster heights = make({Pattern::kRidges, 40, 30, 1, TKS_I16});
  const tks_heights h = heights.heights();
  for (const uint32_t side : {2u, 8u, 15u, 17u, 48u, 1u << 21}) {
    const tks_encode_options options = inRegions(lossless(), side);
    tks_buffer buffer = {};
    EXPECT_EQ(tks_encode(&h, nullptr, &options, &buffer, nullptr, 0), TKS_USAGE) << side;
  }
}

/// Large planes get regions, others and those with a largest error none.
TEST(RegionStream, AreChosenForLargePlanes) {
  const Raster small = make({Pattern::kRamp, 1025, 1025, 1, TKS_U8}),
               large = make({Pattern::kRamp, 1100, 1025, 1, TKS_U8});
  EXPECT_EQ(Stream(encode(&small, nullptr, lossless())).info().regions, 0u);
  EXPECT_EQ(Stream(encode(&large, nullptr, lossless())).info().regions, 512u);
  tks_encode_options bound = budget(0);
  bound.max_error = 1;
  EXPECT_EQ(Stream(encode(&large, nullptr, bound)).info().regions, 512u);
}

/// With and without the checksum repaired: nothing crashes, and windows come out or do not.
TEST(RegionStream, SurvivesEveryDamagedByte) {
  const Raster heights = make({Pattern::kRidges, 26, 7, 1, TKS_I16});
  const Raster image = make({Pattern::kSteps, 24, 5, 1, TKS_U8});
  tks_encode_options options = inRegions(lossless());
  options.index = 1;
  const Bytes bytes = encode(&heights, &image, options);
  const tks_limits limits = smallLimits();
  size_t opened = 0;
  for (size_t at = 0; at < bytes.size(); ++at) {
    for (const int flip : {0x01, 0x90}) {
      Bytes damaged = bytes;
      damaged[at] = static_cast<uint8_t>(damaged[at] ^ flip);
      sealHeader(damaged);
      Stream stream(damaged, &limits);
      if (stream.status() != TKS_OK) continue;
      ++opened;
      stream.heights();
      stream.texture();
      const tks_window w{13, 1, 9, 5};
      std::vector<std::byte> out(9 * 5 * 4);
      tks_decode_heights_window(stream.get(), &w, out.data(),
                                45 * tks_sample_bytes(stream.info().sample));
      tks_verify(stream.get());
    }
  }
  EXPECT_GT(opened, bytes.size());
}

/// However many regions a header declares, opening it takes no memory for them that the limits do
/// not grant.
TEST(RegionStream, OpeningTakesNoMemoryThatHeadersDeclare) {
  const Raster heights = make({Pattern::kFlat, 200, 140, 1, TKS_I16});
  const Bytes bytes = encode(&heights, nullptr, inRegions(lossless()));
  const size_t header = static_cast<size_t>(Stream(bytes).info().header_bytes);
  tks_limits limits = {};
  limits.size = sizeof limits;
  limits.max_samples = 1 << 20;
  const size_t before = peakMemory();
  size_t refused = 0, opened = 0;
  for (size_t at = 6; at < header; ++at) {
    for (const int value : {0x00, 0x04, 0x05, 0x14, 0x7f, 0x80, 0xff}) {
      for (uint8_t level = 0; level < 12; ++level) {
        Bytes damaged = bytes;
        damaged[at] = static_cast<uint8_t>(value);
        damaged[6] = level;
        sealHeader(damaged);
        const tks_status status = Stream(damaged, &limits).status();
        refused += status == TKS_LIMIT;
        opened += status == TKS_OK;
      }
    }
  }
  EXPECT_GT(refused, 0u) << "some of these declare more than the limits";
  EXPECT_GT(opened, 0u);
  // Sanitizers keep what was freed for a while; a million regions would take far more.
  EXPECT_LT(peakMemory() - before, size_t{64} << 20);
}

}  // namespace
}  // namespace tetrakis::test

// SPDX-License-Identifier: Apache-2.0
// Streams of several frames: lossless and bounded ones keep every sample of every frame, prefixes
// show all frames, and damage is safe.
#include <algorithm>
#include <limits>

#include "conformance/samples/void_masks.hpp"
#include "tests/support/moving_frames.hpp"

namespace tetrakis::test {
namespace {

using samples::Pattern;
using samples::Recipe;
using samples::VoidShape;

constexpr tks_sample kTypes[] = {TKS_U8, TKS_I8, TKS_U16, TKS_I16, TKS_U32, TKS_I32, TKS_F32};

TEST(Frames, HeightsOfEveryTypeComeBack) {
  for (const tks_sample sample : kTypes) {
    for (const Pattern pattern : {Pattern::kRidges, Pattern::kFlat, Pattern::kNoise}) {
      const FrameRasters frames = movingFrames({pattern, 37, 29, 1, sample}, 5);
      Stream stream(encodeFrames(heightsOf(frames), {}, lossless()));
      ASSERT_EQ(stream.status(), TKS_OK);
      EXPECT_EQ(stream.info().frames, 5u);
      EXPECT_EQ(stream.info().lossless, 1);
      expectHeights(stream, frames);
    }
  }
}

TEST(Frames, AnyNumberOfThemAndAnySizeComesBack) {
  const std::pair<uint32_t, uint32_t> sizes[] = {{1, 1}, {2, 7}, {5, 1}, {64, 33}};
  for (uint32_t count = 2; count <= TKS_MOST_FRAMES; ++count) {
    const auto [width, height] = sizes[count % 4];
    const FrameRasters frames = movingFrames({Pattern::kHills, width, height, 1, TKS_I16}, count);
    Stream stream(encodeFrames(heightsOf(frames), {}, lossless()));
    ASSERT_EQ(stream.status(), TKS_OK);
    EXPECT_EQ(stream.info().frames, count);
    expectHeights(stream, frames);
  }
}

TEST(Frames, TexturesOfEveryKindComeBack) {
  for (const tks_sample sample : {TKS_U8, TKS_U16}) {
    for (uint32_t channels = 1; channels <= 4; ++channels) {
      const FrameRasters frames = movingFrames({Pattern::kRidges, 41, 30, channels, sample}, 6);
      Stream stream(encodeFrames({}, imagesOf(frames), lossless()));
      ASSERT_EQ(stream.status(), TKS_OK);
      expectTexels(stream, frames);
    }
  }
}

TEST(Frames, HeightsAndTextureShareAStream) {
  const FrameRasters heights = movingFrames({Pattern::kRidges, 40, 40, 1, TKS_I16}, 4);
  const FrameRasters images = movingFrames({Pattern::kHills, 64, 64, 3, TKS_U8}, 4);
  Stream whole(encodeFrames(heightsOf(heights), imagesOf(images), lossless()));
  expectHeights(whole, heights);
  expectTexels(whole, images);
  const Bytes cut = encodeFrames(heightsOf(heights), imagesOf(images), budget(6000));
  EXPECT_LE(cut.size(), 6000u);
  Stream stream{Prefix(cut)};
  EXPECT_GT(stream.info().geometry_bytes, 0u);
  EXPECT_GT(stream.info().texture_bytes, 0u);
}

TEST(Frames, RegionsWindowsAndLevelsShowWhatTheWholeFrameShows) {
  const FrameRasters frames = movingFrames({Pattern::kRidges, 90, 70, 1, TKS_I16}, 5);
  const FrameRasters images = movingFrames({Pattern::kHills, 90, 70, 3, TKS_U8}, 5);
  const Bytes bytes = encodeFrames(heightsOf(frames), imagesOf(images), inRegions(lossless()));
  Stream stream{Prefix(bytes)};
  expectHeights(stream, frames);
  expectTexels(stream, images);
  const tks_window window = {33, 21, 18, 11};
  for (size_t t = 0; t < frames.size(); ++t) {
    showFrame(stream, t);
    std::vector<int16_t> part(size_t{window.width} * window.height);
    ASSERT_EQ(tks_decode_heights_window(stream.get(), &window, part.data(), 2 * part.size()),
              TKS_OK);
    for (uint32_t y = 0; y < window.height; ++y) {
      for (uint32_t x = 0; x < window.width; ++x) {
        const size_t at = size_t{window.y + y} * 90 + window.x + x;
        ASSERT_EQ(part[size_t{y} * window.width + x], sampleAt(frames[t].data, TKS_I16, at));
      }
    }
  }
  ASSERT_EQ(tks_set_levels(stream.get(), 1, 0), TKS_OK);
  std::vector<int16_t> half(45 * 35);
  showFrame(stream, 3);
  ASSERT_EQ(tks_decode_heights(stream.get(), half.data(), 2 * half.size()), TKS_OK);
  double error = 0;
  for (size_t i = 0; i < half.size(); ++i) {
    const size_t at = i / 45 * 2 * 90 + i % 45 * 2;
    error += std::abs(half[i] - sampleAt(frames[3].data, TKS_I16, at));
  }
  EXPECT_LT(error / static_cast<double>(half.size()), 4000);  // a smoothed frame, not another one
}

/// Frames whose voids have a shape of their own each.
struct HoledFrames {
  FrameRasters rasters;
  std::vector<std::vector<uint8_t>> valid;

  std::vector<tks_heights> heights() const {
    std::vector<tks_heights> all = heightsOf(rasters);
    for (tks_heights& h : all) {
      h.has_nodata = 1;
      h.nodata = -32768;
    }
    return all;
  }
};

HoledFrames holed(uint32_t width, uint32_t height, uint32_t frames) {
  constexpr VoidShape kShapes[] = {VoidShape::kCoast, VoidShape::kHoles, VoidShape::kCoast,
                                   VoidShape::kHalf,  VoidShape::kAll,   VoidShape::kOneVoid};
  HoledFrames out{movingFrames({Pattern::kRidges, width, height, 1, TKS_I16}, frames), {}};
  for (uint32_t t = 0; t < frames; ++t) {
    out.valid.push_back(samples::validity(kShapes[t % 6], width, height));
    auto* const data = reinterpret_cast<int16_t*>(out.rasters[t].data.data());
    for (size_t i = 0; i < out.valid[t].size(); ++i) {
      if (out.valid[t][i] == 0)
        data[i] = -32768;
      else if (data[i] == -32768)
        data[i] = -32767;
    }
  }
  return out;
}

TEST(Frames, EachHasItsOwnVoids) {
  for (const uint32_t count : {2u, 6u, 9u}) {
    const HoledFrames frames = holed(43, 35, count);
    Stream stream(encodeFrames(frames.heights(), {}, lossless()));
    ASSERT_EQ(stream.status(), TKS_OK);
    expectHeights(stream, frames.rasters);
    for (size_t t = 0; t < count; ++t) {
      showFrame(stream, t);
      EXPECT_EQ(stream.validity(), frames.valid[t]) << "frame " << t;
    }
  }
}

TEST(Frames, MasksThatStayCostTwoDecisionsAFrame) {
  const auto bytes_of = [](uint32_t count) {
    FrameRasters frames(count, samples::make({Pattern::kFlat, 64, 64, 1, TKS_I16}));
    const std::vector<uint8_t> valid = samples::validity(VoidShape::kHoles, 64, 64);
    for (samples::Raster& frame : frames)
      for (size_t i = 0; i < valid.size(); ++i)
        if (valid[i] == 0) std::memset(frame.data.data() + 2 * i, 0, 2);
    std::vector<tks_heights> heights = heightsOf(frames);
    for (tks_heights& h : heights) h.has_nodata = 1;
    return encodeFrames(heights, {}, lossless()).size();
  };
  EXPECT_LE(bytes_of(32), bytes_of(2) + 64);
}

TEST(Frames, EverySampleKeepsTheLargestError) {
  for (const tks_sample sample : {TKS_U8, TKS_I16, TKS_F32}) {
    for (const double error : {0.5, 3.0, 40.0}) {
      const FrameRasters frames = movingFrames({Pattern::kRidges, 48, 40, 1, sample}, 7);
      Stream stream(encodeFrames(heightsOf(frames), {}, within(error)));
      ASSERT_EQ(stream.status(), TKS_OK);
      EXPECT_EQ(stream.info().max_error, error);
      for (size_t t = 0; t < frames.size(); ++t) {
        showFrame(stream, t);
        EXPECT_LE(largestError(frames[t], stream.heights()), error) << "frame " << t;
      }
    }
  }
}

TEST(Frames, ALargestErrorGivesTexturesTheBytesThatSuitTheHeights) {
  const FrameRasters frames = movingFrames({Pattern::kRidges, 48, 40, 1, TKS_I16}, 5);
  const FrameRasters images = movingFrames({Pattern::kRidges, 64, 64, 3, TKS_U8}, 5);
  const std::vector<tks_image> all = imagesOf(images);
  double before = 0;
  for (const double error : {1.0, 10.0, 100.0}) {
    const std::vector<tks_heights> heights = heightsOf(frames);
    Stream stream(encodeFrames(heights, all, within(error)));
    ASSERT_EQ(stream.status(), TKS_OK);
    double squares = 0;
    for (size_t t = 0; t < frames.size(); ++t) {
      showFrame(stream, t);
      EXPECT_LE(largestError(frames[t], stream.heights()), error) << "frame " << t;
      squares += squaredError(images[t], stream.texture());
    }
    EXPECT_GT(squares, before) << error;
    before = squares;
  }
  const FrameRasters flat(3, samples::make({Pattern::kFlat, 20, 20, 1, TKS_I16}));
  const FrameRasters over(3, samples::make({Pattern::kRidges, 20, 20, 3, TKS_U8}));
  Stream stream(encodeFrames(heightsOf(flat), imagesOf(over), within(1)));
  ASSERT_EQ(stream.status(), TKS_OK);
  EXPECT_LE(squaredError(over.front(), stream.texture()), 20 * 20 * 3.);
}

TEST(Frames, WhatStandsStillTakesBytesOnce) {
  const FrameRasters still(8, samples::make({Pattern::kRidges, 64, 64, 1, TKS_I16}));
  const size_t one = encode(&still.front(), nullptr, lossless()).size();
  EXPECT_LT(encodeFrames(heightsOf(still), {}, lossless()).size(), one + one / 4);
}

TEST(Frames, FloatsWithABaseForEachFrameAreExact) {
  FrameRasters frames = movingFrames({Pattern::kHills, 40, 30, 1, TKS_F32}, 6);
  for (size_t t = 0; t < frames.size(); ++t) {
    auto* const data = reinterpret_cast<float*>(frames[t].data.data());
    for (size_t i = 0; i < 40 * 30; ++i)
      data[i] = static_cast<float>(static_cast<int>(data[i]) * 0.0625 + 271 + 0.001 * double(t));
  }
  Stream stream(encodeFrames(heightsOf(frames), {}, lossless()));
  ASSERT_EQ(stream.status(), TKS_OK);
  expectHeights(stream, frames);
}

TEST(Frames, APsnrIsReached) {
  const FrameRasters frames = movingFrames({Pattern::kRidges, 64, 64, 3, TKS_U8}, 8);
  tks_encode_options options = {};
  options.size = sizeof options;
  options.psnr = 38;
  Stream stream(encodeFrames({}, imagesOf(frames), options));
  double squares = 0;
  for (size_t t = 0; t < frames.size(); ++t) {
    showFrame(stream, t);
    squares += squaredError(frames[t], stream.texture());
  }
  const double mean = squares / (64. * 64 * 3 * 8);
  EXPECT_GE(10 * std::log10(255 * 255 / mean), 38);
}

double errorOf(Prefix bytes, const HoledFrames* heights, const FrameRasters* images) {
  Stream stream(bytes);
  EXPECT_EQ(stream.status(), TKS_OK) << stream.message();
  double squares = 0;
  for (size_t t = 0; t < stream.info().frames; ++t) {
    showFrame(stream, t);
    if (heights != nullptr) squares += squaredError(heights->rasters[t], stream.heights());
    if (images != nullptr) squares += squaredError((*images)[t], stream.texture());
  }
  return squares;
}

TEST(Frames, EveryPrefixDecodesAndMoreBytesShowMore) {
  const FrameRasters images = movingFrames({Pattern::kRidges, 24, 20, 3, TKS_U8}, 4);
  const Bytes bytes = encodeFrames({}, imagesOf(images), lossless());
  const Stream whole{Prefix(bytes)};
  double best = std::numeric_limits<double>::infinity(), last = best;
  uint64_t packets = 0;
  for (size_t size = whole.info().header_bytes; size <= bytes.size(); ++size) {
    const Stream stream(Prefix(bytes).first(size));
    if (stream.info().packets > packets) {
      EXPECT_LE(last, best) << "at the packet end after " << size - 1 << " bytes";
      best = std::min(best, last);
    }
    packets = stream.info().packets;
    last = errorOf(Prefix(bytes).first(size), nullptr, &images);
  }
  EXPECT_EQ(last, 0);
}

TEST(Frames, EveryPrefixOfHeightsWithVoidsDecodes) {
  const HoledFrames frames = holed(20, 18, 5);
  const Bytes bytes = encodeFrames(frames.heights(), {}, lossless());
  const Stream whole{Prefix(bytes)};
  for (size_t size = whole.info().header_bytes; size <= bytes.size(); ++size)
    errorOf(Prefix(bytes).first(size), &frames, nullptr);
  EXPECT_EQ(errorOf(bytes, &frames, nullptr), 0);
}

TEST(Frames, AppendedBytesShowWhatTheWholeShows) {
  const HoledFrames frames = holed(33, 26, 5);
  const Bytes bytes = encodeFrames(frames.heights(), {}, inRegions(lossless()));
  const Stream whole{Prefix(bytes)};
  Stream growing(Prefix(bytes).first(whole.info().header_bytes));
  for (size_t size = whole.info().header_bytes; size < bytes.size(); size += 97) {
    const size_t more = std::min<size_t>(97, bytes.size() - size);
    ASSERT_EQ(tks_append(growing.get(), bytes.data() + size, more), TKS_OK);
    Stream fresh(Prefix(bytes).first(size + more));
    for (const size_t t : {size_t{0}, size / 97 % 5}) {
      showFrame(growing, t);
      showFrame(fresh, t);
      ASSERT_TRUE(sameBytes(growing.heights(), fresh.heights())) << size << ", frame " << t;
    }
  }
}

TEST(Frames, DamageIsSafe) {
  const HoledFrames frames = holed(17, 15, 4);
  const FrameRasters images = movingFrames({Pattern::kHills, 16, 16, 3, TKS_U8}, 4);
  const Bytes good = encodeFrames(frames.heights(), imagesOf(images), lossless());
  const tks_limits limits = smallLimits();
  for (size_t i = 0; i < good.size(); ++i) {
    for (const uint8_t flip : {uint8_t{1}, uint8_t{0x80}, uint8_t{0xff}}) {
      Bytes bad = good;
      bad[i] ^= flip;
      Stream stream(Prefix(bad), &limits);
      if (stream.status() != TKS_OK) continue;
      const uint32_t last = stream.info().frames - 1;
      showFrame(stream, last);
      stream.heights();
      stream.texture();
    }
  }
}

TEST(Frames, UnlikeFramesAreRefusedWithASentence) {
  FrameRasters frames = movingFrames({Pattern::kHills, 20, 20, 1, TKS_I16}, 2);
  frames.push_back(samples::make({Pattern::kHills, 20, 21, 1, TKS_I16}));
  const std::vector<tks_heights> heights = heightsOf(frames);
  tks_buffer buffer = {};
  char message[256] = "";
  const tks_encode_options options = lossless();
  EXPECT_EQ(tks_encode_frames(heights.data(), nullptr, 3, &options, &buffer, message, 256),
            TKS_USAGE);
  EXPECT_NE(std::string(message).find("size"), std::string::npos);
  EXPECT_EQ(tks_encode_frames(heights.data(), nullptr, 1, &options, &buffer, message, 256),
            TKS_USAGE);
  Stream stream(encodeFrames({heights[0], heights[1]}, {}, options));
  EXPECT_EQ(tks_set_frame(stream.get(), 2), TKS_USAGE);
}

}  // namespace
}  // namespace tetrakis::test

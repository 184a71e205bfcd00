// SPDX-License-Identifier: Apache-2.0
// Groups that go on from the last frame of the group before: what stands still takes next to no
// bytes, and every frame is what its own group and those before it make of it, in any order.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <string>

#include "tests/support/sequences.hpp"

namespace tetrakis::test {
namespace {

using samples::Pattern;

tks_sequence_options goingOn(const tks_encode_options& encode, uint32_t group,
                             uint64_t reference = TKS_ALL_BYTES, uint32_t entry = 0) {
  tks_sequence_options options = optionsOf(encode, group);
  options.reference = reference;
  options.entry = entry;
  return options;
}

FrameRasters hills(uint32_t count) {
  return movingFrames({Pattern::kHills, 37, 29, 1, TKS_I16}, count);
}

FrameRasters still(const FrameRasters& of, size_t count) {
  return FrameRasters(count, of.front());
}

/// Ground that a rover has seen: a square that grows from the middle; the rest is void.
FrameRasters seenGround(uint32_t count) {
  const samples::Raster ground = samples::make({Pattern::kHills, 33, 26, 1, TKS_I16});
  FrameRasters frames;
  for (uint32_t t = 0; t < count; ++t) {
    samples::Raster frame = ground;
    auto* const data = reinterpret_cast<int16_t*>(frame.data.data());
    const int reach = 4 + static_cast<int>(t);
    for (int y = 0; y < 26; ++y)
      for (int x = 0; x < 33; ++x)
        if (std::abs(x - 14) > reach || std::abs(y - 12) > reach) data[y * 33 + x] = -32768;
    frames.push_back(std::move(frame));
  }
  return frames;
}

EncodedSequence encodeSeen(const FrameRasters& frames, const tks_sequence_options& options) {
  tks_sequence_encoder* encoder = nullptr;
  char message[256] = "";
  EXPECT_EQ(tks_sequence_encoder_open(&options, &encoder, message, 256), TKS_OK) << message;
  EncodedSequence out;
  for (size_t t = 0; t < frames.size(); ++t) {
    tks_heights heights = frames[t].heights();
    heights.has_nodata = 1;
    heights.nodata = -32768;
    EXPECT_EQ(tks_sequence_push(encoder, &heights, nullptr, static_cast<int64_t>(t), message, 256),
              TKS_OK)
        << message;
  }
  EXPECT_EQ(tks_sequence_flush(encoder, message, 256), TKS_OK) << message;
  tks_buffer buffer = {};
  EXPECT_EQ(tks_sequence_take(encoder, &buffer), TKS_OK);
  out.bytes.assign(buffer.data, buffer.data + buffer.size);
  tks_free_buffer(&buffer);
  tks_sequence_encoder_close(encoder);
  return out;
}

TEST(References, FramesComeBackInAnyOrder) {
  const FrameRasters truth = hills(21);
  const tks_encode_options encode = lossless();
  for (const uint32_t group : {1u, 2u, 5u, 16u}) {
    const EncodedSequence encoded = encodeSequence(truth, goingOn(encode, group));
    const EncodedSequence alone = encodeSequence(truth, optionsOf(encode, group));
    EXPECT_LT(encoded.bytes.size(), alone.bytes.size()) << group;
    Sequence sequence{encoded.bytes};
    ASSERT_EQ(sequence.status, TKS_OK) << tks_sequence_message(sequence.get());
    EXPECT_GT(sequence.group(20).depth, 0u);
    for (const uint64_t t : {20, 0, 7, 8, 9, 19, 4, 20, 15, 16, 17})
      EXPECT_TRUE(sameBytes(sequence.heights(t), truth[t].data)) << group << ", frame " << t;
  }
}

TEST(References, WhatStandsStillTakesNextToNoBytes) {
  const FrameRasters truth = still(hills(1), 40);
  const tks_encode_options encode = lossless();
  const EncodedSequence encoded = encodeSequence(truth, goingOn(encode, 1));
  Sequence sequence{encoded.bytes};
  const uint64_t entry = sequence.group(0).stream_bytes;
  for (uint64_t t = 1; t < 40; ++t) {
    const tks_group group = sequence.group(t);
    EXPECT_EQ(group.depth, t % 16) << t;
    if (t % 16 > 0) {
      EXPECT_LT(group.stream_bytes, 64u) << t;
    } else {
      EXPECT_GT(2 * group.stream_bytes, entry) << t;
    }
  }
  EXPECT_TRUE(sameBytes(sequence.heights(39), truth[39].data));
}

TEST(References, EveryGroupLeadsBackToItsEntry) {
  const FrameRasters truth = hills(14);
  const tks_encode_options encode = lossless();
  const EncodedSequence encoded = encodeSequence(truth, goingOn(encode, 2, TKS_ALL_BYTES, 4));
  Sequence all{encoded.bytes};
  for (uint64_t t = 0; t < 14; ++t) {
    const tks_group group = all.group(t);
    EXPECT_LT(group.depth, 4u);
    const uint64_t from = group.offset - group.bytes_back;
    Sequence part(Prefix(encoded.bytes).subspan(from, group.bytes_back + group.bytes));
    ASSERT_EQ(part.status, TKS_OK);
    EXPECT_EQ(part.info().groups, group.depth + 1);
    EXPECT_TRUE(sameBytes(part.heights(t), truth[t].data)) << t;
  }
}

TEST(References, WhoLosesAGroupIsRightAgainAtTheNextEntry) {
  const FrameRasters truth = hills(16);
  const tks_encode_options encode = lossless();
  const EncodedSequence encoded = encodeSequence(truth, goingOn(encode, 2, TKS_ALL_BYTES, 4));
  Sequence all{encoded.bytes};
  for (uint64_t lost = 0; lost < 16; lost += 2) {
    const tks_group gap = all.group(lost);
    Bytes rest = encoded.bytes;
    rest.erase(rest.begin() + static_cast<ptrdiff_t>(gap.offset),
               rest.begin() + static_cast<ptrdiff_t>(gap.offset + gap.bytes));
    Sequence sequence{rest};
    ASSERT_EQ(sequence.status, TKS_OK) << tks_sequence_message(sequence.get());
    for (uint64_t t = 0; t < 16; ++t) {
      const tks_group group = all.group(t);
      const bool needs_it =
          group.offset >= gap.offset && group.offset - group.bytes_back <= gap.offset;
      tks_decoder* decoder = nullptr;
      const tks_status status = tks_sequence_frame(sequence.get(), t, &decoder);
      if (group.offset == gap.offset) {
        EXPECT_EQ(status, TKS_USAGE) << t;
      } else if (needs_it) {
        EXPECT_EQ(status, TKS_TRUNCATED) << t;
        EXPECT_NE(std::string(tks_sequence_message(sequence.get())).find("not there"),
                  std::string::npos);
      } else {
        EXPECT_TRUE(sameBytes(sequence.heights(t), truth[t].data)) << t;
      }
    }
  }
}

TEST(References, AStreamAloneIsASentence) {
  const FrameRasters truth = hills(4);
  const tks_encode_options encode = lossless();
  const EncodedSequence encoded = encodeSequence(truth, goingOn(encode, 2));
  Sequence sequence{encoded.bytes};
  const tks_group group = sequence.group(3);
  ASSERT_GT(group.depth, 0u);
  tks_decoder* decoder = nullptr;
  char message[256] = "";
  EXPECT_EQ(tks_open(encoded.bytes.data() + group.stream_offset, group.stream_bytes, nullptr,
                     &decoder, message, sizeof message),
            TKS_UNSUPPORTED);
  EXPECT_NE(std::string(message).find("sequence"), std::string::npos);
}

TEST(References, VoidsThatAreFilledLaterComeBack) {
  const FrameRasters truth = seenGround(15);
  const tks_encode_options encode = lossless();
  const EncodedSequence encoded = encodeSeen(truth, goingOn(encode, 3));
  EXPECT_LT(encoded.bytes.size(), encodeSeen(truth, optionsOf(encode, 3)).bytes.size());
  Sequence sequence{encoded.bytes};
  for (uint64_t t = 0; t < 15; ++t) EXPECT_TRUE(sameBytes(sequence.heights(t), truth[t].data)) << t;
}

TEST(References, OfTexturesAndOfBoth) {
  const FrameRasters heights = hills(7);
  for (const uint32_t channels : {1u, 3u, 4u}) {
    const FrameRasters textures = movingFrames({Pattern::kHills, 24, 31, channels, TKS_U8}, 7);
    const tks_encode_options encode = lossless();
    const tks_sequence_options options = goingOn(encode, 2);
    for (const FrameRasters& beside : {FrameRasters(), heights}) {
      const EncodedSequence encoded = encodeSequence(beside, options, textures);
      const EncodedSequence alone = encodeSequence(beside, optionsOf(encode, 2), textures);
      EXPECT_LT(encoded.bytes.size(), alone.bytes.size());
      Sequence sequence{encoded.bytes};
      for (const uint64_t t : {6, 1, 2, 3, 4, 5, 0}) {
        EXPECT_TRUE(sameBytes(sequence.texels(t), textures[t].data)) << t;
        if (beside.empty()) continue;
        EXPECT_TRUE(sameBytes(sequence.heights(t), beside[t].data)) << t;
      }
    }
  }
}

TEST(References, LargestErrorsHold) {
  const FrameRasters truth = hills(12);
  for (const double error : {1.0, 4.0}) {
    const tks_encode_options encode = within(error);
    const EncodedSequence encoded = encodeSequence(truth, goingOn(encode, 3));
    Sequence sequence{encoded.bytes};
    for (uint64_t t = 0; t < 12; ++t) {
      const std::vector<std::byte> shown = sequence.heights(t);
      const auto* a = reinterpret_cast<const int16_t*>(shown.data());
      const auto* b = reinterpret_cast<const int16_t*>(truth[t].data.data());
      for (size_t i = 0; i < shown.size() / 2; ++i) ASSERT_LE(std::abs(a[i] - b[i]), error) << t;
    }
  }
}

/// A receiver that has only so many bytes of a frame of each group sees later groups as one does
/// that has all of them.
TEST(References, ReceiversNeedTheStatedBytesAlone) {
  const FrameRasters truth = still(hills(1), 12);
  const tks_encode_options encode = budget(150);
  const EncodedSequence encoded = encodeSequence(truth, goingOn(encode, 4, 60));
  Sequence all{encoded.bytes};
  ASSERT_EQ(all.group(8).depth, 2u);
  const std::vector<std::byte> last = all.heights(11);
  Bytes damaged = encoded.bytes;
  for (const uint64_t first : {0, 4}) {
    const tks_group group = all.group(first);
    const uint64_t known = group.stream_offset + 4 * 60,
                   end = group.stream_offset + group.stream_bytes;
    ASSERT_LT(known, end);
    std::fill(damaged.begin() + static_cast<ptrdiff_t>(known),
              damaged.begin() + static_cast<ptrdiff_t>(end), uint8_t{0});
  }
  Sequence some{damaged};
  EXPECT_EQ(some.heights(11), last);
}

TEST(References, ThinSequencesKeepWhatLaterGroupsGoOnFrom) {
  const FrameRasters truth = still(hills(1), 12);
  const tks_encode_options encode = budget(150);
  const EncodedSequence encoded = encodeSequence(truth, goingOn(encode, 4, 60));
  Sequence all{encoded.bytes};
  tks_buffer buffer = {};
  ASSERT_EQ(tks_sequence_thin(all.get(), 1, &buffer, nullptr, 0), TKS_OK);
  const Bytes thin(buffer.data, buffer.data + buffer.size);
  tks_free_buffer(&buffer);
  EXPECT_LT(thin.size(), encoded.bytes.size());
  Sequence sequence{thin};
  // The last group has nothing behind it, and is its header; its frames are the ones before then.
  EXPECT_EQ(sequence.group(8).depth, 2u);
  EXPECT_EQ(sequence.group(0).stream_bytes, 4u * 60);
  for (const uint64_t frame : {8, 11}) EXPECT_EQ(sequence.heights(frame), sequence.heights(7));
}

TEST(References, WindowsArePartsOfThePlane) {
  const FrameRasters truth = seenGround(9);
  const tks_encode_options encode = lossless();
  const EncodedSequence encoded = encodeSeen(truth, goingOn(encode, 3));
  Sequence sequence{encoded.bytes};
  const std::vector<std::byte> whole = sequence.heights(8);
  tks_decoder* decoder = sequence.decoder(8);
  const tks_window window = {5, 3, 17, 11};
  std::vector<int16_t> part(17 * 11);
  ASSERT_EQ(tks_decode_heights_window(decoder, &window, part.data(), part.size() * 2), TKS_OK);
  const auto* all = reinterpret_cast<const int16_t*>(whole.data());
  for (uint32_t y = 0; y < 11; ++y)
    for (uint32_t x = 0; x < 17; ++x) ASSERT_EQ(part[y * 17 + x], all[(y + 3) * 33 + x + 5]);
}

/// Root of the sum of the squared differences of a coarser level from the samples that it stands
/// for.
double coarseError(Sequence& sequence, uint64_t frame, uint32_t level) {
  const std::vector<std::byte> whole = sequence.heights(frame);
  const auto* all = reinterpret_cast<const int16_t*>(whole.data());
  tks_decoder* const decoder = sequence.decoder(frame);
  EXPECT_EQ(tks_set_levels(decoder, level, 0), TKS_OK);
  const uint32_t width = (32 >> level) + 1, height = (25 >> level) + 1;
  std::vector<int16_t> shown(size_t{width} * height);
  EXPECT_EQ(tks_decode_heights(decoder, shown.data(), shown.size() * 2), TKS_OK);
  double squares = 0;
  for (uint32_t y = 0; y < height; ++y) {
    for (uint32_t x = 0; x < width; ++x) {
      const int16_t sample = all[(y << level) * 33 + (x << level)];
      EXPECT_EQ(shown[y * width + x] == -32768, sample == -32768);
      if (sample == -32768) continue;
      const double error = shown[y * width + x] - sample;
      squares += error * error;
    }
  }
  EXPECT_EQ(tks_set_levels(decoder, 0, 0), TKS_OK);
  return std::sqrt(squares);
}

TEST(References, CoarserLevelsAreNoFartherOff) {
  const FrameRasters truth = seenGround(9);
  const tks_encode_options encode = lossless();
  Sequence going_on{encodeSeen(truth, goingOn(encode, 3)).bytes};
  Sequence alone{encodeSeen(truth, optionsOf(encode, 3)).bytes};
  for (const uint32_t level : {1u, 2u, 3u})
    EXPECT_LT(coarseError(going_on, 8, level), 1.2 * coarseError(alone, 8, level)) << level;
}

TEST(References, MeshesKeepTheShapesOfEarlierGroups) {
  const FrameRasters truth = still(hills(1), 4);
  const tks_encode_options encode = lossless();
  const EncodedSequence encoded = encodeSequence(truth, goingOn(encode, 2));
  Sequence sequence{encoded.bytes};
  std::vector<uint32_t> triangles;
  for (const uint64_t frame : {0, 3}) {
    tks_mesh mesh = {};
    ASSERT_EQ(tks_decode_mesh(sequence.decoder(frame), TKS_MESH_CODED, 0, &mesh), TKS_OK);
    triangles.push_back(mesh.triangle_count);
    tks_free_mesh(&mesh);
  }
  EXPECT_EQ(triangles[0], triangles[1]);
}

TEST(References, ForgettingKeepsWhatLaterFramesGoOnFrom) {
  const FrameRasters truth = hills(20);
  const tks_encode_options encode = lossless();
  const EncodedSequence encoded = encodeSequence(truth, goingOn(encode, 2, TKS_ALL_BYTES, 4));
  Sequence sequence{encoded.bytes};
  for (uint64_t t = 0; t < 20; ++t) {
    EXPECT_TRUE(sameBytes(sequence.heights(t), truth[t].data)) << t;
    ASSERT_EQ(tks_sequence_forget(sequence.get(), t), TKS_OK);
    EXPECT_TRUE(sameBytes(sequence.heights(t), truth[t].data)) << t;
    EXPECT_LE(sequence.info().groups, 10u);
  }
  EXPECT_GE(sequence.info().first_frame, 16u);
}

/// A group that goes on from a lost one keeps as many groups before it as it goes on from. They may
/// begin in the middle of an earlier run: an opened group of that run is given up.
TEST(References, ForgettingBehindALostGroupIsSafe) {
  const FrameRasters truth = hills(8);
  const tks_encode_options encode = lossless();
  const EncodedSequence encoded = encodeSequence(truth, goingOn(encode, 1, TKS_ALL_BYTES, 4));
  const tks_group gap = Sequence{encoded.bytes}.group(5);
  Bytes rest = encoded.bytes;
  rest.erase(rest.begin() + static_cast<ptrdiff_t>(gap.offset),
             rest.begin() + static_cast<ptrdiff_t>(gap.offset + gap.bytes));
  const tks_status expected[] = {TKS_USAGE, TKS_USAGE, TKS_USAGE, TKS_TRUNCATED, TKS_OK};
  for (uint64_t opened = 0; opened < 5; ++opened) {
    Sequence sequence{rest};
    ASSERT_NE(sequence.decoder(opened), nullptr);  // nothing is decoded yet
    ASSERT_EQ(tks_sequence_forget(sequence.get(), 6), TKS_OK);
    EXPECT_EQ(sequence.info().first_frame, 3u);
    tks_decoder* decoder = nullptr;
    EXPECT_EQ(tks_sequence_frame(sequence.get(), opened, &decoder), expected[opened]) << opened;
    EXPECT_EQ(tks_sequence_frame(sequence.get(), 7, &decoder), TKS_TRUNCATED);
    EXPECT_TRUE(sameBytes(sequence.heights(4), truth[4].data));
  }
}

/// Kinds of samples, of which none is known to be kind to differences.
TEST(References, OddFramesComeBack) {
  struct Kind {
    samples::Recipe recipe;
    uint32_t frames;
  };
  const auto lowest = std::numeric_limits<int32_t>::min();
  for (const Kind& kind :
       {Kind{{Pattern::kHills, 1, 1, 1, TKS_U8}, 4}, Kind{{Pattern::kRidges, 1, 40, 1, TKS_U16}, 4},
        Kind{{Pattern::kNoise, 33, 1, 1, TKS_I32}, 4},
        Kind{{Pattern::kNoise, 19, 14, 1, TKS_F32}, 5},
        Kind{{Pattern::kNoise, 16, 16, 1, TKS_U8}, 5}}) {
    FrameRasters frames = movingFrames(kind.recipe, kind.frames);
    const auto all_of = [&](std::byte value) {
      samples::Raster flat = frames.front();
      std::fill(flat.data.begin(), flat.data.end(), value);
      frames.push_back(flat);
    };
    all_of(std::byte{0});  // flat, and as far off as the type goes
    if (kind.recipe.sample == TKS_I32) {
      samples::Raster far = frames.front();
      for (size_t i = 0; i + 4 <= far.data.size(); i += 4)
        std::memcpy(far.data.data() + i, &lowest, 4);
      frames.push_back(far);
    }
    if (kind.recipe.sample != TKS_F32) all_of(std::byte{0x7f});
    frames.push_back(frames.front());
    const tks_encode_options encode = lossless();
    for (const uint32_t group : {1u, 3u}) {
      Sequence sequence{encodeSequence(frames, goingOn(encode, group)).bytes};
      for (uint64_t t = 0; t < frames.size(); ++t)
        EXPECT_TRUE(sameBytes(sequence.heights(t), frames[t].data))
            << kind.recipe.width << " x " << kind.recipe.height << ", frame " << t;
    }
  }
}

/// Nothing is seen, then a little, then nothing again, then all.
TEST(References, FramesWithoutAnythingComeBack) {
  FrameRasters frames = seenGround(4);
  const samples::Raster all = samples::make({Pattern::kHills, 33, 26, 1, TKS_I16});
  samples::Raster none = all;
  const int16_t nodata = -32768;
  for (size_t i = 0; i < none.data.size(); i += 2) std::memcpy(none.data.data() + i, &nodata, 2);
  frames.insert(frames.begin(), none);
  frames.insert(frames.end(), {none, all, none, frames[2]});
  const tks_encode_options encode = lossless();
  for (const uint32_t group : {1u, 2u, 4u}) {
    Sequence sequence{encodeSeen(frames, goingOn(encode, group)).bytes};
    for (uint64_t t = 0; t < frames.size(); ++t)
      EXPECT_TRUE(sameBytes(sequence.heights(t), frames[t].data)) << group << ", frame " << t;
  }
}

TEST(References, DamageIsSafe) {
  const FrameRasters truth = movingFrames({Pattern::kHills, 9, 8, 1, TKS_I16}, 6);
  const tks_encode_options encode = lossless();
  const EncodedSequence encoded = encodeSequence(truth, goingOn(encode, 2));
  for (size_t i = 0; i < encoded.bytes.size(); ++i) {
    Bytes bad = encoded.bytes;
    bad[i] ^= 0x11;
    Sequence sequence{bad};
    const tks_sequence_info info = sequence.info();
    for (uint64_t t = info.first_frame; t < info.end_frame; ++t) {
      tks_decoder* decoder = nullptr;
      if (tks_sequence_frame(sequence.get(), t, &decoder) != TKS_OK) continue;
      std::vector<int16_t> out(72);
      tks_decode_heights(decoder, out.data(), 144);
    }
  }
}

}  // namespace
}  // namespace tetrakis::test

// SPDX-License-Identifier: Apache-2.0
// Sequences: a chain of groups grows, is cut anywhere, and is found by ranges; memory stays that of
// a group.
#include <algorithm>

#include "tests/support/sequences.hpp"

namespace tetrakis::test {
namespace {

using samples::Pattern;

FrameRasters frames(uint32_t count) {
  return movingFrames({Pattern::kHills, 21, 17, 1, TKS_I16}, count);
}

TEST(Sequences, FramesAndTimesComeBack) {
  const FrameRasters truth = frames(11);
  const tks_encode_options encode = lossless();
  for (const uint32_t group : {1u, 3u, 4u, 32u}) {
    const EncodedSequence encoded = encodeSequence(truth, optionsOf(encode, group));
    Sequence sequence{encoded.bytes};
    ASSERT_EQ(sequence.status, TKS_OK) << tks_sequence_message(sequence.get());
    const tks_sequence_info info = sequence.info();
    EXPECT_EQ(info.end_frame, 11u);
    EXPECT_EQ(info.groups, (11 + group - 1) / group);
    EXPECT_EQ(info.whole_bytes, encoded.bytes.size());
    EXPECT_EQ(info.clock.numerator, 3600u);
    EXPECT_EQ(std::string(info.clock.epoch), "2019-03-01T00:00:00Z");
    for (const uint64_t t : {10, 0, 5, 6, 3}) {
      EXPECT_TRUE(sameBytes(sequence.heights(t), truth[t].data)) << "frame " << t;
      int64_t time = 0;
      ASSERT_EQ(tks_sequence_time(sequence.get(), t, &time), TKS_OK);
      EXPECT_EQ(time, encoded.times[t]);
      uint64_t found = 0;
      ASSERT_EQ(tks_sequence_find(sequence.get(), time, &found), TKS_OK);
      EXPECT_EQ(found, t);
    }
    uint64_t found = 1;
    ASSERT_EQ(tks_sequence_find(sequence.get(), -5, &found), TKS_OK);
    EXPECT_EQ(found, 0u);
    ASSERT_EQ(tks_sequence_find(sequence.get(), 1 << 20, &found), TKS_OK);
    EXPECT_EQ(found, 10u);
    EXPECT_EQ(tks_sequence_time(sequence.get(), 11, nullptr), TKS_USAGE);
  }
}

TEST(Sequences, AnyPrefixIsReadToItsEnd) {
  const FrameRasters truth = frames(9);
  const tks_encode_options encode = lossless();
  const EncodedSequence encoded = encodeSequence(truth, optionsOf(encode, 4));
  uint64_t before = 0;
  for (size_t size = 0; size <= encoded.bytes.size(); ++size) {
    Sequence sequence(Prefix(encoded.bytes).first(size));
    ASSERT_EQ(sequence.status, TKS_OK) << size;
    const tks_sequence_info info = sequence.info();
    EXPECT_GE(info.end_frame, before);
    before = info.end_frame;
    EXPECT_LE(info.whole_bytes, size);
    if (info.end_frame > 0) sequence.heights(info.end_frame - 1);
    if (size % 50 != 0 || info.end_frame == 0) continue;
    for (uint64_t t = 0; t + 4 < info.end_frame; ++t)
      EXPECT_TRUE(sameBytes(sequence.heights(t), truth[t].data)) << size << ", frame " << t;
  }
  EXPECT_EQ(before, 9u);
}

TEST(Sequences, BytesMayComeInAnyPieces) {
  const FrameRasters truth = frames(10);
  const tks_encode_options encode = lossless();
  const EncodedSequence encoded = encodeSequence(truth, optionsOf(encode, 4));
  Sequence sequence;
  for (size_t i = 0; i < encoded.bytes.size();) {
    const size_t size = std::min<size_t>(1 + i * 7 % 300, encoded.bytes.size() - i);
    ASSERT_EQ(tks_sequence_append(sequence.get(), encoded.bytes.data() + i, size), TKS_OK);
    i += size;
    const uint64_t end = sequence.info().end_frame;
    if (end > 0) sequence.heights(end - 1);
  }
  for (uint64_t t = 0; t < 10; ++t)
    EXPECT_TRUE(sameBytes(sequence.heights(t), truth[t].data)) << "frame " << t;
}

TEST(Sequences, GroupsKeepTheBytesOfTheirFrames) {
  const FrameRasters truth = frames(16);
  for (const uint64_t bytes : {60u, 150u}) {
    const tks_encode_options encode = budget(bytes);
    const EncodedSequence encoded = encodeSequence(truth, optionsOf(encode, 8));
    Sequence sequence{encoded.bytes};
    for (const uint64_t first : {0, 8}) {
      tks_group group = {};
      group.size = sizeof group;
      ASSERT_EQ(tks_sequence_group(sequence.get(), first, &group), TKS_OK);
      EXPECT_LE(group.bytes, 8 * bytes);
      EXPECT_GE(group.bytes, 8 * bytes - 16);
      EXPECT_EQ(group.first_frame, first);
    }
  }
}

TEST(Sequences, FramesThatShareNoStepAreGroupsOfOne) {
  FrameRasters truth = movingFrames({Pattern::kNoise, 9, 8, 1, TKS_F32}, 3);
  for (samples::Raster& frame : truth) {
    auto* const data = reinterpret_cast<float*>(frame.data.data());
    for (size_t i = 0; i < 72; ++i) data[i] = std::exp(data[i] / 100) * 1e-3f;
  }
  const tks_encode_options encode = lossless();
  const EncodedSequence encoded = encodeSequence(truth, optionsOf(encode, 3));
  Sequence sequence{encoded.bytes};
  EXPECT_EQ(sequence.info().groups, 3u);
  for (uint64_t t = 0; t < 3; ++t) EXPECT_TRUE(sameBytes(sequence.heights(t), truth[t].data));
}

/// Reads a file by ranges: its last bytes, then what tks_sequence_locate() asks for.
struct Found {
  int requests = 1;
  Bytes group;
};

Found find(Prefix file, int by_time, int64_t place, size_t tail) {
  Found found;
  uint64_t end = file.size();
  Prefix bytes = file.last(std::min(tail, file.size()));
  for (int is_group = 0; is_group == 0;) {
    tks_range range = {};
    const tks_status status =
        tks_sequence_locate(bytes.data(), bytes.size(), end, by_time, place, &range, &is_group);
    EXPECT_EQ(status, TKS_OK);
    if (status != TKS_OK || range.offset + range.size > file.size()) return found;
    ++found.requests;
    bytes = file.subspan(range.offset, range.size);
    end = range.offset + range.size;
  }
  found.group.assign(bytes.begin(), bytes.end());
  return found;
}

TEST(Sequences, AnyFrameIsFoundInThreeRequests) {
  const FrameRasters truth = movingFrames({Pattern::kHills, 4, 3, 1, TKS_I16}, 30);
  FrameRasters many;
  for (int i = 0; i < 20; ++i) many.insert(many.end(), truth.begin(), truth.end());
  const tks_encode_options encode = lossless();
  const EncodedSequence encoded = encodeSequence(many, optionsOf(encode, 2));
  for (const size_t cut : {size_t{0}, size_t{1}, size_t{20}}) {
    const Prefix file = Prefix(encoded.bytes).first(encoded.bytes.size() - cut);
    for (uint64_t frame = 0; frame < many.size() - 2; frame += 7) {
      const Found found = find(file, frame % 2, frame % 2 ? encoded.times[frame] : frame, 1000);
      EXPECT_LE(found.requests, 3);
      Sequence sequence{found.group};
      ASSERT_EQ(sequence.status, TKS_OK);
      ASSERT_LE(sequence.info().first_frame, frame);
      ASSERT_GT(sequence.info().end_frame, frame);
      EXPECT_TRUE(sameBytes(sequence.heights(frame), many[frame].data)) << "frame " << frame;
    }
  }
}

TEST(Sequences, WhatIsForgottenTakesNoFrames) {
  const FrameRasters truth = frames(12);
  const tks_encode_options encode = lossless();
  const EncodedSequence encoded = encodeSequence(truth, optionsOf(encode, 4));
  Sequence sequence{encoded.bytes};
  ASSERT_EQ(tks_sequence_forget(sequence.get(), 6), TKS_OK);
  EXPECT_EQ(sequence.info().first_frame, 4u);
  tks_decoder* decoder = nullptr;
  EXPECT_EQ(tks_sequence_frame(sequence.get(), 3, &decoder), TKS_USAGE);
  EXPECT_TRUE(sameBytes(sequence.heights(4), truth[4].data));
}

TEST(Sequences, GoOnBehindWhatWasWritten) {
  const FrameRasters truth = frames(14);
  const tks_encode_options encode = lossless();
  const tks_sequence_options options = optionsOf(encode, 4);
  const EncodedSequence whole = encodeSequence(truth, options);
  const EncodedSequence first = encodeSequence({truth.begin(), truth.begin() + 8}, options);
  Sequence written{first.bytes};
  const EncodedSequence rest =
      encodeSequence({truth.begin() + 8, truth.end()}, options, {}, written.get(), 8);
  Bytes both = first.bytes;
  both.insert(both.end(), rest.bytes.begin(), rest.bytes.end());
  EXPECT_EQ(both, whole.bytes);
}

TEST(Sequences, GoOnBehindWholeGroupsOfTheirOwnKindAlone) {
  const FrameRasters truth = frames(6);
  const tks_encode_options encode = lossless();
  tks_sequence_options options = optionsOf(encode, 2);
  const EncodedSequence encoded = encodeSequence(truth, options);
  const auto refusal = [&](const Sequence& written, uint32_t width) {
    tks_sequence_encoder* encoder = nullptr;
    char message[256] = "";
    EXPECT_EQ(tks_sequence_encoder_open(&options, &encoder, message, 256), TKS_OK);
    tks_status status = tks_sequence_encoder_continue(encoder, written.get(), message, 256);
    const samples::Raster frame = samples::make({Pattern::kHills, width, 17, 1, TKS_I16});
    const tks_heights heights = frame.heights();
    if (status == TKS_OK)
      status = tks_sequence_push(encoder, &heights, nullptr, 1 << 20, message, 256);
    tks_sequence_encoder_close(encoder);
    EXPECT_EQ(status == TKS_OK, std::string(message).empty());
    return status;
  };
  EXPECT_EQ(refusal(Sequence{encoded.bytes}, 21), TKS_OK);
  EXPECT_EQ(refusal(Sequence{encoded.bytes}, 20), TKS_USAGE);
  EXPECT_EQ(refusal(Sequence{Prefix(encoded.bytes).first(encoded.bytes.size() - 1)}, 21),
            TKS_USAGE);
  EXPECT_EQ(refusal(Sequence{}, 21), TKS_USAGE);
  options.clock.denominator = 7;
  EXPECT_EQ(refusal(Sequence{encoded.bytes}, 21), TKS_USAGE);
}

TEST(Sequences, ThinOnesKeepTheirShare) {
  const FrameRasters truth = frames(12);
  const tks_encode_options encode = lossless();
  const EncodedSequence encoded = encodeSequence(truth, optionsOf(encode, 4));
  Sequence all{encoded.bytes};
  for (const uint64_t bytes : {uint64_t{60}, uint64_t{150}, uint64_t{1} << 40}) {
    tks_buffer buffer = {};
    char message[256] = "";
    ASSERT_EQ(tks_sequence_thin(all.get(), bytes, &buffer, message, 256), TKS_OK) << message;
    const Bytes thin(buffer.data, buffer.data + buffer.size);
    tks_free_buffer(&buffer);
    if (bytes > 1000) {
      EXPECT_EQ(thin, encoded.bytes);
    }
    Sequence sequence{thin};
    ASSERT_EQ(sequence.info().end_frame, 12u);
    for (uint64_t t = 0; t < 12; t += 4) EXPECT_LE(sequence.group(t).bytes, 4 * bytes);
    for (uint64_t t = 0; t < 12; ++t) {
      EXPECT_EQ(sequence.heights(t).size(), truth[t].data.size());
      const Found found = find(thin, 0, static_cast<int64_t>(t), 300);
      EXPECT_LE(found.requests, 3);
    }
  }
}

TEST(Sequences, DamageIsSafe) {
  const FrameRasters truth = movingFrames({Pattern::kHills, 9, 8, 1, TKS_I16}, 6);
  const tks_encode_options encode = lossless();
  const EncodedSequence encoded = encodeSequence(truth, optionsOf(encode, 3));
  for (size_t i = 0; i < encoded.bytes.size(); ++i) {
    for (const uint8_t flip : {uint8_t{1}, uint8_t{0x80}}) {
      Bytes bad = encoded.bytes;
      bad[i] ^= flip;
      Sequence sequence{bad};
      const tks_sequence_info info = sequence.info();
      for (uint64_t t = info.first_frame; t < info.end_frame; ++t) {
        tks_decoder* decoder = nullptr;
        if (tks_sequence_frame(sequence.get(), t, &decoder) != TKS_OK) continue;
        std::vector<int16_t> out(72);
        tks_decode_heights(decoder, out.data(), 144);
      }
      tks_range range = {};
      int found = 0;
      tks_sequence_locate(bad.data(), bad.size(), bad.size(), 0, 1, &range, &found);
    }
  }
}

TEST(Sequences, TimesRunForwardsAndFramesAreAlike) {
  const FrameRasters truth = frames(2);
  const tks_encode_options encode = lossless();
  const tks_sequence_options options = optionsOf(encode, 4);
  tks_sequence_encoder* encoder = nullptr;
  char message[256] = "";
  ASSERT_EQ(tks_sequence_encoder_open(&options, &encoder, message, 256), TKS_OK);
  tks_heights heights = truth[0].heights();
  EXPECT_EQ(tks_sequence_push(encoder, &heights, nullptr, 7, message, 256), TKS_OK);
  EXPECT_EQ(tks_sequence_push(encoder, &heights, nullptr, 7, message, 256), TKS_USAGE);
  EXPECT_NE(std::string(message).find("7"), std::string::npos);
  heights.width = 20;
  EXPECT_EQ(tks_sequence_push(encoder, &heights, nullptr, 8, message, 256), TKS_USAGE);
  heights = truth[1].heights();
  EXPECT_EQ(tks_sequence_push(encoder, &heights, nullptr, 9, message, 256), TKS_OK);
  EXPECT_EQ(tks_sequence_flush(encoder, message, 256), TKS_OK);
  tks_sequence_encoder_close(encoder);
}

}  // namespace
}  // namespace tetrakis::test

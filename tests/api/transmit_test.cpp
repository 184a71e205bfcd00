// SPDX-License-Identifier: Apache-2.0
// System control: receivers of any link get from the same groups what helps them, and nothing
// twice, whatever is lost and whoever lies.
#include <algorithm>
#include <bit>
#include <cmath>
#include <random>

#include "bitstream/stream/header.hpp"
#include "tests/support/indexed_terrain.hpp"
#include "tests/support/transmissions.hpp"

namespace tetrakis::test {
namespace {

using samples::Pattern;

FrameRasters hills(uint32_t count) {
  return movingFrames({Pattern::kHills, 70, 60, 1, TKS_I16}, count);
}

FrameRasters smallHills(uint32_t count) {
  return movingFrames({Pattern::kHills, 40, 33, 1, TKS_I16}, count);
}

tks_encode_options indexed(tks_encode_options encode) {
  encode.regions = 16;
  encode.index = TKS_INDEX_PACKETS;
  return encode;
}

struct Coding {
  bool has_index;
  uint64_t reference;
};

/// Groups of two frames, each a second after the one before.
Bytes encodeSeconds(const FrameRasters& frames, const Coding& coding, tks_encode_options encode) {
  if (coding.has_index) encode = indexed(encode);
  tks_sequence_options options = optionsOf(encode, 2);
  options.clock.numerator = 1;
  options.clock.denominator = 3;  // encodeSequence() lets a frame last about 3 ticks
  options.reference = coding.reference;
  options.entry = 4;
  return encodeSequence(frames, options).bytes;
}

class EveryCoding : public ::testing::TestWithParam<Coding> {};

TEST_P(EveryCoding, GivesEveryReceiverAllOfItAndNothingTwice) {
  const FrameRasters truth = smallHills(12);
  Transmitter transmitter = transmitterOf(encodeSeconds(truth, GetParam(), lossless()));
  for (const uint32_t link : {300u, 9000u, 200000u}) {
    Listener listener(link);
    for (uint64_t frame = 0; frame < 12; ++frame) {
      listener.fill(transmitter, wantsOf(frame, link));
      EXPECT_TRUE(sameBytes(listener.heights(frame), truth[frame].data)) << frame;
    }
    for (uint64_t frame = 0; frame < 12; ++frame)
      EXPECT_FALSE(listener.fill(transmitter, wantsOf(frame, link))) << frame;
  }
}

TEST_P(EveryCoding, BringsWhatWasLostAgain) {
  const FrameRasters truth = smallHills(12);
  Transmitter transmitter = transmitterOf(encodeSeconds(truth, GetParam(), lossless()));
  std::mt19937 random(5);
  Listener listener(1);
  for (const uint64_t frame : {0u, 3u, 11u, 5u, 7u, 9u}) {
    for (int quiet = 0; quiet < 3;) {
      const Bytes answer = listener.ask(transmitter, wantsOf(frame, 1500));
      if (random() % 3 == 0) continue;
      listener.take(answer);
      quiet = listener.receiver.info().last_pieces > 0 ? 0 : quiet + 1;
    }
    EXPECT_TRUE(sameBytes(listener.heights(frame), truth[frame].data)) << frame;
  }
}

TEST_P(EveryCoding, LongSilenceLosesNothing) {
  const FrameRasters truth = smallHills(4);
  Transmitter transmitter = transmitterOf(encodeSeconds(truth, GetParam(), lossless()));
  Listener listener(1);
  listener.take(listener.ask(transmitter, wantsOf(0, 400)));
  for (int i = 0; i < 100; ++i) listener.ask(transmitter, wantsOf(0, 400));
  for (const uint64_t frame : {0u, 2u}) listener.fill(transmitter, wantsOf(frame, 400));
  // What was lost last becomes known with what comes next.
  for (const uint64_t frame : {0u, 2u}) listener.fill(transmitter, wantsOf(frame, 400));
  for (const uint64_t frame : {0u, 1u, 2u, 3u})
    EXPECT_TRUE(sameBytes(listener.heights(frame), truth[frame].data)) << frame;
}

TEST_P(EveryCoding, WhatIsThereOfACutGroupComes) {
  const FrameRasters truth = smallHills(6);
  const Bytes bytes = encodeSeconds(truth, GetParam(), lossless());
  Sequence whole{bytes};
  const tks_group last = whole.group(4);
  const size_t cut = static_cast<size_t>(last.stream_offset + last.stream_bytes * 3 / 4);
  Transmitter transmitter = transmitterOf(Prefix(bytes).first(cut));
  Listener listener(1);
  for (const uint64_t frame : {0u, 2u, 4u}) listener.fill(transmitter, wantsOf(frame, 100000));
  Sequence sequence(Prefix(bytes).first(cut));
  EXPECT_TRUE(sameBytes(listener.heights(5), sequence.heights(5)));
  const Status status = transmitter.append(Prefix(bytes).subspan(cut));
  ASSERT_TRUE(status.ok()) << status.message();
  listener.fill(transmitter, wantsOf(5, 100000));
  EXPECT_TRUE(sameBytes(listener.heights(5), truth[5].data));
}

TEST_P(EveryCoding, LateAndStalledReceiversAreRightAgain) {
  const FrameRasters truth = smallHills(24);
  const Bytes bytes = encodeSeconds(truth, GetParam(), lossless());
  Sequence whole{bytes};
  Transmitter transmitter = transmitterOf({});
  Listener late(1), stalled(2);
  for (uint64_t frame = 0; frame < 24; frame += 2) {
    const tks_group group = whole.group(frame);
    const Status status = transmitter.append(
        Prefix(bytes).subspan(static_cast<size_t>(group.offset), static_cast<size_t>(group.bytes)));
    ASSERT_TRUE(status.ok()) << status.message();
    const auto follow = [&](Listener& listener) {
      listener.fill(transmitter, wantsOf(TKS_NEWEST_FRAME, 20000));
      EXPECT_TRUE(sameBytes(listener.heights(frame), truth[frame].data)) << frame;
      EXPECT_TRUE(listener.receiver.forget(frame).ok());
    };
    if (frame >= 10) follow(late);
    if (frame < 6 || frame > 14) follow(stalled);
    ASSERT_TRUE(transmitter.forget(frame).ok());
    EXPECT_LE(transmitter.info().groups, 4u);
  }
}

TEST_P(EveryCoding, WhatCameIsASequence) {
  const FrameRasters truth = smallHills(16);
  Transmitter transmitter = transmitterOf(encodeSeconds(truth, GetParam(), lossless()));
  Listener listener(1);
  Bytes written;
  const auto write = [&](uint64_t frame) {
    const Result<Buffer> part = listener.receiver.write(frame);
    ASSERT_TRUE(part.ok()) << part.status().message();
    written.insert(written.end(), part->bytes().begin(), part->bytes().end());
  };
  for (uint64_t frame = 0; frame < 16; frame += 2) {
    if (frame == 8) continue;  // a point of entry, and yet the next groups need it
    listener.fill(transmitter, wantsOf(frame, 50000));
    write(frame);
  }
  write(TKS_NEWEST_FRAME);
  EXPECT_EQ(listener.receiver.info().end_frame, 0u);
  Sequence sequence{written};
  ASSERT_EQ(sequence.status, TKS_OK) << tks_sequence_message(sequence.get());
  EXPECT_EQ(sequence.info().end_frame, 16u);
  EXPECT_EQ(sequence.info().whole_bytes, written.size());
  for (uint64_t frame = 0; frame < 16; ++frame)
    EXPECT_TRUE(sameBytes(sequence.heights(frame), truth[frame].data)) << frame;
}

INSTANTIATE_TEST_SUITE_P(All, EveryCoding,
                         ::testing::Values(Coding{false, 0}, Coding{true, 0},
                                           Coding{false, TKS_ALL_BYTES}, Coding{true, 300}));

TEST(Transmitters, AnswersKeepWithinTheLink) {
  Transmitter transmitter = transmitterOf(encodeSeconds(hills(6), {true, 0}, lossless()), 0.25);
  for (const uint32_t link : {1000u, 5000u, 30000u}) {
    Listener listener(link);
    for (int i = 0; i < 20; ++i) {
      const Bytes answer = listener.ask(transmitter, wantsOf(0, link));
      EXPECT_LE(answer.size(), std::max(link / 4, 100u) + 20);
      listener.take(answer);
    }
  }
}

TEST(Transmitters, EachGroupHasItsShareBeforeTheFirstHasAll) {
  Transmitter transmitter = transmitterOf(encodeSeconds(hills(12), {false, 0}, lossless()), 0.25);
  Listener listener(1);
  constexpr uint32_t kLink = 800;  // a group lasts 2 s
  for (int i = 0; i < 5 * 8; ++i) listener.take(listener.ask(transmitter, wantsOf(0, kLink)));
  for (uint64_t group = 0; group < 4; ++group) {
    EXPECT_GT(listener.bytesOf(group), 2 * kLink * 0.8) << group;
    EXPECT_LT(listener.bytesOf(group), 2 * kLink * 1.5) << group;
  }
}

/// RMSE of the best mesh of so many triangles of the decoded frame.
double meshErrorOf(Result<Decoder> decoder, const samples::Raster& truth, uint32_t count) {
  const Result<Mesh> mesh = decoder->budgetMesh(count);
  EXPECT_TRUE(mesh.ok());
  double sum = 0;
  for (uint32_t v = 0; v < mesh->vertexCount(); ++v) {
    const double d =
        mesh->heights()[v] - sampleAt(truth.data, truth.sample, mesh->gridIndices()[v]);
    sum += d * d;
  }
  return std::sqrt(sum / mesh->vertexCount());
}

TEST(Transmitters, StopWhereTheRendererHasEnough) {
  const FrameRasters truth = hills(2);
  for (const bool has_index : {false, true}) {
    Transmitter transmitter = transmitterOf(encodeSeconds(truth, {has_index, 0}, lossless()));
    Listener all(1);
    all.fill(transmitter, wantsOf(0, 50000));
    uint64_t before = all.receiver.info().bytes;
    for (const uint32_t triangles : {1000u, 100u, 20u}) {
      Listener few(triangles);
      tks_wants wants = wantsOf(0, 50000);
      wants.triangles = triangles;
      few.fill(transmitter, wants);
      EXPECT_LT(few.receiver.info().bytes, before) << triangles;
      before = few.receiver.info().bytes;
      const double enough = meshErrorOf(few.receiver.decoder(0), truth[0], triangles);
      EXPECT_LT(enough, 1.3 * meshErrorOf(all.receiver.decoder(0), truth[0], triangles) + 1);
    }
  }
}

TEST(Transmitters, WhatIsLookedAtComesFirst) {
  const FrameRasters truth = hills(4);
  Transmitter transmitter = transmitterOf(encodeSeconds(truth, {true, 0}, lossless()));
  const auto errors = [&](uint64_t number, const tks_screen_camera* view) {
    Listener listener(number);
    tks_wants wants = wantsOf(0, 900);
    wants.view = view;
    for (int i = 0; i < 7; ++i) listener.take(listener.ask(transmitter, wants));
    const std::vector<std::byte> shown = listener.heights(0);
    return std::pair(errorIn(truth[0], shown, {0, 40, 20, 20}),
                     errorIn(truth[0], shown, {50, 40, 20, 20}));
  };
  // Down the rows from row 25; heights are flattened so that none is out of sight.
  const auto above = [](double column) {
    return cameraOf({3, 0, 0, -3 * column, 0, 0, 1e-4, -1, 0, 0, 0, 0, 0, 1, 0, -25});
  };
  const tks_screen_camera left = above(8), right = above(62);
  const auto [of_left, beside_left] = errors(1, &left);
  const auto [beside_right, of_right] = errors(2, &right);
  EXPECT_LT(of_left, beside_right);
  EXPECT_LT(of_right, beside_left);
}

TEST(Transmitters, LiarsHarmNobodyButThemselves) {
  const FrameRasters truth = hills(8);
  const Bytes bytes = encodeSeconds(truth, {true, TKS_ALL_BYTES}, lossless());
  Transmitter honest = transmitterOf(bytes), lied_to = transmitterOf(bytes);
  Listener a(1), b(1);
  std::mt19937 random(2);
  const auto below = [&](uint32_t end) { return static_cast<uint32_t>(random() % end); };
  int refused = 0, answered = 0;
  for (int round = 0; round < 60; ++round) {
    const tks_wants wants = wantsOf(static_cast<uint64_t>(round / 8), 2500);
    const Bytes answer = a.ask(honest, wants);
    EXPECT_EQ(b.ask(lied_to, wants), answer);
    a.take(answer);
    b.take(answer);
    ControlMessage lie{.receiver = 2 + below(3), .answers = below(9), .link = 1 + below(kMostRate)};
    lie.lost = lie.answers > 1 ? below(1u << (lie.answers - 1)) : 0;
    lie.kept = below(20);
    lie.frame = below(20);
    lie.triangles = below(50);
    lie.view = ControlView{1 + below(32768), 1, {}};
    for (uint32_t& bits : lie.view->rows)
      bits = std::bit_cast<uint32_t>(static_cast<float>(below(1000)) * 1e30f);
    const auto given = lied_to.answer(writeControl(lie));
    if (given.ok()) {
      ++answered;
      EXPECT_LE(given->bytes().size(), (1u << 20) + 100);
    } else {
      ++refused;
      EXPECT_EQ(given.status().code(), TKS_USAGE) << given.status().message();
    }
  }
  EXPECT_GT(refused, 0);
  EXPECT_GT(answered, 0);
}

TEST(Transmitters, ForgottenReceiversBeginAnew) {
  tks_transmitter_options options = makeTransmitterOptions();
  options.receivers = 2;
  Transmitter transmitter = *Transmitter::open(options);
  ASSERT_TRUE(transmitter.append(encodeSeconds(hills(2), {false, 0}, lossless())).ok());
  Listener first(1), second(2), third(3);
  for (Listener* listener : {&first, &second, &first, &third})
    listener->take(listener->ask(transmitter, wantsOf(0, 500)));
  first.take(first.ask(transmitter, wantsOf(0, 500)));
  const auto control = second.receiver.control(wantsOf(0, 500));
  EXPECT_EQ(transmitter.answer(*control).status().code(), TKS_USAGE);
  Listener anew(4);
  anew.fill(transmitter, wantsOf(0, 500));
}

TEST(Transmitters, WithoutGroupsTellThatThereAreNone) {
  Transmitter transmitter = transmitterOf({});
  Listener listener(1);
  EXPECT_FALSE(listener.fill(transmitter, wantsOf(TKS_NEWEST_FRAME, 500)));
  EXPECT_EQ(listener.receiver.info().source_end_frame, 0u);
  EXPECT_FALSE(listener.receiver.decoder(0).ok());
  EXPECT_FALSE(listener.receiver.find(9).ok());
}

/// An answer of which a few bytes are others, with a checksum that is right.
Bytes damaged(Bytes answer, std::mt19937& random) {
  for (int i = 0; i < 3; ++i)
    answer[4 + random() % (answer.size() - 8)] = static_cast<uint8_t>(random());
  const uint32_t crc = crc32(Prefix(answer).first(answer.size() - 4));
  for (size_t i = 0; i < 4; ++i)
    answer[answer.size() - 4 + i] = static_cast<uint8_t>(crc >> (8 * i));
  return answer;
}

TEST(Receivers, TakeAnyBytesOrRefuseThemWithASentence) {
  const Bytes bytes = encodeSeconds(smallHills(4), {true, 300}, lossless());
  std::mt19937 random(4);
  int refused = 0, shown = 0;
  for (uint64_t number = 0; number < 150; ++number) {
    Transmitter transmitter = transmitterOf(bytes);
    const tks_limits limits = smallLimits();
    Receiver receiver = *Receiver::open(number, limits);
    for (int i = 0; i < 6; ++i) {
      const auto control = receiver.control(wantsOf(number % 4, 3000));
      const auto answer = transmitter.answer(*control);
      if (!answer.ok()) break;  // it tells of answers that were never given
      Bytes given(answer->bytes().begin(), answer->bytes().end());
      if (random() % 2 == 0) given = damaged(std::move(given), random);
      const Status status = receiver.take(given);
      if (!status.ok()) {
        ++refused;
        EXPECT_FALSE(status.message().empty());
      }
      Result<Decoder> decoder = receiver.decoder(number % 4);
      if (decoder.ok() && decoder->heights().ok()) ++shown;
      EXPECT_NE(receiver.write(number % 3).status().code(), TKS_NO_MEMORY);
    }
  }
  EXPECT_GT(refused, 20);
  EXPECT_GT(shown, 20);
}

TEST(Receivers, RefuseAnswersThatCannotBe) {
  const Bytes bytes = encodeSeconds(hills(4), {false, 0}, lossless());
  Transmitter transmitter = transmitterOf(bytes);
  Listener listener(1);
  listener.fill(transmitter, wantsOf(0, 50000));
  const tks_receiver_info before = listener.receiver.info();
  const Prefix head = Prefix(bytes).first(60);
  const auto refused = [&](std::vector<AnswerPiece> pieces) {
    const Status status = listener.receiver.take(writeAnswer({9, 4, std::move(pieces)}));
    EXPECT_EQ(status.code(), TKS_CORRUPT) << status.message();
    EXPECT_EQ(listener.receiver.info().bytes, before.bytes);
    EXPECT_EQ(listener.receiver.info().answers, before.answers);
  };
  refused({{7, 0, head}});  // it calls itself group 0
  const Bytes others(20, 7);
  refused({{8, 0, others}});
}

}  // namespace
}  // namespace tetrakis::test

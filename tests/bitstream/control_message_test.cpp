// SPDX-License-Identifier: Apache-2.0
// Control messages and answers: what is written is read; all else is refused with one sentence.
#include "bitstream/sequence/control_message.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <limits>
#include <random>
#include <span>
#include <vector>

#include "bitstream/sequence/group_head.hpp"
#include "bitstream/stream/header.hpp"

namespace tetrakis {
namespace {

using Bytes = std::vector<uint8_t>;

ControlMessage longest() {
  ControlMessage message{UINT64_MAX,
                         UINT32_MAX,
                         UINT32_MAX,
                         kMostFirstFrame + kMostFrames,
                         kMostFirstFrame + kMostFrames,
                         kMostRate,
                         kMostRate,
                         ControlView{}};
  message.view->width = message.view->height = 32768;
  message.view->rows.fill(std::bit_cast<uint32_t>(-std::numeric_limits<float>::max()));
  return message;
}

std::vector<ControlMessage> someMessages() {
  std::vector<ControlMessage> messages = {longest(), {.receiver = 7}};
  messages.push_back({.receiver = 1, .answers = 5, .lost = 9, .frame = 0, .link = 8000});
  messages.push_back({.answers = 33, .lost = UINT32_MAX, .kept = 12, .triangles = 3000});
  messages.back().view =
      ControlView{640, 400, {1, 0, 0x80000000, 0x3f800000, 0, 7, 0, 2, 0, 0, 9, 3}};
  return messages;
}

/// With the checksum that its bytes have now.
Bytes sealed(Bytes bytes) {
  const uint32_t crc = crc32(std::span(bytes).first(bytes.size() - 4));
  for (size_t i = 0; i < 4; ++i) bytes[bytes.size() - 4 + i] = static_cast<uint8_t>(crc >> (8 * i));
  return bytes;
}

void expectSentence(const Status& status) {
  EXPECT_TRUE(status.code() == TKS_CORRUPT || status.code() == TKS_UNSUPPORTED);
  ASSERT_FALSE(status.message().empty());
  EXPECT_EQ(status.message().back(), '.');
}

TEST(ControlMessages, ComeBackAndTakeAtMostAHundredBytes) {
  for (const ControlMessage& message : someMessages()) {
    const Bytes bytes = writeControl(message);
    EXPECT_LE(bytes.size(), kMostControlBytes);
    const Result<ControlMessage> read = readControl(bytes);
    ASSERT_TRUE(read.ok()) << read.status().message();
    EXPECT_EQ(*read, message);
  }
}

TEST(ControlMessages, OfOtherBytesNoneIsTaken) {
  for (const ControlMessage& message : someMessages()) {
    const Bytes bytes = writeControl(message);
    for (size_t size = 0; size < bytes.size(); ++size)
      expectSentence(readControl(std::span(bytes).first(size)).status());
    for (size_t i = 0; i < bytes.size(); ++i) {
      for (int bit = 0; bit < 8; ++bit) {
        Bytes wrong = bytes;
        wrong[i] ^= static_cast<uint8_t>(1 << bit);
        expectSentence(readControl(wrong).status());
      }
    }
    Bytes longer = bytes;
    longer.insert(longer.end() - 4, 0);
    expectSentence(readControl(sealed(longer)).status());
  }
}

TEST(ControlMessages, EveryMessageHasOneForm) {
  std::mt19937 random(3);
  const std::vector<ControlMessage> messages = someMessages();
  int taken = 0;
  for (int round = 0; round < 20000; ++round) {
    Bytes bytes = writeControl(messages[random() % messages.size()]);
    for (auto changes = 1 + random() % 3; changes > 0; --changes)
      bytes[3 + random() % (bytes.size() - 7)] = static_cast<uint8_t>(random());
    bytes = sealed(bytes);
    const Result<ControlMessage> read = readControl(bytes);
    if (!read.ok()) {
      expectSentence(read.status());
      continue;
    }
    EXPECT_EQ(writeControl(*read), bytes);
    ++taken;
  }
  EXPECT_GT(taken, 1000);
}

TEST(ControlMessages, LiesAreRefused) {
  const auto refused = [](const ControlMessage& message) {
    expectSentence(readControl(writeControl(message)).status());
  };
  refused({.link = 0});
  refused({.link = kMostRate + 1});
  refused({.triangles = kMostRate + 1});
  refused({.answers = 3, .lost = 4});  // there were only two before the last one
  refused({.answers = 0, .lost = 1});
  refused({.kept = kMostFirstFrame + kMostFrames + 1});
  ControlMessage message = longest();
  message.view->height = 0;
  refused(message);
  message = longest();
  message.view->rows[5] = std::bit_cast<uint32_t>(std::numeric_limits<float>::quiet_NaN());
  refused(message);
}

TEST(Answers, ComeBackAndNothingElseIsTaken) {
  const Bytes data = {1, 2, 3, 4, 5, 6, 7};
  const std::span<const uint8_t> all(data);
  const Answer answer{300, 12, {{0, 0, all}, {UINT32_MAX, uint64_t{1} << 60, all.first(1)}}};
  const Bytes bytes = writeAnswer(answer);
  const Result<Answer> read = readAnswer(bytes);
  ASSERT_TRUE(read.ok()) << read.status().message();
  EXPECT_EQ(read->number, 300u);
  EXPECT_EQ(read->end_frame, 12u);
  ASSERT_EQ(read->pieces.size(), 2u);
  EXPECT_TRUE(std::ranges::equal(read->pieces[0].bytes, data));
  EXPECT_EQ(read->pieces[1].group, UINT32_MAX);
  EXPECT_EQ(read->pieces[1].place, uint64_t{1} << 60);
  EXPECT_EQ(read->pieces[1].bytes.size(), 1u);
  for (size_t size = 0; size < bytes.size(); ++size)
    expectSentence(readAnswer(std::span(bytes).first(size)).status());
  for (size_t i = 4; i + 4 < bytes.size(); ++i) {
    Bytes wrong = bytes;
    wrong[i] = 0xff;
    const Result<Answer> damaged = readAnswer(sealed(wrong));
    if (!damaged.ok()) expectSentence(damaged.status());
  }
}

}  // namespace
}  // namespace tetrakis

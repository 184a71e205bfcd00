// SPDX-License-Identifier: Apache-2.0
// A transmitter and its receivers, for tests, which note that no byte comes twice.
#pragma once

#include <map>

#include "bitstream/sequence/control_message.hpp"
#include "ratecontrol/receiver/sent_pieces.hpp"
#include "tests/support/sequences.hpp"
#include "tetrakis/transmit.hpp"

namespace tetrakis::test {

inline Transmitter transmitterOf(Prefix bytes, double seconds = 0.5) {
  tks_transmitter_options options = makeTransmitterOptions();
  options.seconds = seconds;
  Result<Transmitter> transmitter = Transmitter::open(options);
  EXPECT_TRUE(transmitter.ok());
  const Status status = transmitter->append(bytes);
  EXPECT_TRUE(status.ok()) << status.message();
  return *std::move(transmitter);
}

inline tks_wants wantsOf(uint64_t frame, uint32_t link) {
  tks_wants wants = makeWants();
  wants.frame = frame;
  wants.link = link;
  return wants;
}

/// A receiver that looks at what comes.
class Listener {
 public:
  explicit Listener(uint64_t number) : receiver(*Receiver::open(number)) {}

  /// Sends a message and gives what is answered.
  Bytes ask(Transmitter& transmitter, const tks_wants& wants) {
    const auto control = receiver.control(wants);
    EXPECT_TRUE(control.ok()) << control.status().message();
    const auto answer = transmitter.answer(*control);
    EXPECT_TRUE(answer.ok()) << answer.status().message();
    if (!answer.ok()) return {};
    const auto bytes = answer->bytes();
    return Bytes(bytes.begin(), bytes.end());
  }
  void take(Prefix answer) {
    const Status status = receiver.take(answer);
    EXPECT_TRUE(status.ok()) << status.message();
    const Result<Answer> parts = readAnswer(answer);
    ASSERT_TRUE(parts.ok());
    for (const AnswerPiece& piece : parts->pieces) {
      const uint64_t end = piece.place + piece.bytes.size();
      ByteRanges& has = has_[piece.group];
      EXPECT_EQ(has.missing({piece.place, end}), (std::vector<ByteRange>{{piece.place, end}}))
          << "group " << piece.group << " twice";
      has.add({piece.place, end});
    }
  }
  /// Asks until nothing helps any more. Whether something came.
  bool fill(Transmitter& transmitter, const tks_wants& wants) {
    const uint64_t before = receiver.info().bytes;
    do take(ask(transmitter, wants));
    while (receiver.info().last_pieces > 0 && !::testing::Test::HasFailure());
    return receiver.info().bytes > before;
  }
  std::vector<std::byte> heights(uint64_t frame) {
    Result<Decoder> decoder = receiver.decoder(frame);
    EXPECT_TRUE(decoder.ok()) << decoder.status().message();
    if (!decoder.ok()) return {};
    const Result<std::vector<std::byte>> samples = decoder->heights();
    EXPECT_TRUE(samples.ok()) << samples.status().message();
    return samples.ok() ? *samples : std::vector<std::byte>();
  }
  /// What it has of a group.
  uint64_t bytesOf(uint64_t group) { return has_[group].bytes(); }

  Receiver receiver;

 private:
  std::map<uint64_t, ByteRanges> has_;
};

}  // namespace tetrakis::test

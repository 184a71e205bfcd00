// SPDX-License-Identifier: Apache-2.0
// Ten thousand frames leave the memory of encoder, transmitter and receivers where it was.
#include "tests/support/allocation_count.hpp"
#include "tests/support/transmissions.hpp"

namespace tetrakis::test {
namespace {

/// A live sequence of tiny frames, and those who look at it.
class Broadcast {
 public:
  void send(uint32_t frames) {
    for (uint32_t end = frame_ + frames; frame_ < end; ++frame_) {
      const samples::Raster& raster = frames_[frame_ % frames_.size()];
      const tks_heights heights = raster.heights();
      ASSERT_TRUE(encoder_.push(&heights, nullptr, frame_).ok());
      const Result<Buffer> bytes = encoder_.take();
      if (!bytes->bytes().empty()) sendGroup(bytes->bytes());
    }
  }

 private:
  void sendGroup(std::span<const uint8_t> bytes) {
    ASSERT_TRUE(transmitter_.append(bytes).ok());
    const uint64_t newest = transmitter_.info().end_frame - 1;
    ASSERT_TRUE(transmitter_.forget(newest).ok());
    for (Receiver* receiver : {&fast_, &slow_}) {
      tks_wants wants = wantsOf(TKS_NEWEST_FRAME, receiver == &fast_ ? 100000 : 300);
      const auto control = receiver->control(wants);
      const auto answer = transmitter_.answer(*control);
      ASSERT_TRUE(answer.ok()) << answer.status().message();
      if (receiver == &slow_ && frame_ % 64 < 16) continue;  // the answer is lost
      ASSERT_TRUE(receiver->take(answer->bytes()).ok());
      ASSERT_TRUE(receiver->write(newest).ok());
    }
    EXPECT_TRUE(fast_.decoder(newest).ok());
  }

  static SequenceEncoder encoder() {
    static const tks_encode_options encode = lossless();
    tks_sequence_options options = optionsOf(encode, 16);
    options.reference = 200;
    return *SequenceEncoder::open(options);
  }

  FrameRasters frames_ = movingFrames({samples::Pattern::kHills, 4, 3, 1, TKS_U8}, 40);
  SequenceEncoder encoder_ = encoder();
  Transmitter transmitter_ = transmitterOf({});
  Receiver fast_ = *Receiver::open(1), slow_ = *Receiver::open(2);
  uint32_t frame_ = 0;
};

TEST(TransmitMemory, OfTenThousandFramesIsThatOfAThousand) {
  Broadcast broadcast;
  startCounting();
  broadcast.send(1000);
  const uint64_t before = countedPeak();
  broadcast.send(9000);
  // The encoder keeps 50 bytes of each group, for a moment beside twice as many as it did before.
  constexpr uint64_t kOfGroups = 150 * (9000 / 16);
  EXPECT_LE(countedPeak(), before + kOfGroups);
}

}  // namespace
}  // namespace tetrakis::test

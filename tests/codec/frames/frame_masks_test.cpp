// SPDX-License-Identifier: Apache-2.0
// The masks of frames come back from their codeword; prefixes of it and any other bytes give masks
// as well, and masks that hardly change take few bytes.
#include "codec/frames/frame_masks.hpp"

#include <gtest/gtest.h>

#include <random>
#include <span>
#include <vector>

#include "conformance/samples/void_masks.hpp"

namespace tetrakis::test {
namespace {

using samples::VoidShape;

constexpr Extent kPlane{45, 38};

SharedBits maskOf(VoidShape shape) {
  return shared(BitPlane(samples::validity(shape, kPlane.width, kPlane.height), kPlane));
}

FrameMasks masks() {
  FrameMasks all = {maskOf(VoidShape::kCoast),   maskOf(VoidShape::kHoles),
                    maskOf(VoidShape::kAll),     nullptr,
                    maskOf(VoidShape::kSpeckle), maskOf(VoidShape::kSpeckle)};
  return all;
}

std::vector<uint8_t> marksOf(const SharedBits& mask) {
  return mask == nullptr ? std::vector<uint8_t>(kPlane.samples(), 1) : mask->bytes();
}

TEST(FrameMasks, ComeBack) {
  const FrameMasks truth = masks();
  const FrameMasks decoded =
      decodeFrameMasks(encodeFrameMasks(truth, kPlane), kPlane, truth.size());
  ASSERT_EQ(decoded.size(), truth.size());
  for (size_t t = 0; t < truth.size(); ++t)
    EXPECT_EQ(marksOf(decoded[t]), marksOf(truth[t])) << "frame " << t;
}

TEST(FrameMasks, NeedNoCodewordWhereAllIsValid) {
  EXPECT_TRUE(encodeFrameMasks(FrameMasks(4), kPlane).empty());
  EXPECT_EQ(decodeFrameMasks({}, kPlane, 4), FrameMasks(4));
  EXPECT_EQ(everValid({maskOf(VoidShape::kHalf), nullptr}), nullptr);
}

TEST(FrameMasks, OfAPrefixStayAsTheyWere) {
  const std::vector<uint8_t> codeword = encodeFrameMasks(masks(), kPlane);
  for (size_t bytes = 1; bytes <= codeword.size(); ++bytes) {
    const FrameMasks decoded =
        decodeFrameMasks(std::span(codeword).first(bytes), kPlane, masks().size());
    if (2 * bytes > codeword.size()) continue;
    EXPECT_EQ(marksOf(decoded[5]), marksOf(decoded[4])) << bytes << " bytes";
  }
}

TEST(FrameMasks, OfAnyBytesAreSafe) {
  std::mt19937 random(1);
  for (int i = 0; i < 200; ++i) {
    std::vector<uint8_t> bytes(random() % 60 + 1);
    for (uint8_t& byte : bytes) byte = static_cast<uint8_t>(random());
    EXPECT_EQ(decodeFrameMasks(bytes, kPlane, 7).size(), 7u);
  }
}

TEST(FrameMasks, ThatStayTakeHardlyAByte) {
  const size_t one = encodeFrameMasks({maskOf(VoidShape::kCoast)}, kPlane).size();
  EXPECT_LE(encodeFrameMasks(FrameMasks(32, maskOf(VoidShape::kCoast)), kPlane).size(), one + 3);
}

}  // namespace
}  // namespace tetrakis::test

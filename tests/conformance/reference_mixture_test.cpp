// SPDX-License-Identifier: Apache-2.0
// Weights of mixtures end at 2^20 on both sides (docs/FORMAT.md, section 4). No vector gets there:
// a weight grows only while its model is right and unsure, by a few units a decision, and models
// that are right become sure. So the models of this test are made anew for each decision.
#include <gtest/gtest.h>

#include <array>
#include <vector>

#include "bitstream/coder/mixture.hpp"
#include "bitstream/coder/range_encoder.hpp"
#include "conformance/reference_decoder/mixed.hpp"

namespace tetrakis {
namespace {

/// Of the decisions that a model has learnt from, the first is one more 0.
constexpr int kLearnt = 21;
constexpr int32_t kEnd = 1 << 20;

struct Part {
  bool bit;
  int decisions;
  int32_t weight;  ///< behind them
};
constexpr std::array<Part, 3> kParts = {
    {{false, 300000, kEnd}, {true, 600000, -kEnd}, {false, 600000, kEnd}}};

AdaptiveBit unsureBit() {
  AdaptiveBit model;
  for (int i = 0; i < kLearnt; ++i) model.update(i % 2 != 0);
  return model;
}

std::vector<uint8_t> encoded() {
  RangeEncoder encoder;
  auto weights = freshWeights<1>();
  const OddsTable odds = makeOddsTable();
  for (const Part& part : kParts) {
    for (int i = 0; i < part.decisions; ++i) {
      AdaptiveBit model = unsureBit();
      Mixture<1> mixture({&model}, weights, odds);
      encoder.encodeOf(mixture.zero(), part.bit);
      mixture.learn(part.bit);
    }
    EXPECT_EQ(weights[0], part.weight);
  }
  return encoder.finish();
}

TEST(ReferenceMixture, EndsWeightsAsTheLibraryDoes) {
  const std::vector<uint8_t> codeword = encoded();
  reference::RangeDecoder decoder(codeword);
  std::array<int64_t, 1> weights = {reference::kFirstWeight};
  for (const Part& part : kParts) {
    for (int i = 0; i < part.decisions; ++i) {
      reference::Model model;
      for (int k = 0; k < kLearnt; ++k) model.learn(k % 2);
      const std::array<reference::Model*, 1> models = {&model};
      ASSERT_EQ(reference::decodeMixed(decoder, models, weights), int{part.bit}) << i;
    }
    EXPECT_EQ(weights[0], part.weight);
  }
}

}  // namespace
}  // namespace tetrakis

// SPDX-License-Identifier: Apache-2.0
// The example of conformance/EXAMPLE.md is the stream that it names: its bytes, and the probability
// and outcome of each decision.
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <regex>
#include <string>
#include <vector>

#include "conformance/reference_decoder/range_decoder.hpp"

namespace tetrakis::conformance {
namespace {

std::string contentOf(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::vector<std::smatch> matchesOf(const std::string& text, const std::regex& pattern) {
  return {std::sregex_iterator(text.begin(), text.end(), pattern), std::sregex_iterator()};
}

/// The page, and its listing of the stream.
class FormatExample : public ::testing::Test {
 protected:
  void SetUp() override {
    page_ = contentOf(TETRAKIS_EXAMPLE);
    const size_t begin = page_.find("```\n") + 4;
    listing_ = page_.substr(begin, page_.find("```", begin) - begin);
  }

  std::string page_, listing_;
};

TEST_F(FormatExample, ListsTheBytesOfItsStream) {
  const std::string stream = contentOf(std::string(TETRAKIS_VECTORS) + "/tiny_2x2.tks");
  const std::regex row("(^|\n)((?:[0-9a-f]{2} )+)");
  std::string listed;
  for (const std::smatch& match : matchesOf(listing_, row)) {
    const std::string bytes = match[2];
    for (size_t i = 0; i < bytes.size(); i += 3)
      listed += static_cast<char>(std::stoi(bytes.substr(i, 2), nullptr, 16));
  }
  EXPECT_EQ(listed, stream);
}

TEST_F(FormatExample, ListsItsDecisions) {
  const std::string stream = contentOf(std::string(TETRAKIS_VECTORS) + "/tiny_2x2.tks");
  const auto* const last = reinterpret_cast<const uint8_t*>(stream.data()) + stream.size();
  reference::RangeDecoder decoder({last - 7, 7});
  size_t decisions = 0;
  const auto expect = [&](const std::string& zero, const std::string& bit) {
    ++decisions;
    EXPECT_EQ(decoder.decode(static_cast<uint32_t>(std::stoul(zero))), std::stoi(bit)) << decisions;
  };
  for (const std::smatch& match :
       matchesOf(page_, std::regex("\\| (\\d+) \\| [0-9a-f]{8} \\| [0-9a-f]{8} \\| ([01])")))
    expect(match[1], match[2]);
  for (const std::smatch& match : matchesOf(page_, std::regex("(\\d+) → ([01]) \\|")))
    expect(match[1], match[2]);
  EXPECT_EQ(decisions, 9u + 7 * 4);
}

}  // namespace
}  // namespace tetrakis::conformance

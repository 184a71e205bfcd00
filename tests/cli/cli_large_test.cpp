// SPDX-License-Identifier: Apache-2.0
// Streams of more samples than the library takes unasked.
#include <functional>

#include "bitstream/header.hpp"
#include "tests/cli/cli_fixture.hpp"

namespace tetrakis::test {
namespace {

class CliLarge : public CliTest {
 protected:
  /// a.tks, encoded from a few samples, with the header of many: coding those would take minutes.
  void enlarge(const std::function<void(StreamHeader&)>& change) {
    const std::string stream = content("a.tks");
    const auto* first = reinterpret_cast<const uint8_t*>(stream.data());
    Result<ParsedHeader> parsed = readHeader({first, stream.size()});
    ASSERT_TRUE(parsed.ok()) << parsed.status().message();
    change(parsed->header);
    const std::vector<uint8_t> header = writeHeader(parsed->header);
    write("a.tks", std::string(header.begin(), header.end()) + stream.substr(parsed->bytes));
  }
};

TEST_F(CliLarge, TexturesOfEverySizeAreOpened) {
  makeInputs();
  ASSERT_EQ(cli("encode --texture texture.png --lossless -o a.tks").code, 0);
  for (const uint32_t side : {20000u, 32768u}) {
    enlarge(
        [side](StreamHeader& header) { header.texture->width = header.texture->height = side; });
    const Outcome run = cli("info a.tks");
    EXPECT_EQ(run.code, 0) << run.err;
    EXPECT_NE(run.out.find(std::to_string(side)), std::string::npos) << run.out;
  }
}

TEST_F(CliLarge, HeightsAreOpenedUpToTheLargestFile) {
  makeInputs();
  ASSERT_EQ(cli("encode height.tif --lossless -o a.tks").code, 0);
  enlarge([](StreamHeader& header) { header.geometry->width = header.geometry->height = 1 << 16; });
  EXPECT_EQ(cli("info a.tks").code, 0);
  enlarge([](StreamHeader& header) { header.geometry->width = (1 << 16) + 1; });
  EXPECT_EQ(cli("info a.tks").code, 6);
}

}  // namespace
}  // namespace tetrakis::test

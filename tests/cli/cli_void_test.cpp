// SPDX-License-Identifier: Apache-2.0
// Voids through the command line: what a file declares, what --nodata says, and what comes back.
#include <cstring>

#include "tests/cli/cli_fixture.hpp"

namespace tetrakis::test {
namespace {

class CliVoids : public CliTest {
 protected:
  /// Hills whose first 40 samples hold `value`.
  static tools::HeightFile holed(uint16_t value) {
    tools::HeightFile heights = hills(17);
    for (size_t i = 0; i < 40; ++i) std::memcpy(heights.data.data() + 2 * i, &value, sizeof value);
    return heights;
  }
};

TEST_F(CliVoids, DeclaredNodataComesBackDeclared) {
  tools::HeightFile heights = holed(65535);
  heights.nodata = 65535;
  ASSERT_TRUE(tools::writeHeights(path("v.tif"), heights).ok());
  const Outcome run = cli("encode v.tif --lossless -o v.tks");
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_NE(run.err.find("40 samples are void"), std::string::npos) << run.err;
  ASSERT_EQ(cli("decode v.tks --height w.tif").code, 0);
  const auto decoded = tools::readHeights(path("w.tif"));
  ASSERT_TRUE(decoded.ok());
  EXPECT_EQ(decoded->data, heights.data);
  EXPECT_EQ(decoded->nodata, 65535);
}

TEST_F(CliVoids, OptionDeclaresThemForAnyFormat) {
  ASSERT_TRUE(tools::writeHeights(path("v.png"), holed(9)).ok());
  ASSERT_EQ(cli("encode v.png --nodata 9 --max-error 2 -o v.tks").code, 0);
  ASSERT_EQ(cli("decode v.tks --height w.png").code, 0);
  const auto decoded = tools::readHeights(path("w.png"));
  ASSERT_TRUE(decoded.ok());
  for (size_t i = 0; i < decoded->data.size() / 2; ++i) {
    uint16_t sample = 0;
    std::memcpy(&sample, decoded->data.data() + 2 * i, sizeof sample);
    EXPECT_EQ(sample == 9, i < 40) << i;
  }
  EXPECT_EQ(cli("compare v.tks --height v.png").code, 0) << "the bound holds for valid samples";
}

}  // namespace
}  // namespace tetrakis::test

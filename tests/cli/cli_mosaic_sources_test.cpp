// SPDX-License-Identifier: Apache-2.0
// What a mosaic keeps of its sources: heights of every value, the files themselves, and promises to
// doubles.
#include <cmath>
#include <cstring>

#include "tests/cli/cli_fixture.hpp"
#include "tests/support/tiny_tiff.hpp"

namespace tetrakis::test {
namespace {

class CliMosaicSources : public CliTest {
 protected:
  static constexpr uint32_t kSide = 40;

  static tools::HeightFile ground() {
    tools::HeightFile file = hills(kSide);
    file.crs = "EPSG:32633";
    file.geotransform = {500000, 30, 0, 4000000, 0, -30};
    file.registration = TKS_REGISTRATION_AREA;
    return file;
  }
};

/// A height that is another file's value for no height would be lost.
TEST_F(CliMosaicSources, RefusesHeightsOfTheValueForNone) {
  tools::HeightFile left = ground(), right = ground();
  (*right.geotransform)[0] += 30 * kSide;
  left.nodata = 1;
  right.nodata = 2;
  const uint16_t one = 1;
  std::memcpy(right.data.data(), &one, sizeof one);
  ASSERT_TRUE(tools::writeHeights(path("left.tif"), left).ok());
  ASSERT_TRUE(tools::writeHeights(path("right.tif"), right).ok());
  const Outcome run = cli("mosaic join left.tif right.tif --lossless -o a.tks");
  EXPECT_EQ(run.code, 1);
  EXPECT_NE(run.err.find("right.tif"), std::string::npos) << run.err;
}

TEST_F(CliMosaicSources, SourcesStay) {
  ASSERT_TRUE(tools::writeHeights(path("a.tif"), ground()).ok());
  const std::string before = content("a.tif");
  EXPECT_EQ(cli("mosaic join a.tif -f -o a.tif --lossless").code, 1);
  ASSERT_EQ(cli("mosaic plan a.tif -o w --lossless").code, 0);
  ASSERT_EQ(cli("mosaic code w").code, 0);
  EXPECT_EQ(cli("mosaic merge w -f -o a.tif").code, 1);
  EXPECT_EQ(content("a.tif"), before);
  EXPECT_EQ(cli("mosaic join a.tif -o a.tks --psnr 50 --layout windows --preview 9k").code, 1);
  EXPECT_EQ(cli("mosaic join a.tif -o a.tks --psnr 50 --layout tiles").code, 1);
}

/// Doubles become floats: what that spends of a largest error is gone, and nothing is lossless.
TEST_F(CliMosaicSources, CountsTheRoundingOfDoubles) {
  constexpr uint32_t kDoubles = 40;
  std::vector<double> doubles(kDoubles * kDoubles);
  for (size_t i = 0; i < doubles.size(); ++i) doubles[i] = 1000 * std::sin(double(i));
  std::vector<uint8_t> pixels(doubles.size() * sizeof(double));
  std::memcpy(pixels.data(), doubles.data(), pixels.size());
  TinyTiff tiff(kDoubles, kDoubles, 1, 64, pixels);
  tiff.shorts(TinyTiff::kSampleFormat, {3});
  const std::vector<uint8_t> bytes = tiff.bytes();
  ASSERT_TRUE(tools::writeBytes(path("d.tif"), std::as_bytes(std::span(bytes))).ok());
  EXPECT_EQ(cli("mosaic join d.tif --lossless -o a.tks").code, 1);
  EXPECT_EQ(cli("mosaic join d.tif --max-error 1e-6 -o a.tks").code, 1);
  ASSERT_EQ(cli("mosaic join d.tif --max-error 1e-3 -o a.tks").code, 0);
  EXPECT_EQ(cli("compare a.tks --height d.tif").code, 0);
  const std::string info = cli("info a.tks --json").out;
  EXPECT_NE(info.find("\"max_error\": 0.0009"), std::string::npos) << info;
}

/// A stream may hold more than heights, and what is left out is told.
TEST_F(CliMosaicSources, NotesTellWhatIsLeftOut) {
  makeStream();
  const Outcome run = cli("mosaic join a.tks -o b.tks --lossless");
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_NE(run.err.find("texture"), std::string::npos) << run.err;
}

}  // namespace
}  // namespace tetrakis::test

// SPDX-License-Identifier: Apache-2.0
// Regions and windows through the command line.
#include "tests/cli/cli_fixture.hpp"

namespace tetrakis::test {
namespace {

class CliWindows : public CliTest {};

/// Samples of a window. row: places of the whole in one; place: its bytes.
std::vector<std::byte> cropOf(const std::vector<std::byte>& all, size_t row, size_t place,
                              const tks_window& window) {
  std::vector<std::byte> out;
  for (size_t y = window.y; y < size_t{window.y} + window.height; ++y) {
    const auto from = all.begin() + static_cast<ptrdiff_t>((y * row + window.x) * place);
    out.insert(out.end(), from, from + static_cast<ptrdiff_t>(window.width * place));
  }
  return out;
}

TEST_F(CliWindows, WritesThePartOfHeightsAndTexture) {
  const tools::HeightFile heights = hills(65);
  ASSERT_TRUE(tools::writeHeights(path("h.tif"), heights).ok());
  ASSERT_EQ(cli("synth --size 33 -o s").code, 0);
  ASSERT_EQ(
      cli("encode h.tif --texture s/texture.png --regions 16 --threads 2 --lossless -o w.tks").code,
      0);
  EXPECT_NE(cli("info w.tks --json").out.find("\"regions\": 16"), std::string::npos);
  ASSERT_EQ(cli("decode w.tks --height a.tif --texture a.png").code, 0);
  const Outcome run = cli("decode w.tks --window 40,3,10,20 --height b.tif --texture b.png");
  ASSERT_EQ(run.code, 0) << run.err;
  const auto part = tools::readHeights(path("b.tif"));
  ASSERT_TRUE(part.ok());
  EXPECT_EQ(part->width, 10u);
  EXPECT_EQ(part->height, 20u);
  EXPECT_TRUE(sameBytes(part->data, cropOf(heights.data, 65, 2, {40, 3, 10, 20})));
  const auto whole = tools::readImage(path("a.png")), image = tools::readImage(path("b.png"));
  ASSERT_TRUE(whole.ok() && image.ok());
  // Columns 40 to 49 of 0 to 64, rows 3 to 22, rounded outwards to texels.
  const auto first = [](size_t sample, size_t texels) { return sample * texels / 64; };
  const auto last = [](size_t sample, size_t texels) { return (sample * texels + 63) / 64; };
  const size_t x = first(40, whole->width), y = first(3, whole->height);
  EXPECT_EQ(image->width, last(49, whole->width) - x);
  EXPECT_EQ(image->height, last(22, whole->height) - y);
  const tks_window texels = {static_cast<uint32_t>(x), static_cast<uint32_t>(y), image->width,
                             image->height};
  EXPECT_TRUE(sameBytes(image->data, cropOf(whole->data, whole->width, whole->channels, texels)));
}

TEST_F(CliWindows, RefusesWhatMakesNoSense) {
  ASSERT_TRUE(tools::writeHeights(path("h.tif"), hills(17)).ok());
  EXPECT_EQ(cli("encode h.tif --regions 100 --lossless -o w.tks").code, 1);
  EXPECT_EQ(cli("encode h.tif --regions many --lossless -o w.tks").code, 1);
  ASSERT_EQ(cli("encode h.tif --regions off --lossless -o w.tks").code, 0);
  for (const char* window : {"0,0,18,1", "17,0,1,1", "0,0,0,4", "1,2,3", "4294967295,0,2,1"}) {
    const Outcome run = cli(std::string("decode w.tks --height b.tif --window ") + window);
    EXPECT_EQ(run.code, 1) << window;
    EXPECT_FALSE(run.err.empty());
  }
  EXPECT_EQ(cli("decode w.tks --mesh b.glb --window 0,0,4,4").code, 1);
}

}  // namespace
}  // namespace tetrakis::test

// SPDX-License-Identifier: Apache-2.0
// tetrakis plan and tetrakis reorder: what receivers get.
#include <nlohmann/json.hpp>

#include "tests/cli/cli_fixture.hpp"

namespace tetrakis::test {
namespace {

class CliReceiver : public CliTest {
 protected:
  void SetUp() override {
    CliTest::SetUp();
    ASSERT_EQ(cli("synth -o . --size 129 -q").code, 0);
    const Outcome run =
        cli("encode height.tif --texture texture.png --bytes 40k --regions 32 --index -q -o a.tks");
    ASSERT_EQ(run.code, 0) << run.err;
  }

  nlohmann::json json(const std::string& arguments) {
    const Outcome run = cli(arguments + " --json");
    EXPECT_EQ(run.code, 0) << run.err;
    return nlohmann::json::parse(run.out, nullptr, false);
  }

  /// Of `compare --json`.
  static double screenPsnr(const Outcome& compared) {
    return nlohmann::json::parse(compared.out)["screen_psnr"].get<double>();
  }
};

TEST_F(CliReceiver, PlansFollowFromTwoOfThree) {
  const auto both = json("plan a.tks --channel 40k/s --seconds 2");
  EXPECT_EQ(both["bytes"], 10000);
  EXPECT_EQ(both["limit"], "channel");
  EXPECT_GT(both["triangles"], 100);
  EXPECT_EQ(both["renderer"], 30 * both["triangles"].get<double>());
  ASSERT_EQ(cli("encode height.tif --bytes 20k -q -o h.tks").code, 0);
  const auto weak = json("plan h.tks --renderer 6ktri/s --fps 20 --seconds 2");
  EXPECT_EQ(weak["triangles"], 300);
  EXPECT_EQ(weak["limit"], "renderer");
  EXPECT_EQ(weak["channel"], 4 * weak["bytes"].get<double>());
  const auto weaker = json("plan h.tks --renderer 2k/s --fps 20 --channel 1Mbit/s");
  EXPECT_LT(weaker["bytes"], weak["bytes"]);
  const auto all = json("plan h.tks --renderer 6k/s --fps 20 --channel 1M/s --seconds 100");
  EXPECT_EQ(all["bytes"], weak["bytes"]);
}

/// A weak renderer shows a texture as well as a strong one.
TEST_F(CliReceiver, TexturesAreSentToWeakRenderersToo) {
  const auto weak = json("plan a.tks --renderer 6k/s --fps 20 --channel 1M/s --seconds 100");
  const auto early = json("plan a.tks --renderer 6k/s --fps 20 --channel 40k/s --seconds 2");
  EXPECT_GT(weak["bytes"], 30000);
  EXPECT_EQ(early["bytes"], 10000);
  if (!weak["screen_psnr"].is_null()) {
    EXPECT_GT(weak["screen_psnr"], early["screen_psnr"]);
  }
}

TEST_F(CliReceiver, WholeStreamsSufficeForAllChannelsAndRenderers) {
  const auto plan = json("plan a.tks --channel 1G/s --seconds 9");
  EXPECT_EQ(plan["bytes"], 40960);
  EXPECT_EQ(plan["limit"], "stream");
  ASSERT_EQ(cli("encode --texture texture.png --bytes 9k -q -o t.tks").code, 0);
  const auto image = json("plan t.tks --channel 8k/s --seconds 4");
  EXPECT_EQ(image["bytes"], 4000);
  EXPECT_TRUE(image["triangles"].is_null());
}

TEST_F(CliReceiver, PlansThatMakeNoSenseAreRefused) {
  for (const std::string arguments :
       {"--channel 9k/s", "--seconds 2", "--channel x --seconds 2", "--channel 9k/m --seconds 2",
        "--channel 0 --seconds 2", "--channel 80/s --seconds 1", "--renderer -3 --seconds 1"}) {
    const Outcome run = cli("plan a.tks " + arguments);
    EXPECT_EQ(run.code, 1) << arguments;
    EXPECT_EQ(run.out, "");
  }
  EXPECT_NE(cli("plan a.tks --channel 80/s --seconds 1").err.find("header"), std::string::npos);
}

/// Seen from above errors of heights move little: the texture is worth more of the first bytes.
TEST_F(CliReceiver, ReorderSharesBytesForItsCameraWithoutRegions) {
  ASSERT_EQ(cli("encode height.tif --texture texture.png --bytes 40k --index -q -o one.tks").code,
            0);
  ASSERT_EQ(cli("reorder one.tks --view top -o top.tks").code, 0);
  const std::string judged =
      " --bytes 16k --height height.tif --texture texture.png --view top --json -q";
  const Outcome a = cli("compare one.tks" + judged), b = cli("compare top.tks" + judged);
  if (a.code == 5) GTEST_SKIP() << a.err;
  EXPECT_GT(screenPsnr(b), screenPsnr(a) + 0.2);
}

TEST_F(CliReceiver, ReorderedStreamsHoldTheSameAndServeTheirCamera) {
  ASSERT_EQ(cli("reorder a.tks --view low -o b.tks").code, 0);
  ASSERT_EQ(cli("verify b.tks").code, 0);
  EXPECT_EQ(cli("decode a.tks --height -").out, cli("decode b.tks --height -").out);
  EXPECT_EQ(cli("decode a.tks --texture -").out, cli("decode b.tks --texture -").out);
  EXPECT_NE(content("a.tks"), content("b.tks"));
  const std::string judged =
      " --bytes 16k --height height.tif --texture texture.png --view low --json -q";
  const Outcome a = cli("compare a.tks" + judged), b = cli("compare b.tks" + judged);
  if (a.code == 5) GTEST_SKIP() << a.err;
  EXPECT_GT(screenPsnr(b), screenPsnr(a) + 1);
}

TEST_F(CliReceiver, ReorderRefusesWhatItCannotDo) {
  EXPECT_EQ(cli("reorder a.tks -o b.tks").code, 1);
  ASSERT_EQ(cli("encode height.tif --bytes 4k -q -o plain.tks").code, 0);
  const Outcome plain = cli("reorder plain.tks --view low -o b.tks");
  EXPECT_EQ(plain.code, 1);
  EXPECT_NE(plain.err.find("index"), std::string::npos);
  ASSERT_EQ(cli("encode --texture texture.png --bytes 9k --index -q -o t.tks").code, 0);
  EXPECT_EQ(cli("reorder t.tks --view low -o b.tks").code, 1);
}

TEST_F(CliReceiver, ReorderLooksThroughCamerasThatCountAndSeeGround) {
  const std::string near = R"({"eye": [-900,900,0], "target": [-1200,0,0]})";
  const std::string far =
      R"({"name": "far", "eye": [0,9000,9000], "target": [0,0,0], "weight": 0})";
  const std::string away = R"({"name": "away", "eye": [0,900,0], "target": [0,9000,1]})";
  write("near.json", R"({"cameras": [)" + near + "]}");
  write("both.json", R"({"cameras": [)" + near + ", " + far + "]}");
  write("away.json", R"({"cameras": [)" + near + ", " + away + "]}");
  ASSERT_EQ(cli("reorder a.tks --cameras near.json -o near.tks").code, 0);
  ASSERT_EQ(cli("reorder a.tks --cameras both.json -o both.tks").code, 0);
  EXPECT_EQ(content("near.tks"), content("both.tks"));
  const Outcome blind = cli("reorder a.tks --cameras away.json -o blind.tks");
  EXPECT_EQ(blind.code, 1);
  EXPECT_NE(blind.err.find("'away' sees no ground"), std::string::npos) << blind.err;
}

}  // namespace
}  // namespace tetrakis::test

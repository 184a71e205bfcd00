// SPDX-License-Identifier: Apache-2.0
// combine makes one stream of several, and --component takes out of it what one of them had.
#include <filesystem>
#include <nlohmann/json.hpp>

#include "tests/cli/cli_fixture.hpp"

namespace tetrakis::test {
namespace {

class CliComponent : public CliTest {
 protected:
  /// base.tks, and classes.tks, a texture alone.
  void makeStreams() {
    makeInputs();
    ASSERT_EQ(cli("encode height.tif --texture texture.png --bytes 2k -o base.tks").code, 0);
    ASSERT_EQ(cli("encode --texture texture.png --lossless -o classes.tks").code, 0);
    ASSERT_EQ(cli("encode height.tif --lossless --offset 7 -o later.tks").code, 0);
  }
  void expectRefused(const std::string& arguments, int code, const std::string& words) {
    const Outcome run = cli(arguments);
    EXPECT_EQ(run.code, code) << arguments << run.err;
    EXPECT_NE(run.err.find(words), std::string::npos) << run.err;
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
  }
};

TEST_F(CliComponent, ComeBackByNameAndByNumber) {
  makeStreams();
  ASSERT_EQ(cli("combine base.tks classes=classes.tks 2030=later.tks -o all.tks").code, 0);
  EXPECT_EQ(cli("verify all.tks").code, 0);
  const auto info = nlohmann::json::parse(cli("info all.tks --json").out);
  ASSERT_EQ(info["components"].size(), 4u);
  EXPECT_EQ(info["components"][2]["name"], "classes");
  EXPECT_EQ(info["components"][2]["kind"], "texture");
  EXPECT_EQ(info["components"][3]["kind"], "heights");
  ASSERT_EQ(cli("decode classes.tks --texture own.tif").code, 0);
  ASSERT_EQ(cli("decode later.tks --height own_height.tif").code, 0);
  for (const std::string name : {"classes", "2"}) {
    ASSERT_EQ(cli("decode all.tks --component " + name + " --texture got.tif -f").code, 0);
    EXPECT_TRUE(content("got.tif") == content("own.tif"));
  }
  ASSERT_EQ(cli("decode all.tks --component 2030 --component classes --height got_height.tif "
                "--texture got.tif -f")
                .code,
            0);
  EXPECT_TRUE(content("got_height.tif") == content("own_height.tif"));
  EXPECT_TRUE(content("got.tif") == content("own.tif"));
  const auto taken = nlohmann::json::parse(cli("info all.tks --component 2030 --json").out);
  EXPECT_EQ(taken["heights"]["offset"], 7);
  const auto exact =
      nlohmann::json::parse(cli("compare all.tks --component classes --texture texture.png "
                                "--json")
                                .out);
  EXPECT_EQ(exact["texture_exact"], true);
}

TEST_F(CliComponent, AreEncodedAtOnce) {
  makeInputs();
  ASSERT_EQ(cli("encode height.tif --texture texture.png --also a=texture.png --also b=texture.png "
                "--lossless -o all.tks")
                .code,
            0);
  EXPECT_EQ(nlohmann::json::parse(cli("info all.tks --json").out)["lossless"], true);
  for (const std::string name : {"a", "b"})
    EXPECT_EQ(nlohmann::json::parse(
                  cli("compare all.tks --component " + name + " --texture texture.png --json")
                      .out)["texture_exact"],
              true);
  ASSERT_EQ(
      cli("encode height.tif --also a=texture.png --also-weight a=3 --bytes 1k -o cut.tks").code,
      0);
  EXPECT_LE(content("cut.tks").size(), 1024u);
  expectRefused("encode height.tif --also texture.png --lossless -o b.tks", 1, "has no name");
  expectRefused("encode height.tif --also a=gone.png --lossless -o b.tks", 2, "gone.png");
}

TEST_F(CliComponent, OfOneStreamAreNotListed) {
  makeStreams();
  EXPECT_FALSE(nlohmann::json::parse(cli("info base.tks --json").out).contains("components"));
}

TEST_F(CliComponent, KeepABudgetAndWeights) {
  makeStreams();
  const auto bytesOf = [&](const std::string& weight) {
    EXPECT_EQ(cli("combine base.tks c=classes.tks --bytes 1500 -o cut.tks -f" + weight).code, 0);
    EXPECT_EQ(content("cut.tks").size(), 1500u);
    const auto info = nlohmann::json::parse(cli("info cut.tks --json").out);
    return info["components"][2]["bytes"].get<uint64_t>();
  };
  EXPECT_LT(bytesOf(" --weight c=0.01"), bytesOf(" --weight c=100"));
}

TEST_F(CliComponent, AreRefusedWithASentence) {
  makeStreams();
  ASSERT_EQ(cli("combine base.tks classes=classes.tks -o all.tks").code, 0);
  expectRefused("decode all.tks --component normals --texture t.tif", 1, "'normals'");
  EXPECT_EQ(cliOf({"decode", "all.tks", "--component", "", "--texture", "t.tif"}).code, 1);
  expectRefused("decode all.tks --component 9 --texture t.tif", 1, "no component 9");
  expectRefused("combine base.tks classes.tks -o b.tks", 1, "same name");
  expectRefused("combine base.tks height.tif -o b.tks", 3, "'height.tif'");
  expectRefused("combine base.tks a=nothing.tks -o b.tks", 2, "'nothing.tks'");
  expectRefused("combine base.tks a=classes.tks --weight b=2 -o b.tks", 1, "'b=2'");
  expectRefused("combine base.tks a=classes.tks --weight a=x -o b.tks", 1, "no weight");
  expectRefused("combine base.tks a=classes.tks -o base.tks -f", 1, "base.tks");
  expectRefused("combine base.tks a=classes.tks --bytes 60 -o b.tks", 1, "header");
  EXPECT_FALSE(std::filesystem::exists(path("b.tks")));
  EXPECT_FALSE(std::filesystem::exists(path("t.tif")));
}

}  // namespace
}  // namespace tetrakis::test

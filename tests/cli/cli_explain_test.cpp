// SPDX-License-Identifier: Apache-2.0
// encode --explain, as text and as JSON.
#include <nlohmann/json.hpp>

#include "tests/cli/cli_fixture.hpp"

namespace tetrakis::test {
namespace {

class CliExplain : public CliTest {};

TEST_F(CliExplain, JsonTellsThePlansOfBothComponents) {
  makeInputs(65);
  const std::string encode = "encode height.tif --texture texture.png --lossless -o ";
  ASSERT_EQ(cli(encode + "plain.tks").code, 0);
  const Outcome run = cli("-q " + encode + "a.tks --explain --json");
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_EQ(content("a.tks"), content("plain.tks"));
  const auto plans = nlohmann::json::parse(run.out, nullptr, false);
  const auto info = nlohmann::json::parse(cli("info a.tks --json").out, nullptr, false);
  for (const std::string component : {"heights", "texture"}) {
    size_t taken = 0;
    for (const auto& plan : plans[component]) {
      if (plan["verdict"] != "taken") continue;
      ++taken;
      const char* const bytes = component == "heights" ? "geometry_bytes" : "texture_bytes";
      EXPECT_EQ(plan["coded"]["needed_bytes"], info[bytes]);
      EXPECT_EQ(plan["coded"]["rmse"], 0);
      EXPECT_EQ(plan["base"] == "wavelet", info[component]["coding"] == "wavelet");
      EXPECT_TRUE(plan["filters"].is_array() && plan["layers"].is_array());
    }
    EXPECT_EQ(taken, 1u) << component;
  }
}

TEST_F(CliExplain, TextHasALineForEachPlan) {
  makeInputs(65);
  const Outcome run = cli("-q encode height.tif --max-error 0.5 -o a.tks --explain");
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_TRUE(run.out.starts_with("heights\n  expected  coded  needed"));
  EXPECT_EQ(run.out.find("texture"), std::string::npos);
  EXPECT_NE(run.out.find("  taken  "), std::string::npos);
  const Outcome json = cli("-q encode height.tif --max-error 0.5 -f -o a.tks --explain --json");
  const auto plans = nlohmann::json::parse(json.out, nullptr, false);
  EXPECT_TRUE(plans["texture"].is_null());
  const auto lines = std::count(run.out.begin(), run.out.end(), '\n');
  EXPECT_EQ(static_cast<size_t>(lines), 2 + plans["heights"].size());
}

TEST_F(CliExplain, NeedsStandardOutputForItself) {
  makeInputs();
  const Outcome both = cli("encode height.tif --lossless -o - --explain");
  EXPECT_EQ(both.code, 1);
  EXPECT_EQ(both.out, "");
  EXPECT_EQ(cli("encode height.tif --lossless -o a.tks --json").code, 1);
}

}  // namespace
}  // namespace tetrakis::test

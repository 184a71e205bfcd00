// SPDX-License-Identifier: Apache-2.0
// tetrakis profile: what it says of the terrain along a line, and what it refuses.
#include <cstring>
#include <nlohmann/json.hpp>

#include "tests/cli/cli_fixture.hpp"

namespace tetrakis::test {
namespace {

class CliProfile : public CliTest {
 protected:
  static double sampleOf(const tools::HeightFile& file, uint32_t column, uint32_t row) {
    uint16_t sample = 0;
    std::memcpy(&sample, file.data.data() + 2 * (size_t{row} * file.width + column), sizeof sample);
    return sample * file.scale + file.offset;
  }

  void encode(const tools::HeightFile& file, const std::string& target = "--lossless") {
    ASSERT_TRUE(tools::writeHeights(path("h.tif"), file).ok());
    const Outcome run = cli("encode h.tif -q -f -o h.tks " + target);
    ASSERT_EQ(run.code, 0) << run.err;
  }

  Outcome profile(const std::string& line, const std::string& points,
                  const std::vector<std::string>& more = {}) {
    std::vector<std::string> words{"profile", "h.tks", "--line", line, "--points", points};
    words.insert(words.end(), more.begin(), more.end());
    return cliOf(words);
  }

  nlohmann::json json(const std::string& line, const std::string& points,
                      std::vector<std::string> more = {}) {
    more.push_back("--json");
    const Outcome run = profile(line, points, more);
    EXPECT_EQ(run.code, 0) << run.err;
    return nlohmann::json::parse(run.out, nullptr, false);
  }

  /// The polyline at a distance; NaN in gaps.
  static double heightAt(const nlohmann::json& profile, double distance) {
    const auto& points = profile["points"];
    for (size_t i = 1; i < points.size(); ++i) {
      const double from = points[i - 1]["distance"], to = points[i]["distance"];
      if (points[i]["piece"] != points[i - 1]["piece"] || distance < from || distance > to)
        continue;
      const double low = points[i - 1]["height"], high = points[i]["height"];
      return low + (high - low) * (distance - from) / (to - from);
    }
    return std::nan("");
  }
};

TEST_F(CliProfile, OfAllPointsIsTheGround) {
  const tools::HeightFile file = hills(17);
  encode(file);
  const nlohmann::json row = json("16,5 0,5", "99"), bent = json("2,3 2,14 9,14", "99");
  EXPECT_EQ(row["length"], 480);
  EXPECT_EQ(row["distance_unit"], "m");
  EXPECT_EQ(row["unit"], "m");
  EXPECT_EQ(row["samples"], 17);
  EXPECT_EQ(bent["samples"], 12 + 7);
  EXPECT_NEAR(row["rmse"], 0, 1e-4);
  for (uint32_t k = 0; k < 17; ++k)
    EXPECT_NEAR(heightAt(row, 30.0 * k), sampleOf(file, 16 - k, 5), 1e-6) << k;
  for (uint32_t k = 0; k < 19; ++k) {
    const double height = k < 12 ? sampleOf(file, 2, 3 + k) : sampleOf(file, k - 9, 14);
    EXPECT_NEAR(heightAt(bent, 30.0 * k), height, 1e-6) << k;
  }
}

TEST_F(CliProfile, IsBilinearBetweenSamples) {
  const tools::HeightFile file = hills(17);
  encode(file);
  const nlohmann::json line = json("3.25,4.5 11.5,8", "2");
  ASSERT_EQ(line["points"].size(), 2U);
  const double upper = 0.75 * sampleOf(file, 3, 4) + 0.25 * sampleOf(file, 4, 4);
  const double lower = 0.75 * sampleOf(file, 3, 5) + 0.25 * sampleOf(file, 4, 5);
  EXPECT_NEAR(line["points"][0]["height"], (upper + lower) / 2, 1e-9);
  EXPECT_NEAR(line["points"][1]["height"], (sampleOf(file, 11, 8) + sampleOf(file, 12, 8)) / 2,
              1e-9);
  EXPECT_EQ(line["points"][0]["x"], 3.25);
  EXPECT_EQ(line["points"][0]["y"], 4.5);
}

TEST_F(CliProfile, MorePointsAreNeverWorse) {
  encode(hills(33));
  double before = 1e9;
  for (const char* points : {"2", "3", "4", "7", "12", "30"}) {
    const nlohmann::json line = json("0,0 32,20 5,31", points);
    EXPECT_LE(line["points"].size(), std::stoul(points));
    EXPECT_LE(line["rmse"], before);
    before = line["rmse"];
    EXPECT_EQ(line["algorithm"], "uoptimal");
    EXPECT_TRUE(line["gaps"].empty());
  }
}

TEST_F(CliProfile, WritesCsvOfTheSamePoints) {
  encode(hills(17));
  const nlohmann::json line = json("-3,2 12,9", "6");
  const Outcome run = profile("-3,2 12,9", "6");
  std::istringstream rows(run.out);
  std::string row;
  std::getline(rows, row);
  EXPECT_EQ(row, "piece,distance,height,x,y");
  for (const auto& point : line["points"]) {
    double distance = 0, height = 0, x = 0, y = 0;
    int piece = 0;
    ASSERT_TRUE(std::getline(rows, row));
    ASSERT_EQ(std::sscanf(row.c_str(), "%d,%lf,%lf,%lf,%lf", &piece, &distance, &height, &x, &y),
              5);
    EXPECT_EQ(point["piece"], piece);
    EXPECT_EQ(point["distance"], distance);
    EXPECT_EQ(point["height"], height);
    EXPECT_EQ(point["x"], x);
    EXPECT_EQ(point["y"], y);
  }
  EXPECT_FALSE(std::getline(rows, row));
  EXPECT_NE(run.err.find("1 gap: 0 to "), std::string::npos) << run.err;
  EXPECT_NE(run.err.find("outside the ground"), std::string::npos) << run.err;
  EXPECT_EQ(profile("-3,2 12,9", "6", {"-q"}).err, "");
}

TEST_F(CliProfile, StatesPartsOutsideTheGroundAndOverVoidsAsGaps) {
  tools::HeightFile file = hills(17);
  file.nodata = 65535;
  const uint16_t nothing = 65535;
  for (uint32_t row = 0; row < 17; ++row)
    for (uint32_t column = 6; column < 9; ++column)
      std::memcpy(file.data.data() + 2 * (size_t{row} * 17 + column), &nothing, sizeof nothing);
  encode(file);
  const nlohmann::json line = json("-4,8 20,8", "99");
  ASSERT_EQ(line["gaps"].size(), 3U);
  const auto expectGap = [&](size_t i, double from, double to, const char* why) {
    EXPECT_EQ(line["gaps"][i]["from"], from);
    EXPECT_EQ(line["gaps"][i]["to"], to);
    EXPECT_EQ(line["gaps"][i]["why"], why);
  };
  expectGap(0, 0, 4 * 30, "outside");
  expectGap(1, (4 + 5) * 30, (4 + 9) * 30, "void");
  expectGap(2, (4 + 16) * 30, 24 * 30, "outside");
  EXPECT_EQ(line["samples"], 14);
  for (uint32_t column = 0; column < 17; ++column) {
    const double height = heightAt(line, 30.0 * (column + 4));
    if (column < 6 || column > 8) {
      EXPECT_NEAR(height, sampleOf(file, column, 8), 1e-6) << column;
    } else {
      EXPECT_TRUE(std::isnan(height)) << column;
    }
  }
  // Three corners outside: the way round is one gap.
  const nlohmann::json round = json("0,8 -5,8 -5,30 3,30 3,16", "99");
  ASSERT_EQ(round["gaps"].size(), 1U);
  EXPECT_EQ(round["gaps"][0]["from"], 0);
  EXPECT_EQ(round["gaps"][0]["to"], round["length"]);
  EXPECT_EQ(round["samples"], 2);

  const Outcome few = profile("-4,8 20,8", "3");
  EXPECT_EQ(few.code, 1);
  EXPECT_NE(few.err.find("--points must be at least 4"), std::string::npos) << few.err;
  EXPECT_EQ(profile("7,2 7,9", "5").code, 1);
  EXPECT_EQ(profile("-7,2 -3,9", "5").code, 1);
}

TEST_F(CliProfile, OfAPrefixIsThatOfItsHeights) {
  encode(hills(33));
  const auto size = std::filesystem::file_size(path("h.tks"));
  for (uint64_t bytes = 120; bytes <= size; bytes += 37) {
    const std::string cut = std::to_string(bytes);
    if (cli("info h.tks --bytes " + cut).code != 0) continue;
    ASSERT_EQ(cli("decode h.tks -q -f --height d.tif --bytes " + cut).code, 0);
    const auto decoded = tools::readHeights(path("d.tif"));
    ASSERT_TRUE(decoded.ok());
    const nlohmann::json line = json("4,30 4,3", "99", {"--bytes", cut});
    for (uint32_t k = 0; k <= 27; ++k)
      EXPECT_NEAR(heightAt(line, 30.0 * k), sampleOf(*decoded, 4, 30 - k), 1e-4) << cut << ' ' << k;
  }
}

TEST_F(CliProfile, TakesCoordinatesOfTheCrs) {
  tools::HeightFile file = hills(17);
  encode(file);
  EXPECT_EQ(profile("3,3 9,9", "5", {"--geo"}).code, 1);
  file.geotransform = {2600000, 25, 0, 1200000, 0, -20};
  file.crs = "EPSG:2056";
  file.spacing_x = 25;
  file.spacing_y = 20;
  encode(file);
  // The middle of sample (c, r) lies at 2600000 + 25 (c + 1/2), 1200000 - 20 (r + 1/2).
  const nlohmann::json geographic = json("2600087.5,1199930 2600312.5,1199770", "9", {"--geo"}),
                       plain = json("3,3 12,11", "9");
  EXPECT_NEAR(geographic["length"], std::hypot(9 * 25, 8 * 20), 1e-6);
  ASSERT_EQ(geographic["points"].size(), plain["points"].size());
  for (size_t i = 0; i < plain["points"].size(); ++i) {
    const auto &a = geographic["points"][i], &b = plain["points"][i];
    EXPECT_NEAR(a["distance"], b["distance"], 1e-6);
    EXPECT_NEAR(a["height"], b["height"], 1e-6);
    EXPECT_NEAR(a["x"], 2600000 + 25 * (b["x"].get<double>() + 0.5), 1e-5);
    EXPECT_NEAR(a["y"], 1200000 - 20 * (b["y"].get<double>() + 0.5), 1e-5);
  }
  // Corners of the raster are on its border, whatever the rounding.
  EXPECT_TRUE(json("2600012.5,1199990 2600412.5,1199670", "9", {"--geo"})["gaps"].empty());
}

TEST_F(CliProfile, CountsDistancesInSamplesWithoutASpacing) {
  tools::HeightFile file = hills(17);
  file.spacing_x = file.spacing_y = 0;
  encode(file);
  const nlohmann::json line = json("0,0 3,4", "9");
  EXPECT_EQ(line["distance_unit"], "samples");
  EXPECT_EQ(line["length"], 5);
}

TEST_F(CliProfile, TakesNarrowGroundAndOneSampleOfIt) {
  tools::HeightFile file = hills(10);
  file.width = 2;
  file.height = 50;
  encode(file);
  EXPECT_EQ(json("1,0 1,49", "50")["samples"], 50);
  const nlohmann::json corner = json("2,-1 0,1", "3"), across = json("-5,3 5,3", "2");
  EXPECT_EQ(corner["samples"], 3);
  EXPECT_EQ(across["points"].size(), 2U);
  EXPECT_EQ(across["gaps"].size(), 2U);
  const nlohmann::json touched = json("-1,1 1,-1", "2");
  EXPECT_EQ(touched["points"].size(), 1U);
  EXPECT_EQ(touched["gaps"].size(), 2U);
}

TEST_F(CliProfile, RefusesWhatMakesNoSenseInOneSentence) {
  makeStream();
  encode(hills(17));
  const auto expectFailure = [&](const Outcome& run, int code) {
    EXPECT_EQ(run.code, code) << run.err;
    EXPECT_EQ(run.out, "");
    EXPECT_TRUE(run.err.starts_with("tetrakis: ")) << run.err;
  };
  for (const char* line : {"", "3,3", "3,3 3,3 3,3", "3 3", "3,3 4;4", "3,3 4,nan", "3,3 4,inf",
                           "3,3 4,4x", "3,3 4,4,4", "3,3 1e300,4", "-9,-9 -2,-3"})
    expectFailure(profile(line, "5"), 1);
  for (const char* points : {"0", "1", "-3", "x", "1.5"})
    expectFailure(profile("3,3 9,9", points), 1);
  expectFailure(cliOf({"profile", "h.tks", "--points", "5"}), 1);
  expectFailure(cliOf({"profile", "h.tks", "--line", "3,3 9,9"}), 1);
  expectFailure(cliOf({"profile", "none.tks", "--line", "3,3 9,9", "--points", "5"}), 2);
  expectFailure(cliOf({"profile", "h.tif", "--line", "3,3 9,9", "--points", "5"}), 3);
  expectFailure(profile("3,3 9,9", "5", {"--bytes", "9"}), 4);
  ASSERT_EQ(cli("encode --texture texture.png --lossless -o t.tks").code, 0);
  expectFailure(cliOf({"profile", "t.tks", "--line", "3,3 9,9", "--points", "5"}), 1);
  std::string far = "0,0";
  for (int i = 0; i < 60000; ++i) far += " 16,16 0,0 16,0 0,16";
  expectFailure(profile(far, "5"), 6);
}

}  // namespace
}  // namespace tetrakis::test

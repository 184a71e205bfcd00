// SPDX-License-Identifier: Apache-2.0
// Sequences on the command line: frames of files in and out, targets, cuts, comparisons, and
// mistakes with the name of the file in their sentence.
#include <nlohmann/json.hpp>

#include "tests/cli/cli_fixture.hpp"

namespace tetrakis::test {
namespace {

class CliSequence : public CliTest {
 protected:
  using Json = nlohmann::json;

  void synth(const std::string& kind, uint32_t frames, uint32_t size = 33) {
    const Outcome made = cli("synth -q --kind " + kind + " --frames " + std::to_string(frames) +
                             " --size " + std::to_string(size) + " -o " + kind);
    ASSERT_EQ(made.code, 0) << made.err;
  }
  Json json(const std::string& arguments) {
    const Outcome outcome = cli(arguments + " --json -q");
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return Json::parse(outcome.out, nullptr, false);
  }
  static std::string file(const std::string& kind, uint32_t frame, const std::string& extension) {
    return kind + "/frame-00" + std::to_string(frame) + extension;
  }
};

TEST_F(CliSequence, FramesComeBackByNumberAndByTime) {
  for (const std::string kind : {"erosion", "rover"}) {
    synth(kind, 7);
    const Outcome encoded =
        cliOf({"encode", kind + "/*.tif", "--every", "1800", "--epoch", "2019-03-01T00:00:00Z",
               "--group", "3", "--lossless", "-o", kind + ".tks"});
    ASSERT_EQ(encoded.code, 0) << encoded.err;
    EXPECT_NE(encoded.err.find("7 frames"), std::string::npos);
    for (const uint32_t frame : {0u, 4u, 6u}) {
      const std::string by_time = std::to_string(1800 * frame + 900);
      for (const std::string& which : {"--frame " + std::to_string(frame), "--time " + by_time}) {
        const Outcome decoded = cli("decode -q " + kind + ".tks " + which + " --height o.tif -f");
        ASSERT_EQ(decoded.code, 0) << decoded.err;
        const auto original = tools::readHeights(path(file(kind, frame, ".tif")));
        const auto copy = tools::readHeights(path("o.tif"));
        ASSERT_TRUE(original.ok() && copy.ok());
        EXPECT_TRUE(sameBytes(copy->data, original->data)) << kind << " " << which;
      }
    }
    const Json info = json("info " + kind + ".tks --frame 4");
    EXPECT_EQ(info["sequence"]["frames"], 7);
    EXPECT_EQ(info["sequence"]["groups"], 3);
    EXPECT_EQ(info["sequence"]["seconds"], 4 * 1800);
    EXPECT_EQ(info["sequence"]["epoch"], "2019-03-01T00:00:00Z");
    EXPECT_EQ(info["frame"], 1);
  }
}

/// Times are rounded numbers: each is still that of its own frame.
TEST_F(CliSequence, TimesThatInfoTellsFindTheirFrames) {
  synth("erosion", 9, 5);
  for (const std::string fps : {"29.97", "3", "7", "59.94"}) {
    ASSERT_EQ(
        cliOf({"encode", "erosion/*.tif", "--fps", fps, "--lossless", "-q", "-f", "-o", "e.tks"})
            .code,
        0);
    for (uint32_t frame = 0; frame < 9; ++frame) {
      const Json told = json("info e.tks --frame " + std::to_string(frame))["sequence"];
      const Json found = json("info e.tks --time " + told["seconds"].dump())["sequence"];
      EXPECT_EQ(found["frame"], frame) << fps << " frames a second";
    }
  }
}

/// However many threads there are, heights and texture of one call are those of one frame.
TEST_F(CliSequence, HeightsAndTextureAreOfOneFrame) {
  synth("flood", 4);
  synth("clouds", 4);
  ASSERT_EQ(cliOf({"encode", "flood/*.tif", "--texture", "clouds/*.png", "--group", "2",
                   "--reference", "all", "--lossless", "-q", "-o", "f.tks"})
                .code,
            0);
  for (const char* threads : {"1", "3"}) {
    ASSERT_EQ(cli(std::string("decode -q f.tks --frame 3 --height o.tif --texture o.png -f ") +
                  "--threads " + threads)
                  .code,
              0);
    const auto original = tools::readImage(path(file("clouds", 3, ".png")));
    const auto copy = tools::readImage(path("o.png"));
    ASSERT_TRUE(original.ok() && copy.ok());
    EXPECT_TRUE(sameBytes(copy->data, original->data)) << threads;
  }
}

TEST_F(CliSequence, EveryFrameKeepsItsPromise) {
  synth("flood", 5);
  ASSERT_EQ(cliOf({"encode", "flood/*.tif", "--max-error", "1m", "-q", "-o", "f.tks"}).code, 0);
  const Json compared = json("compare f.tks --height flood/*.tif");
  EXPECT_EQ(compared["frames"], 5);
  EXPECT_LE(compared["height_max_error"], 1);
  EXPECT_GT(compared["height_max_error"], 0.1);
  EXPECT_EQ(compared["of_frames"].size(), 5u);
}

TEST_F(CliSequence, BytesAreThoseOfAllFrames) {
  synth("clouds", 6);
  ASSERT_EQ(cliOf({"encode", "--texture", "clouds/*.png", "--bytes", "6000", "--group", "4", "-q",
                   "-o", "all.tks"})
                .code,
            0);
  EXPECT_LE(content("all.tks").size(), 6000u);
  EXPECT_GE(content("all.tks").size(), 5900u);
  ASSERT_EQ(cliOf({"encode", "--texture", "clouds/*.png", "--rate", "2000", "--fps", "4", "--group",
                   "3", "-q", "-o", "rate.tks"})
                .code,
            0);
  EXPECT_LE(content("rate.tks").size(), 3000u);
  const Json compared = json("compare all.tks --texture clouds/*.png");
  EXPECT_GT(compared["texture_psnr"], 15);
}

TEST_F(CliSequence, CutsKeepWholeGroupsAndAPartOfTheNext) {
  synth("erosion", 6);
  ASSERT_EQ(
      cliOf({"encode", "erosion/*.tif", "--group", "3", "--lossless", "-q", "-o", "e.tks"}).code,
      0);
  const Json second = json("info e.tks --frame 3");
  const size_t bytes = second["sequence"]["group_offset"].get<size_t>() + 400;
  ASSERT_EQ(cli("truncate e.tks --bytes " + std::to_string(bytes) + " -o cut.tks").code, 0);
  EXPECT_EQ(content("cut.tks"), content("e.tks").substr(0, bytes));
  const Json cut = json("info cut.tks --frame 5");
  EXPECT_EQ(cut["complete"], false);
  EXPECT_EQ(
      json("compare cut.tks --frame 2 --height " + file("erosion", 2, ".tif"))["height_exact"],
      true);
  EXPECT_EQ(
      json("compare cut.tks --frame 5 --height " + file("erosion", 5, ".tif"))["height_exact"],
      false);
  EXPECT_EQ(cli("info cut.tks --strict").code, 4);
}

TEST_F(CliSequence, GroupsGoOnFromTheOneBefore) {
  synth("rover", 9);
  const auto encoded = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {"encode", "rover/*.tif", "--group", "2",    "--lossless",
                                          "-q",     "-f",          "-o",      "r.tks"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    EXPECT_EQ(cliOf(arguments).code, 0);
    return content("r.tks").size();
  };
  const size_t alone = encoded({});
  EXPECT_LT(encoded({"--reference", "all", "--entry", "3"}), alone);
  const Json info = json("info r.tks --frame 8");
  EXPECT_EQ(info["sequence"]["group_depth"], 1);
  EXPECT_GT(info["sequence"]["group_bytes_back"], 0);
  for (const uint32_t frame : {8u, 3u}) {
    const std::string number = std::to_string(frame);
    ASSERT_EQ(cli("decode r.tks --frame " + number + " --height o.tif -q -f").code, 0);
    EXPECT_TRUE(sameBytes(tools::readHeights(path("o.tif"))->data,
                          tools::readHeights(path(file("rover", frame, ".tif")))->data));
  }
  EXPECT_EQ(json("compare r.tks --height rover/*.tif")["height_max_error"], 0);
  EXPECT_EQ(cli("verify r.tks -q").code, 0);
  EXPECT_EQ(cliOf({"encode", "rover/*.tif", "--lossless", "--entry", "2", "-o", "x.tks"}).code, 1);
  EXPECT_EQ(
      cliOf({"encode", "rover/*.tif", "--lossless", "--reference", "none", "-o", "x.tks"}).code, 1);
}

TEST_F(CliSequence, GrowAtTheirEnd) {
  synth("erosion", 5);
  ASSERT_EQ(cliOf({"encode", "erosion/*.tif", "--fps", "2", "--group", "3", "--lossless", "-q",
                   "-o", "e.tks"})
                .code,
            0);
  std::filesystem::create_directory(path("late"));
  for (const char* name : {"frame-003.tif", "frame-004.tif"})
    std::filesystem::rename(path("erosion/") + name, path("late/") + name);
  const std::string all = content("e.tks");
  const Json first = json("info e.tks --frame 3");
  const auto whole = first["sequence"]["group_offset"].get<size_t>();
  write("e.tks", all.substr(0, all.size() - 20));  // its writer stopped inside the second group
  const Outcome added =
      cliOf({"encode", "late/*.tif", "--group", "3", "--lossless", "--append", "-o", "e.tks"});
  ASSERT_EQ(added.code, 0) << added.err;
  EXPECT_NE(added.err.find(std::to_string(all.size() - 20 - whole) + " bytes"), std::string::npos)
      << added.err;
  EXPECT_EQ(content("e.tks"), all);
  synth("rover", 2, 17);
  const std::string before = content("e.tks");
  EXPECT_EQ(cliOf({"encode", "rover/*.tif", "--lossless", "--append", "-q", "-o", "e.tks"}).code,
            1);
  EXPECT_EQ(content("e.tks"), before);
  EXPECT_NE(cliOf({"encode", "late/*.tif", "--lossless", "--append", "-q", "-o", "no.tks"}).code,
            0);
}

TEST_F(CliSequence, AreThinnedForAChannel) {
  synth("flood", 6, 65);
  ASSERT_EQ(cliOf({"encode", "flood/*.tif", "--fps", "2", "--group", "2", "--lossless",
                   "--reference", "400", "-q", "-o", "f.tks"})
                .code,
            0);
  ASSERT_EQ(cli("truncate f.tks --rate 1200 -o thin.tks -q").code, 0);
  EXPECT_LT(content("thin.tks").size(), content("f.tks").size());
  EXPECT_EQ(cli("verify thin.tks -q").code, 4);  // groups that are cut are no whole streams
  const Json compared = json("compare thin.tks --height flood/*.tif");
  EXPECT_EQ(compared["frames"], 6);
  EXPECT_EQ(cli("truncate f.tks --rate 1200 --bytes 900 -o x.tks").code, 1);
  EXPECT_EQ(cli("truncate f.tks -o x.tks").code, 1);
}

/// A sequence has one place, reference system and unit. What a frame leaves unsaid is as before.
TEST_F(CliSequence, FramesLieOnTheSameGround) {
  synth("erosion", 3, 9);
  const std::string name = path("erosion/frame-001.tif");
  const tools::HeightFile original = *tools::readHeights(name);
  tools::HeightFile moved = original, elsewhere = original, feet = original, silent;
  (*moved.geotransform)[0] += 30;
  elsewhere.crs = "EPSG:32633";
  feet.unit = "ft";
  silent.width = original.width;
  silent.height = original.height;
  silent.sample = original.sample;
  silent.data = original.data;
  silent.scale = original.scale;
  ASSERT_EQ(cliOf({"encode", "erosion/frame-00[0].tif", "--lossless", "-q", "-o", "a.tks"}).code,
            0);
  for (const tools::HeightFile& other : {moved, elsewhere, feet, silent}) {
    ASSERT_TRUE(tools::writeHeights(name, other).ok());
    const int expected = other.geotransform ? 1 : 0;
    const Outcome all = cliOf({"encode", "erosion/*.tif", "--lossless", "-q", "-f", "-o", "x.tks"});
    EXPECT_EQ(all.code, expected) << all.err;
    EXPECT_EQ(all.err.find("frame-001.tif") != std::string::npos, expected != 0) << all.err;
    const Outcome appended =
        cliOf({"encode", "erosion/frame-00[1].tif", "--lossless", "-q", "--append", "-o", "a.tks"});
    EXPECT_EQ(appended.code, expected) << appended.err;
  }
}

TEST_F(CliSequence, MistakesAreSentences) {
  synth("erosion", 2);
  synth("rover", 3, 17);
  const Outcome none = cliOf({"encode", "none/*.tif", "--lossless", "-o", "x.tks"});
  EXPECT_EQ(none.code, 2);
  EXPECT_NE(none.err.find("none/*.tif"), std::string::npos);
  std::filesystem::copy_file(path("rover/frame-002.tif"), path("erosion/frame-002.tif"));
  const Outcome unlike = cliOf({"encode", "erosion/*.tif", "--lossless", "-q", "-o", "x.tks"});
  EXPECT_EQ(unlike.code, 1);
  EXPECT_NE(unlike.err.find("frame-002.tif"), std::string::npos);
  EXPECT_EQ(names().count("x.tks"), 0u);
  EXPECT_EQ(cli("encode rover/frame-000.tif --fps 2 --lossless -o x.tks").code, 1);
  ASSERT_EQ(cliOf({"encode", "rover/*.tif", "--lossless", "-q", "-o", "r.tks"}).code, 0);
  EXPECT_EQ(cli("decode r.tks --frame 3 --height o.tif").code, 1);
  EXPECT_EQ(cli("decode r.tks --time 1 --height o.tif").code, 1);  // nobody knows its ticks
  for (const uint32_t bytes : {0u, 1u, 2u, 3u, 4u, 30u, 80u}) {
    std::filesystem::copy_file(path("r.tks"), path("cut.tks"),
                               std::filesystem::copy_options::overwrite_existing);
    std::filesystem::resize_file(path("cut.tks"), bytes);
    EXPECT_EQ(cli("info cut.tks").code, 4) << bytes;
  }
}

}  // namespace
}  // namespace tetrakis::test

// SPDX-License-Identifier: Apache-2.0
// tetrakis mosaic: sources of many files, workers that share a folder, and workers that die.
#include <signal.h>

#include <chrono>
#include <random>
#include <thread>

#include "tests/cli/cli_fixture.hpp"

namespace tetrakis::test {
namespace {

using tools::HeightFile;

class CliMosaic : public CliTest {
 protected:
  static constexpr uint32_t kSide = 300;
  static constexpr const char* kPlan = " --lossless --tile 64 --regions 32";

  static HeightFile ground() {
    HeightFile file = hills(kSide);
    file.crs = "EPSG:32633";
    file.geotransform = {500000, 30, 0, 4000000, 0, -30};
    file.registration = TKS_REGISTRATION_AREA;
    return file;
  }

  /// Columns and rows of a file, where they lie.
  static HeightFile cutOut(const HeightFile& from, uint32_t x, uint32_t y, uint32_t width,
                           uint32_t height) {
    HeightFile part = from;
    part.width = width;
    part.height = height;
    part.data.clear();
    const size_t sample = tks_sample_bytes(from.sample);
    for (uint32_t row = y; row < y + height; ++row) {
      const auto* first = from.data.data() + (size_t{row} * from.width + x) * sample;
      part.data.insert(part.data.end(), first, first + width * sample);
    }
    part.geotransform = tools::movedTo(*from.geotransform, x, y);
    return part;
  }

  /// Writes ground.tif, and the folder tiles/ of four files that overlap by a column and a row.
  void makeTiles() {
    const HeightFile all = ground();
    ASSERT_TRUE(tools::writeHeights(path("ground.tif"), all).ok());
    std::filesystem::create_directory(path("tiles"));
    for (const uint32_t x : {0u, 250u}) {
      for (const uint32_t y : {0u, 240u}) {
        const uint32_t width = x == 0 ? 251 : kSide - x, height = y == 0 ? 241 : kSide - y;
        const std::string name = "tiles/" + std::to_string(x) + "-" + std::to_string(y) + ".tif";
        ASSERT_TRUE(tools::writeHeights(path(name), cutOut(all, x, y, width, height)).ok());
      }
    }
  }

  void plan(const std::string& source, const std::string& work = "w") {
    const Outcome run = cli("mosaic plan " + source + " -o " + work + kPlan);
    ASSERT_EQ(run.code, 0) << run.err;
  }
  void finish(const std::string& work, const std::string& stream) {
    Outcome run = cli("mosaic code " + work);
    ASSERT_EQ(run.code, 0) << run.err;
    run = cli("mosaic merge -f " + work + " -o " + stream);
    ASSERT_EQ(run.code, 0) << run.err;
  }
  size_t tasks(const std::string& work) {
    const std::string names = cli("mosaic tasks " + work).out;
    return static_cast<size_t>(std::count(names.begin(), names.end(), '\n'));
  }
  size_t left(const std::string& work) {
    const Outcome run = cli("mosaic status " + work);
    EXPECT_EQ(run.code, 0) << run.err;
    return std::stoul(run.out.substr(run.out.find("left") + 4));
  }
};

TEST_F(CliMosaic, FilesOnAGridAreOnePlane) {
  makeTiles();
  plan("ground.tif", "whole");
  plan("tiles", "parts");
  finish("whole", "whole.tks");
  finish("parts", "parts.tks");
  EXPECT_EQ(content("whole.tks"), content("parts.tks"));
  Outcome run = cli("decode parts.tks --height back.tif");
  ASSERT_EQ(run.code, 0) << run.err;
  run = cli("compare ground.tif back.tif --json");
  const Result<HeightFile> back = tools::readHeights(path("back.tif"));
  ASSERT_TRUE(back.ok());
  const HeightFile all = ground();
  EXPECT_TRUE(back->data == all.data);
  EXPECT_EQ(back->geotransform, all.geotransform);
  EXPECT_EQ(back->crs, all.crs);
  EXPECT_EQ(cli("verify parts.tks").code, 0);
}

TEST_F(CliMosaic, AnyNumberOfWorkersMakeTheSameFile) {
  makeTiles();
  plan("tiles", "one");
  finish("one", "one.tks");
  plan("tiles", "seven");
  for (int group = 0; group < 6; ++group) {  // three that code, and three that restore
    std::string workers;
    for (int i = 1; i <= 7; ++i) {
      workers += "$TETRAKIS -q mosaic code seven --group " + std::to_string(group) + " --part " +
                 std::to_string(i) + "/7 & ";
    }
    const Outcome run = shell(workers + "wait");
    ASSERT_EQ(run.code, 0) << run.err;
  }
  ASSERT_EQ(cli("mosaic merge seven -o seven.tks").code, 0);
  EXPECT_EQ(content("seven.tks"), content("one.tks"));
}

TEST_F(CliMosaic, MakeRunsTheTasks) {
  makeTiles();
  plan("tiles", "one");
  finish("one", "one.tks");
  plan("tiles", "made");
  Outcome run = shell("$TETRAKIS mosaic tasks made --make | make -s -j3 -f -");
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_EQ(left("made"), 0u);
  ASSERT_EQ(cli("mosaic merge made -o made.tks").code, 0);
  EXPECT_EQ(content("made.tks"), content("one.tks"));
  run = cli("mosaic tasks made --json");
  EXPECT_NE(run.out.find("\"id\": \"g0-x1-y2\""), std::string::npos) << run.out;
}

/// Workers that nobody asks before they end.
TEST_F(CliMosaic, KilledWorkersCostTheirTileAlone) {
  makeTiles();
  plan("tiles", "one");
  finish("one", "one.tks");
  plan("tiles", "killed");
  std::mt19937 random(7);
  for (int round = 0; round < 20; ++round) {
    const pid_t worker = fork();
    if (worker == 0) {
      std::filesystem::current_path(folder());
      execl(TETRAKIS_CLI, "tetrakis", "-q", "mosaic", "code", "killed", "--threads", "1", nullptr);
      _exit(127);
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(random() % 60));
    kill(worker, SIGKILL);
    waitpid(worker, nullptr, 0);
  }
  finish("killed", "killed.tks");
  EXPECT_EQ(content("killed.tks"), content("one.tks"));
}

/// As make has it: what is older than its source runs again, and then what has come out otherwise.
TEST_F(CliMosaic, AChangedSourceRunsItsTilesAgain) {
  makeTiles();
  plan("tiles");
  finish("w", "before.tks");
  EXPECT_EQ(left("w"), 0u);
  HeightFile corner = cutOut(ground(), 250, 240, kSide - 250, kSide - 240);
  corner.data[2 * (30 * corner.width + 20)] ^= std::byte{3};
  std::filesystem::remove(path("tiles/250-240.tif"));
  ASSERT_TRUE(tools::writeHeights(path("tiles/250-240.tif"), corner).ok());
  EXPECT_GT(left("w"), 0u);
  EXPECT_LT(left("w"), tasks("w"));  // tiles at the far corner read other samples
  finish("w", "after.tks");
  EXPECT_EQ(left("w"), 0u);
  plan("tiles", "fresh");
  finish("fresh", "fresh.tks");
  EXPECT_EQ(content("after.tks"), content("fresh.tks"));
  EXPECT_NE(content("after.tks"), content("before.tks"));
}

TEST_F(CliMosaic, DamagedPartsAreMadeAgain) {
  makeTiles();
  plan("tiles");
  finish("w", "a.tks");
  write("w/g0-x1-y1.part", content("w/g0-x1-y1.part").substr(0, 500));
  Outcome run = cli("mosaic merge w -o b.tks");
  EXPECT_EQ(run.code, 2);
  EXPECT_NE(run.err.find("g0-x1-y1.part"), std::string::npos) << run.err;
  EXPECT_FALSE(std::filesystem::exists(path("b.tks")));
  // The tile, and those that read its codewords.
  EXPECT_GE(left("w"), 1u);
  EXPECT_LT(left("w"), tasks("w"));
  finish("w", "b.tks");
  EXPECT_EQ(content("b.tks"), content("a.tks"));
}

TEST_F(CliMosaic, ReadsRawSamplesAndSrtmTiles) {
  const HeightFile all = ground();
  ASSERT_TRUE(tools::writeHeights(path("ground.raw"), all).ok());
  plan("ground.raw:300x300:u16", "raw");
  finish("raw", "raw.tks");
  ASSERT_EQ(cli("decode raw.tks --height back.raw").code, 0);
  EXPECT_EQ(content("back.raw"), content("ground.raw"));
  const std::string row(1201 * 2, '\1');
  std::string tile;
  for (int i = 0; i < 1201; ++i) tile += row;
  std::filesystem::create_directory(path("srtm"));
  write("srtm/N46E007.hgt", tile);
  write("srtm/N46E009.hgt", tile);
  const Outcome run = cli("mosaic plan srtm -o tiles --lossless --tile 1024");
  ASSERT_EQ(run.code, 0) << run.err;
  finish("tiles", "srtm.tks");
  const Outcome info = cli("info srtm.tks --json");
  EXPECT_NE(info.out.find("\"width\": 3601"), std::string::npos) << info.out;
}

TEST_F(CliMosaic, SaysWhatIsWrongWithSources) {
  makeTiles();
  const auto refused = [&](const std::string& arguments, int code, const std::string& word) {
    const Outcome run = cli("mosaic plan " + arguments + " -o bad");
    EXPECT_EQ(run.code, code) << arguments;
    EXPECT_NE(run.err.find(word), std::string::npos) << run.err;
    EXPECT_FALSE(std::filesystem::exists(path("bad/plan")));
  };
  refused("nowhere.tif --lossless", 2, "nowhere.tif");
  write("ground.tif.msk", "a mask");
  refused("ground.tif --lossless", 1, "mask");
  std::filesystem::remove(path("ground.tif.msk"));
  refused("tiles", 1, "required");
  refused("tiles --lossless --psnr 50", 1, "");
  refused("tiles --lossless --tile 100", 1, "powers of two");
  HeightFile other = cutOut(ground(), 0, 0, 100, 100);
  other.geotransform = {500015, 30, 0, 4000000, 0, -30};
  ASSERT_TRUE(tools::writeHeights(path("tiles/shifted.tif"), other).ok());
  refused("tiles --lossless", 1, "part of a pixel");
  other.geotransform = {500000, 20, 0, 4000000, 0, -20};
  ASSERT_TRUE(tools::writeHeights(path("tiles/shifted.tif"), other).ok());
  refused("tiles --lossless", 1, "another size");
  std::filesystem::remove(path("tiles/shifted.tif"));
  std::filesystem::remove(path("tiles/0-0.tif"));
  refused("tiles --lossless", 1, "--nodata");
  plan("tiles --nodata 0", "gap");
  finish("gap", "gap.tks");
  plan("tiles --nodata 0", "vanished");
  std::filesystem::remove(path("tiles/250-0.tif"));
  const Outcome run = cli("mosaic code vanished");
  EXPECT_EQ(run.code, 2);
}

TEST_F(CliMosaic, RefusesTilesThatMemoryCannotHold) {
  makeTiles();
  plan("tiles");
  const Outcome run = cli("mosaic code w --max-memory 60M");
  EXPECT_EQ(run.code, 6);
  EXPECT_FALSE(std::filesystem::exists(path("w/g0-x0-y0.part")));
}

/// Streams that were coded apart, from a source that was cut: one plane, without a step at the cut.
TEST_F(CliMosaic, JoinsStreamsThatAdjoin) {
  makeTiles();
  for (const char* name : {"0-0", "250-0", "0-240", "250-240"}) {
    const std::string tile = name;
    ASSERT_EQ(cli("encode tiles/" + tile + ".tif --lossless -o tiles/" + tile + ".tks").code, 0);
    std::filesystem::remove(path("tiles/" + tile + ".tif"));
  }
  Outcome run = cli("mosaic join tiles -o joined.tks --lossless --tile 64 --regions 32");
  ASSERT_EQ(run.code, 0) << run.err;
  plan("ground.tif");
  finish("w", "whole.tks");
  EXPECT_EQ(content("joined.tks"), content("whole.tks"));
  for (const std::string& name : names()) EXPECT_FALSE(name.starts_with(".")) << name;
  run = cli("mosaic join tiles -o joined.tks --lossless");
  EXPECT_EQ(run.code, 2) << "there is a file already";
  run = cli("mosaic join nowhere.tif -o other.tks --lossless");
  EXPECT_EQ(run.code, 2);
  EXPECT_FALSE(std::filesystem::exists(path("other.tks")));
}

TEST_F(CliMosaic, VerifiesEverySample) {
  makeTiles();
  plan("tiles");
  finish("w", "a.tks");
  Outcome run = cli("mosaic verify w a.tks");
  EXPECT_EQ(run.code, 0) << run.err;
  for (int i = 1; i <= 3; ++i)
    EXPECT_EQ(cli("mosaic verify w a.tks --part " + std::to_string(i) + "/3").code, 0);
  ASSERT_EQ(cli("mosaic join tiles -o rough.tks --max-error 2 --tile 64 --regions 32").code, 0);
  EXPECT_EQ(cli("mosaic verify w rough.tks").code, 0);
  HeightFile other = ground();
  other.data[2 * (123 * kSide + 45)] ^= std::byte{8};
  ASSERT_TRUE(tools::writeHeights(path("other.tif"), other).ok());
  ASSERT_EQ(cli("encode other.tif --lossless -o other.tks").code, 0);
  run = cli("mosaic verify w other.tks");
  EXPECT_EQ(run.code, 7);
  EXPECT_NE(run.err.find("8"), std::string::npos) << run.err;
}

/// The samples alone would take more than the whole process may.
TEST_F(CliMosaic, CodesPlanesThatDoNotFitIntoMemory) {
  write("all.raw", "");
  std::filesystem::resize_file(path("all.raw"), uint64_t{2} * 16384 * 16384);
  const Outcome run = shell(
      "ulimit -v 450000; $TETRAKIS mosaic plan all.raw:16384x16384:i16 -o w --lossless --tile 2048 "
      "&& $TETRAKIS mosaic code w --threads 2 && $TETRAKIS mosaic merge w -o a.tks");
  EXPECT_EQ(run.code, 0) << run.err;
  const Outcome info = cli("info a.tks --json");
  EXPECT_NE(info.out.find("\"width\": 16384"), std::string::npos) << info.out;
}

}  // namespace
}  // namespace tetrakis::test

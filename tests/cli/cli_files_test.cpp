// SPDX-License-Identifier: Apache-2.0
// Files, standard input and output: what goes in comes out, whole or not at all.
#include <sys/stat.h>

#include "apps/tools/files/meshes/surface_file.hpp"
#include "tests/cli/cli_fixture.hpp"
#include "tests/support/tiny_tiff.hpp"

namespace tetrakis::test {
namespace {

using CliFiles = CliTest;

TEST_F(CliFiles, LosslessRoundTripKeepsSamplesTypeAndMetadata) {
  makeStream();
  ASSERT_EQ(cli("decode a.tks --height h.tif --texture t.png").code, 0);
  const auto heights = tools::readHeights(path("h.tif"));
  ASSERT_TRUE(heights.ok());
  const tools::HeightFile original = hills(17);
  EXPECT_TRUE(sameBytes(heights->data, original.data));
  EXPECT_EQ(heights->sample, original.sample);
  EXPECT_EQ(heights->scale, original.scale);
  EXPECT_EQ(heights->unit, original.unit);
  const auto image = tools::readImage(path("t.png"));
  ASSERT_TRUE(image.ok());
  EXPECT_TRUE(sameBytes(image->data, photo(34).data));
}

TEST_F(CliFiles, StandardInputAndOutputCarryTheSameBytesAsFiles) {
  makeStream();
  ASSERT_EQ(cli("decode a.tks --height h.tif").code, 0);
  const std::string stream = content("a.tks");
  const std::string target = " --texture texture.png --lossless -q -o -";
  EXPECT_EQ(cli("encode height.tif" + target).out, stream);
  EXPECT_EQ(cli("encode -" + target, "height.tif").out, stream);
  EXPECT_EQ(cli("truncate - --bytes 1M -o -", "a.tks").out, stream);
  EXPECT_EQ(cli("decode - --height -", "a.tks").out, content("h.tif"));
  EXPECT_EQ(shell("cat a.tks | \"$TETRAKIS\" truncate - --bytes 300 -o - | "
                  "\"$TETRAKIS\" decode - --height -")
                .out,
            cli("decode a.tks --bytes 300 --height -").out);
  EXPECT_EQ(cli("info -", "a.tks").out, cli("info a.tks").out);
}

TEST_F(CliFiles, LevelsAreSmallerFilesOfTheSameGround) {
  makeStream();
  ASSERT_EQ(cli("decode a.tks --level 2 --height h.tif --texture t.png").code, 0);
  const auto heights = tools::readHeights(path("h.tif"));
  ASSERT_TRUE(heights.ok());
  EXPECT_EQ(heights->width, 5u);
  EXPECT_EQ(heights->height, 5u);
  EXPECT_EQ(heights->spacing_x, 4 * hills(17).spacing_x);
  EXPECT_EQ(heights->spacing_y, 4 * hills(17).spacing_y);
  const auto image = tools::readImage(path("t.png"));
  ASSERT_TRUE(image.ok());
  EXPECT_EQ(image->width, 9u);
  const Outcome beyond = cli("decode a.tks --level 9 --height x.tif");
  EXPECT_EQ(beyond.code, 1);
  EXPECT_NE(beyond.err.find("their coarsest is"), std::string::npos) << beyond.err;
  EXPECT_EQ(cli("decode a.tks --level 1 --mesh x.glb").code, 1);
}

/// Of a window of a level: the samples that the level has there, where they lie.
TEST_F(CliFiles, WindowsOfLevelsArePartsOfThem) {
  makeStream();
  ASSERT_EQ(cli("decode a.tks --level 1 --height l.tif").code, 0);
  ASSERT_EQ(cli("decode a.tks --level 1 --window 2,3,5,4 --height w.tif --texture t.png").code, 0);
  const auto level = tools::readHeights(path("l.tif")), window = tools::readHeights(path("w.tif"));
  ASSERT_TRUE(level.ok() && window.ok());
  ASSERT_EQ(level->width, 9u);
  ASSERT_EQ(window->width, 5u);
  ASSERT_EQ(window->height, 4u);
  EXPECT_EQ(window->spacing_x, level->spacing_x);
  const size_t bytes = level->data.size() / (size_t{9} * 9);
  for (size_t y = 0; y < 4; ++y) {
    const auto row = level->data.begin() + static_cast<ptrdiff_t>(((3 + y) * 9 + 2) * bytes);
    EXPECT_TRUE(std::equal(row, row + static_cast<ptrdiff_t>(5 * bytes),
                           window->data.begin() + static_cast<ptrdiff_t>(y * 5 * bytes)));
  }
  EXPECT_EQ(cli("decode a.tks --level 1 --window 2,3,8,4 --height x.tif").code, 1);
}

/// By a stream that promises something; what is there of it decodes all the same.
TEST_F(CliFiles, DamageIsFound) {
  makeInputs();
  ASSERT_EQ(cli("encode height.tif --lossless -o a.tks").code, 0);
  std::string stream = content("a.tks");
  stream[stream.size() * 2 / 3] ^= 16;
  write("b.tks", stream);
  for (const std::string verb : {"verify b.tks", "decode b.tks --height b.tif", "info b.tks",
                                 "compare b.tks --height height.tif"}) {
    const Outcome run = cli(verb);
    EXPECT_EQ(run.code, 3) << verb;
    EXPECT_NE(run.err.find("damaged"), std::string::npos) << run.err;
  }
  const std::string less = std::to_string(stream.size() - 1);
  EXPECT_EQ(cli("decode b.tks --height b.tif --bytes " + less).code, 0);
}

TEST_F(CliFiles, TruncateWritesTheExactPrefix) {
  makeStream();
  const std::string stream = content("a.tks");
  for (const size_t bytes : {stream.size() / 2, stream.size() - 1, stream.size()}) {
    ASSERT_EQ(cli("truncate a.tks -f -o b.tks --bytes " + std::to_string(bytes)).code, 0);
    EXPECT_EQ(content("b.tks"), stream.substr(0, bytes));
  }
}

TEST_F(CliFiles, DoublesAreRoundedOnlyWhereNobodyAskedForAll) {
  constexpr uint32_t kSide = 20;
  std::vector<double> doubles(kSide * kSide);
  for (size_t i = 0; i < doubles.size(); ++i)
    doubles[i] = 1000 + 100 * std::sin(double(i) / 30) + 0.1 * double(i % 7);
  std::vector<uint8_t> pixels(doubles.size() * sizeof(double));
  std::memcpy(pixels.data(), doubles.data(), pixels.size());
  TinyTiff tiff(kSide, kSide, 1, 64, pixels);
  tiff.shorts(TinyTiff::kSampleFormat, {3});
  const std::vector<uint8_t> bytes = tiff.bytes();
  ASSERT_TRUE(tools::writeBytes(path("d.tif"), std::as_bytes(std::span(bytes))).ok());
  const Outcome exact = cli("encode d.tif --lossless -o a.tks");
  EXPECT_EQ(exact.code, 1);
  EXPECT_NE(exact.err.find("gdal_translate -ot Float32"), std::string::npos) << exact.err;
  EXPECT_EQ(exact.err.find("rounded to"), std::string::npos) << exact.err;
  EXPECT_EQ(cli("encode d.tif --max-error 0.00001 -o a.tks").code, 1);
  const Outcome bounded = cli("encode d.tif --max-error 0.01 -o a.tks");
  ASSERT_EQ(bounded.code, 0) << bounded.err;
  EXPECT_NE(bounded.err.find("rounded to 32 bits, by up to"), std::string::npos) << bounded.err;
  ASSERT_EQ(cli("decode a.tks --height h.tif").code, 0);
  const auto heights = tools::readHeights(path("h.tif"));
  ASSERT_TRUE(heights.ok());
  std::vector<float> floats(doubles.size());
  ASSERT_EQ(heights->data.size(), floats.size() * sizeof(float));
  std::memcpy(floats.data(), heights->data.data(), heights->data.size());
  for (size_t i = 0; i < doubles.size(); ++i) EXPECT_NEAR(floats[i], doubles[i], 0.01);
}

TEST_F(CliFiles, ByteBudgetIsKeptAndSuffixesMeanPowersOf1024) {
  makeInputs(65);
  const std::string encode = "encode height.tif --texture texture.png -f -q -o ";
  for (const char* arguments : {"a.tks --bytes 2048", "b.tks --bytes 2k", "c.tks --bytes 2KiB"})
    ASSERT_EQ(cli(encode + arguments).code, 0) << arguments;
  EXPECT_LE(content("a.tks").size(), 2048u);
  EXPECT_GT(content("a.tks").size(), 1500u);
  EXPECT_EQ(content("b.tks"), content("a.tks"));
  EXPECT_EQ(content("c.tks"), content("a.tks"));
}

TEST_F(CliFiles, ExistingFilesAreKeptUnlessForced) {
  makeStream();
  write("kept", "precious");
  for (const char* arguments :
       {"encode height.tif --lossless -o kept", "truncate a.tks --bytes 300 -o kept",
        "decode a.tks --height kept"}) {
    const Outcome run = cli(arguments);
    EXPECT_EQ(run.code, 2) << arguments;
    EXPECT_NE(run.err.find("-f"), std::string::npos) << arguments;
    EXPECT_EQ(content("kept"), "precious") << arguments;
  }
  EXPECT_EQ(cli("truncate a.tks --bytes 300 -o kept -f").code, 0);
  EXPECT_EQ(content("kept"), content("a.tks").substr(0, 300));
}

TEST_F(CliFiles, OneFailingOutputHoldsTheOthersBack) {
  makeStream();
  const std::set<std::string> before = names();
  EXPECT_NE(cli("decode a.tks --height h.tif --texture t.nothing").code, 0);
  EXPECT_EQ(names(), before);
  EXPECT_NE(cli("decode a.tks --height h.tif --mesh h.tif").code, 0);
  EXPECT_EQ(names(), before);
}

TEST_F(CliFiles, TwoOutputsOfOneNameAreRefusedBeforeAnyWork) {
  makeStream();
  write("kept.tif", "precious");
  std::filesystem::create_symlink("kept.tif", path("link.tif"));
  const std::set<std::string> before = names();
  for (const char* outputs :
       {"--height same.tif --texture same.tif", "--height same.tif --texture ./same.tif",
        "--height kept.tif --texture link.tif", "--texture m.png --mesh m.obj"}) {
    for (const char* force : {"", " -f"}) {
      const Outcome run = cli("decode a.tks " + std::string(outputs) + force);
      EXPECT_EQ(run.code, 1) << outputs;
      EXPECT_NE(run.err.find("two outputs"), std::string::npos) << run.err;
    }
  }
  EXPECT_EQ(names(), before);
  EXPECT_EQ(content("kept.tif"), "precious");
  EXPECT_EQ(cli("decode a.tks --height /dev/null --texture /dev/null").code, 0);
}

TEST_F(CliFiles, AnEncoderDoesNotReplaceWhatItReads) {
  makeStream();
  ASSERT_EQ(cli("decode a.tks --height h.tif --texture t.png").code, 0);
  std::filesystem::create_symlink("h.tif", path("link.tif"));
  const std::string heights = content("h.tif"), texture = content("t.png");
  for (const char* output : {"h.tif", "./h.tif", "link.tif", "t.png"}) {
    const Outcome run = cli("encode h.tif --texture t.png --lossless -f -o " + std::string(output));
    EXPECT_EQ(run.code, 1) << output;
    EXPECT_NE(run.err.find("would replace the input"), std::string::npos) << run.err;
  }
  EXPECT_EQ(content("h.tif"), heights);
  EXPECT_EQ(content("t.png"), texture);
}

TEST_F(CliFiles, CutsDoNotReplaceTheirStream) {
  makeStream();
  std::filesystem::create_symlink("a.tks", path("link.tks"));
  const std::string stream = content("a.tks");
  for (const char* verb :
       {"truncate a.tks --bytes 500 -f -o ", "reorder a.tks --view low -f -o "}) {
    for (const char* output : {"a.tks", "link.tks"}) {
      const Outcome run = cli(std::string(verb) + output);
      EXPECT_EQ(run.code, 1) << verb;
      EXPECT_NE(run.err.find("would replace the input"), std::string::npos) << run.err;
    }
  }
  EXPECT_EQ(content("a.tks"), stream);
  EXPECT_NE(cli("encode h.tif --lossless -o z --report z").err.find("two outputs"),
            std::string::npos);
}

TEST_F(CliFiles, TexturesAreWrittenInOtherFormatsAndRefusedWhereTheyDoNotFit) {
  makeStream();
  ASSERT_EQ(cli("decode a.tks --texture t.ppm").code, 0);
  EXPECT_TRUE(content("t.ppm").starts_with("P6"));
  const Outcome run = cli("decode a.tks --height h.tif --texture t.ico");
  EXPECT_EQ(run.code, 1);
  EXPECT_NE(run.err.find("cannot hold"), std::string::npos) << run.err;
  EXPECT_FALSE(names().contains("h.tif"));
}

TEST_F(CliFiles, PipesAreWrittenNotReplaced) {
  makeStream();
  ASSERT_EQ(mkfifo(path("pipe").c_str(), 0600), 0);
  const Outcome run =
      shell("cat pipe >got & \"$TETRAKIS\" truncate a.tks --bytes 300 -o pipe && wait");
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_EQ(content("got"), content("a.tks").substr(0, 300));
  EXPECT_TRUE(std::filesystem::is_fifo(path("pipe")));
}

TEST_F(CliFiles, LinksStayLinks) {
  makeStream();
  write("target", "old");
  std::filesystem::create_symlink("target", path("link"));
  ASSERT_EQ(cli("truncate a.tks --bytes 300 -o link -f").code, 0);
  EXPECT_TRUE(std::filesystem::is_symlink(path("link")));
  EXPECT_EQ(content("target"), content("a.tks").substr(0, 300));
}

TEST_F(CliFiles, LinksToNothingGetTheirTarget) {
  makeStream();
  std::filesystem::create_directory(path("there"));
  std::filesystem::create_symlink("there/a.tif", path("hop"));
  std::filesystem::create_symlink("hop", path("link.tif"));
  ASSERT_EQ(cli("decode a.tks --height link.tif").code, 0);
  EXPECT_TRUE(std::filesystem::is_symlink(path("link.tif")));
  EXPECT_TRUE(std::filesystem::is_symlink(path("hop")));
  EXPECT_TRUE(content("there/a.tif").starts_with("II"));
  EXPECT_EQ(cli("decode a.tks --height link.tif").code, 2) << "it exists now";
  std::filesystem::remove(path("there/a.tif"));
  EXPECT_EQ(cli("decode a.tks --height link.tif --texture there/a.tif").code, 1) << "one file";
  std::filesystem::create_symlink("missing/a.tif", path("lost.tif"));
  std::filesystem::create_symlink("loop.tif", path("loop.tif"));
  const std::set<std::string> before = names();
  for (const char* name : {"lost.tif", "loop.tif"}) {
    const Outcome run = cli("decode a.tks --height " + std::string(name));
    EXPECT_EQ(run.code, 2) << name;
    EXPECT_NE(run.err.find("cannot write '" + std::string(name)), std::string::npos) << run.err;
  }
  EXPECT_EQ(names(), before);
}

TEST_F(CliFiles, MeshesOfEveryFormatAreWrittenWithTheirSideFiles) {
  makeStream();
  for (const char* name : {"m.glb", "m.obj", "m.ply"}) {
    const Outcome run = cli("decode a.tks --mesh " + std::string(name));
    EXPECT_EQ(run.code, 0) << name << run.err;
    EXPECT_GT(content(name).size(), 1000u) << name;
    EXPECT_EQ(run.err.find("no place for the texture") != run.err.npos, name[2] == 'p') << run.err;
  }
  EXPECT_NE(content("m.obj").find("mtllib m.mtl"), std::string::npos);
  EXPECT_NE(content("m.mtl").find("map_Kd m.png"), std::string::npos);
  EXPECT_EQ(content("m.mtl").find("map_d"), std::string::npos);
  EXPECT_TRUE(cli("decode a.tks --mesh - --triangles 20").out.starts_with("glTF"));
  EXPECT_TRUE(cli("decode a.tks --mesh - --coded-mesh").out.starts_with("glTF"));
  EXPECT_EQ(cli("decode a.tks --mesh m.obj").code, 2);
}

TEST_F(CliFiles, SynthesisIsDeterministicAndDependsOnTheSeed) {
  ASSERT_EQ(cli("synth -o a --size 33").code, 0);
  ASSERT_EQ(cli("synth -o b --size 33 --seed 1").code, 0);
  ASSERT_EQ(cli("synth -o c --size 33 --seed 2").code, 0);
  EXPECT_EQ(content("a/height.tif"), content("b/height.tif"));
  EXPECT_EQ(content("a/texture.png"), content("b/texture.png"));
  EXPECT_NE(content("a/height.tif"), content("c/height.tif"));
  EXPECT_EQ(cli("synth -o a --size 33").code, 2);
  EXPECT_EQ(cli("encode a/height.tif --texture a/texture.png --bytes 4k -o a.tks").code, 0);
}

TEST_F(CliFiles, SynthesisMakesSurfacesAsWell) {
  for (const char* const name : {"a.glb", "a.obj", "a.ply"}) {
    const std::string synth = "synth --kind knot --triangles 500 -o " + std::string(name);
    ASSERT_EQ(cli(synth).code, 0);
    EXPECT_EQ(cli(synth).code, 2);
    const auto surface = tools::readSurface(path(name));
    ASSERT_TRUE(surface.ok()) << surface.status().message();
    EXPECT_NEAR(double(surface->triangles.size()), 500, 50);
    EXPECT_EQ(surface->points.size() * 2, surface->triangles.size());
  }
  ASSERT_TRUE(tools::readSurface(path("a.obj"))->texture.has_value());
  EXPECT_TRUE(cli("synth --kind blob --triangles 20 -o -").out.starts_with("glTF"));
  EXPECT_EQ(cli("synth --kind blob -o b.tif").code, 1);
  EXPECT_EQ(cli("synth --kind blob --size 65 -o b.glb").code, 1);
  EXPECT_EQ(cli("synth --kind lakes --triangles 65 -o b").code, 1);
}

TEST_F(CliFiles, FolderWithoutManifestCannotBeVerified) {
  EXPECT_EQ(cli("verify .").code, 2);
}

TEST_F(CliFiles, WeightsChangeWhatComesFirst) {
  ASSERT_EQ(cli("synth --size 65 -o s").code, 0);
  const std::string encode = "encode --texture s/texture.png --bytes 1500 -q ";
  ASSERT_EQ(cli(encode + "-o plain.tks").code, 0);
  ASSERT_EQ(cli(encode + "--weights psnr -o psnr.tks").code, 0);
  ASSERT_EQ(cli(encode + "--weights visual -o visual.tks").code, 0);
  for (const char* name : {"plain", "psnr", "visual"}) {
    const std::string file = name;
    ASSERT_EQ(cli("decode " + file + ".tks --texture " + file + ".png").code, 0);
  }
  const auto plain = tools::readImage(path("plain.png")), psnr = tools::readImage(path("psnr.png")),
             visual = tools::readImage(path("visual.png"));
  ASSERT_TRUE(plain.ok() && psnr.ok() && visual.ok());
  EXPECT_TRUE(sameBytes(plain->data, psnr->data));
  EXPECT_FALSE(sameBytes(plain->data, visual->data));
  EXPECT_EQ(cli(encode + "--weights loud -o loud.tks").code, 1);
}

TEST_F(CliFiles, PipesAreReadAsStandardInputIs) {
  makeStream();
  const std::string options = " --lossless -q -f -o b.tks";
  ASSERT_EQ(shell("cat height.tif | \"$TETRAKIS\" encode /dev/stdin" + options).code, 0);
  const std::string heights = content("b.tks");
  ASSERT_EQ(cli("encode height.tif" + options).code, 0);
  EXPECT_EQ(heights, content("b.tks"));
  ASSERT_EQ(mkfifo(path("pipe").c_str(), 0600), 0);
  ASSERT_EQ(shell("cat texture.png > pipe & \"$TETRAKIS\" encode --texture pipe" + options).code,
            0);
  const std::string texture = content("b.tks");
  ASSERT_EQ(cli("encode --texture texture.png" + options).code, 0);
  EXPECT_EQ(texture, content("b.tks"));
}

}  // namespace
}  // namespace tetrakis::test

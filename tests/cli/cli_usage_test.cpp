// SPDX-License-Identifier: Apache-2.0
// Exit codes, messages, and that a command that fails leaves the folder as it was.
#include "tests/cli/cli_fixture.hpp"

namespace tetrakis::test {
namespace {

class CliUsage : public CliTest {
 protected:
  /// Runs the command and expects the code, one sentence on standard error, nothing on standard
  /// output, and no change of the folder.
  void expectFailure(const std::string& arguments, int code) {
    const std::set<std::string> before = names();
    const Outcome run = cli(arguments);
    EXPECT_EQ(run.code, code) << arguments << "\n" << run.err;
    EXPECT_EQ(run.out, "") << arguments;
    EXPECT_TRUE(run.err.starts_with("tetrakis: ")) << arguments << "\n" << run.err;
    EXPECT_EQ(names(), before) << arguments;
  }
};

TEST_F(CliUsage, CommandsThatMakeNoSenseGiveOne) {
  makeStream();
  for (const char* arguments : {
           "",
           "fly",
           "encode height.tif -o b.tks",
           "encode height.tif -o b.tks --bytes 64k --lossless",
           "encode height.tif --bytes 64k",
           "encode -o b.tks --lossless",
           "encode height.tif -o b.tks --bytes 0",
           "encode height.tif -o b.tks --bytes=-5",
           "encode height.tif -o b.tks --bytes 64x",
           "encode height.tif -o b.tks --bytes 99999999999E",
           "encode height.tif -o b.tks --psnr 0",
           "encode height.tif -o b.tks --max-error 0",
           "encode height.tif -o b.tks --max-error 3parsec",
           "encode height.tif -o b.tks --max-error 1m --unit K",
           "encode height.tif -o b.tks --lossless --spacing 0",
           "encode height.tif -o b.tks --lossless --view inside",
           "encode height.tif -o b.tks --lossless --view top --cameras c.json",
           "encode --texture texture.png -o b.tks --max-error 1",
           "encode --texture texture.png -o b.tks --bytes 1k --triangles 5",
           "encode --texture texture.png -o b.tks --bytes 1k --crs EPSG:4326",
           "encode --texture texture.png -o b.tks --bytes 1k --spacing 30",
           "encode --texture texture.png -o b.tks --bytes 1k --scale 2",
           "encode --texture texture.png -o b.tks --bytes 1k --step 2",
           "encode --texture texture.png -o b.tks --bytes 1k --view top",
           "encode - --texture - -o b.tks --lossless",
           "decode a.tks",
           "decode a.tks --mesh m.glb --triangles 0",
           "decode a.tks --mesh m.glb --triangles 9 --coded-mesh",
           "decode a.tks --height h.tif --triangles 9",
           "decode a.tks --height - --texture -",
           "truncate a.tks -o b.tks",
           "compare a.tks",
           "compare a.tks --texture texture.png --triangles 9",
           "synth -o s --size 1",
           "synth -o s --kind moon",
           "verify",
       })
    expectFailure(arguments, 1);
}

TEST_F(CliUsage, UnknownCommandsAreNamed) {
  EXPECT_NE(cli("fly").err.find("'fly'"), std::string::npos);
  EXPECT_EQ(cli("--fly").err.find("command 'fly'"), std::string::npos);
}

TEST_F(CliUsage, MisspeltOptionsAreNamed) {
  makeInputs();
  const Outcome run = cli("encode height.tif --lossles -o b.tks");
  EXPECT_EQ(run.code, 1);
  EXPECT_EQ(run.err, "tetrakis: there is no option '--lossles'; --help shows the usage\n");
}

TEST_F(CliUsage, FilesWithoutAHeaderNeedAShape) {
  for (const char* name : {"a.raw", "a.r16", "a.r32", "a.R16", "a.raw:2x2", "a.raw:2x2:f64"}) {
    write("a.raw", "12345678");
    const Outcome run = cli(std::string("encode ") + name + " --lossless -o b.tks");
    EXPECT_EQ(run.code, 1) << name;
    const std::string bare = std::string(name).substr(0, 5);
    EXPECT_NE(run.err.find(" give " + bare + ":WIDTHxHEIGHT:TYPE "), std::string::npos) << run.err;
  }
}

TEST_F(CliUsage, MessagesAboutNumbersAreShort) {
  makeInputs();
  const std::string encode = "encode height.tif -o b.tks ";
  const std::pair<std::string, const char*> wrong[] = {
      {encode + "--bytes 0", "'0' is not a finite number above 0"},
      {encode + "--bytes=-5", "'-5' is not a number of bytes"},
      {encode + "--psnr 0", "'0' is not a finite number above 0"},
      {encode + "--bytes 5q", "64k, 1M or 2G"},
      {encode + "--bytes 99999999999999999999", "more than 2^64"},
      {encode + "--bytes 20000000000G", "more than 2^64"},
      {encode + "--lossless --nodata sea", "'sea' is not a number"},
      {"decode a.tks --height b.tif --window -1,0,4,4", "'-1' is no whole number"},
      {"decode a.tks --height b.tif --level half", "'half' is no whole number"},
      {"plan a.tks --channel 9k/s --seconds 0", "'0' is not a finite number above 0"},
      {"plan a.tks --renderer 9k/s --seconds 1 --fps inf", "'inf' is not a finite number above 0"}};
  for (const auto& [command, text] : wrong) {
    const Outcome run = cli(command);
    EXPECT_EQ(run.code, 1) << command;
    EXPECT_NE(run.err.find(text), std::string::npos) << run.err;
    EXPECT_LT(run.err.size(), 160u) << run.err;
  }
}

TEST_F(CliUsage, NumbersAreFinite) {
  makeStream();
  const std::string encode = "encode height.tif -o b.tks -q ";
  for (const char* number : {"nan", "inf", "-inf", "-nan", "1e999"}) {
    for (const char* option : {"--scale", "--offset", "--step", "--spacing"}) {
      const std::string arguments = encode + "--lossless " + option + "=" + number;
      expectFailure(arguments, 1);
      EXPECT_NE(cli(arguments).err.find(number), std::string::npos) << arguments;
    }
    for (const char* option : {"--psnr", "--max-error", "--bytes", "--triangles"})
      expectFailure(encode + option + "=" + number, 1);
  }
}

TEST_F(CliUsage, OptionsAreJudgedBeforeAnyFileIsRead) {
  for (const char* option : {"--max-error 0", "--max-error -1", "--max-error 2parsec",
                             "--lossless --view low,top", "--lossless --triangles 5k"})
    expectFailure(std::string("encode missing.tif -o b.tks ") + option, 1);
  expectFailure("decode missing.tks --mesh m.glb --view inside", 1);
  EXPECT_NE(cli("decode a.tks --mesh m.glb --triangles 5k").err.find("number of triangles"),
            std::string::npos);
}

TEST_F(CliUsage, CamerasThatCannotBeReadSayWhy) {
  makeInputs();
  const Outcome run = cli("encode height.tif -o b.tks --lossless --cameras missing.json");
  EXPECT_NE(run.err.find("No such file"), std::string::npos) << run.err;
  const Outcome empty = cli("encode height.tif -o b.tks --lossless --cameras /dev/null");
  EXPECT_EQ(empty.code, 1);
  EXPECT_NE(empty.err.find("'/dev/null' is empty"), std::string::npos) << empty.err;
}

TEST_F(CliUsage, TinyStepsAreReportedAsTheyAre) {
  makeInputs();
  const Outcome run = cli("encode height.tif -o b.tks --bytes 900 --step 1e-30");
  EXPECT_EQ(run.code, 1);
  EXPECT_NE(run.err.find("A step of 1e-30 divides"), std::string::npos) << run.err;
}

TEST_F(CliUsage, FilesOfHeightsAreNoTextures) {
  makeInputs();
  for (const char* name : {"N46E007.hgt", "a.raw:3x3:u8", "a.raw"}) {
    const Outcome run = cli("encode height.tif --lossless -o b.tks --texture " + std::string(name));
    EXPECT_EQ(run.code, 1);
    EXPECT_NE(run.err.find("is a file of heights"), std::string::npos) << run.err;
  }
}

TEST_F(CliUsage, BoundsThatLeaveNoRoomAreTold) {
  makeInputs();
  const std::string told = "--max-error 1e-300: nothing takes fewer bytes than every bit";
  const Outcome tight = cli("encode height.tif --max-error 1e-300 -o b.tks");
  EXPECT_NE(tight.err.find(told), std::string::npos) << tight.err;
  EXPECT_EQ(cli("encode height.tif --max-error 1e-300 -o c.tks -q").err, "");
  const Outcome wide = cli("encode height.tif --max-error 20 -o d.tks");
  EXPECT_EQ(wide.err.find("no room"), std::string::npos) << wide.err;
}

TEST_F(CliUsage, PartsOfTheSummaryAddUp) {
  makeInputs();
  const Outcome run = cli("encode height.tif --texture texture.png --bytes 2k -o b.tks");
  std::vector<uint64_t> numbers;
  for (size_t at = run.err.find(':'); at < run.err.size();) {
    at = std::min(run.err.find_first_of("0123456789", at), run.err.size());
    size_t digits = 0;
    if (at < run.err.size()) numbers.push_back(std::stoull(run.err.substr(at), &digits));
    at += digits;
  }
  ASSERT_EQ(numbers.size(), 5u) << run.err;
  EXPECT_EQ(numbers[0], numbers[1] + numbers[2] + numbers[3] + numbers[4]) << run.err;
}

TEST_F(CliUsage, RawHeightsAreReadAgainByTheNameThatTheNoteTells) {
  makeStream();
  const Outcome run = cli("decode a.tks --height h.raw");
  const size_t name = run.err.find("h.raw:");
  ASSERT_NE(name, std::string::npos) << run.err;
  const std::string raw = run.err.substr(name, run.err.find('\n') - name);
  EXPECT_EQ(cli("encode " + raw + " --lossless -o r.tks").code, 0) << raw;
  EXPECT_EQ(cli("decode a.tks --height g.raw -q").err, "");
}

TEST_F(CliUsage, MeshesThatCannotBeSoSmallSayTheirSize) {
  makeStream();
  const Outcome run = cli("decode a.tks --mesh m.glb --triangles 1");
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_NE(run.err.find("note: the mesh has 2 triangles"), std::string::npos) << run.err;
  EXPECT_EQ(cli("decode a.tks --mesh n.glb --triangles 1 -q").err, "");
  EXPECT_EQ(cli("decode a.tks --mesh o.glb --triangles 2").err, "");
  const Outcome measured = cli("compare a.tks --height height.tif --triangles 1");
  EXPECT_NE(measured.err.find("note: the mesh has 2 triangles"), std::string::npos);
}

TEST_F(CliUsage, WhatCannotBeReadOrWrittenGivesTwo) {
  makeStream();
  write("odd.hgt", "seven b");
  for (const char* arguments : {
           "encode missing.tif -o b.tks --lossless",
           "encode odd.hgt -o b.tks --lossless",
           "encode height.tif -o missing/b.tks --lossless",
           "encode height.tif -o . --lossless",
           "encode height.tif --texture missing.png -o b.tks --lossless",
           "encode height.tif -o b.tks --lossless --cameras missing.json",
           "decode missing.tks --height h.tif",
           "decode a.tks --height missing/h.tif",
           "truncate missing.tks --bytes 9 -o b.tks",
           "info missing.tks",
           "compare a.tks --height missing.tif",
           "verify missing.tks",
           "synth -o height.tif",
       })
    expectFailure(arguments, 2);
}

TEST_F(CliUsage, WhatIsNoStreamGivesThree) {
  makeInputs();
  for (const char* verb : {"info", "verify", "decode --height h.tif", "compare --height height.tif",
                           "truncate --bytes 50 -o b.tks"})
    expectFailure(std::string(verb) + " texture.png", 3);
}

TEST_F(CliUsage, TruncationIsAnErrorOnlyWhenStrict) {
  makeStream();
  const auto size = std::filesystem::file_size(path("a.tks"));
  ASSERT_EQ(cli("truncate a.tks --bytes " + std::to_string(size - 1) + " -o cut.tks").code, 0);
  for (const std::string verb :
       {"info", "decode --texture -", "compare --height height.tif --texture texture.png"}) {
    EXPECT_EQ(cli(verb + " cut.tks").code, 0) << verb;
    EXPECT_EQ(cli(verb + " --strict a.tks").code, 0) << verb;
    expectFailure(verb + " --strict cut.tks", 4);
  }
  EXPECT_EQ(cli("verify a.tks").code, 0);
  expectFailure("verify cut.tks", 4);
}

TEST_F(CliUsage, PrefixTooShortForTheHeaderSaysWhatItNeeds) {
  makeStream();
  expectFailure("truncate a.tks --bytes 9 -o b.tks", 4);
  EXPECT_NE(cli("info a.tks --bytes 9").err.find("byte"), std::string::npos);
}

TEST_F(CliUsage, TrackThatTheStreamLacksIsAUsageError) {
  makeInputs();
  ASSERT_EQ(cli("encode height.tif --lossless -o h.tks").code, 0);
  ASSERT_EQ(cli("encode --texture texture.png --lossless -o t.tks").code, 0);
  expectFailure("decode h.tks --texture x.png", 1);
  expectFailure("decode t.tks --height x.tif", 1);
  expectFailure("decode t.tks --mesh x.glb", 1);
  expectFailure("compare h.tks --texture texture.png", 1);
  expectFailure("compare t.tks --height height.tif", 1);
}

TEST_F(CliUsage, StatedPsnrHasNoMoreDigitsThanItsSteps) {
  makeInputs();
  ASSERT_EQ(cli("encode height.tif --texture texture.png --bytes 2k -q -o a.tks").code, 0);
  const std::string table = cli("info a.tks").out;
  for (const std::string key : {"texture.psnr", "heights.rmse"}) {
    const size_t at = table.find(key);
    ASSERT_NE(at, std::string::npos) << table;
    std::istringstream line(table.substr(at + key.size()));
    std::string value;
    line >> value;
    EXPECT_NE(value, "-") << key;
    EXPECT_LE(value.size(), 8u) << key << " " << value;
  }
}

TEST_F(CliUsage, HelpAndVersionGoToStandardOutput) {
  for (const char* arguments : {"--help", "encode --help", "verify --help", "--version", "help"}) {
    const Outcome run = cli(arguments);
    EXPECT_EQ(run.code, 0) << arguments;
    EXPECT_NE(run.out, "") << arguments;
    EXPECT_EQ(run.err, "") << arguments;
  }
  EXPECT_EQ(cli("help fly").code, 1);
}

TEST_F(CliUsage, HelpOfAVerbHasItsOptionsAsTheyAreTyped) {
  for (const std::string verb :
       {"encode", "decode", "truncate", "info", "compare", "verify", "combine", "plan", "reorder",
        "profile", "synth", "view", "serve", "receive", "tiles"}) {
    const std::string help = cli("help " + verb).out;
    // CLI11 lists excluded options in the order of their addresses.
    EXPECT_EQ(help.size(), cli(verb + " --help").out.size());
    EXPECT_NE(help.find("--max-memory SIZE"), std::string::npos) << help;
    for (const char* leak : {"{", " x 4", "S=", "N="})
      EXPECT_EQ(help.find(leak), std::string::npos) << help;
  }
}

TEST_F(CliUsage, TablesHaveNoMoreDigitsThanPeopleRead) {
  makeInputs();
  ASSERT_EQ(cli("encode height.tif --texture texture.png --bytes 2k -q -o a.tks").code, 0);
  const std::string compare = "compare a.tks --height height.tif --texture texture.png ";
  std::istringstream table(cli(compare + "-q").out);
  size_t longest = 0;
  for (std::string key, value; table >> key >> value;)
    if (value.find('.') != value.npos) longest = std::max(longest, value.size());
  EXPECT_GT(longest, 2u);
  EXPECT_LE(longest, 9u);
}

TEST_F(CliUsage, QuietSaysNothingAndNoBarIsDrawnWithoutATerminal) {
  makeInputs();
  EXPECT_EQ(cli("encode height.tif --lossless -o a.tks -q").err, "");
  const Outcome run = cli("encode height.tif --lossless -o b.tks");
  EXPECT_NE(run.err.find("b.tks: "), std::string::npos);
  EXPECT_EQ(run.err.find('\r'), std::string::npos);
  EXPECT_EQ(run.out, "");
}

}  // namespace
}  // namespace tetrakis::test

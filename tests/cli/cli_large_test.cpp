// SPDX-License-Identifier: Apache-2.0
// Streams of more samples than the library takes unasked.
#include <functional>

#include "bitstream/stream/header.hpp"
#include "tests/cli/cli_fixture.hpp"
#include "tests/support/hostile_streams.hpp"

namespace tetrakis::test {
namespace {

class CliLarge : public CliTest {
 protected:
  /// a.tks, encoded from a few samples, with the header of many: coding those would take minutes.
  void enlarge(const std::function<void(StreamHeader&)>& change) {
    const std::string stream = content("a.tks");
    const auto* first = reinterpret_cast<const uint8_t*>(stream.data());
    Result<ParsedHeader> parsed = readHeader({first, stream.size()});
    ASSERT_TRUE(parsed.ok()) << parsed.status().message();
    change(parsed->header);
    const std::vector<uint8_t> header = writeHeader(parsed->header);
    write("a.tks", std::string(header.begin(), header.end()) + stream.substr(parsed->bytes));
  }
};

TEST_F(CliLarge, TexturesOfEverySizeAreOpened) {
  makeInputs();
  ASSERT_EQ(cli("encode --texture texture.png --lossless -o a.tks").code, 0);
  for (const uint32_t side : {20000u, 32768u}) {
    enlarge(
        [side](StreamHeader& header) { header.texture->width = header.texture->height = side; });
    const Outcome run = cli("info a.tks");
    EXPECT_EQ(run.code, 0) << run.err;
    EXPECT_NE(run.out.find(std::to_string(side)), std::string::npos) << run.out;
  }
}

TEST_F(CliLarge, TheLargestHeightsAreOpened) {
  makeInputs();
  ASSERT_EQ(cli("encode height.tif --lossless -o a.tks").code, 0);
  enlarge([](StreamHeader& header) { header.geometry->width = header.geometry->height = 1 << 20; });
  EXPECT_EQ(cli("info a.tks").code, 0);
  EXPECT_EQ(cli("decode a.tks --height all.tif").code, 6);
}

/// Streams of a few bytes that declare more than the machine holds end with a sentence, whatever is
/// asked of them, and not at the kernel's hands. Every kind of stream is opened and decoded, whole
/// and a window; those of which something is sent are asked for the rest, which no stream that is
/// not sent makes harder. (HostileSizes asks the library for everything of all of them.)
TEST_F(CliLarge, HugePlanesOfFewBytesAreRefused) {
  makeInputs();
  for (const HostileStream& hostile : hostileStreams()) {
    if (hostile.name.ends_with("constant")) continue;  // like those unsent, which take longer
    SCOPED_TRACE(hostile.name);
    write("a.tks", std::string(hostile.bytes.begin(), hostile.bytes.end()));
    const bool heights = hostile.name.starts_with("heights");
    const std::string part = heights ? " --height part.tif" : " --texture part.png";
    const auto code = [this](const std::string& verb) {
      return shell("ulimit -v 1000000; timeout 20 $TETRAKIS -q " + verb).code;
    };
    EXPECT_EQ(code("info a.tks > info.txt"), 0);
    const Outcome whole =
        shell("ulimit -v 1000000; timeout 20 $TETRAKIS -q decode a.tks -f" + part);
    EXPECT_EQ(whole.code, 6);
    EXPECT_NE(whole.err.find(" of memory; the limit"), std::string::npos) << whole.err;
    EXPECT_EQ(code("decode a.tks -f --window 5000,1000,16,16" + part), hostile.sent ? 6 : 0);
    if (!hostile.sent) continue;
    EXPECT_EQ(code("verify a.tks"), 0);
    // A level of a drawing takes no more than its samples.
    const bool drawn = hostile.name == "drawn, sent" || hostile.name == "heights drawn, sent";
    EXPECT_EQ(code("decode a.tks -f --level 9" + part), drawn ? 0 : 6);
    EXPECT_EQ(code("decode a.tks -f --mesh a.glb"), 6);
    EXPECT_EQ(code(std::string("compare a.tks") +
                   (heights ? " --height height.tif" : " --texture texture.png")),
              7);
  }
}

TEST_F(CliLarge, MemoryIsLimitedByOption) {
  makeStream(257);
  EXPECT_EQ(cli("--max-memory 1M decode a.tks --height b.tif").code, 6);
  const Outcome run = cli("decode a.tks --max-memory 3M --texture b.png");
  EXPECT_EQ(run.code, 6);
  EXPECT_NE(run.err.find("Decoding 514 x 514 texels of 3 channels takes "), std::string::npos)
      << run.err;
  EXPECT_NE(run.err.find("the limit (--max-memory) is 3"), std::string::npos) << run.err;
  EXPECT_FALSE(names().contains("b.png"));
  EXPECT_EQ(cli("info a.tks --max-memory 8M").code, 0);
  EXPECT_EQ(cli("verify a.tks --max-memory 8M").code, 0);
  EXPECT_EQ(cli("compare a.tks --texture texture.png --max-memory 3M").code, 6);
  EXPECT_EQ(cli("encode height.tif --lossless -o b.tks --max-memory 1M").code, 6);
  EXPECT_EQ(cli("encode height.tif --lossless -o b.tks --max-memory 100k").code, 6);
  EXPECT_EQ(cli("encode height.tif --lossless -o b.tks --max-memory 64M").code, 0);
  EXPECT_EQ(cli("decode a.tks --max-memory 64M --height b.tif --texture b.png").code, 0);
  EXPECT_EQ(cli("decode a.tks --max-memory much --height c.tif").code, 1);
}

/// Bands of one column have rows of a whole word.
TEST_F(CliLarge, MemoryOfNarrowPlanesIsLimitedToo) {
  write("a.raw", std::string(200000, '\0'));
  for (const char* shape : {"100000x1", "1x100000", "3x33333"}) {
    const bool all = std::string(shape).find("33333") == std::string::npos;
    if (!all) write("a.raw", std::string(3 * 33333 * 2, '\0'));
    const std::string verb = std::string("encode a.raw:") + shape + ":i16 --lossless -f -o b.tks";
    EXPECT_EQ(cli(verb + " --max-memory 8M").code, 6) << shape;
    EXPECT_EQ(cli(verb + " --max-memory 256M").code, 0) << shape;
  }
}

/// Small regions and meshes take more than the samples do.
TEST_F(CliLarge, MemoryOfRegionsAndMeshesIsLimitedToo) {
  write("a.raw", std::string(2 * 256 * 256, '\0'));
  const std::string verb = "encode a.raw:256x256:i16 -f -o b.tks --bytes 1k --max-memory 3M";
  EXPECT_EQ(cli(verb).code, 0);
  EXPECT_EQ(cli(verb + " --regions 16").code, 6);
  EXPECT_EQ(cli(verb + " --triangles 100").code, 6);
}

}  // namespace
}  // namespace tetrakis::test

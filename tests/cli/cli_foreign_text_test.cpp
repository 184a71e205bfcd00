// SPDX-License-Identifier: Apache-2.0
// Texts of streams and files that would steer a terminal: no command shows them raw.
#include <algorithm>
#include <nlohmann/json.hpp>
#include <vector>

#include "tests/cli/cli_fixture.hpp"

#include "base/shown_text.hpp"
#include "bitstream/stream/header.hpp"
#include "tetrakis/tetrakis.hpp"

namespace tetrakis::test {
namespace {

/// It sets the title of a terminal, clears it, turns the line around and ends it, with C0, C1, DEL,
/// marks of direction, separators of lines, and bytes that are no UTF-8; and ends what encloses it.
const std::string kEvil =
    "\x1b]0;x\x07\x1b[2J\xC2\x9B\x7f\xE2\x80\xAE\xE2\x80\xA8\n\r\xff\xC0</script>'\"&";

class CliForeignText : public CliTest {
 protected:
  /// Both components, with texts that are evil wherever a header has one.
  void SetUp() override {
    CliTest::SetUp();
    std::vector<int16_t> samples(24 * 20);
    std::vector<uint8_t> texels(samples.size() * 3);
    for (size_t i = 0; i < samples.size(); ++i) samples[i] = static_cast<int16_t>(i * i % 97);
    for (size_t i = 0; i < texels.size(); ++i) texels[i] = static_cast<uint8_t>(i * i % 89);
    tks_heights heights = makeHeights();
    heights.width = 24;
    heights.height = 20;
    heights.sample = TKS_I16;
    heights.data = samples.data();
    heights.unit = "u";
    tks_image image = makeImage();
    image.width = 24;
    image.height = 20;
    image.channels = 3;
    image.data = texels.data();
    for (auto* place : {&heights.geotransform, &image.geotransform}) (*place)[1] = (*place)[5] = 1;
    heights.has_geotransform = image.has_geotransform = 1;
    tks_encode_options options = makeEncodeOptions();
    options.lossless = 1;
    const auto stream = tetrakis::encode(&heights, &image, options);
    ASSERT_TRUE(stream.ok()) << stream.status().message();
    ParsedHeader parsed = *readHeader(stream->bytes());
    Metadata& metadata = parsed.header.metadata;
    metadata.unit = metadata.vertical_datum = metadata.crs = kEvil;
    Georeference& place = parsed.header.georeference;
    place.description = place.texture_crs = place.heights.geo_keys = kEvil;
    std::vector<uint8_t> bytes = writeHeader(parsed.header);
    bytes.insert(bytes.end(), stream->bytes().begin() + static_cast<ptrdiff_t>(parsed.bytes),
                 stream->bytes().end());
    ASSERT_TRUE(tools::writeBytes(path("evil.tks"), std::as_bytes(std::span(bytes))).ok());
  }

  /// Lines of ordinary UTF-8.
  static void expectHarmless(const std::string& text) {
    EXPECT_TRUE(isUtf8(text)) << text;
    for (const char* raw :
         {"\x1b", "\x07", "\x7f", "\r", "\xC2\x9B", "\xE2\x80\xAE", "\xE2\x80\xA8"})
      EXPECT_EQ(text.find(raw), std::string::npos) << text;
  }
};

TEST_F(CliForeignText, OfAStreamIsShownByNoCommandRaw) {
  const std::vector<std::vector<std::string>> commands = {
      {"info", "evil.tks"},
      {"info", "--json", "evil.tks"},
      {"verify", "evil.tks"},
      {"decode", "evil.tks", "-f", "--height", "h.tif"},
      {"decode", "evil.tks", "-f", "--height", "h.asc", "--texture", "t.png"},
      {"decode", "evil.tks", "-f", "--mesh", "m.obj", "--triangles", "40"},
      {"decode", "evil.tks", "-f", "--mesh", "m.glb"},
      {"profile", "evil.tks", "--line", "1,1 10,10", "--points", "4"},
      {"profile", "--json", "evil.tks", "--line", "1,1 10,10", "--points", "4"},
      {"tiles", "evil.tks", "-o", "tiles"},
      {"plan", "evil.tks", "--channel", "1k/s", "--seconds", "1"},
      {"compare", "evil.tks", "--height", "h.tif"},
      {"encode", "--height", "h.tif", "--lossless", "-f", "-o", "again.tks"}};
  for (const auto& words : commands) {
    const Outcome result = cliOf(words);
    SCOPED_TRACE(words[0] + ": " + std::to_string(result.code) + " " + result.err);
    expectHarmless(result.out);
    expectHarmless(result.err);
  }
}

/// A table has a line a value, whatever the text.
TEST_F(CliForeignText, AddsNoLineToATable) {
  const std::string table = cli("info evil.tks").out;
  const size_t row = table.find("heights.unit ");
  ASSERT_NE(row, std::string::npos) << table;
  const std::string unit = table.substr(row, table.find('\n', row) - row);
  EXPECT_NE(unit.find(" \\u001b]0;x\\u0007"), std::string::npos) << unit;
  EXPECT_NE(unit.find("\\u009b\\u007f\\u202e\\u2028\\n\\r\\xff\\xc0</script>"), std::string::npos);
}

TEST_F(CliForeignText, IsTheSameInJson) {
  const auto json = nlohmann::json::parse(cli("info --json evil.tks").out);
  const std::string valid = kEvil.substr(0, kEvil.find('\xff'));
  EXPECT_EQ(json["heights"]["unit"].get<std::string>().substr(0, valid.size()), valid);
}

/// Names of files are foreign as well.
TEST_F(CliForeignText, OfNamesIsShownByNoMessageRaw) {
  const std::string name = "a\x1b[2J\xE2\x80\xAE.tks";
  EXPECT_EQ(shell("cp evil.tks '" + name + "'").code, 0);
  const std::vector<std::vector<std::string>> commands = {
      {"info", "no" + name},
      {"verify", name},
      {"decode", name, "--height", name + ".asc"},
      {"info", name + ".tif"},
      {"\x1b[2J"},
      {"info", "--\x1b[2J", "x"},
      {"decode", name, "--height", "\x1b[2J/h.tif"}};
  for (const auto& words : commands) {
    const Outcome result = cliOf(words);
    SCOPED_TRACE(words[0] + ": " + std::to_string(result.code) + " " + result.err);
    expectHarmless(result.out);
    expectHarmless(result.err);
  }
}

}  // namespace
}  // namespace tetrakis::test

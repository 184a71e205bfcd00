// SPDX-License-Identifier: Apache-2.0
// What is shown of foreign text steers no terminal, and ordinary text stays as it is.
#include <gtest/gtest.h>

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>

#include "base/shown_text.hpp"

namespace tetrakis::inline base {
namespace {

TEST(ShownText, KeepsOrdinaryText) {
  for (const char* text : {"", "m", "EPSG:2056+5728", "Höhe über Normalnull", "标高", "متر",
                           "\\u001b", "\xF0\x9F\x97\xBB", "e\xCC\x81", "\"quoted\" <b>&amp;</b>"}) {
    EXPECT_EQ(shownText(text), text);
    EXPECT_EQ(shownLines(text), text);
  }
}

TEST(ShownText, EscapesWhatSteers) {
  EXPECT_EQ(shownText("\x1b]0;a\x07"), "\\u001b]0;a\\u0007");
  EXPECT_EQ(shownText("a\n\r\tb\x7f"), "a\\n\\r\\tb\\u007f");
  EXPECT_EQ(shownText(std::string("a\0b", 3)), "a\\u0000b");
  EXPECT_EQ(shownText("\xC2\x9B"
                      "31m"),
            "\\u009b31m");
  EXPECT_EQ(shownText("\xE2\x80\xAEtxt"), "\\u202etxt");
  EXPECT_EQ(shownText("\xE2\x80\xA8\xE2\x81\xA6\xD8\x9C\xEF\xBB\xBF"),
            "\\u2028\\u2066\\u061c\\ufeff");
}

TEST(ShownText, NamesBytesThatAreNoUtf8) {
  EXPECT_EQ(shownText("\xFF\xC0\x80\x9B\xED\xA0\x80\xE2\x80"),
            "\\xff\\xc0\\x80\\x9b\\xed\\xa0\\x80\\xe2\\x80");
}

TEST(ShownText, OfSeveralLinesKeepsThem) {
  EXPECT_EQ(shownLines("a\n\tb\r\n"), "a\n\tb\\r\n");
}

/// Whatever the bytes: valid UTF-8 without control characters, and the same when it is shown again.
TEST(ShownText, OfAnyBytesIsHarmless) {
  uint32_t state = 1;
  for (int run = 0; run < 2000; ++run) {
    std::string text;
    for (int i = 0; i < 40; ++i) {
      state = state * 1664525u + 1013904223u;
      text +=
          static_cast<char>(state % 3 == 0 ? state >> 24 : (state >> 16 & 3) + 0x80 + (run & 96));
    }
    const std::string shown = shownText(text);
    EXPECT_TRUE(isUtf8(shown));
    for (size_t i = 0; i < shown.size(); ++i) {
      const auto byte = static_cast<uint8_t>(shown[i]);
      EXPECT_TRUE(byte >= 0x20 && byte != 0x7F);
      if (byte == 0xC2) {
        EXPECT_GE(static_cast<uint8_t>(shown[i + 1]), 0xA0);
      }
    }
    EXPECT_EQ(shownText(shown), shown);
  }
}

/// The escapes are those of JSON.
TEST(ShownText, LeavesJsonAsItIs) {
  const nlohmann::json json = {{"a\xE2\x80\xAE", "\x1b\x7f\xC2\x85\n\xE2\x80\xA9"},
                               {"b", {1, "ö"}}};
  const std::string shown = shownLines(json.dump(2));
  EXPECT_EQ(nlohmann::json::parse(shown), json);
  EXPECT_EQ(shown.find('\x7f'), std::string::npos);
  EXPECT_EQ(shown.find("\xE2\x80"), std::string::npos);
}

}  // namespace
}  // namespace tetrakis::inline base

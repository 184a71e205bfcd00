// SPDX-License-Identifier: Apache-2.0
// Lengths as people type them.
#include "apps/tools/files/units.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "base/coordinates.hpp"

namespace tetrakis::tools {
namespace {

TEST(Units, SuffixesConvertToTheUnitOfTheHeights) {
  EXPECT_DOUBLE_EQ(*parseLength("0.5", "K"), 0.5);
  EXPECT_DOUBLE_EQ(*parseLength("0.5m", "m"), 0.5);
  EXPECT_DOUBLE_EQ(*parseLength("50cm", "m"), 0.5);
  EXPECT_DOUBLE_EQ(*parseLength("50cm", ""), 0.5);
  EXPECT_DOUBLE_EQ(*parseLength("1e2mm", "cm"), 10);
  EXPECT_DOUBLE_EQ(*parseLength("1ft", "m"), 0.3048);
  EXPECT_DOUBLE_EQ(*parseLength("0.3048m", "ft"), 1);
}

TEST(Units, SurveyFeetAreNotFeet) {
  for (const char* unit : {"us-ft", "ftUS", "US survey foot", "us_survey_feet", "Foot_US"}) {
    EXPECT_EQ(canonicalUnit(unit), "us-ft");
    EXPECT_DOUBLE_EQ(*metresPerUnit(unit), 1200.0 / 3937);
    EXPECT_DOUBLE_EQ(*parseLength("1200m", unit), 3937);
  }
  EXPECT_DOUBLE_EQ(*parseLength("1us-ft", "m"), 1200.0 / 3937);
  EXPECT_EQ(lengthName(1200.0 / 3937), "us-ft");
  EXPECT_EQ(lengthName(0.3048), "ft");
  EXPECT_EQ(lengthName(0.3), "");
  EXPECT_EQ(canonicalUnit("FT"), "ft");
  EXPECT_EQ(canonicalUnit("M"), "m");
  EXPECT_EQ(canonicalUnit("K"), "K");
}

TEST(Units, NamesOfLengthsAreThoseOfTheTable) {
  std::ifstream table(TKS_LENGTH_NAMES);
  ASSERT_TRUE(table);
  int names = 0;
  for (std::string line; std::getline(table, line);) {
    if (line.starts_with('#')) continue;
    const std::string metres = line.substr(0, line.find(' ')),
                      name = line.substr(metres.size() + 1);
    const auto known = metresPerUnit(name);
    EXPECT_EQ(known.has_value(), metres != "none") << name;
    if (known) {
      EXPECT_DOUBLE_EQ(*known, std::stod(metres)) << name;
    }
    ++names;
  }
  EXPECT_GT(names, 25);
}

TEST(Units, NonsenseIsRefused) {
  for (const char* text : {"", "m", "-1", "1 m", "1parsec", "nan", "inf", "1m2", "1,5", "0x1m"})
    EXPECT_EQ(parseLength(text, "m").status().code(), TKS_USAGE) << text;
  EXPECT_EQ(parseLength("1m", "K").status().code(), TKS_USAGE);
}

TEST(Units, SpacingIsOneNumberOrTwo) {
  EXPECT_EQ(*parseSpacing("30"), (std::array<double, 2>{30, 30}));
  EXPECT_EQ(*parseSpacing("30,24.5"), (std::array<double, 2>{30, 24.5}));
  for (const char* text : {"", "0", "-3", "30,", ",30", "30,0", "30;25", "30,25,20", "a"})
    EXPECT_EQ(parseSpacing(text).status().code(), TKS_USAGE) << text;
}

}  // namespace
}  // namespace tetrakis::tools

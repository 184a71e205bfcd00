// SPDX-License-Identifier: Apache-2.0
// The sequences among the vectors decode as their manifest says, and the reference decoder, which
// passes from head to head by itself, agrees on every prefix.
#include <gtest/gtest.h>

#include <filesystem>
#include <set>
#include <sstream>

#include "conformance/cases/vector_cases.hpp"
#include "conformance/decode_cut.hpp"
#include "conformance/digest.hpp"
#include "conformance/reference_decoder.hpp"
#include "conformance/runner.hpp"
#include "tests/support/reference_status.hpp"

namespace tetrakis::conformance {
namespace {

/// What the reference decoder makes of a prefix, as decodeCut() tells it.
Cut referenceCut(std::span<const uint8_t> prefix, int level) {
  const reference::DecodedSequence decoded =
      reference::decodeSequence(prefix, reference::kMaxSamples, {level, level});
  Cut cut;
  cut.bytes = prefix.size();
  cut.level = level;
  cut.status = test::statusOf(decoded.outcome);
  std::vector<uint8_t> heights, texture;
  for (const reference::DecodedGroup& group : decoded.groups) {
    if (cut.status == TKS_OK) cut.status = test::statusOf(group.frames.outcome);
    const auto add = [](const auto& from, std::vector<uint8_t>& to) {
      if (from) to.insert(to.end(), from->begin(), from->end());
    };
    add(group.frames.heights, heights);
    add(group.frames.texture, texture);
  }
  if (cut.status == TKS_OK && decoded.groups.empty()) cut.status = TKS_TRUNCATED;
  const auto digest = [](const std::vector<uint8_t>& samples) {
    return samples.empty() ? "" : sampleDigest(std::as_bytes(std::span(samples)), TKS_U8);
  };
  cut.heights = digest(heights);
  cut.texture = digest(texture);
  return cut;
}

void expectSame(const Cut& wanted, const Cut& got) {
  EXPECT_EQ(got.status, wanted.status);
  EXPECT_EQ(got.heights, wanted.heights);
  EXPECT_EQ(got.texture, wanted.texture);
}

TEST(SequenceVectors, AllPass) {
  std::ostringstream log;
  const auto summary = runVectors(TETRAKIS_SEQUENCES, log);
  ASSERT_TRUE(summary.ok()) << summary.status().message();
  EXPECT_EQ(summary->failed, 0) << log.str();
  EXPECT_EQ(summary->passed, static_cast<int>(sequenceCases().size()));
}

TEST(SequenceVectors, ReferenceDecoderPasses) {
  const auto vectors = readManifest(TETRAKIS_SEQUENCES);
  ASSERT_TRUE(vectors.ok());
  for (const Vector& vector : *vectors) {
    const auto stream = readFile(std::string(TETRAKIS_SEQUENCES) + "/" + vector.file);
    ASSERT_TRUE(stream.ok());
    for (const Cut& cut : vector.cuts) {
      SCOPED_TRACE(vector.name + " at " + std::to_string(cut.bytes) + " bytes");
      const auto prefix = std::span(*stream).first(static_cast<size_t>(cut.bytes));
      expectSame(cut, referenceCut(prefix, cut.level));
    }
  }
}

TEST(SequenceVectors, BothDecodersAgreeOnDamage) {
  const auto vectors = readManifest(TETRAKIS_SEQUENCES);
  ASSERT_TRUE(vectors.ok());
  for (const Vector& vector : *vectors) {
    const auto stream = readFile(std::string(TETRAKIS_SEQUENCES) + "/" + vector.file);
    ASSERT_TRUE(stream.ok());
    for (size_t i = 0; i < stream->size(); i += 211) {
      SCOPED_TRACE(vector.name + ", byte " + std::to_string(i));
      std::vector<uint8_t> bad = *stream;
      bad[i] ^= 0x24;
      expectSame(decodeCut(bad, 0), referenceCut(bad, 0));
    }
  }
}

TEST(SequenceVectors, ManifestIsComplete) {
  const auto vectors = readManifest(TETRAKIS_SEQUENCES);
  ASSERT_TRUE(vectors.ok());
  const auto readme = readFile(std::string(TETRAKIS_SEQUENCES) + "/../README.md");
  ASSERT_TRUE(readme.ok());
  const std::string table(readme->begin(), readme->end());
  std::set<std::string> listed{kManifestName};
  for (const Vector& vector : *vectors) {
    listed.insert(vector.file);
    uint64_t bytes = 0;
    for (const Cut& cut : vector.cuts) bytes = std::max(bytes, cut.bytes);
    const std::string row =
        "| `" + vector.name + "` | " + std::to_string(bytes) + " | " + vector.purpose + " |";
    EXPECT_NE(table.find(row), std::string::npos) << row;
  }
  for (const auto& entry : std::filesystem::directory_iterator(TETRAKIS_SEQUENCES))
    EXPECT_TRUE(listed.contains(entry.path().filename())) << entry.path();
}

}  // namespace
}  // namespace tetrakis::conformance

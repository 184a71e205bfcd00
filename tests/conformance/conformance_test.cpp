// SPDX-License-Identifier: Apache-2.0
// The conformance vectors decode as their manifest says, and the runner sees it when they do not.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <optional>
#include <set>
#include <sstream>

#include "bitstream/stream/header.hpp"
#include "codec/wavelet/lifting/lifting_kernel.hpp"
#include "conformance/cases/stream_tools.hpp"
#include "conformance/cases/vector_cases.hpp"
#include "conformance/digest.hpp"
#include "conformance/reference_decoder.hpp"
#include "conformance/runner.hpp"
#include "tests/support/reference_status.hpp"

namespace tetrakis::conformance {
namespace {

namespace fs = std::filesystem;

/// A copy of the vectors that a test may spoil; removed afterwards.
class Vectors : public ::testing::Test {
 protected:
  void SetUp() override {
    directory_ = fs::temp_directory_path() /
                 (std::string("tetrakis_") +
                  ::testing::UnitTest::GetInstance()->current_test_info()->name() + "_" +
                  std::to_string(::getpid()));
    fs::copy(kVectors, directory_, fs::copy_options::recursive);
  }
  void TearDown() override { fs::remove_all(directory_); }

  static constexpr const char* kVectors = TETRAKIS_VECTORS;
  fs::path directory_;
  std::ostringstream log_;
};

TEST(Digest, IsSha256OfLittleEndianSamples) {
  EXPECT_EQ(sampleDigest({}, TKS_U8),
            "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  const uint16_t samples[] = {0x6261};  // "ab"
  EXPECT_EQ(sampleDigest(std::as_bytes(std::span(samples)), TKS_U16),
            "fb8e20fc2e4c3f248c60c39bd652f3c1347298bb977b8b4d5903b85055620603");
}

TEST_F(Vectors, AllPass) {
  const auto summary = runVectors(kVectors, log_);
  ASSERT_TRUE(summary.ok()) << summary.status().message();
  EXPECT_EQ(summary->failed, 0) << log_.str();
  EXPECT_GE(summary->passed, 12);
}

/// Samples of the reference decoder are little endian bytes already.
std::string digestOf(const std::optional<std::vector<uint8_t>>& samples) {
  return samples ? sampleDigest(std::as_bytes(std::span(*samples)), TKS_U8) : "";
}

std::string digestOf(const reference::Triangles& mesh) {
  std::vector<double> all;
  for (const auto& place : mesh.places) all.insert(all.end(), place.begin(), place.end());
  for (const auto& place : mesh.texcoords) all.insert(all.end(), place.begin(), place.end());
  return mesh.sound ? doublesDigest(all) : "";
}

/// What a cut asks for.
reference::Choice choiceOf(std::span<const uint8_t> stream, const Cut& cut) {
  if (!cut.component) return {};
  const auto decoder = Decoder::open(stream);
  const bool heights = decoder->component(*cut.component)->kind == TKS_COMPONENT_HEIGHTS;
  return heights ? reference::Choice{*cut.component, {}} : reference::Choice{{}, *cut.component};
}

/// The decoder that was written from the text alone gives what the library gave.
TEST_F(Vectors, ReferenceDecoderPasses) {
  const auto vectors = readManifest(kVectors);
  ASSERT_TRUE(vectors.ok());
  for (const Vector& vector : *vectors) {
    const auto stream = readFile(std::string(kVectors) + "/" + vector.file);
    ASSERT_TRUE(stream.ok());
    for (const Cut& cut : vector.cuts) {
      SCOPED_TRACE(vector.name + " at " + std::to_string(cut.bytes) + " bytes");
      const reference::Decoded decoded =
          reference::decode(std::span(*stream).first(static_cast<size_t>(cut.bytes)),
                            reference::kMaxSamples, {cut.level, cut.level}, choiceOf(*stream, cut));
      const auto triangles =
          reference::decodeTriangles(std::span(*stream).first(static_cast<size_t>(cut.bytes)));
      const bool sound = !triangles || triangles->sound;
      EXPECT_EQ(sound ? test::statusOf(decoded.outcome) : TKS_CORRUPT, cut.status);
      EXPECT_EQ(triangles ? digestOf(*triangles) : "", cut.triangles);
      EXPECT_EQ(digestOf(decoded.heights), cut.heights);
      EXPECT_EQ(digestOf(decoded.texture), cut.texture);
    }
  }
}

/// The encoder is free to choose another way, and then a vector no longer tests what it is for.
TEST_F(Vectors, HaveTheToolsThatTheyState) {
  const auto vectors = readManifest(kVectors);
  ASSERT_TRUE(vectors.ok());
  for (const Vector& vector : *vectors) {
    const auto stream = readFile(std::string(kVectors) + "/" + vector.file);
    ASSERT_TRUE(stream.ok());
    const Status status = checkTools(vector.name, *stream);
    EXPECT_TRUE(status.ok()) << status.message();
  }
}

/// Every tool has a vector, and no vector states one that there is not.
TEST_F(Vectors, StateEveryTool) {
  Tools stated;
  for (const VectorCase& vector_case : vectorCases())
    stated.merge(toolsStatedFor(vector_case.name));
  EXPECT_EQ(stated, allTools());
}

TEST(CheckTools, NamesWhatAVectorLacksAndHas) {
  const auto stream = readFile(std::string(TETRAKIS_VECTORS) + "/tiny_2x2.tks");
  ASSERT_TRUE(stream.ok());
  const Status status = checkTools("stored_i16_17x19", *stream);
  EXPECT_EQ(status.code(), TKS_MISMATCH);
  EXPECT_NE(status.message().find("lacks \"stored heights\";"), std::string::npos);
  EXPECT_NE(status.message().find("has \"heights by wavelet\""), std::string::npos);
}

/// Every stream on disk is listed, in the manifest and in the README, and small.
TEST_F(Vectors, ManifestIsComplete) {
  const auto vectors = readManifest(kVectors);
  ASSERT_TRUE(vectors.ok()) << vectors.status().message();
  const auto readme = readFile(std::string(kVectors) + "/../README.md");
  ASSERT_TRUE(readme.ok());
  const std::string table(readme->begin(), readme->end());
  std::set<std::string> listed{kManifestName};
  for (const Vector& vector : *vectors) {
    EXPECT_TRUE(listed.insert(vector.file).second) << vector.file << " is listed twice";
    EXPECT_LT(fs::file_size(fs::path(kVectors) / vector.file), 20000u);
    ASSERT_FALSE(vector.cuts.empty());
    const std::string row = "| `" + vector.name + "` | " +
                            std::to_string(vector.cuts.back().bytes) + " | " + vector.purpose +
                            " |";
    EXPECT_NE(table.find(row), std::string::npos) << row;
  }
  for (const auto& entry : fs::directory_iterator(kVectors)) {
    EXPECT_TRUE(listed.contains(entry.path().filename())) << entry.path();
  }
  EXPECT_EQ(vectors->size(), vectorCases().size());
}

void addWavelet(const WaveletHeader& wavelet, Tools& tools) {
  for (const uint8_t filter : wavelet.filters) tools.insert("filter " + std::to_string(filter));
  if (wavelet.filters[0] != wavelet.filters[1]) tools.insert("level 2 differs");
  if (wavelet.filters[1] != wavelet.filters[2]) tools.insert("level 3 differs");
  tools.insert("fraction bits " + std::to_string(wavelet.fraction_bits));
  if (wavelet.bits > 20) tools.insert("wide sums");
}

/// What the header says that a stream makes use of.
void addTools(const StreamHeader& header, Tools& tools) {
  if (header.geometry) {
    tools.insert("heights " + std::to_string(header.geometry->sample));
    addWavelet(header.geometry->wavelet, tools);
    const std::string kind = std::to_string(static_cast<int>(header.layers.corrections));
    tools.insert((header.layers.validity_bytes > 0 ? "voids, corrections " : "corrections ") +
                 kind);
    if (header.layers.has_nodata) tools.insert("nodata");
    if (header.layers.bridge > 0) tools.insert("bridged voids");
    if (header.layers.late_mask) tools.insert("late mask");
  }
  if (header.texture) {
    tools.insert("channels " + std::to_string(header.texture->channels));
    if (header.texture->alpha_bytes > 0)
      tools.insert(header.texture->hidden ? "cut-out that hides" : "cut-out");
    tools.insert("texels " + std::to_string(header.texture->sample));
    if (!header.texture->repeats.none()) tools.insert("repeated texels");
    if (header.texture->drawn()) {
      tools.insert("drawn");
    } else {
      addWavelet(header.texture->wavelet, tools);
      if (header.texture->overlay_bytes > 0) tools.insert("overlay");
      if (header.texture->bridge > 0)
        tools.insert(header.texture->hidden ? "bridged cut-out" : "bridged overlay");
      if (header.texture->tables.present) tools.insert("tables of channels");
    }
  }
  if (!header.index.empty()) tools.insert("index");
}

TEST_F(Vectors, VisitEveryToolOfTheHeader) {
  const auto vectors = readManifest(kVectors);
  ASSERT_TRUE(vectors.ok());
  Tools tools;
  for (const Vector& vector : *vectors) {
    const auto stream = readFile(std::string(kVectors) + "/" + vector.file);
    ASSERT_TRUE(stream.ok());
    const auto parsed = readHeader(*stream);
    if (parsed.ok()) addTools(parsed->header, tools);
  }
  Tools wanted{"level 2 differs", "level 3 differs", "fraction bits 0", "fraction bits 4",
               "wide sums",       "nodata",          "index",           "texels 0",
               "texels 2",        "drawn",           "overlay"};
  wanted.insert({"cut-out", "cut-out that hides", "tables of channels", "repeated texels",
                 "bridged cut-out", "bridged overlay", "bridged voids", "late mask"});
  for (int i = 0; i < kFilters; ++i) wanted.insert("filter " + std::to_string(i));
  for (int i = 1; i <= 4; ++i) wanted.insert("channels " + std::to_string(i));
  for (int i = TKS_U8; i <= TKS_F32; ++i) wanted.insert("heights " + std::to_string(i));
  for (const char* kind : {"0", "1", "2", "3"}) {
    wanted.insert(std::string("corrections ") + kind);
    wanted.insert(std::string("voids, corrections ") + kind);
  }
  for (const std::string& tool : wanted) EXPECT_TRUE(tools.contains(tool)) << tool;
}

TEST_F(Vectors, ManifestIsWrittenAsItIsRead) {
  const auto vectors = readManifest(kVectors);
  ASSERT_TRUE(vectors.ok());
  ASSERT_TRUE(writeManifest(directory_, *vectors).ok());
  const auto original = readFile(std::string(kVectors) + "/" + kManifestName);
  const auto copy = readFile(directory_ / kManifestName);
  EXPECT_TRUE(*original == *copy);
}

TEST_F(Vectors, RunnerSeesWrongSamplesShortStreamsAndMissingFiles) {
  auto vectors = readManifest(directory_);
  ASSERT_TRUE(vectors.ok());
  ASSERT_GE(vectors->size(), 3u);
  const auto stream = readFile(directory_ / (*vectors)[1].file);
  ASSERT_TRUE(
      writeFile(directory_ / (*vectors)[1].file, std::string(stream->begin(), stream->end() - 1))
          .ok());
  fs::remove(directory_ / (*vectors)[2].file);
  Cut& whole = vectors->front().cuts.back();
  (whole.heights.empty() ? whole.texture : whole.heights)[5] ^= 1;
  ASSERT_TRUE(writeManifest(directory_, *vectors).ok());
  const auto summary = runVectors(directory_, log_);
  ASSERT_TRUE(summary.ok());
  EXPECT_EQ(summary->failed, 3) << log_.str();
  EXPECT_EQ(summary->passed + 3, static_cast<int>(vectors->size()));
}

TEST_F(Vectors, ManifestErrors) {
  EXPECT_EQ(runVectors(directory_ / "nowhere", log_).status().code(), TKS_IO);
  for (const char* text : {"", "[]", "{\"vectors\": [{\"name\": 3}]}", "{\"vectors\": 7"}) {
    ASSERT_TRUE(writeFile(directory_ / kManifestName, text).ok());
    EXPECT_EQ(runVectors(directory_, log_).status().code(), TKS_CORRUPT) << text;
  }
}

}  // namespace
}  // namespace tetrakis::conformance

// SPDX-License-Identifier: Apache-2.0
// No bytes keep a decoder busy for longer than what is asked for is worth. Some of the streams that
// `slow_hunt` goes through for as long as one likes, and those that once took minutes.
#include <gtest/gtest.h>

#include <string>

#include "bitstream/stream/fields.hpp"
#include "bitstream/stream/header.hpp"
#include "tests/pace/pace.hpp"
#include "tests/pace/slow_case.hpp"

namespace tetrakis::test {
namespace {

using Bytes = std::vector<uint8_t>;

/// One packet of the first track.
Bytes streamOf(StreamHeader header, const Bytes& codeword) {
  FieldWriter payload;
  payload.put(uint64_t{codeword.size()} << 2);
  if (trackCounts(header)[header.geometry ? 0 : 1].named) payload.put(0);
  payload.bytes.push_back(64);
  payload.bytes.insert(payload.bytes.end(), codeword.begin(), codeword.end());
  header.payload_bytes = payload.bytes.size();
  Bytes stream = writeHeader(header);
  stream.insert(stream.end(), payload.bytes.begin(), payload.bytes.end());
  return stream;
}

StreamHeader heightsOf(uint32_t side) {
  StreamHeader header;
  GeometryHeader& g = header.geometry.emplace();
  g.width = g.height = side;
  g.sample = TKS_F32;
  g.planes = 30;
  return header;
}

const Bytes kOnes(20, 0xff);
const Bytes kNearlyOnes = {0xff, 0xff, 0xff, 0xfe, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff};

/// Four bytes of FF would be a codeword without an end, a byte less takes its time.
TEST(Pace, OfOnesAndNearlyOnes) {
  const double slow = slowness();
  StreamHeader texture;
  TextureHeader& t = texture.texture.emplace();
  t.width = t.height = 1 << 11;
  t.channels = 4;
  t.planes = 30;
  for (const Bytes& codeword : {kOnes, kNearlyOnes}) {
    EXPECT_EQ(slowCall(streamOf(heightsOf(1 << 13), codeword), slow), "");
    EXPECT_EQ(slowCall(streamOf(texture, codeword), slow), "");
  }
}

/// Corrections of the rows before a window are decoded only as far as their bytes go.
TEST(Pace, OfCorrectionsBeforeAWindow) {
  const double slow = slowness();
  for (const CorrectionKind kind : {CorrectionKind::kSteps, CorrectionKind::kSamples,
                                    CorrectionKind::kRelative, CorrectionKind::kFacets}) {
    StreamHeader header = heightsOf(1 << 14);
    header.layers.corrections = kind;
    header.layers.correction_step = 1;
    header.layers.relative = {1, 4};
    header.layers.facet_unit = 100;
    for (const Bytes& codeword : {kOnes, Bytes{0xff, 0xff, 0xfe}, Bytes{0, 0, 0}})
      EXPECT_EQ(slowCall(streamOf(header, codeword), slow), "") << static_cast<int>(kind);
  }
}

/// A window of a plane of 2^28 samples whose mask, bridges, drawing or stored samples are a few
/// bytes for all of it.
TEST(Pace, OfOneCodewordForAWholePlane) {
  const double slow = slowness();
  const Bytes few(20, 0);
  const auto expectInTime = [&](const StreamHeader& header, const char* what) {
    for (const Bytes& codeword : {few, kNearlyOnes})
      EXPECT_EQ(slowCall(streamOf(header, codeword), slow), "") << what;
  };
  StreamHeader masked = heightsOf(1 << 14);
  masked.layers.validity_bytes = few.size();
  masked.layers.has_nodata = 1;
  expectInTime(masked, "a mask");
  masked.layers.bridge = 254;
  expectInTime(masked, "bridges");
  StreamHeader direct = heightsOf(1 << 14);
  direct.geometry->planes = GeometryHeader::kDirectPlanes;
  expectInTime(direct, "stored heights");
  direct.geometry->drawn = true;
  expectInTime(direct, "drawn heights");
  StreamHeader ordered = heightsOf(1 << 13);
  ordered.geometry->priorities = {7, "\x5a\x93\x12\x77\x33\x19"};
  expectInTime(ordered, "priorities");
  StreamHeader texture;
  TextureHeader& t = texture.texture.emplace();
  t.width = t.height = 1 << 14;
  t.channels = 2;
  t.planes = 30;
  t.alpha_bytes = few.size();
  t.hidden = 1;
  t.bridge = 254;
  expectInTime(texture, "bridges of a cut-out");
  t = {};
  t.width = t.height = 1 << 14;
  t.channels = 1;
  t.planes = kDrawnPlanes;
  expectInTime(texture, "a drawn texture");
  t.stored = true;
  expectInTime(texture, "a stored texture");
}

/// A mask by which all samples are flat, in a few bytes.
TEST(Pace, OfFlatAreas) {
  const double slow = slowness();
  Bytes codeword(4000, 0xff);
  codeword[3] = 0xfe;
  StreamHeader flat = heightsOf(1 << 13);
  flat.layers.flat_bytes = codeword.size() / 2;
  for (const uint32_t areas : {1u, 3u}) {
    flat.layers.flat_areas = areas;
    EXPECT_EQ(slowCall(streamOf(flat, codeword), slow), "") << areas;
  }
}

class SlowStreams : public testing::TestWithParam<uint64_t> {};

TEST_P(SlowStreams, TakeTheirTime) {
  constexpr uint64_t kCases = 25;
  const double slow = slowness();
  for (uint64_t seed = kCases * GetParam(); seed < kCases * (GetParam() + 1); ++seed) {
    const SlowCase made = slowCase(seed, 1 << 18);
    EXPECT_EQ(slowCall(made.stream, slow), "") << "seed " << seed << ": " << made.description;
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, SlowStreams, testing::Range<uint64_t>(0, 4));

}  // namespace
}  // namespace tetrakis::test

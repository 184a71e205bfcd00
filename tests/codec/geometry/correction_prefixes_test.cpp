// SPDX-License-Identifier: Apache-2.0
// What encoders find out about all prefixes of corrections at once is what a decoder shows of each.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <iterator>
#include <set>

#include "bitstream/stream/geometry_header.hpp"
#include "bitstream/stream/header.hpp"
#include "bitstream/stream/packet.hpp"
#include "codec/geometry/heights_decoder.hpp"
#include "codec/geometry/heights_encoder.hpp"
#include "codec/geometry/plane_corrections.hpp"

namespace tetrakis::test {
namespace {

std::vector<uint8_t> streamOf(const std::string& vector) {
  std::ifstream file(std::string(TETRAKIS_VECTORS) + "/" + vector + ".tks", std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

void expectSame(const DecodedHeights& of_encoder, const DecodedHeights& decoded) {
  EXPECT_EQ(of_encoder.geometry.heights, decoded.geometry.heights);
  EXPECT_EQ(of_encoder.geometry.significant, decoded.geometry.significant);
  EXPECT_EQ(of_encoder.geometry.valid, decoded.geometry.valid);
  EXPECT_EQ(of_encoder.geometry.fraction_bits, decoded.geometry.fraction_bits);
  EXPECT_EQ(of_encoder.geometry.quiet_levels, decoded.geometry.quiet_levels);
  EXPECT_EQ(of_encoder.corrections, decoded.corrections);
}

/// Prefixes at even distances, those of the first and the last bytes, and a short one at last:
/// prefixes may be asked for in any order.
std::vector<uint64_t> lengthsUpTo(uint64_t bytes) {
  constexpr uint64_t kEnds = 8, kMost = 100;
  std::vector<uint64_t> lengths;
  for (uint64_t length = 1; length <= bytes; ++length) {
    const bool even = length % std::max<uint64_t>(1, bytes / kMost) == 0;
    if (even || length <= kEnds || length + kEnds > bytes) lengths.push_back(length);
  }
  lengths.push_back(1 + bytes / 3);
  return lengths;
}

/// Returns the kind of the corrections, and in how many steps they count.
std::pair<CorrectionKind, bool> comparePrefixes(const std::string& vector) {
  SCOPED_TRACE(vector);
  const std::vector<uint8_t> stream = streamOf(vector);
  const Result<ParsedHeader> parsed = readHeader(stream);
  EXPECT_TRUE(parsed.ok());
  const StreamHeader& header = parsed->header;
  const GeometryHeader& geometry = *header.geometry;
  const GeometryLayers& layers = header.layers;
  const auto taken =
      demultiplex(std::span(stream).subspan(parsed->bytes), parsed->bytes, trackCounts(header));
  EXPECT_TRUE(taken.ok());
  const Codewords tracks = taken->codewordsOf(Component::kGeometry);
  EXPECT_EQ(correctionTracks(geometry, layers), 0u);
  const std::span<const uint8_t> track = tracks.front();
  const uint64_t bytes = takeApart(tracks, geometry, layers).corrections.front().size();
  EXPECT_GT(bytes, 0u);
  HeightsMemory memory;
  memory.corrected = prefixesOfCorrections(geometry, layers, track);
  for (const uint64_t length : lengthsUpTo(bytes)) {
    SCOPED_TRACE(std::to_string(length) + " of " + std::to_string(bytes));
    const Codewords prefix = {track.first(track.size() - bytes + length)};
    expectSame(decodeHeights(geometry, layers, prefix, {}, {1, &memory}),
               decodeHeights(geometry, layers, prefix));
    if (::testing::Test::HasFailure()) break;
  }
  return {layers.corrections, layers.correction_step > 1};
}

TEST(CorrectionPrefixes, AreWhatDecodersShow) {
  std::set<std::pair<CorrectionKind, bool>> kinds;
  for (const char* vector : {"coast_bounded_64x50", "coast_exact_64x50", "holes_bounded_i16_64x50",
                             "noise_corrections_f32_30x20", "noise_corrections_u32_30x20",
                             "relative_geoid_75x61", "facets_83x61", "forest_cone_33x33"})
    kinds.insert(comparePrefixes(vector));
  using enum CorrectionKind;
  for (const auto& kind : {std::pair{kSteps, true},
                           {kSteps, false},
                           {kSamples, false},
                           {kRelative, false},
                           {kFacets, false}})
    EXPECT_TRUE(kinds.contains(kind));
}

}  // namespace
}  // namespace tetrakis::test

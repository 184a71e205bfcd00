// SPDX-License-Identifier: Apache-2.0
// tks_put: bytes of a stream that come in any order, and how many its header takes.
#include <algorithm>
#include <array>
#include <limits>
#include <numeric>
#include <random>

#include "bitstream/stream/header.hpp"
#include "codec/geometry/heights_decoder.hpp"
#include "conformance/samples/header_seal.hpp"
#include "tests/support/indexed_terrain.hpp"
#include "texture_wavelet/texture_decoder.hpp"

namespace tetrakis::test {
namespace {

/// What the API ought to decode: of each track the bytes of whole packets, and of one that is not
/// whole what is there, up to the first gap.
std::array<std::vector<Bytes>, 2> tracksOf(const Bytes& bytes, const std::vector<bool>& there,
                                           const ParsedHeader& parsed) {
  const TrackCounts counts = trackCounts(parsed.header);
  std::array<std::vector<Bytes>, 2> tracks = {std::vector<Bytes>(counts[0].tracks),
                                              std::vector<Bytes>(counts[1].tracks)};
  std::array<std::vector<bool>, 2> ended = {std::vector<bool>(counts[0].tracks),
                                            std::vector<bool>(counts[1].tracks)};
  size_t place = parsed.bytes;
  for (const auto& [entry, slope] : parsed.header.index) {
    if (place >= bytes.size()) break;
    const auto c = static_cast<size_t>(entry.component);
    place += headBytes(entry, counts).size();
    const size_t length = entry.length;
    size_t known = 0;
    while (known < length && place + known < bytes.size() && there[place + known]) ++known;
    if (!ended[c][entry.track] && (known == length || !entry.whole)) {
      Bytes& track = tracks[c][entry.track];
      for (size_t i = 0; i < known; ++i) track.push_back(bytes[place + i]);
    }
    if (known < length) ended[c][entry.track] = true;
    place += length;
  }
  return tracks;
}

tks_status putRanges(Stream& stream, const Bytes& bytes, const std::vector<tks_range>& ranges) {
  std::vector<const uint8_t*> data;
  for (const tks_range& range : ranges) data.push_back(bytes.data() + range.offset);
  return tks_put_ranges(stream.get(), ranges.data(), data.data(), ranges.size());
}

/// Decodes the tracks without the C interface.
void expectTracks(Stream& stream, const ParsedHeader& parsed,
                  const std::array<std::vector<Bytes>, 2>& tracks) {
  std::array<Codewords, 2> codewords;
  for (size_t c = 0; c < 2; ++c)
    for (const Bytes& track : tracks[c]) codewords[c].push_back(track);
  if (parsed.header.geometry) {
    const DecodedGeometry expected =
        decodeHeights(*parsed.header.geometry, parsed.header.layers, codewords[0]).geometry;
    const std::vector<std::byte> heights = stream.heights();
    const std::vector<int32_t> steps = wholeSteps(expected);
    for (size_t i = 0; i < steps.size(); ++i) {
      const double sample = parsed.header.geometry->base + steps[i] * parsed.header.geometry->step;
      ASSERT_EQ(sampleAt(heights, stream.info().sample, i), sample) << i;
    }
  }
  if (parsed.header.texture) {
    const Texels expected = decodeTexture(*parsed.header.texture, codewords[1]);
    const std::vector<std::byte> texture = stream.texture();
    for (size_t i = 0; i < expected.samples.size(); ++i)
      ASSERT_EQ(sampleAt(texture, stream.info().texture_sample, i), expected.samples[i]) << i;
  }
}

/// Packets of regions in random orders, cut anywhere: of each track counts what has no gap.
TEST(Put, AnyOrderDecodesWhatIsThere) {
  const samples::Raster heights = samples::make({samples::Pattern::kRidges, 70, 45, 1, TKS_I16}),
                        image = samples::make({samples::Pattern::kRidges, 41, 52, 3, TKS_U8});
  const Bytes bytes = encodeRegions(&heights, &image, lossless());
  const auto parsed = readHeader(bytes);
  ASSERT_TRUE(parsed.ok());
  std::mt19937 random(7);
  for (int trial = 0; trial < 12; ++trial) {
    std::vector<size_t> places;  // where pieces begin
    for (size_t place = parsed->bytes; place < bytes.size();
         place += 1 + random() % (bytes.size() / 9))
      places.push_back(place);
    std::vector<size_t> order(places.size());
    std::iota(order.begin(), order.end(), size_t{0});
    std::shuffle(order.begin(), order.end(), random);
    Stream stream(Prefix(bytes).first(parsed->bytes)), at_once(Prefix(bytes).first(parsed->bytes));
    std::vector<bool> there(bytes.size());
    std::vector<tks_range> ranges;  // that the second stream does not have yet
    for (const size_t i : order) {
      const size_t begin = places[i], next = i + 1 < places.size() ? places[i + 1] : bytes.size();
      const size_t end = std::min(next + random() % 20, bytes.size());  // they may overlap
      ASSERT_EQ(tks_put(stream.get(), begin, bytes.data() + begin, end - begin), TKS_OK)
          << tks_message(stream.get());
      for (size_t k = begin; k < end; ++k) there[k] = true;
      ASSERT_NO_FATAL_FAILURE(expectTracks(stream, *parsed, tracksOf(bytes, there, *parsed)));
      ranges.push_back({begin, end - begin, 0});
      if (random() % 3 != 0 && i != order.back()) continue;
      ASSERT_EQ(putRanges(at_once, bytes, ranges), TKS_OK) << tks_message(at_once.get());
      ASSERT_TRUE(at_once.heights() == stream.heights());
      ASSERT_TRUE(at_once.texture() == stream.texture());
      ranges.clear();
    }
    EXPECT_EQ(tks_verify(stream.get()), TKS_OK) << tks_message(stream.get());
    EXPECT_EQ(squaredError(heights, stream.heights()), 0);
    EXPECT_EQ(squaredError(image, stream.texture()), 0);
  }
}

/// Coefficients that come before the mask of voids, in the last bytes first, wait for it.
TEST(Put, CoefficientsWaitForTheMask) {
  samples::Raster raster = samples::make({samples::Pattern::kRidges, 70, 45, 1, TKS_F32});
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (size_t i = 0; i < 70 * 45; ++i)
    if (i % 70 + i / 70 < 40) std::memcpy(raster.data.data() + 4 * i, &nan, sizeof nan);
  const Bytes bytes = encodeRegions(&raster, nullptr, lossless());
  const auto parsed = readHeader(bytes);
  ASSERT_TRUE(parsed.ok());
  ASSERT_GT(parsed->header.layers.validity_bytes, 0u);
  Stream stream(Prefix(bytes).first(parsed->bytes)), unsent(Prefix(bytes).first(parsed->bytes));
  const size_t piece = (bytes.size() - parsed->bytes) / 7;
  const size_t masked = parsed->bytes + 1 + parsed->header.layers.validity_bytes;
  for (size_t end = bytes.size(); end > parsed->bytes;) {
    const size_t begin = std::max(end - std::min(end, piece), parsed->bytes);
    ASSERT_EQ(tks_put(stream.get(), begin, bytes.data() + begin, end - begin), TKS_OK);
    const std::vector<std::byte> heights = stream.heights();
    if (begin > masked) {
      ASSERT_TRUE(heights == unsent.heights()) << begin;
    }
    end = begin;
  }
  EXPECT_TRUE(stream.heights() == Stream(bytes).heights());
  EXPECT_EQ(tks_verify(stream.get()), TKS_OK);
}

/// The last packet is cut by the budget; what lies behind the stream's end is no part of it.
TEST(Put, BytesBehindTheEndAreNone) {
  const samples::Raster heights = samples::make({samples::Pattern::kRidges, 70, 45, 1, TKS_I16});
  Bytes bytes = encodeRegions(&heights, nullptr, budget(1500));
  const Bytes whole = bytes;
  for (int i = 0; i < 700; ++i) bytes.push_back(static_cast<uint8_t>(i * 37));
  const size_t header = readHeader(bytes)->bytes;
  for (size_t gap = header; gap + 1 < whole.size(); gap += 11) {
    Stream stream(Prefix(bytes).first(gap)), other(Prefix(whole).first(gap));
    const size_t behind = gap + 1;
    ASSERT_EQ(tks_put(stream.get(), behind, bytes.data() + behind, bytes.size() - behind), TKS_OK);
    ASSERT_EQ(tks_put(other.get(), behind, whole.data() + behind, whole.size() - behind), TKS_OK);
    ASSERT_TRUE(stream.heights() == other.heights()) << gap;
    ASSERT_EQ(tks_put(stream.get(), gap, bytes.data() + gap, 1), TKS_OK);
    ASSERT_TRUE(stream.heights() == Stream(whole).heights()) << gap;
  }
}

/// An index may lie. While bytes are missing, tracks are what it says of them; in the end they are
/// what the packets say.
TEST(Put, InTheEndAnIndexThatLiesChangesNothing) {
  const samples::Raster heights = samples::make({samples::Pattern::kRidges, 40, 31, 1, TKS_I16});
  const samples::Raster image = samples::make({samples::Pattern::kSteps, 24, 19, 1, TKS_U8});
  const Bytes bytes = encodeRegions(&heights, &image, lossless());
  const size_t header = readHeader(bytes)->bytes;
  std::mt19937 random(11);
  size_t taken = 0;
  for (size_t at = header / 3; at < header - 4; ++at) {
    Bytes damaged = bytes;
    damaged[at] = static_cast<uint8_t>(damaged[at] ^ (1u << random() % 8));
    sealHeader(damaged);
    const Stream fresh(damaged);
    if (fresh.status() != TKS_OK || readHeader(damaged)->bytes != header) continue;
    const size_t half = header + 1 + random() % (bytes.size() - header - 1);
    Stream stream(Prefix(damaged).first(header));
    if (tks_put(stream.get(), half, damaged.data() + half, damaged.size() - half) != TKS_OK)
      continue;
    for (size_t begin = header; begin < half; begin += half / 3) {
      if (stream.info().has_heights) stream.heights();
      if (stream.info().has_texture) stream.texture();
      const size_t size = std::min(half - begin, half / 3);
      if (tks_put(stream.get(), begin, damaged.data() + begin, size) != TKS_OK) break;
    }
    tks_info info = {};
    info.size = sizeof info;
    ASSERT_EQ(tks_get_info(stream.get(), &info), TKS_OK);
    if (info.available_bytes < damaged.size()) continue;
    ++taken;
    ASSERT_TRUE(stream.heights() == Stream(damaged).heights()) << at;
    ASSERT_TRUE(stream.texture() == Stream(damaged).texture()) << at;
  }
  EXPECT_GT(taken, 20u);
}

/// Who has all bytes does not need the index; who takes bytes where it says is told.
TEST(Put, AnIndexThatLiesIsNoDamageWithoutGaps) {
  const samples::Raster heights = samples::make({samples::Pattern::kRidges, 40, 31, 1, TKS_I16});
  const Bytes bytes = encodeRegions(&heights, nullptr, lossless());
  const auto parsed = readHeader(bytes);
  StreamHeader header = parsed->header;
  ASSERT_GT(header.index.size(), 1u);
  for (const bool length : {false, true}) {
    header.index = parsed->header.index;
    PacketHead& told = header.index.front().packet;
    if (length) {
      told.length += 1;
    } else {
      told.quality ^= 1;
    }
    Bytes lying = writeHeader(header);
    const size_t begin = lying.size();
    lying.insert(lying.end(), bytes.begin() + static_cast<ptrdiff_t>(parsed->bytes), bytes.end());
    Stream stream(lying), grown(Prefix(lying).first(begin)), scattered(Prefix(lying).first(begin));
    EXPECT_EQ(tks_verify(stream.get()), TKS_OK) << tks_message(stream.get());
    EXPECT_EQ(squaredError(heights, stream.heights()), 0);
    ASSERT_EQ(tks_append(grown.get(), lying.data() + begin, lying.size() - begin), TKS_OK);
    EXPECT_EQ(squaredError(heights, grown.heights()), 0);
    const size_t behind = begin + 1 + 2;  // in the payload of the first packet
    ASSERT_EQ(tks_put(scattered.get(), behind, lying.data() + behind, 1), TKS_OK);
    EXPECT_EQ(tks_append(scattered.get(), lying.data() + begin, 2 + 1), TKS_CORRUPT);
  }
}

TEST(Put, WithoutAnIndexBytesComeInTheirOrder) {
  const samples::Raster heights = samples::make({samples::Pattern::kRidges, 30, 20, 1, TKS_I16});
  const Bytes bytes = encode(&heights, nullptr, lossless());
  Stream stream(Prefix(bytes).first(bytes.size() / 2));
  EXPECT_EQ(tks_put(stream.get(), bytes.size() - 5, bytes.data() + bytes.size() - 5, 5), TKS_USAGE);
  EXPECT_NE(std::string(tks_message(stream.get())).find("no index"), std::string::npos);
  EXPECT_EQ(tks_put(stream.get(), 0, bytes.data(), bytes.size()), TKS_OK);
  EXPECT_EQ(squaredError(heights, stream.heights()), 0);
}

/// With a gap between them none of many ranges is taken, not even the first.
TEST(Put, WithoutAnIndexRangesComeInTheirOrder) {
  const samples::Raster heights = samples::make({samples::Pattern::kRidges, 30, 20, 1, TKS_I16});
  const Bytes bytes = encode(&heights, nullptr, lossless());
  const size_t third = bytes.size() / 3, last = bytes.size() - 5;
  Stream stream(Prefix(bytes).first(third));
  EXPECT_EQ(putRanges(stream, bytes, {{third, 50, 0}, {last, 5, 0}}), TKS_USAGE);
  EXPECT_EQ(putRanges(stream, bytes, {{third + 50, 5, 0}}), TKS_USAGE);
  EXPECT_EQ(putRanges(stream, bytes, {{third, last - third, 0}, {last, 5, 0}}), TKS_OK);
  EXPECT_EQ(squaredError(heights, stream.heights()), 0);
}

/// A packet of another stream is no packet of this one; what was there goes on.
TEST(Put, ForeignBytesAreRefused) {
  const samples::Raster heights = samples::make({samples::Pattern::kRidges, 70, 45, 1, TKS_I16});
  const Bytes bytes = encodeRegions(&heights, nullptr, lossless());
  const size_t header = readHeader(bytes)->bytes;
  Stream stream(Prefix(bytes).first(header + 100)), before(Prefix(bytes).first(header + 100));
  Bytes foreign(bytes.size() - header - 200, 0);
  EXPECT_EQ(tks_put(stream.get(), header + 200, foreign.data(), foreign.size()), TKS_CORRUPT);
  EXPECT_TRUE(stream.heights() == before.heights());
  EXPECT_EQ(tks_append(stream.get(), bytes.data() + header + 100, 50), TKS_CORRUPT);
  EXPECT_TRUE(stream.heights() == before.heights());
}

TEST(HeaderBytes, AreKnownFromAFewBytesOn) {
  const samples::Raster heights = samples::make({samples::Pattern::kRidges, 30, 20, 1, TKS_I16});
  const Bytes bytes = encodeRegions(&heights, nullptr, lossless());
  const size_t header = readHeader(bytes)->bytes;
  for (size_t size = 0; size <= bytes.size(); ++size) {
    uint64_t needed = 0;
    const tks_status status = tks_header_bytes(bytes.data(), size, &needed);
    ASSERT_EQ(status, size < header ? TKS_TRUNCATED : TKS_OK) << size;
    if (size >= 16) {
      ASSERT_EQ(needed, header);
    }
    ASSERT_LE(needed, header);
    ASSERT_TRUE(needed > size || size >= header);
  }
  uint64_t needed = 1;
  const uint8_t foreign[] = {'P', 'N', 'G'};
  EXPECT_EQ(tks_header_bytes(foreign, sizeof foreign, &needed), TKS_CORRUPT);
  EXPECT_EQ(needed, 0u);
}

}  // namespace
}  // namespace tetrakis::test

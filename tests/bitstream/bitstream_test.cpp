// SPDX-License-Identifier: Apache-2.0
// Range coder, tail rule, header and packets.
#include <gtest/gtest.h>

#include <bit>
#include <limits>
#include <random>
#include <span>

#include "bitstream/coder/adaptive_bit.hpp"
#include "bitstream/coder/range_decoder.hpp"
#include "bitstream/coder/range_encoder.hpp"
#include "bitstream/stream/fields.hpp"
#include "bitstream/stream/header.hpp"
#include "bitstream/stream/packet.hpp"

namespace tetrakis {
namespace {

struct CodedBits {
  std::vector<bool> bits;
  std::vector<uint64_t> decided;  ///< bytes that decide each bit
  std::vector<uint8_t> codeword;
};

CodedBits randomBits(uint32_t seed) {
  std::mt19937 random(seed);
  CodedBits out;
  RangeEncoder encoder;
  std::array<AdaptiveBit, 3> models;
  const auto odds = static_cast<uint32_t>(random() % 1001);
  for (size_t i = random() % 400; i-- > 0;) {
    const bool bit = random() % 1000 < odds;
    const size_t n = out.bits.size();
    n % 7 == 0 ? encoder.encodeEven(bit) : encoder.encode(models[n % 3], bit);
    out.bits.push_back(bit);
    out.decided.push_back(encoder.decidedBytes());
  }
  out.codeword = encoder.finish();
  return out;
}

/// Bits that a prefix of the codeword decides.
std::vector<bool> decodePrefix(const CodedBits& coded, size_t bytes) {
  std::array<AdaptiveBit, 3> models;
  RangeDecoder decoder(std::span(coded.codeword).first(bytes));
  std::vector<bool> bits;
  while (bits.size() < coded.bits.size()) {
    const size_t n = bits.size();
    const bool bit = n % 7 == 0 ? decoder.decodeEven() : decoder.decode(models[n % 3]);
    if (decoder.exhausted()) break;
    bits.push_back(bit);
  }
  return bits;
}

TEST(RangeCoder, EveryPrefixDecidesAPrefixOfTheBits) {
  for (uint32_t seed = 0; seed < 300; ++seed) {
    const CodedBits coded = randomBits(seed);
    EXPECT_EQ(decodePrefix(coded, coded.codeword.size()), coded.bits);
    size_t before = 0;
    for (size_t bytes = 0; bytes <= coded.codeword.size(); ++bytes) {
      const std::vector<bool> bits = decodePrefix(coded, bytes);
      ASSERT_GE(bits.size(), before);
      before = bits.size();
      ASSERT_TRUE(std::equal(bits.begin(), bits.end(), coded.bits.begin())) << seed << " " << bytes;
      if (bits.size() == coded.bits.size()) continue;
      ASSERT_GT(coded.decided[bits.size()], bytes);
    }
  }
}

/// Bytes of which many are at an end of the range, and the first ones most of all.
std::vector<uint8_t> extremeBytes(uint32_t seed) {
  std::mt19937 random(seed);
  std::vector<uint8_t> bytes(random() % 40);
  const size_t ones = random() % 7;
  for (size_t i = 0; i < bytes.size(); ++i) {
    const auto kind = random() % 4;
    bytes[i] = static_cast<uint8_t>(i < ones || kind == 0 ? 0xff : kind == 1 ? 0 : random());
  }
  return bytes;
}

/// The decisions of one model and of even odds in turn, at most so many.
std::vector<bool> decisionsOf(std::span<const uint8_t> bytes, size_t most) {
  RangeDecoder decoder(bytes);
  AdaptiveBit model;
  std::vector<bool> bits;
  while (bits.size() < most) {
    const bool bit = bits.size() % 3 == 0 ? decoder.decodeEven() : decoder.decode(model);
    if (decoder.exhausted()) break;
    bits.push_back(bit);
  }
  return bits;
}

TEST(RangeCoder, APrefixOfAnyBytesDecidesAPrefix) {
  for (uint32_t seed = 0; seed < 2000; ++seed) {
    const std::vector<uint8_t> bytes = extremeBytes(seed);
    std::vector<bool> before;
    for (size_t size = 0; size <= bytes.size(); ++size) {
      const std::vector<bool> bits = decisionsOf(std::span(bytes).first(size), 2000);
      ASSERT_LT(bits.size(), 2000u);
      ASSERT_GE(bits.size(), before.size()) << seed << " " << size;
      ASSERT_TRUE(std::equal(before.begin(), before.end(), bits.begin())) << seed << " " << size;
      before = bits;
    }
  }
}

TEST(RangeCoder, OnesAloneDecideNothing) {
  for (size_t size = 0; size < 20; ++size) {
    const std::vector<uint8_t> ones(size, 0xff);
    EXPECT_TRUE(decisionsOf(ones, 1).empty()) << size;
    RangeDecoder decoder(ones);
    EXPECT_FALSE(decoder.hasPlenty(1));
  }
  for (size_t other = 0; other < 4; ++other) {
    std::vector<uint8_t> bytes(8, 0xff);
    bytes[other] = 0xfe;
    EXPECT_FALSE(decisionsOf(bytes, 1).empty()) << other;
  }
}

/// At the ends of the range a model gets as certain as one can, and decisions are cheapest.
TEST(RangeCoder, BytesPayForDecisions) {
  for (const uint8_t byte : {uint8_t{0}, uint8_t{0xff}}) {
    for (const size_t size : {4u, 5u, 9u, 40u}) {
      std::vector<uint8_t> bytes(size, byte);
      if (byte == 0xff) bytes[3] = 0xfe;
      RangeDecoder decoder(bytes);
      AdaptiveBit model;
      uint64_t decisions = 0;
      for (; decisions <= mostDecisions(size); ++decisions) {
        decoder.decode(model);
        if (decoder.exhausted()) break;
      }
      EXPECT_LE(decisions, mostDecisions(size)) << size;
      EXPECT_GT(decisions, mostDecisions(size) * 9 / 10 - 300'000) << size;
    }
  }
}

/// Any bytes: decisions with plenty of them in stretches, and one by one, are the same until the
/// end.
TEST(RangeCoder, PlentyChangesNothing) {
  constexpr size_t kStretch = 40;
  for (uint32_t seed = 0; seed < 200; ++seed) {
    std::mt19937 random(seed);
    std::vector<uint8_t> bytes(random() % 600);
    // Runs of equal bytes make models certain; what follows then takes the most bytes.
    for (uint8_t& byte : bytes)
      byte = static_cast<uint8_t>(seed % 2 == 0 || random() % 4 == 0 ? random() : 0xff);
    if (bytes.size() > 3 && bytes[3] == 0xff) bytes[3] = 0xfe;  // four of them decide nothing
    RangeDecoder one(bytes), other(bytes);
    std::array<AdaptiveBit, 3> models, other_models;
    size_t stretches = 0;
    for (; other.hasPlenty(kStretch); ++stretches) {
      RangeDecoder::Plenty plenty(other);
      for (size_t i = 0; i < kStretch; ++i) {
        AdaptiveBit& model = other_models[i % 3];
        const bool bit = i % 2 == 0 ? plenty.decode(model) : plenty.decodeUncertain(model);
        ASSERT_EQ(one.decode(models[i % 3]), bit) << seed;
        ASSERT_FALSE(one.exhausted());
      }
    }
    EXPECT_EQ(stretches > 0, bytes.size() >= 2 * kStretch + 4);
    while (!one.exhausted()) {
      ASSERT_EQ(one.decode(models[0]), other.decode(other_models[0])) << seed;
      ASSERT_EQ(one.exhausted(), other.exhausted());
    }
  }
}

TEST(RangeCoder, TailRuleNeverDependsOnTheMissingBytes) {
  const CodedBits coded = randomBits(7);
  for (size_t bytes = 0; bytes < coded.codeword.size(); ++bytes) {
    const std::vector<bool> decided = decodePrefix(coded, bytes);
    for (const uint8_t fill : {uint8_t{0x00}, uint8_t{0xff}}) {
      CodedBits other = coded;
      std::fill(other.codeword.begin() + static_cast<ptrdiff_t>(bytes), other.codeword.end(), fill);
      other.codeword.resize(coded.codeword.size() + 8, fill);
      const std::vector<bool> bits = decodePrefix(other, other.codeword.size());
      ASSERT_GE(bits.size(), decided.size());
      EXPECT_TRUE(std::equal(decided.begin(), decided.end(), bits.begin()));
    }
  }
}

TEST(RangeCoder, AdaptsToSkewedOdds) {
  RangeEncoder encoder;
  AdaptiveBit model;
  for (int i = 0; i < 100000; ++i) encoder.encode(model, i % 100 == 0);
  // Entropy of 1 : 99 is 0.081 bits; adaptation costs a tenth more.
  EXPECT_LT(static_cast<double>(encoder.finish().size()), 100000 * 0.081 / 8 * 1.15);
}

StreamHeader sampleHeader() {
  StreamHeader header;
  header.payload_bytes = 12345;
  header.triangles = 777;
  header.geometry.emplace();
  header.geometry->width = 300;
  header.geometry->height = 2;
  header.geometry->sample = TKS_I16;
  header.geometry->planes = 14;
  header.geometry->base = -12.5;
  header.geometry->step = 0.1;
  header.texture.emplace();
  header.texture->width = 5;
  header.texture->height = 70000 / 7;
  header.texture->channels = 3;
  header.metadata.crs = "EPSG:32633";
  header.metadata.spacing_x = 30;
  header.index = {{{40, 0, 3}, 200}, {{81, 0, 0}, 0}};
  return header;
}

TEST(Fields, DoublesComeBackBitForBit) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const std::vector<std::pair<double, size_t>> doubles = {
      {0, 1},         {-0.0, 2}, {1, 3}, {-1, 3},    {3436, 4},   {0.1, 9},     {5e-324, 9},
      {kInfinity, 3}, {30, 3},   {2, 2}, {1e300, 9}, {-32768, 3}, {-3.4e38f, 6}};
  for (const auto& [value, size] : doubles) {
    FieldWriter writer;
    double written = value, read = 7;
    writer.f64("value", written);
    EXPECT_EQ(writer.bytes.size(), size) << value;
    FieldReader reader(writer.bytes);
    reader.f64("value", read, true);
    EXPECT_TRUE(reader.ok());
    EXPECT_EQ(reader.position(), writer.bytes.size());
    EXPECT_EQ(std::bit_cast<uint64_t>(read), std::bit_cast<uint64_t>(value));
    FieldReader starved(std::span(writer.bytes).first(size - 1));
    starved.f64("value", read, true);
    EXPECT_TRUE(starved.starved());
  }
  const std::vector<uint8_t> long_one = {8, 0, 0, 0, 0, 0, 0, 0xf0, 0x3f}, too_long(10, 9);
  double read = 0;
  FieldReader reader(long_one);
  reader.f64("value", read);
  EXPECT_EQ(read, 1);
  FieldReader failing(too_long);
  failing.f64("value", read);
  EXPECT_FALSE(failing.ok() || failing.starved());
}

TEST(Header, ReadsWhatItWrites) {
  const std::vector<uint8_t> bytes = writeHeader(sampleHeader());
  Result<ParsedHeader> parsed = readHeader(bytes);
  ASSERT_TRUE(parsed.ok()) << parsed.status().message();
  EXPECT_EQ(parsed->bytes, bytes.size());
  EXPECT_EQ(writeHeader(parsed->header), bytes);
  EXPECT_EQ(parsed->header.geometry->base, -12.5);
  EXPECT_EQ(parsed->header.metadata.crs, "EPSG:32633");
  EXPECT_EQ(parsed->header.index.size(), 2u);
}

TEST(Header, EveryPrefixAsksForMore) {
  const std::vector<uint8_t> bytes = writeHeader(sampleHeader());
  for (size_t n = 0; n < bytes.size(); ++n) {
    const Result<ParsedHeader> parsed = readHeader(std::span(bytes).first(n));
    ASSERT_FALSE(parsed.ok());
    EXPECT_EQ(parsed.status().code(), TKS_TRUNCATED) << n;
  }
}

TEST(Header, EveryCorruptByteIsNoticed) {
  std::vector<uint8_t> bytes = writeHeader(sampleHeader());
  for (size_t i = 0; i < bytes.size(); ++i) {
    for (const int change : {1, 0x80, 0xff}) {
      bytes[i] = static_cast<uint8_t>(bytes[i] ^ change);
      EXPECT_FALSE(readHeader(bytes).ok()) << i;
      bytes[i] = static_cast<uint8_t>(bytes[i] ^ change);
    }
  }
}

/// Numbers that no encoder writes, and that would spread through all that is computed with them.
TEST(Header, RefusesNumbersThatAreNone) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const auto opens = [](auto&& change) {
    StreamHeader header = sampleHeader();
    change(header);
    return readHeader(writeHeader(header)).ok();
  };
  EXPECT_TRUE(opens([](StreamHeader& h) { h.geometry->exact = 1; }));
  for (const double wrong : {kInfinity, -kInfinity, std::nan("")}) {
    EXPECT_FALSE(opens([&](StreamHeader& h) { h.geometry->base = wrong; }));
    EXPECT_FALSE(opens([&](StreamHeader& h) { h.geometry->step = wrong; }));
    EXPECT_FALSE(opens([&](StreamHeader& h) {
      h.geometry->exact = 1;  // so that there is a bound
      h.geometry->max_error = wrong;
    }));
    EXPECT_FALSE(opens([&](StreamHeader& h) { h.metadata.scale = wrong; }));
    EXPECT_FALSE(opens([&](StreamHeader& h) { h.metadata.offset = wrong; }));
    EXPECT_FALSE(opens([&](StreamHeader& h) { h.metadata.spacing_x = wrong; }));
    EXPECT_FALSE(opens([&](StreamHeader& h) { h.metadata.spacing_y = wrong; }));
  }
  EXPECT_FALSE(opens([](StreamHeader& h) { h.geometry->step = 0; }));
  EXPECT_FALSE(opens([](StreamHeader& h) { h.metadata.scale = 0; }));
  EXPECT_FALSE(opens([](StreamHeader& h) { h.metadata.spacing_x = -1; }));
}

/// Voids of integers need a value that the type has; without voids any number may be declared.
TEST(Header, VoidsOfIntegersNeedASample) {
  const auto opens = [](uint64_t validity_bytes, double nodata) {
    StreamHeader header = sampleHeader();
    header.geometry->sample = TKS_U8;
    header.layers.validity_bytes = validity_bytes;
    header.layers.has_nodata = 1;
    header.layers.nodata = nodata;
    return readHeader(writeHeader(header)).ok();
  };
  EXPECT_TRUE(opens(9, 0) && opens(9, 255) && opens(0, -9999) && opens(0, 0.5));
  EXPECT_FALSE(opens(9, -1) || opens(9, 256) || opens(9, 0.5) || opens(9, 1e300));
}

TEST(Header, DrawnTexturesHaveNeitherRegionsNorWeights) {
  const auto opens = [](uint8_t region_log2, uint8_t levels) {
    StreamHeader header = sampleHeader();
    header.texture->planes = kDrawnPlanes;
    header.texture->regions.side_log2 = region_log2;
    header.texture->weights.levels = levels;
    header.index.clear();
    return readHeader(writeHeader(header)).ok();
  };
  EXPECT_TRUE(opens(0, 0));
  EXPECT_FALSE(opens(4, 0));
  EXPECT_FALSE(opens(0, 1));
}

/// Two packets of heights around a whole one of a texture.
struct ThreePackets {
  std::vector<uint8_t> geometry, texture, payload;

  ThreePackets() : geometry(700), texture(300) {
    for (size_t i = 0; i < geometry.size(); ++i) geometry[i] = static_cast<uint8_t>(i * 7);
    for (size_t i = 0; i < texture.size(); ++i) texture[i] = static_cast<uint8_t>(i * 11);
    const std::vector<Packet> packets = {{Component::kGeometry, false, 90, 0, 40, {}},
                                         {Component::kTexture, true, 80, 0, 300, {}},
                                         {Component::kGeometry, false, 70, 40, 700, {}}};
    payload = multiplex(packets, counts(), {Codewords{geometry}, Codewords{texture}}, UINT64_MAX);
  }
  static TrackCounts counts() {
    TrackCounts counts;
    counts.add(Component::kGeometry, {1, false});
    counts.add(Component::kTexture, {1, false});
    return counts;
  }
};

TEST(Packets, DemultiplexGoesOnWhereItEnded) {
  const std::vector<uint8_t> payload = ThreePackets().payload;
  for (const size_t stride : {1, 2, 37, 500}) {
    Demultiplexed grown;
    grown.counts = ThreePackets::counts();
    for (size_t end = 0; end < payload.size();) {
      end = std::min(end + stride, payload.size());
      const auto there = std::span(payload).first(end);
      const auto before = countPackets(there, 0, grown.counts, grown.end);
      ASSERT_TRUE(before.ok());
      const size_t begun = grown.heads.size();
      ASSERT_TRUE(demultiplexMore(there, 0, grown).ok());
      EXPECT_EQ(grown.heads.size(), begun + before->packets);
      const Result<Demultiplexed> fresh = demultiplex(there, 0, grown.counts);
      ASSERT_TRUE(fresh.ok());
      EXPECT_EQ(grown.heads, fresh->heads) << end;
      EXPECT_EQ(grown.quality, fresh->quality) << end;
      EXPECT_EQ(grown.codewords, fresh->codewords) << end;
    }
  }
}

TEST(Packets, DemultiplexUndoesMultiplexAtEveryCut) {
  const auto [geometry, texture, payload] = ThreePackets();
  for (size_t cut = 0; cut <= payload.size(); ++cut) {
    Result<Demultiplexed> out =
        demultiplex(std::span(payload).first(cut), 0, ThreePackets::counts());
    ASSERT_TRUE(out.ok());
    const auto& g = out->codewords[0][0];
    const auto& t = out->codewords[1][0];
    EXPECT_TRUE(std::equal(g.begin(), g.end(), geometry.begin()));
    EXPECT_TRUE(t.empty() || t == texture);  // a whole packet comes whole or not at all
  }
  TrackCounts alone;
  alone.add(Component::kGeometry, {1, false});
  EXPECT_FALSE(demultiplex(payload, 0, alone).ok());
}

/// A third component, and one whose packets name regions: those that are known get the same bytes.
TEST(Packets, OfOtherComponentsArePassedOver) {
  TrackCounts counts;
  counts.add(Component::kOther, {0, true});
  counts.add(Component::kTexture, {1, false});
  counts.add(Component::kGeometry, {1, false});
  FieldWriter payload;
  const auto put = [&](uint8_t number, uint32_t track, const std::vector<uint8_t>& bytes) {
    const std::vector<uint8_t> head = headBytes({bytes.size(), track, 9, false, number}, counts);
    payload.bytes.insert(payload.bytes.end(), head.begin(), head.end());
    payload.bytes.insert(payload.bytes.end(), bytes.begin(), bytes.end());
  };
  put(0, 70000, std::vector<uint8_t>(300, 1));
  put(2, 0, {2, 3});
  put(0, 5, {4});
  put(1, 0, {5, 6, 7});
  put(2, 0, {8});
  const Result<Demultiplexed> out = demultiplex(payload.bytes, 0, counts);
  ASSERT_TRUE(out.ok());
  EXPECT_EQ(out->heads.size(), 5u);
  EXPECT_EQ(out->codewords[0].at(0), (std::vector<uint8_t>{2, 3, 8}));
  EXPECT_EQ(out->codewords[1].at(0), (std::vector<uint8_t>{5, 6, 7}));
  EXPECT_TRUE(out->codewords[2].empty());
  put(3, 0, {1});
  EXPECT_FALSE(demultiplex(payload.bytes, 0, counts).ok());
}

TEST(Packets, QualityRoundsUp) {
  EXPECT_EQ(rmseOf(qualityOf(0)), 0);
  for (double rmse = 0.01; rmse < 1e6; rmse *= 1.37) {
    EXPECT_GE(rmseOf(qualityOf(rmse)), rmse * 0.999999);
    EXPECT_LE(rmseOf(qualityOf(rmse)), rmse * 1.0906);
  }
}

}  // namespace
}  // namespace tetrakis

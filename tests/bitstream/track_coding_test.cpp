// SPDX-License-Identifier: Apache-2.0
// The coding of tracks: what every prefix tells about a coefficient, and where it is reconstructed.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "bitstream/track/reconstruction.hpp"
#include "bitstream/track/track_decoder.hpp"
#include "bitstream/track/track_encoder.hpp"
#include "conformance/samples/terrain_samples.hpp"
#include "tests/support/band_shapes.hpp"
#include "tests/support/random_planes.hpp"

namespace tetrakis::test {
namespace {

/// Bands of one track with parents and a second colour plane, filled with values of a peaked
/// distribution whose scale rises from fine to coarse.
struct Material {
  std::vector<BandPlan> plan;
  std::vector<BandSource> sources;
};

EncodedTrack encodeTrack(const std::vector<BandPlan>& plan,
                         const std::vector<BandSource>& sources) {
  return std::move(encodeTracks({{plan, sources}}, {}).front());
}

Material material(uint32_t seed, const BandShape& coarse, int scale_bits) {
  Random random(seed);
  Material m;
  for (int plane = 0; plane < 2; ++plane) {
    const auto first = static_cast<int>(m.plan.size());
    for (const Orientation orientation : {Orientation::kLL, Orientation::kHL, Orientation::kLH,
                                          Orientation::kHH, Orientation::kHL}) {
      const auto i = static_cast<int>(m.plan.size()) - first;
      BandPlan band;
      band.shape = i < 4 ? coarse : BandShape{2 * coarse.rows, 2 * coarse.columns - 1};
      band.orientation = orientation;
      band.log_norm = i < 4 ? 20 - 8 * plane : 4;
      band.models = static_cast<uint32_t>(i / 4 + 2 * plane);
      if (i == 4) band.parent = first + 1;
      if (i == 1) band.siblings = {first + 2, first + 3};
      if (i == 2 || i == 3) band.siblings = {first + 1, first + 5 - i};
      if (plane > 0) band.companion = i;
      m.plan.push_back(band);
      BandSource source;
      source.values.assign(band.shape.cells(), 0);
      source.weight = std::exp2(band.log_norm / 8.0);
      for (uint32_t row = 0; row < band.shape.rows; ++row) {
        for (uint32_t column = 0; column < band.shape.columns; ++column) {
          const int bits = static_cast<int>(random() % static_cast<uint32_t>(scale_bits + 1));
          const auto magnitude = static_cast<int32_t>(random() & ((uint32_t{1} << bits) - 1));
          const bool quiet = (row / 8 + column / 32) % 3 == 1 && i != 0;
          source.values[band.shape.cell(row, column)] = quiet               ? 0
                                                        : random() % 2 == 0 ? magnitude
                                                                            : -magnitude;
        }
      }
      m.sources.push_back(std::move(source));
    }
  }
  return m;
}

/// The same coefficients, each in one of four tiers.
Material inTiers(Material m, uint32_t seed) {
  Random random(seed);
  for (BandPlan& band : m.plan) {
    const BandShape& shape = band.shape;
    BandTiers tiers;
    tiers.members = ZeroedArray<uint32_t>(kPriorities * shape.wordCells());
    for (uint32_t row = 0; row < shape.rows; ++row) {
      for (uint32_t column = 0; column < shape.columns; ++column) {
        const size_t word = shape.word(row, column / 32);
        tiers.members[random() % 4 * shape.wordCells() + word] |= uint32_t{1} << column % 32;
      }
    }
    tiers.markBlocks(shape);
    band.tiers = std::make_shared<const BandTiers>(std::move(tiers));
  }
  return m;
}

/// What is known of a coefficient, with its sign: 0 in a band without cells.
int64_t knownOf(const Band& band, size_t cell) {
  return band.hasCells() ? int64_t{band.sign[cell]} * band.magnitude[cell] : 0;
}

/// What the decoder believes is true: known bits, signs, and that the rest is below 2^plane.
/// places: binary ones that estimates are also read with.
void expectTruth(const TrackState& state, size_t index, const BandSource& source, int places) {
  const Band& band = state.bands[index];
  const BandShape& shape = band.shape;
  std::vector<int32_t> whole(shape.columns), fine(shape.columns);
  for (uint32_t row = 0; row < shape.rows; ++row) {
    if (band.hasCells()) {
      Reconstruction(band, 0).row(row, whole.data());
      Reconstruction(band, places).row(row, fine.data());
    }
    for (uint32_t column = 0; column < shape.columns; ++column) {
      const size_t cell = shape.cell(row, column), word = shape.word(row, column / 32);
      const int32_t truth = source.values[cell];
      const bool visited = (band.visited[word] >> column % 32) & 1;
      const int plane = band.tier_states[0].plane + (visited ? 0 : 1);
      const int64_t known = knownOf(band, cell);
      const int64_t low = std::abs(known), high = low + (int64_t{1} << plane);
      const int64_t magnitude = std::abs(int64_t{truth});
      ASSERT_TRUE(magnitude >= low && magnitude < high) << truth << " below plane " << plane;
      ASSERT_EQ(low != 0, ((band.significant[word] >> column % 32) & 1) != 0);
      ASSERT_TRUE(low == 0 || (known < 0) == (truth < 0));
      const int64_t estimate = std::abs(int64_t{whole[column]});
      ASSERT_TRUE(estimate >= low && estimate < high) << "an estimate outside of what is known";
      ASSERT_TRUE(low == 0 || (whole[column] < 0) == (truth < 0));
      ASSERT_EQ(std::abs(int64_t{fine[column]}) >> places, estimate) << "places only refine";
      ASSERT_TRUE(!state.complete || fine[column] == truth * (1 << places));
      ASSERT_TRUE(!state.complete || whole[column] == truth);
    }
  }
}

TEST(TrackCoding, EveryPrefixTellsTheTruth) {
  uint32_t seed = 0;
  for (const BandShape& coarse : {BandShape{1, 1}, {5, 5}, {9, 40}, {20, 17}, {3, 70}}) {
    for (const int scale_bits : {0, 1, 5, 29}) {
      const Material m = material(++seed, coarse, scale_bits);
      const EncodedTrack track = encodeTrack(m.plan, m.sources);
      ASSERT_TRUE(track.complete);
      const int places = track.planes < 27 ? 4 : 0;
      const size_t size = track.codeword.size(), stride = 1 + size / 25;
      for (size_t bytes = 0; bytes <= size; bytes += bytes + stride > size ? 1 : stride) {
        const TrackState state =
            decodeTrack(m.plan, track.planes, std::span(track.codeword).first(bytes));
        ASSERT_TRUE(bytes < size || state.complete);
        for (size_t i = 0; i < m.plan.size(); ++i) {
          ASSERT_NO_FATAL_FAILURE(expectTruth(state, i, m.sources[i], places));
        }
      }
    }
  }
}

template <class T>
bool equal(const ZeroedArray<T>& a, const ZeroedArray<T>& b) {
  return std::equal(a.data(), a.data() + a.size(), b.data(), b.data() + b.size());
}

/// Whether the significant coefficients are as many as the tiers say.
bool areCounted(const Band& band) {
  const auto found = [](int8_t sign) { return sign != 0; };
  uint32_t counted = 0;
  for (const TierState& tier : band.tier_states) counted += tier.significant_count;
  return std::count_if(band.sign.data(), band.sign.data() + band.sign.size(), found) == counted;
}

bool sameTiers(const Band& a, const Band& b) {
  bool same = areCounted(a) && areCounted(b);
  for (size_t tier = 0; tier < kPriorities; ++tier) {
    same &= a.tier_states[tier].plane == b.tier_states[tier].plane &&
            a.tier_states[tier].significant_count == b.tier_states[tier].significant_count;
  }
  return same;
}

/// What is known of the coefficients and where, not what the next bit-plane starts from.
bool sameKnowledge(const TrackState& a, const TrackState& b) {
  bool same = a.complete == b.complete && a.bands.size() == b.bands.size();
  for (size_t i = 0; same && i < a.bands.size(); ++i) {
    same = sameTiers(a.bands[i], b.bands[i]) && equal(a.bands[i].sign, b.bands[i].sign) &&
           equal(a.bands[i].magnitude, b.bands[i].magnitude) &&
           equal(a.bands[i].visited, b.bands[i].visited);
  }
  return same;
}

/// A growing track knows what the prefix alone tells, whatever was asked before.
TEST(TrackCoding, GrowingTracksForgetNothingAndInventNothing) {
  const Material one_tier = material(3, {9, 40}, 5);
  for (const Material& m : {one_tier, inTiers(one_tier, 4)}) {
    const EncodedTrack track = encodeTrack(m.plan, m.sources);
    for (const size_t stride : {1u, 5u, 50u}) {
      GrowingTrack growing(m.plan, track.planes);
      for (size_t bytes = 0; bytes <= track.codeword.size(); bytes += stride) {
        const auto prefix = std::span(track.codeword).first(bytes);
        const TrackState& grown = growing.decode(prefix);
        ASSERT_TRUE(sameKnowledge(grown, decodeTrack(m.plan, track.planes, prefix)))
            << bytes << " of " << track.codeword.size() << " bytes, steps of " << stride;
      }
    }
  }
}

/// Not even if a prefix ends in a pass that takes much more than all passes before it.
TEST(TrackCoding, GrowingTracksEndInLongPasses) {
  const Material m = material(7, {60, 90}, 3);
  const EncodedTrack track = encodeTrack(m.plan, m.sources);
  ASSERT_GT(track.codeword.size(), 8000u);
  for (const size_t first : {300u, 1500u, 4000u}) {
    GrowingTrack growing(m.plan, track.planes);
    for (size_t bytes = first; bytes <= track.codeword.size(); bytes += bytes / 2) {
      const auto prefix = std::span(track.codeword).first(bytes);
      ASSERT_TRUE(sameKnowledge(growing.decode(prefix), decodeTrack(m.plan, track.planes, prefix)))
          << bytes << " of " << track.codeword.size() << " bytes";
    }
  }
}

/// Bands take bytes for each coefficient from the first significant one on.
TEST(TrackCoding, BandsWithoutSignificanceHaveNoCells) {
  const Material m = material(4, {40, 70}, 6);
  const EncodedTrack track = encodeTrack(m.plan, m.sources);
  size_t without = 0;
  for (size_t bytes = 0; bytes <= track.codeword.size(); bytes += 1 + bytes / 2) {
    const TrackState state =
        decodeTrack(m.plan, track.planes, std::span(track.codeword).first(bytes));
    for (const Band& band : state.bands) {
      ASSERT_TRUE(band.hasCells() || band.tier_states[0].significant_count == 0);
      ASSERT_EQ(band.hasCells(), band.nonzero());
      without += !band.hasCells();
    }
  }
  EXPECT_GT(without, 0u);
}

/// All known bits of a are known in b.
bool isWithin(const TrackState& a, const TrackState& b) {
  bool within = true;
  for (size_t i = 0; i < a.bands.size(); ++i)
    for (size_t k = 0; k < a.bands[i].magnitude.size(); ++k)
      within &= (a.bands[i].magnitude[k] & ~b.bands[i].magnitude[k]) == 0;
  return within;
}

/// Whole passes know all that a prefix tells, but for the bytes that a decoder reads ahead, and end
/// with everything.
TEST(TrackCoding, WholePassesKnowWhatPrefixesTell) {
  constexpr size_t kAhead = 4;
  const Material m = material(3, {9, 40}, 5);
  const EncodedTrack track = encodeTrack(m.plan, m.sources);
  const TrackState all = decodeTrack(m.plan, track.planes, track.codeword);
  for (const size_t stride : {1u, 7u, 50u}) {
    GrowingTrack growing(m.plan, track.planes);
    for (size_t bytes = kAhead; bytes <= track.codeword.size(); bytes += stride) {
      const auto prefix = std::span(track.codeword).first(bytes - kAhead);
      const TrackState& known = growing.decodePasses(track.codeword, bytes);
      ASSERT_TRUE(isWithin(decodeTrack(m.plan, track.planes, prefix), known)) << bytes;
      ASSERT_TRUE(isWithin(known, all)) << bytes;
    }
    const TrackState& last = growing.decodePasses(track.codeword, UINT64_MAX);
    EXPECT_TRUE(last.complete && sameKnowledge(last, all));
  }
}

/// Coefficients of 30 bits, the most there may be, all of them.
TEST(TrackCoding, TheLargestMagnitudesComeBack) {
  Material m = material(9, {6, 9}, 5);
  for (size_t i = 0; i < m.plan.size(); ++i) {
    const BandShape& shape = m.plan[i].shape;
    for (uint32_t row = 0; row < shape.rows; ++row) {
      for (uint32_t column = 0; column < shape.columns; ++column) {
        int32_t& value = m.sources[i].values[shape.cell(row, column)];
        value = value < 0 ? -((1 << 30) - 1) : (1 << 30) - 1;
      }
    }
  }
  const EncodedTrack track = encodeTrack(m.plan, m.sources);
  ASSERT_EQ(track.planes, kMaxPlanes);
  const TrackState state = decodeTrack(m.plan, track.planes, track.codeword);
  ASSERT_TRUE(state.complete);
  for (size_t i = 0; i < m.plan.size(); ++i) {
    ASSERT_NO_FATAL_FAILURE(expectTruth(state, i, m.sources[i], 0));
  }
}

TEST(TrackCoding, ZerosCostNothing) {
  Material m = material(10, {20, 40}, 5);
  for (BandSource& source : m.sources) std::fill(source.values.begin(), source.values.end(), 0);
  const EncodedTrack track = encodeTrack(m.plan, m.sources);
  EXPECT_EQ(track.planes, 0);
  EXPECT_LE(track.codeword.size(), 1u);
  const TrackState state = decodeTrack(m.plan, 0, {});
  EXPECT_TRUE(state.complete);
  std::vector<int32_t> values(79, 1);
  for (const Band& band : state.bands) {
    Reconstruction(band, 4).row(0, values.data());
    EXPECT_EQ(std::count(values.begin(), values.begin() + band.shape.columns, 0),
              static_cast<ptrdiff_t>(band.shape.columns));
  }
}

/// Takes coefficients away from the bands: single ones, whole blocks, whole bands.
void takeAway(Random& random, Material& m) {
  for (size_t i = 0; i < m.plan.size(); ++i) {
    BandPlan& band = m.plan[i];
    band.absent.assign(band.shape.wordCells(), 0);
    const uint32_t kind = random() % 4;
    for (uint32_t row = 0; row < band.shape.rows; ++row) {
      for (uint32_t column = 0; column < band.shape.columns; ++column) {
        const bool block = samples::hash(row / 8, column / 32, kind) % 2 == 0;
        const bool gone = kind == 0   ? random() % 4 == 0
                          : kind == 1 ? block
                          : kind == 2 ? block || random() % 2 == 0
                                      : true;
        if (!gone) continue;
        band.absent[band.shape.word(row, column / 32)] |= uint32_t{1} << column % 32;
        m.sources[i].values[band.shape.cell(row, column)] = 0;
      }
    }
  }
}

TEST(TrackCoding, EveryPrefixIsTrueWhereCoefficientsAreAbsent) {
  Random random(13);
  for (int trial = 0; trial < 12; ++trial) {
    const BandShape coarse = kBandShapes[random() % std::size(kBandShapes)];
    Material m = material(static_cast<uint32_t>(random()), coarse, 1 + trial);
    takeAway(random, m);
    const EncodedTrack track = encodeTrack(m.plan, m.sources);
    const size_t stride = std::max<size_t>(1, track.codeword.size() / 20);
    for (size_t n = 0; n <= track.codeword.size(); n += stride) {
      const auto prefix = std::span(track.codeword).first(n);
      const TrackState state = decodeTrack(m.plan, track.planes, prefix);
      for (size_t i = 0; i < m.plan.size(); ++i)
        ASSERT_NO_FATAL_FAILURE(expectTruth(state, i, m.sources[i], 3));
    }
    const TrackState whole = decodeTrack(m.plan, track.planes, track.codeword);
    EXPECT_TRUE(whole.complete);
  }
}

/// What any bytes say, they say nothing of a coefficient that is absent.
TEST(TrackCoding, AbsentCoefficientsStayZero) {
  Random random(14);
  Material m = material(15, {20, 70}, 8);
  takeAway(random, m);
  std::vector<uint8_t> noise(3000);
  for (uint8_t& byte : noise) byte = static_cast<uint8_t>(random());
  const TrackState state = decodeTrack(m.plan, 12, noise);
  size_t significant = 0;
  for (size_t i = 0; i < m.plan.size(); ++i) {
    for (size_t word = 0; word < m.plan[i].absent.size(); ++word) {
      ASSERT_EQ(state.bands[i].significant[word] & m.plan[i].absent[word], 0u);
      significant += static_cast<size_t>(std::popcount(state.bands[i].significant[word]));
    }
  }
  EXPECT_GT(significant, 100u);
}

/// A band in which one coefficient exists takes that one's bits alone, however large it is.
TEST(TrackCoding, AbsentCoefficientsCostNothing) {
  for (const uint32_t side : {16u, 256u, 512u}) {
    BandPlan band;
    band.shape = {side, side};
    band.absent.assign(band.shape.wordCells(), ~uint32_t{0});
    band.absent[band.shape.word(side / 2, 0)] ^= 4;
    BandSource source;
    source.values.assign(band.shape.cells(), 0);
    source.values[band.shape.cell(side / 2, 2)] = 1000;
    const EncodedTrack track = encodeTrack({band}, {source});
    ASSERT_NO_FATAL_FAILURE(
        expectTruth(decodeTrack({band}, track.planes, track.codeword), 0, source, 4));
    EXPECT_LE(track.codeword.size(), 4u) << side;
  }
}

/// One coefficient in a large empty band costs its place, sign and bits: quiet blocks and groups
/// are passed over.
TEST(TrackCoding, LoneCoefficientsAreCheap) {
  Random random(11);
  size_t bytes = 0;
  for (int trial = 0; trial < 20; ++trial) {
    BandPlan band;
    band.shape = {256, 256};
    band.orientation = Orientation::kHH;
    BandSource source;
    source.values.assign(band.shape.cells(), 0);
    source.values[band.shape.cell(random() % 256, random() % 256)] =
        static_cast<int32_t>(1 + random() % 1000);
    const EncodedTrack track = encodeTrack({band}, {source});
    const TrackState state = decodeTrack({band}, track.planes, track.codeword);
    ASSERT_NO_FATAL_FAILURE(expectTruth(state, 0, source, 4));
    bytes += track.codeword.size();
  }
  EXPECT_LT(bytes, 20 * 64u);
}

/// Estimates serve: after half of the bytes they are better than the low ends of the intervals.
TEST(Reconstruction, EstimatesReduceTheError) {
  const Material m = material(12, {30, 40}, 9);
  const EncodedTrack track = encodeTrack(m.plan, m.sources);
  for (const size_t part : {3, 4, 5}) {
    const TrackState state = decodeTrack(
        m.plan, track.planes, std::span(track.codeword).first(track.codeword.size() * part / 8));
    double estimated = 0, low_ends = 0;
    for (size_t i = 0; i < m.plan.size(); ++i) {
      const Band& band = state.bands[i];
      std::vector<int32_t> values(band.shape.columns);
      for (uint32_t row = 0; row < band.shape.rows; ++row) {
        Reconstruction(band, 0).row(row, values.data());
        for (uint32_t column = 0; column < band.shape.columns; ++column) {
          const size_t cell = band.shape.cell(row, column);
          const double truth = m.sources[i].values[cell];
          const auto low = static_cast<double>(knownOf(band, cell));
          estimated += std::pow(values[column] - truth, 2);
          low_ends += std::pow(low - truth, 2);
        }
      }
    }
    EXPECT_LT(estimated, 0.7 * low_ends);
  }
}

}  // namespace
}  // namespace tetrakis::test

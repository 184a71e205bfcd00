// SPDX-License-Identifier: Apache-2.0
// Regions and windows of tracks: every coefficient lies in one region, a window holds what the
// whole plane holds there whatever the bytes are, and nothing depends on the threads.
#include <gtest/gtest.h>

#include <atomic>
#include <new>
#include <set>

#include "base/parallel.hpp"
#include "codec/geometry/heights_decoder.hpp"
#include "codec/geometry/heights_encoder.hpp"
#include "conformance/samples/void_masks.hpp"
#include "ratecontrol/curves/component_curve.hpp"
#include "tests/support/random_planes.hpp"
#include "tests/support/wavelet_cases.hpp"
#include "texture_wavelet/texture_decoder.hpp"
#include "texture_wavelet/texture_encoder.hpp"

namespace tetrakis::test {
namespace {

constexpr Size kSizes[] = {{2, 2},   {17, 23},  {24, 24}, {40, 8},   {40, 3}, {3, 100},
                           {65, 33}, {100, 71}, {90, 90}, {130, 40}, {1, 90}, {200, 17}};

/// Samples lie in the region, levels are those it holds, and nothing is missing or held twice.
TEST(Regions, ShareOutAllCoefficients) {
  for (const Size& size : kSizes) {
    const PlaneLayout layout(uniform(FilterId::kShort), Pyramid(size.extent()));
    for (const int log2 : {0, 4, 5, 6, 20}) {
      const std::vector<Region> regions = regionsOf(size.width, size.height, log2);
      ASSERT_EQ(regions.size(), regionCount(size.width, size.height, log2));
      std::multiset<std::pair<size_t, size_t>> seen;
      for (const Region& region : regions) {
        for (const BandPart& part : layout.parts(region)) {
          const Subband& band = layout.subbands()[part.subband];
          ASSERT_TRUE(band.orientation == Orientation::kLL ? region.isBase()
                                                           : region.holds(band.level));
          for (uint32_t y = 0; y < part.rows; ++y) {
            for (uint32_t x = 0; x < part.columns; ++x) {
              const uint32_t column = part.column + x, row = part.row + y;
              ASSERT_LT(column, band.width);
              ASSERT_LT(row, band.height);
              ASSERT_TRUE((column << band.splits_x) >= region.x0 &&
                          (column << band.splits_x) < region.x1);
              seen.insert({part.subband, size_t{row} * band.width + column});
            }
          }
        }
      }
      ASSERT_EQ(seen.size(), size.count()) << size << ", " << log2;
      for (const auto& coefficient : seen) ASSERT_EQ(seen.count(coefficient), 1u);
    }
  }
}

/// visit: layout, parts and plan of every region, of planes of all sizes.
template <class Visit>
void forEachRegion(const Visit& visit) {
  for (const Size& size : kSizes) {
    const PlaneLayout layout(uniform(FilterId::kShort), Pyramid(size.extent()));
    for (const Region& region : regionsOf(size.width, size.height, 4)) {
      const std::vector<BandPart> parts = layout.parts(region);
      visit(layout, parts, layout.plan(parts));
    }
  }
}

/// Children lie below their parents in the same region.
TEST(Regions, ParentsCoverTheirChildren) {
  forEachRegion([](const PlaneLayout& layout, const auto& parts, const auto& plan) {
    for (size_t i = 0; i < plan.size(); ++i) {
      if (plan[i].parent == BandPlan::kNone || plan[i].shape.empty()) continue;
      const BandPart& parent = parts[static_cast<size_t>(plan[i].parent)];
      const Subband &child_band = layout.subbands()[parts[i].subband],
                    &parent_band = layout.subbands()[parent.subband];
      ASSERT_EQ(parent_band.level, child_band.level + 1);
      ASSERT_EQ(parent_band.orientation, child_band.orientation);
      const auto halves = [](uint32_t child, uint32_t of, int more) { return child >> more == of; };
      ASSERT_TRUE(
          halves(parts[i].column, parent.column, parent_band.splits_x - child_band.splits_x));
      ASSERT_TRUE(halves(parts[i].row, parent.row, parent_band.splits_y - child_band.splits_y));
    }
  });
}

/// Siblings start at the same place as each other and differ by one row or column at most.
TEST(Regions, SiblingsHaveThePlacesOfEachOther) {
  forEachRegion([](const PlaneLayout& layout, const auto& parts, const auto& plan) {
    for (size_t i = 0; i < plan.size(); ++i) {
      for (const int index : plan[i].siblings) {
        if (index == BandPlan::kNone || plan[i].shape.empty()) continue;
        const BandPart& sibling = parts[static_cast<size_t>(index)];
        ASSERT_EQ(layout.subbands()[sibling.subband].level,
                  layout.subbands()[parts[i].subband].level);
        ASSERT_EQ(sibling.column, parts[i].column);
        ASSERT_EQ(sibling.row, parts[i].row);
        ASSERT_LE(parts[i].columns, sibling.columns + 1);
        ASSERT_LE(parts[i].rows, sibling.rows + 1);
      }
    }
  });
}

/// Tracks of a header that may say anything.
struct Coded {
  GeometryHeader header;
  std::vector<std::vector<uint8_t>> codewords;

  Codewords spans() const { return {codewords.begin(), codewords.end()}; }
};

Coded encodeInRegions(const PlaneView<const int32_t>& heights, const WaveletSpec& spec,
                      int fraction_bits, int region_log2) {
  Coded coded;
  coded.header.width = heights.width;
  coded.header.height = heights.height;
  for (size_t i = 0; i < spec.filters.size(); ++i)
    coded.header.wavelet.filters[i] = static_cast<uint8_t>(spec.filters[i]);
  coded.header.wavelet.fraction_bits = static_cast<uint8_t>(fraction_bits);
  coded.header.wavelet.bits = static_cast<uint8_t>(12 + fraction_bits);
  coded.header.wavelet.first_doubled =
      static_cast<uint8_t>(fraction_bits > 0 ? 0 : spec.first_doubled);
  coded.header.regions.side_log2 = static_cast<uint8_t>(region_log2);
  const std::vector<EncodedTrack> tracks =
      encodeCoefficients(heights, coded.header.wavelet, {UINT64_MAX, region_log2, 2});
  coded.header.planes = static_cast<uint8_t>(tracks.front().planes);
  for (const EncodedTrack& track : tracks) {
    coded.codewords.push_back(track.codeword);
    coded.header.wavelet.rounded_bytes += fraction_bits > 0 ? 0 : track.codeword.size();
  }
  return coded;
}

Window randomWindow(Random& random, const Size& size) {
  const auto x = static_cast<uint32_t>(random() % size.width),
             y = static_cast<uint32_t>(random() % size.height);
  return {x, y, 1 + static_cast<uint32_t>(random() % (size.width - x)),
          1 + static_cast<uint32_t>(random() % (size.height - y))};
}

void expectCodedWindows(Random& random, const Coded& coded, const Size& size,
                        const std::vector<uint8_t>& valid) {
  const KnownSamples known{sharedBits(valid, size.extent())};
  const DecodedGeometry whole = decodeCoefficients(coded.header, coded.spans(), known);
  const DecodedGeometry again = decodeCoefficients(coded.header, coded.spans(), known, {}, {5});
  ASSERT_EQ(whole.heights, again.heights);
  ASSERT_EQ(whole.significant, again.significant);
  ASSERT_EQ(whole.quiet_levels, again.quiet_levels);
  for (int i = 0; i < 3; ++i) {
    const Window window =
        i == 0 ? Window{0, 0, size.width, size.height} : randomWindow(random, size);
    const auto threads = static_cast<uint32_t>(1 + i % 3);
    const DecodedGeometry part =
        decodeCoefficients(coded.header, coded.spans(), known, {0, window}, {threads});
    ASSERT_EQ(part.fraction_bits, whole.fraction_bits);
    ASSERT_EQ(part.heights,
              slice(std::span<const int32_t>(whole.heights), size.extent(), {0, window}))
        << size << ": " << window.x << " " << window.y << " " << window.width << " "
        << window.height;
  }
}

/// Every wavelet on every third size.
TEST(Windows, HoldWhatThePlaneHoldsThere) {
  Random random(7);
  size_t turn = 0;
  for (const Size& size : kSizes) {
    const Plane heights = randomPlane(random, size.count(), -2000, 2000);
    ++turn;
    for (const WaveletSpec& spec : allSpecs()) {
      if (turn++ % 3 > 0) continue;
      const int fraction_bits = spec.whole ? 0 : 3, log2 = static_cast<int>(random() % 3);
      const bool voids = random() % 2 == 0;
      const auto shape = samples::kVoidShapes[random() % std::size(samples::kVoidShapes)];
      const auto valid =
          voids ? samples::validity(shape, size.width, size.height) : std::vector<uint8_t>();
      Coded coded = encodeInRegions({heights, size.extent(), valid}, spec, fraction_bits,
                                    log2 == 0 ? 0 : 3 + log2);
      expectCodedWindows(random, coded, size, valid);
      for (std::vector<uint8_t>& codeword : coded.codewords)
        codeword.resize(random() % (codeword.size() + 1));
      expectCodedWindows(random, coded, size, valid);
      if (HasFatalFailure()) return;
    }
  }
}

/// Coefficients of 30 bit-planes make sums overflow: they do so alike.
TEST(Windows, HoldForAnyBytes) {
  Random random(8);
  for (const Size& size : {Size{17, 23}, Size{65, 33}, Size{100, 71}}) {
    for (const WaveletSpec& spec : allSpecs()) {
      for (const int log2 : {0, 4}) {
        const auto valid = samples::validity(samples::VoidShape::kSpeckle, size.width, size.height);
        const Plane zeros(size.count(), 0);
        Coded coded = encodeInRegions({zeros, size.extent()}, spec, 0, log2);
        coded.header.planes = 30;
        coded.header.wavelet.bits = static_cast<uint8_t>(random() % 33);
        for (std::vector<uint8_t>& codeword : coded.codewords) {
          codeword.resize(200);
          for (uint8_t& byte : codeword) byte = static_cast<uint8_t>(random() % 3 ? 255 : random());
        }
        expectCodedWindows(random, coded, size, random() % 2 ? valid : std::vector<uint8_t>());
        if (HasFatalFailure()) return;
      }
    }
  }
}

TEST(Windows, OfTextures) {
  Random random(9);
  for (const Size& size : {Size{1, 1}, Size{33, 50}, Size{90, 65}}) {
    for (uint32_t channels = 1; channels <= 4; ++channels) {
      Texels texels{size.width, size.height, channels, 8, {}};
      for (size_t i = 0; i < size.count() * channels; ++i)
        texels.samples.push_back(static_cast<uint16_t>(1 + (i / 50 + random() % 40) % 255));
      for (const Purpose purpose : {Purpose::kLossless, Purpose::kLossy}) {
        const EncodedTexture coded = encodeTexture(texels, purpose, {UINT64_MAX, 4, 3});
        Codewords codewords;
        for (const EncodedTrack& track : coded.tracks) codewords.push_back(track.codeword);
        EXPECT_EQ(decodeTexture(coded.header, codewords, {}, {2}).samples, texels.samples);
        for (auto& codeword : codewords)
          codeword = codeword.first(random() % 4 ? random() % (codeword.size() + 1) : 0);
        const Texels whole = decodeTexture(coded.header, codewords);
        for (int i = 0; i < 4; ++i) {
          const Window w = randomWindow(random, size);
          const auto threads = static_cast<uint32_t>(1 + i);
          const Texels part = decodeTexture(coded.header, codewords, {0, w}, {threads});
          const Window samples{w.x * channels, w.y, w.width * channels, w.height};
          ASSERT_EQ(part.samples, slice(std::span<const uint16_t>(whole.samples),
                                        {size.width * channels, size.height}, {0, samples}));
        }
      }
    }
  }
}

TEST(Tracks, AreTheSameForAllThreadsAndStopTogether) {
  Random random(10);
  const Size size{150, 130};
  const Plane heights = randomPlane(random, size.count(), -300, 300);
  const WaveletHeader wavelet{{1, 1, 1}, 0, 10};
  for (const uint64_t limit : {UINT64_MAX, uint64_t{6000}}) {
    const auto one = encodeCoefficients({heights, size.extent()}, wavelet, {limit, 5, 1});
    uint64_t bytes = 0;
    for (const EncodedTrack& track : one) bytes += track.codeword.size();
    EXPECT_EQ(one.front().complete, limit == UINT64_MAX);
    EXPECT_GT(bytes, 6000u);
    if (limit == 6000) {
      EXPECT_LT(bytes, 20000u);
    }
    for (const uint32_t threads : {2u, 5u}) {
      const auto many = encodeCoefficients({heights, size.extent()}, wavelet, {limit, 5, threads});
      ASSERT_EQ(one.size(), many.size());
      for (size_t i = 0; i < one.size(); ++i) EXPECT_EQ(one[i].codeword, many[i].codeword);
    }
  }
}

/// Every codeword in order and to its end, steep packets first, the distortion of all tracks
/// falling to what they leave.
TEST(Tracks, AreOrderedBySlope) {
  Random random(11);
  const Size size{150, 130};
  const Plane heights = randomPlane(random, size.count(), -300, 300);
  const auto tracks =
      encodeCoefficients({heights, size.extent()}, {{1, 1, 1}, 0, 10}, {UINT64_MAX, 5, 1});
  const OrderedTracks order = orderTracks({Component::kGeometry, tracks}, TrackOrder::kSlopes);
  std::vector<uint64_t> sent(tracks.size());
  ASSERT_EQ(order.points.size(), order.packets.size() + 1);
  double before = 1e300;
  size_t begin = 0;  // of packets of one region, which a dip may have parted
  for (size_t i = 0; i < order.packets.size(); ++i) {
    const Packet& packet = order.packets[i];
    ASSERT_EQ(packet.begin, sent[*packet.track]);
    sent[*packet.track] = packet.end;
    if (i + 1 < order.packets.size() && order.packets[i + 1].track == packet.track) continue;
    const RatePoint &a = order.points[begin], &b = order.points[i + 1];
    begin = i + 1;
    const double slope = (a.distortion - b.distortion) / static_cast<double>(b.bytes - a.bytes);
    EXPECT_LE(slope, before * (1 + 1e-6));
    before = slope;
  }
  for (size_t i = 0; i < tracks.size(); ++i) EXPECT_EQ(sent[i], tracks[i].codeword.size());
  EXPECT_EQ(order.points.back().distortion, 0);
}

/// The same bytes of every codeword in order; classes of slopes fall, and tracks rise within one.
TEST(Tracks, KeepTogether) {
  Random random(12);
  const Size size{150, 130};
  const Plane heights = randomPlane(random, size.count(), -300, 300);
  const auto tracks =
      encodeCoefficients({heights, size.extent()}, {{1, 1, 1}, 0, 10}, {UINT64_MAX, 5, 1});
  const CodedTracks coded{Component::kGeometry, tracks};
  const auto changes = [&](TrackOrder by) {
    const OrderedTracks order = orderTracks(coded, by);
    std::vector<uint64_t> sent(tracks.size());
    uint32_t last = 0;
    size_t backwards = 0;
    for (const Packet& packet : order.packets) {
      EXPECT_EQ(packet.begin, sent[*packet.track]);
      sent[*packet.track] = packet.end;
      backwards += *packet.track < last;
      last = *packet.track;
    }
    for (size_t i = 0; i < tracks.size(); ++i) EXPECT_EQ(sent[i], tracks[i].codeword.size());
    EXPECT_EQ(order.points.back().distortion, 0);
    return backwards;
  };
  EXPECT_EQ(changes(TrackOrder::kTracks), 0u);
  EXPECT_LT(changes(TrackOrder::kClasses), 40u);
  EXPECT_GT(changes(TrackOrder::kSlopes), 2 * changes(TrackOrder::kClasses));
}

TEST(ParallelFor, CallsEachOnceAndPassesExceptionsOn) {
  for (const uint32_t threads : {0u, 1u, 2u, 9u}) {
    for (const size_t count : {0u, 1u, 7u, 300u}) {
      std::vector<std::atomic<int>> calls(count);
      parallelFor(threads, count, [&](size_t i) { ++calls[i]; });
      for (const auto& c : calls) EXPECT_EQ(c, 1);
    }
    EXPECT_THROW(parallelFor(threads, 50,
                             [](size_t i) {
                               if (i == 20) throw std::bad_alloc();
                             }),
                 std::bad_alloc);
  }
}

}  // namespace
}  // namespace tetrakis::test

// SPDX-License-Identifier: Apache-2.0
// Layouts of mosaics, and the index in pages that large ones have: whoever reads a window by pages
// has what the whole stream holds there, and no damage of the index changes a sample.
#include <algorithm>
#include <map>
#include <optional>
#include <random>
#include <tuple>

#include "bitstream/stream/page_index.hpp"
#include "tests/support/mosaic_source.hpp"
#include "tests/support/planned_ranges.hpp"

namespace tetrakis::test {
namespace {

constexpr uint32_t kWidth = 1100, kHeight = 980;
constexpr tks_layout kIndexed[] = {TKS_LAYOUT_WINDOWS, TKS_LAYOUT_MIXED};

tks_mosaic_options smallRegions(double max_error = 0) {
  tks_mosaic_options options = mosaicOptions();
  options.regions = 16;
  options.tile = 256;
  options.max_error = max_error;
  options.lossless = max_error == 0 ? 1 : 0;
  return options;
}

/// The parts of heights that are coded once for all layouts.
struct Coded {
  explicit Coded(Source& source, const tks_mosaic_options& options)
      : plan(planOf(source, options)) {
    for (const tks_tile& tile : tilesOf(plan)) EXPECT_EQ(code(plan, tile, source, files), TKS_OK);
  }
  Bytes in(tks_layout layout, uint64_t preview = 0) {
    Bytes stream;
    EXPECT_EQ(merge(plan, files, stream, layout, preview), TKS_OK);
    return stream;
  }

  Bytes plan;
  Files files;
};

/// With corrections behind a cut, if there is an error. Each is made once.
const Bytes& paged(tks_layout layout, double max_error = 0, bool voids = true) {
  static std::map<std::tuple<double, bool>, Coded> coded;
  static std::map<std::tuple<tks_layout, double, bool>, Bytes> made;
  const auto [known, is_new] = made.try_emplace({layout, max_error, voids});
  if (!is_new) return known->second;
  Source source(hills(TKS_I16, kWidth, kHeight));
  if (voids) dig(source, samples::VoidShape::kCoast);
  Coded& parts =
      coded.try_emplace({max_error, voids}, source, smallRegions(max_error)).first->second;
  known->second = parts.in(layout);
  EXPECT_EQ(Stream(Prefix(known->second)).info().index, TKS_INDEX_PAGES);
  return known->second;
}

std::vector<int16_t> windowOf(Stream& stream, const tks_window& window) {
  std::vector<int16_t> samples(size_t{window.width} * window.height);
  EXPECT_EQ(tks_decode_heights_window(stream.get(), &window, samples.data(), 2 * samples.size()),
            TKS_OK)
      << tks_message(stream.get());
  return samples;
}

tks_window somewhere(std::mt19937& random, uint32_t side, uint32_t width, uint32_t height) {
  return {static_cast<uint32_t>(random() % (width - side + 1)),
          static_cast<uint32_t>(random() % (height - side + 1)), side, side};
}

struct Fetched {
  uint64_t bytes = 0;
  int rounds = 0;
};

/// Fetches what is needed, pages first. put: takes a range.
Fetched fetch(Stream& stream, const Bytes& bytes, const tks_window* window) {
  Fetched fetched;
  for (bool pages = true; pages;) {
    tks_ranges ranges = {};
    EXPECT_EQ(tks_needed_ranges(stream.get(), TKS_PART_HEIGHTS, window, &ranges), TKS_OK)
        << tks_message(stream.get());
    pages = false;
    for (size_t i = 0; i < ranges.count; ++i) {
      pages = pages || ranges.ranges[i].offset >= stream.info().stream_bytes;
      fetched.bytes += ranges.ranges[i].size;
      put(stream, bytes, ranges.ranges[i]);
    }
    tks_free_ranges(&ranges);
    if (++fetched.rounds > 3) break;
  }
  return fetched;
}

TEST(MosaicLayout, PagesGiveWindowsAndLevels) {
  std::mt19937 random(5);
  for (const tks_layout layout : kIndexed) {
    for (const auto& [error, voids] : {std::pair(0., true), {0., false}, {3., true}}) {
      const Bytes& bytes = paged(layout, error, voids);
      Stream whole((Prefix(bytes)));
      EXPECT_EQ(tks_verify(whole.get()), TKS_OK);
      EXPECT_EQ(whole.info().stream_bytes + whole.info().index_bytes, bytes.size());
      const size_t header = whole.info().header_bytes;
      Stream panning(Prefix(bytes).first(header));
      for (uint32_t level = 0; level < 5; ++level) {
        Stream stream(Prefix(bytes).first(header));
        for (Stream* one : {&whole, &panning, &stream})
          ASSERT_EQ(tks_set_levels(one->get(), level, 0), TKS_OK);
        const tks_window window = somewhere(random, 1 + static_cast<uint32_t>(random() % 60),
                                            kWidth >> level, kHeight >> level);
        const Fetched fetched = fetch(stream, bytes, &window);
        EXPECT_EQ(fetched.rounds, 2);
        EXPECT_LT(fetched.bytes, bytes.size() / 4);
        fetch(panning, bytes, &window);
        const std::vector<int16_t> expected = windowOf(whole, window);
        EXPECT_TRUE(windowOf(stream, window) == expected) << layout << ", level " << level;
        EXPECT_TRUE(windowOf(panning, window) == expected) << layout << ", level " << level;
      }
    }
  }
}

TEST(MosaicLayout, AllLayoutsHoldTheSame) {
  Source source(hills(TKS_I16, kWidth, kHeight));
  Coded coded(source, smallRegions());
  const Bytes progressive = coded.in(TKS_LAYOUT_PROGRESSIVE);
  EXPECT_EQ(Stream(Prefix(progressive)).info().index, TKS_INDEX_NONE);
  for (const tks_layout layout : kIndexed) {
    const Bytes bytes = coded.in(layout);
    Stream stream((Prefix(bytes)));
    EXPECT_TRUE(stream.heights() == source.raster.data);
    EXPECT_LT(static_cast<double>(bytes.size()), 1.03 * static_cast<double>(progressive.size()));
  }
}

double squaresOf(Prefix bytes, const Raster& raster) {
  Stream stream(bytes);
  const std::vector<std::byte> heights = stream.heights();
  double squares = 0;
  for (size_t i = 0; i < heights.size() / 2; ++i)
    squares += std::pow(sampleAt(heights, TKS_I16, i) - sampleAt(raster.data, TKS_I16, i), 2);
  return squares;
}

/// A cut in the preview costs hardly anything.
TEST(MosaicLayout, APreviewIsAsGoodAsAProgressiveStream) {
  Source source(hills(TKS_I16, kWidth, kHeight));
  Coded coded(source, smallRegions());
  const Bytes progressive = coded.in(TKS_LAYOUT_PROGRESSIVE), mixed = coded.in(TKS_LAYOUT_MIXED),
              large = coded.in(TKS_LAYOUT_MIXED, progressive.size() / 2);
  const auto cut = [&](const Bytes& bytes, uint64_t payload) {
    return squaresOf(Prefix(bytes).first(Stream(Prefix(bytes)).info().header_bytes + payload),
                     source.raster);
  };
  for (const size_t part : {40, 20, 11}) {
    const uint64_t payload = progressive.size() / part;
    EXPECT_LT(cut(mixed, payload), 1.06 * cut(progressive, payload)) << part;
  }
  EXPECT_LT(cut(large, progressive.size() / 3), 1.06 * cut(progressive, progressive.size() / 3));
  EXPECT_GT(cut(mixed, progressive.size() / 3), 1.2 * cut(progressive, progressive.size() / 3));
}

TEST(MosaicLayout, KeepsABudget) {
  Source source(hills(TKS_I16, kWidth, kHeight));
  tks_mosaic_options options = smallRegions();
  options.lossless = 0;
  options.bytes = 150000;
  Coded coded(source, options);
  const double best = squaresOf(coded.in(TKS_LAYOUT_PROGRESSIVE), source.raster);
  for (const tks_layout layout : kIndexed) {
    const Bytes bytes = coded.in(layout);
    EXPECT_LE(bytes.size(), options.bytes);
    EXPECT_GT(bytes.size(), options.bytes - 400);
    // A third of the bytes are heads and pages of 4500 regions of 16 x 16 samples.
    EXPECT_LT(squaresOf(bytes, source.raster), 2 * best) << layout;
  }
}

/// Bytes of the stream and of its pages that come in any order.
TEST(MosaicLayout, TakesBytesAndPagesInAnyOrder) {
  std::mt19937 random(9);
  for (const tks_layout layout : kIndexed) {
    const Bytes bytes = paged(layout);
    Stream whole((Prefix(bytes)));
    const size_t header = whole.info().header_bytes;
    const std::vector<std::byte> expected = whole.heights();
    for (int trial = 0; trial < 3; ++trial) {
      Stream stream(Prefix(bytes).first(header + random() % 9000));
      std::vector<size_t> pieces(40);
      for (size_t i = 0; i < pieces.size(); ++i) pieces[i] = i;
      std::shuffle(pieces.begin(), pieces.end(), random);
      const size_t side = bytes.size() / pieces.size() + 1;
      for (const size_t piece : pieces) {
        const size_t from = piece * side, to = std::min(bytes.size(), from + side);
        ASSERT_EQ(tks_put(stream.get(), from, bytes.data() + from, to - from), TKS_OK)
            << tks_message(stream.get());
        if (piece % 8 == 0) stream.heights();
      }
      EXPECT_TRUE(stream.heights() == expected);
    }
  }
}

/// Bytes that follow a gap are decoded without pages once the gap is closed.
TEST(MosaicLayout, ClosedGapsNeedNoPages) {
  const Bytes bytes = paged(TKS_LAYOUT_MIXED);
  Stream whole((Prefix(bytes)));
  const size_t header = whole.info().header_bytes, end = whole.info().stream_bytes;
  for (const size_t half : {header + (end - header) / 3, header + 2000}) {
    Stream stream(Prefix(bytes).first(header + 1000));
    ASSERT_EQ(tks_put(stream.get(), half, bytes.data() + half, end - half), TKS_OK);
    ASSERT_EQ(
        tks_put(stream.get(), header + 1000, bytes.data() + header + 1000, half - header - 1000),
        TKS_OK);
    EXPECT_TRUE(stream.heights() == whole.heights());
  }
}

/// What a viewer asks for by its picture brings pages and packets until nothing is missing.
TEST(MosaicLayout, PlansBringPages) {
  const Bytes bytes = paged(TKS_LAYOUT_WINDOWS, 0, false);
  Stream whole((Prefix(bytes)));
  Stream stream(Prefix(bytes).first(whole.info().header_bytes));
  bool pages = false;
  for (int round = 0; round < 200; ++round) {
    const Ranges plan(stream, nullptr, 100000);
    if (plan.all().empty()) break;
    for (const tks_range& range : plan.all()) {
      pages = pages || range.offset >= whole.info().stream_bytes;
      put(stream, bytes, range);
    }
  }
  EXPECT_TRUE(pages);
  EXPECT_TRUE(stream.heights() == whole.heights());
}

TEST(MosaicLayout, DamagedPagesAreTold) {
  Bytes bytes = paged(TKS_LAYOUT_MIXED);
  Stream whole((Prefix(bytes)));
  const std::vector<std::byte> expected = whole.heights();
  const size_t header = whole.info().header_bytes, end = whole.info().stream_bytes;
  std::mt19937 random(2);
  const tks_window window{100, 90, 60, 60};
  for (int trial = 0; trial < 12; ++trial) {
    const size_t place = end + random() % (bytes.size() - end);
    const uint8_t sound = bytes[place];
    bytes[place] ^= static_cast<uint8_t>(1 + random() % 255);
    Stream damaged((Prefix(bytes)));
    EXPECT_TRUE(damaged.heights() == expected);
    EXPECT_EQ(tks_verify(damaged.get()), TKS_CORRUPT);
    Stream stream(Prefix(bytes).first(header));
    EXPECT_EQ(tks_put(stream.get(), end, bytes.data() + end, bytes.size() - end), TKS_CORRUPT);
    EXPECT_TRUE(stream.heights().size() == expected.size());
    tks_ranges ranges = {};
    Stream other((Prefix(bytes)));
    const tks_window all{0, 0, kWidth, kHeight};
    EXPECT_EQ(tks_needed_ranges(other.get(), TKS_PART_HEIGHTS, &all, &ranges), TKS_CORRUPT);
    tks_free_ranges(&ranges);
    bytes[place] = sound;
  }
  Stream part(Prefix(bytes).first(bytes.size() - 1));
  EXPECT_EQ(tks_verify(part.get()), TKS_TRUNCATED);
  bytes.push_back(0);
  Stream longer((Prefix(bytes)));
  EXPECT_EQ(tks_verify(longer.get()), TKS_CORRUPT);
  // Of a file without its pages windows are not found, and nothing else is lost.
  Stream cut(Prefix(bytes).first(end));
  EXPECT_TRUE(cut.heights() == expected);
  EXPECT_EQ(windowOf(cut, window), windowOf(whole, window));
}

/// A record with the right seal that lists packets which are not there.
TEST(MosaicLayout, FalsePagesAreToldByTheirHeads) {
  Bytes bytes = paged(TKS_LAYOUT_WINDOWS, 0, false);
  const size_t end = Stream(Prefix(bytes)).info().stream_bytes;
  const Result<ParsedHeader> parsed = readHeader(bytes);
  ASSERT_TRUE(parsed.ok());
  std::optional<PageIndex> index = PageIndex::of(*parsed);
  ASSERT_TRUE(index);
  const auto [from, to] = index->record(0);
  ASSERT_EQ(from, end);
  Bytes record(bytes.begin() + static_cast<ptrdiff_t>(from),
               bytes.begin() + static_cast<ptrdiff_t>(to));
  ASSERT_TRUE(index->take(0, record).ok());
  record[0] ^= 1;  // a byte farther on
  const uint32_t crc = crc32(Prefix(record).first(record.size() - 4));
  for (size_t i = 0; i < 4; ++i)
    record[record.size() - 4 + i] = static_cast<uint8_t>(crc >> (8 * i));
  Stream stream(Prefix(bytes).first(readHeader(bytes)->bytes + 200));
  ASSERT_EQ(tks_put(stream.get(), from, record.data(), record.size()), TKS_OK);
  EXPECT_EQ(tks_put(stream.get(), end - 10, bytes.data() + end - 10, 10), TKS_CORRUPT);
}

/// A record of one run of one packet.
Bytes recordOf(uint64_t gap, uint64_t length, int64_t track) {
  FieldWriter fields;
  fields.put(gap);
  fields.put(1);
  fields.put(length << 2);
  fields.zigzag("track_step", track, track);
  fields.bytes.push_back(255);
  fields.u32("crc", crc32(fields.bytes));
  return fields.bytes;
}

TEST(MosaicLayout, PagesListPacketsOfTheirOwn) {
  const Bytes bytes = paged(TKS_LAYOUT_WINDOWS, 0, false);
  const Result<ParsedHeader> parsed = readHeader(bytes);
  ASSERT_TRUE(parsed.ok());
  const auto takes = [&](const std::vector<std::pair<uint32_t, Bytes>>& records) {
    PageIndex index = *PageIndex::of(*parsed);
    Status last;
    for (const auto& [page, record] : records) last = index.take(page, record);
    return last.code();
  };
  const uint64_t end = parsed->header.payload_bytes;
  EXPECT_EQ(takes({{0, recordOf(0, 100, 0)}, {1, recordOf(200, 100, 1)}}), TKS_OK);
  EXPECT_EQ(takes({{1, recordOf(200, 100, 1)}, {0, recordOf(0, 100, 0)}}), TKS_OK);
  EXPECT_EQ(takes({{0, recordOf(0, 100, 0)}, {1, recordOf(50, 10, 1)}}), TKS_CORRUPT);
  EXPECT_EQ(takes({{1, recordOf(50, 10, 1)}, {0, recordOf(0, 100, 0)}}), TKS_CORRUPT);
  EXPECT_EQ(takes({{0, recordOf(50, 10, 1)}}), TKS_CORRUPT);
  EXPECT_EQ(takes({{0, recordOf(0, 0, 0)}}), TKS_CORRUPT);
  EXPECT_EQ(takes({{0, recordOf(end, 10, 0)}}), TKS_CORRUPT);
  EXPECT_EQ(takes({{0, recordOf(end - 1, 10, 0)}}), TKS_OK);  // a payload that was cut
  EXPECT_EQ(takes({{0, recordOf(0, 100, int64_t{1} << 31)}}), TKS_CORRUPT);
  EXPECT_EQ(takes({{0, Bytes(3, 0)}}), TKS_CORRUPT);
}

TEST(MosaicLayout, RefusesWhatMeansNothing) {
  Source source(hills(TKS_I16, 200, 150));
  tks_mosaic_options options = mosaicOptions();
  options.lossless = 1;
  Coded coded(source, options);
  Bytes stream;
  EXPECT_EQ(merge(coded.plan, coded.files, stream, TKS_LAYOUT_WINDOWS, 100), TKS_USAGE);
  EXPECT_EQ(merge(coded.plan, coded.files, stream, static_cast<tks_layout>(3)), TKS_USAGE);
  EXPECT_EQ(Stream(coded.in(TKS_LAYOUT_WINDOWS)).info().index, TKS_INDEX_WINDOWS);
  EXPECT_EQ(Stream(coded.in(TKS_LAYOUT_MIXED)).info().index, TKS_INDEX_PACKETS);
}

/// Seas and other ground of one value take no bytes, beside land and between voids.
TEST(MosaicLayout, ConstantTilesTakeNoBytes) {
  for (const int level : {0, -7, 1200}) {
    const auto sea = static_cast<int16_t>(level);
    for (const bool voids : {false, true}) {
      Source source(hills(TKS_I16, 1500, 700));
      auto* samples = reinterpret_cast<int16_t*>(source.raster.data.data());
      for (uint32_t y = 0; y < 700; ++y) std::fill_n(samples + size_t{y} * 1500 + 400, 1100, sea);
      if (voids) {
        source.heights.has_nodata = 1;
        source.heights.nodata = 31000;
        for (uint32_t y = 0; y < 300; ++y)
          std::fill_n(samples + size_t{y} * 1500, 200, int16_t{31000});
      }
      tks_mosaic_options options = mosaicOptions();
      options.lossless = 1;
      const Bytes bytes = mosaicOf(source, options, TKS_LAYOUT_WINDOWS);
      Stream stream((Prefix(bytes)));
      EXPECT_TRUE(stream.heights() == source.raster.data) << sea << voids;
      const tks_window window{900, 300, 300, 300};
      EXPECT_TRUE(windowOf(stream, window) == std::vector<int16_t>(90000, sea));
      Stream front(Prefix(bytes).first(stream.info().header_bytes));
      EXPECT_LT(fetch(front, bytes, &window).bytes, 2500u);
      EXPECT_TRUE(windowOf(front, window) == std::vector<int16_t>(90000, sea));
    }
  }
}

}  // namespace
}  // namespace tetrakis::test

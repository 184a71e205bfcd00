// SPDX-License-Identifier: Apache-2.0
// Whole streams of heights that were enlarged by copying samples: they come back, their bytes are
// those of the small grid, and prefixes, levels, windows and meshes are those of any other heights.
#include <algorithm>
#include <chrono>

#include "bitstream/stream/header.hpp"
#include "conformance/reference_decoder.hpp"
#include "tests/support/stream_fixture.hpp"
#include "tests/support/window_checks.hpp"

namespace tetrakis::test {
namespace {

using samples::make;
using samples::Pattern;
using samples::Raster;

constexpr tks_sample kTypes[] = {TKS_U8, TKS_I8, TKS_U16, TKS_I16, TKS_U32, TKS_I32, TKS_F32};

/// Which line of the small grid each line of a larger one shows: runs of some lengths by turns.
std::vector<uint32_t> linesOf(uint32_t lines, std::initializer_list<uint32_t> runs) {
  std::vector<uint32_t> shown;
  for (uint32_t line = 0; line < lines; ++line)
    shown.insert(shown.end(), runs.begin()[line % runs.size()], line);
  return shown;
}

Raster copied(const Raster& small, const std::vector<uint32_t>& columns,
              const std::vector<uint32_t>& rows) {
  Raster large = small;
  large.width = static_cast<uint32_t>(columns.size());
  large.height = static_cast<uint32_t>(rows.size());
  large.data.clear();
  const size_t bytes = tks_sample_bytes(small.sample);
  for (const uint32_t row : rows) {
    for (const uint32_t column : columns) {
      const std::byte* from = small.data.data() + (size_t{row} * small.width + column) * bytes;
      large.data.insert(large.data.end(), from, from + bytes);
    }
  }
  return large;
}

Raster small(tks_sample sample = TKS_I16) {
  return make({Pattern::kRidges, 40, 33, 1, sample});
}

bool repeats(const Bytes& stream) {
  return !readHeader(stream)->header.geometry->repeats.none();
}

TEST(RepeatedLines, ComeBackWithAllTypesAndRuns) {
  for (const tks_sample type : kTypes) {
    const Raster of = small(type);
    for (const auto& runs :
         {linesOf(33, {2}), linesOf(33, {1, 2}), linesOf(33, {5}), linesOf(33, {2, 2, 3})}) {
      const Raster large = copied(of, linesOf(40, {3}), runs);
      const Bytes stream = encode(&large, nullptr, lossless());
      EXPECT_TRUE(repeats(stream));
      EXPECT_TRUE(Stream(stream).heights() == large.data) << type;
    }
  }
}

/// Of floats too, as long as none is void.
TEST(RepeatedLines, ServePsnr) {
  tks_encode_options options = lossless();
  options.lossless = 0;
  options.psnr = 60;
  for (const tks_sample type : {TKS_U16, TKS_F32}) {
    const Raster of = small(type), large = copied(of, linesOf(40, {4}), linesOf(33, {4}));
    const Bytes stream = encode(&large, nullptr, options);
    EXPECT_TRUE(repeats(stream)) << type;
    EXPECT_LE(stream.size(), encode(&of, nullptr, options).size() * 11 / 10) << type;
  }
}

/// A grid of copies may begin anywhere.
TEST(RepeatedLines, TakeTheBytesOfTheSmallGrid) {
  const Raster of = small();
  const size_t alone = encode(&of, nullptr, lossless()).size();
  for (uint32_t k = 2; k <= 6; ++k) {
    std::vector<uint32_t> columns = linesOf(40, {k}), rows = linesOf(33, {k});
    columns.erase(columns.begin());
    rows.erase(rows.begin(), rows.begin() + k / 2);
    const Raster large = copied(of, columns, rows);
    EXPECT_LE(encode(&large, nullptr, lossless()).size(), alone + 24) << k;
  }
}

/// Regions, which large heights are cut into, would take some bytes each.
TEST(RepeatedLines, AreAllButTwoOfOneHeight) {
  Raster flat = make({Pattern::kFlat, 1100, 1000, 1, TKS_F32});
  const Bytes stream = encode(&flat, nullptr, lossless());
  EXPECT_TRUE(repeats(stream));
  EXPECT_LE(stream.size(), 60u);
  EXPECT_TRUE(Stream(stream).heights() == flat.data);
}

TEST(RepeatedLines, AreNoneWhereOnlyAFewAre) {
  Raster sea = small();
  std::fill_n(sea.data.begin(), size_t{2} * 40 * 12, std::byte{0});
  EXPECT_FALSE(repeats(encode(&sea, nullptr, lossless())));
}

/// At every 41st byte, and as the reference decoder shows it.
TEST(RepeatedLines, DecodeAsTheReferenceDoesInAllPrefixesAndLevels) {
  const Raster large = copied(small(), linesOf(40, {3}), linesOf(33, {1, 2}));
  for (const tks_encode_options& options :
       {lossless(), budget(900), inRegions(lossless()), inRegions(budget(900))}) {
    const Bytes stream = encode(&large, nullptr, options);
    ASSERT_TRUE(repeats(stream));
    for (size_t bytes = readHeader(stream)->bytes; bytes <= stream.size(); bytes += 141) {
      const Prefix prefix = Prefix(stream).first(bytes);
      for (const uint32_t level : {0u, 1u, 2u, 3u, 5u}) {
        Stream decoded(prefix);
        ASSERT_EQ(tks_set_levels(decoded.get(), level, 0), TKS_OK);
        const size_t columns = ((large.width - 1) >> level) + 1;
        const size_t rows = ((large.height - 1) >> level) + 1;
        std::vector<uint8_t> heights(2 * columns * rows);
        ASSERT_EQ(tks_decode_heights(decoded.get(), heights.data(), heights.size()), TKS_OK);
        const int wanted = static_cast<int>(level);
        ASSERT_EQ(heights, reference::decode(prefix, 1 << 20, {wanted, 0}).heights)
            << bytes << ", level " << level;
      }
    }
  }
}

TEST(RepeatedLines, WindowsAreThoseOfTheWhole) {
  Raster of = small();
  const Raster large = copied(of, linesOf(40, {3}), linesOf(33, {2, 3}));
  for (const tks_encode_options& options : {budget(900), inRegions(lossless())}) {
    const Bytes stream = encode(&large, nullptr, options);
    const std::vector<std::byte> whole = Stream(stream).heights();
    for (const tks_window& window : {tks_window{0, 0, large.width, large.height},
                                     tks_window{31, 40, 20, 3}, tks_window{119, 81, 1, 1}})
      expectHeightsWindow(Stream(stream), window, whole);
  }
}

/// All targets are met for the samples that are shown, beside voids as well.
TEST(RepeatedLines, MeetTargets) {
  Raster of = small(TKS_U16);
  const Raster large = copied(of, linesOf(40, {2}), linesOf(33, {4}));
  tks_encode_options bounded = lossless();
  bounded.lossless = 0;
  bounded.max_error = 300;
  const Bytes bound = encode(&large, nullptr, bounded);
  EXPECT_TRUE(repeats(bound));
  EXPECT_LE(largestError(large, Stream(bound).heights()), 300);
  const Bytes less = encode(&large, nullptr, budget(700));
  EXPECT_LE(less.size(), 700u);
  const Bytes alone = encode(&of, nullptr, budget(680));
  EXPECT_LE(squaredError(large, Stream(less).heights()),
            8 * 1.02 * squaredError(of, Stream(alone).heights()));
}

/// Limits are those of all samples, however few are coded.
TEST(RepeatedLines, CountInLimits) {
  const Raster of = small();
  StreamHeader header = readHeader(encode(&of, nullptr, lossless()))->header;
  for (const uint32_t side : {1u << 20, 1u << 13}) {
    header.geometry->repeats = {{side, side}, "few"};
    Stream huge(writeHeader(header));
    EXPECT_EQ(huge.status(), side > (1u << 14) ? TKS_LIMIT : TKS_OK);
  }
}

/// What a renderer reads of the heights: all samples that the caller gave.
int errorOfLines(void* user, const void* heights, const void*, double* sum, double* values) {
  const Raster& large = *static_cast<const Raster*>(user);
  const auto* samples = static_cast<const std::byte*>(heights);
  *sum = squaredError(large, {samples, samples + large.data.size()});
  *values = static_cast<double>(large.width * large.height);
  return 0;
}

TEST(RepeatedLines, AreShownToRenderersWhole) {
  Raster large = copied(small(), linesOf(40, {3}), linesOf(33, {2}));
  const Raster image = make({Pattern::kRidges, 48, 48, 3, TKS_U8});
  tks_encode_options options = budget(3000);
  options.picture_error = errorOfLines;
  options.picture_user = &large;
  EXPECT_LE(encode(&large, &image, options).size(), 3000u);
}

/// A map of runs without order takes more than small budgets have.
TEST(RepeatedLines, LeaveSmallBudgetsToTheHeights) {
  const Raster of = make({Pattern::kRidges, 600, 33, 1, TKS_I16});
  std::vector<uint32_t> columns;
  for (uint32_t line = 0; line < 600; ++line)
    columns.insert(columns.end(), 1 + samples::hash(line, 7, 1) % 3, line);
  const Raster large = copied(of, columns, linesOf(33, {1}));
  EXPECT_TRUE(repeats(encode(&large, nullptr, budget(6000))));
  EXPECT_FALSE(repeats(encode(&large, nullptr, budget(300))));
}

double secondsToEncode(const Raster& large) {
  const auto start = std::chrono::steady_clock::now();
  EXPECT_TRUE(repeats(encode(&large, nullptr, lossless())));
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// However many lengths the runs have, and so however many weights of errors there are.
TEST(RepeatedLines, TakeNoLongerWhereRunsDiffer) {
  const Raster of = make({Pattern::kRidges, 100, 100, 1, TKS_I16});
  std::vector<uint32_t> columns, rows;
  for (uint32_t line = 0; line < 100; ++line) {
    columns.insert(columns.end(), 8 + samples::hash(line, 7, 1) % 25, line);
    rows.insert(rows.end(), 8 + samples::hash(line, 7, 2) % 25, line);
  }
  const double alike = secondsToEncode(copied(of, linesOf(100, {20}), linesOf(100, {20})));
  EXPECT_LT(secondsToEncode(copied(of, columns, rows)), 8 * alike + 0.2);
}

/// Meshes are made of all samples.
TEST(RepeatedLines, HaveMeshes) {
  const Raster large = copied(small(), linesOf(40, {2}), linesOf(33, {2}));
  const Bytes stream = encode(&large, nullptr, lossless());
  for (const tks_mesh_kind kind : {TKS_MESH_CODED, TKS_MESH_BUDGET}) {
    Stream decoded(stream);
    tks_mesh mesh = {};
    ASSERT_EQ(tks_decode_mesh(decoded.get(), kind, 400, &mesh), TKS_OK) << kind;
    EXPECT_GT(mesh.triangle_count, 0u);
    tks_free_mesh(&mesh);
  }
}

}  // namespace
}  // namespace tetrakis::test

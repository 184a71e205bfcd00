// SPDX-License-Identifier: Apache-2.0
// Heights of one column, one row or one sample: profiles, windows of one row, tiny tiles. All
// targets keep their promises, and every prefix, level and window decodes as those of any heights.
// They have no area: no mesh can be made of them, and no camera sees them.
#include <limits>
#include <utility>

#include "bitstream/stream/header.hpp"
#include "conformance/reference_decoder.hpp"
#include "conformance/samples/few_values.hpp"
#include "tests/support/stream_fixture.hpp"

namespace tetrakis::test {
namespace {

using samples::make;
using samples::Pattern;
using samples::Raster;

constexpr tks_sample kTypes[] = {TKS_U8, TKS_I8, TKS_U16, TKS_I16, TKS_U32, TKS_I32, TKS_F32};
constexpr Extent kSizes[] = {{1, 1}, {1, 2}, {2, 1}, {1, 90}, {90, 1}};

/// What options promise of samples that come back.
void expectPromises(const Raster& raster, const tks_encode_options& options, const Bytes& stream) {
  Stream whole(stream);
  const std::vector<std::byte> decoded = whole.heights();
  if (options.lossless != 0) {
    EXPECT_TRUE(whole.info().lossless);
    EXPECT_TRUE(decoded == raster.data);
  }
  if (options.max_error > 0) {
    EXPECT_LE(largestError(raster, decoded), options.max_error);
  }
  if (options.bytes > 0) {
    EXPECT_LE(stream.size(), options.bytes);
  }
  if (options.psnr <= 0) return;
  const size_t count = raster.data.size() / tks_sample_bytes(raster.sample);
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (size_t i = 0; i < count; ++i) {
    low = std::min(low, sampleAt(raster.data, raster.sample, i));
    high = std::max(high, sampleAt(raster.data, raster.sample, i));
  }
  const double wanted = std::pow((high - low) * std::pow(10, -options.psnr / 20), 2);
  EXPECT_LE(squaredError(raster, decoded) / static_cast<double>(count), wanted * (1 + 1e-9));
}

std::vector<uint8_t> heightsAtLevel(Stream& stream, uint32_t level) {
  EXPECT_EQ(tks_set_levels(stream.get(), level, 0), TKS_OK);
  tks_info info = {};
  info.size = sizeof info;
  EXPECT_EQ(tks_get_info(stream.get(), &info), TKS_OK);
  std::vector<uint8_t> heights(size_t{info.width} * info.height * tks_sample_bytes(info.sample));
  EXPECT_EQ(tks_decode_heights(stream.get(), heights.data(), heights.size()), TKS_OK)
      << tks_message(stream.get());
  return heights;
}

/// A window of the last row, from its middle on.
void expectWindow(const Bytes& bytes) {
  Stream stream(bytes);
  const std::vector<std::byte> whole = stream.heights();
  const uint32_t x = stream.info().width / 2;
  const tks_window window{x, stream.info().height - 1, stream.info().width - x, 1};
  std::vector<std::byte> part(window.width * tks_sample_bytes(stream.info().sample));
  Stream again(bytes);
  ASSERT_EQ(tks_decode_heights_window(again.get(), &window, part.data(), part.size()), TKS_OK);
  const auto count = static_cast<ptrdiff_t>(part.size());
  EXPECT_TRUE(std::equal(part.begin(), part.end(), whole.end() - count));
}

/// Prefixes at all levels as the reference decoder has them, a decoder that grows with the bytes,
/// and a window.
void expectDecodes(const Bytes& bytes) {
  const size_t header = readHeader(bytes)->bytes;
  const size_t stride = std::max<size_t>(1, (bytes.size() - header) / 4);
  Stream growing(Prefix(bytes).first(header));
  size_t there = header;
  for (size_t n = header; n <= bytes.size(); n += stride) {
    const Prefix prefix = Prefix(bytes).first(n);
    ASSERT_EQ(tks_append(growing.get(), bytes.data() + there, n - there), TKS_OK);
    there = n;
    Stream stream(prefix);
    ASSERT_EQ(stream.status(), TKS_OK) << stream.message();
    const uint32_t coarsest = stream.info().coarsest_level;
    for (uint32_t level = 0; level <= coarsest; level += std::max(1u, coarsest)) {
      const auto wanted = reference::decode(prefix, 1 << 20, {static_cast<int>(level), 0});
      ASSERT_EQ(heightsAtLevel(stream, level), wanted.heights) << n << ", level " << level;
    }
    ASSERT_EQ(heightsAtLevel(growing, 0), heightsAtLevel(stream, 0)) << n;
  }
  expectWindow(bytes);
}

std::vector<tks_encode_options> allTargets() {
  tks_encode_options quality = budget(0), indexed = lossless();
  quality.psnr = 40;
  indexed.index = TKS_INDEX_PACKETS;
  tks_encode_options for_meshes = budget(300);
  for_meshes.triangles = 50;
  return {
      lossless(), inRegions(lossless()), indexed, quality, within(0.4), within(900), budget(130),
      for_meshes, inRegions(budget(300))};
}

void expectAll(const Raster& raster, const tks_heights& heights) {
  for (const tks_encode_options& options : allTargets()) {
    SCOPED_TRACE(testing::Message()
                 << "type " << raster.sample << ", " << raster.width << " x " << raster.height
                 << ", lossless " << options.lossless << ", bytes " << options.bytes << ", psnr "
                 << options.psnr << ", max_error " << options.max_error << ", regions "
                 << options.regions);
    const Bytes stream = encodeHeights(heights, options);
    ASSERT_FALSE(stream.empty());
    expectPromises(raster, options, stream);
    expectDecodes(stream);
    if (testing::Test::HasFailure()) return;  // the others say the same
  }
}

TEST(SingleLine, KeepsPromisesOfAllTargets) {
  for (const tks_sample type : kTypes) {
    for (const auto& [width, height] : kSizes) {
      for (const Pattern pattern : {Pattern::kRidges, Pattern::kFlat, Pattern::kExtreme}) {
        if (pattern != Pattern::kRidges && type != TKS_U8 && type != TKS_F32) continue;
        const Raster raster = make({pattern, width, height, 1, type});
        expectAll(raster, raster.heights());
        if (HasFailure()) return;
      }
    }
  }
}

/// Every third sample, or each of them.
TEST(SingleLine, KeepsVoids) {
  for (const auto& [width, height] : kSizes) {
    for (const uint32_t every : {1u, 3u}) {
      Raster raster = make({Pattern::kRidges, width, height, 1, TKS_I16});
      const int16_t nodata = -9999;
      for (size_t i = 0; i < raster.data.size() / 2; i += every)
        std::memcpy(raster.data.data() + 2 * i, &nodata, sizeof nodata);
      tks_heights heights = raster.heights();
      heights.has_nodata = 1;
      heights.nodata = nodata;
      const Bytes stream = encodeHeights(heights, lossless());
      EXPECT_TRUE(Stream(stream).heights() == raster.data);
      expectDecodes(stream);
      expectDecodes(encodeHeights(heights, within(900)));
      expectDecodes(encodeHeights(heights, inRegions(budget(300))));
      if (HasFailure()) return;
    }
  }
}

Raster turned(Raster raster) {
  std::swap(raster.width, raster.height);
  return raster;
}

/// Lines of few values, lines with lakes, and lines of long runs.
TEST(SingleLine, TakesTablesLakesAndDrawings) {
  constexpr uint32_t kSamples = 1500;
  const Raster line = make({Pattern::kRidges, kSamples, 1, 1, TKS_U8});
  const Raster feet = samples::withFewValues(line, samples::FewValues::kRescaled);
  Raster lakes = make({Pattern::kExtreme, kSamples, 1, 1, TKS_I16});
  Raster classes = line;
  for (uint32_t i = 0; i < kSamples; ++i) {
    if (i / 250 % 2 == 1) std::memset(lakes.data.data() + 2 * size_t{i}, 0, 2);
    classes.data[i] = std::byte(samples::hash(i / 40, 1, 1) % 5 * 50);
  }
  EXPECT_GT(readHeader(encode(&feet, nullptr, lossless()))->header.layers.table_values, 0u);
  EXPECT_TRUE(readHeader(encode(&classes, nullptr, lossless()))->header.geometry->drawn);
  for (const Raster& raster : {feet, turned(feet), lakes, classes, turned(classes)}) {
    for (const tks_encode_options& options : {lossless(), within(900), inRegions(budget(400))}) {
      const Bytes stream = encode(&raster, nullptr, options);
      expectPromises(raster, options, stream);
      expectDecodes(stream);
    }
  }
}

/// Rows that all equal the first are one row.
TEST(SingleLine, IsWhatIsCodedOfRowsThatRepeatIt) {
  const Raster line = make({Pattern::kRidges, 300, 1, 1, TKS_I16});
  Raster rows = line;
  for (rows.height = 1; rows.height < 40; ++rows.height)
    rows.data.insert(rows.data.end(), line.data.begin(), line.data.end());
  for (const tks_encode_options& options : {lossless(), inRegions(budget(300)), within(900)}) {
    const Bytes stream = encode(&rows, nullptr, options);
    EXPECT_EQ(readHeader(stream)->header.geometry->height, 1u);
    expectPromises(rows, options, stream);
    expectDecodes(stream);
  }
  EXPECT_LE(encode(&rows, nullptr, lossless()).size(),
            encode(&line, nullptr, lossless()).size() + 24);
}

TEST(SingleLine, StandsBesideTextures) {
  for (const auto& [width, height] : kSizes) {
    const Raster raster = make({Pattern::kRidges, width, height, 1, TKS_F32});
    for (const auto& [columns, rows] : {Extent{1, 1}, Extent{40, 30}}) {
      const Raster image = make({Pattern::kRidges, columns, rows, 3, TKS_U8});
      const Bytes stream = encode(&raster, &image, lossless());
      EXPECT_TRUE(Stream(stream).texture() == image.data);
      expectDecodes(stream);
      tks_encode_options options = budget(700);
      EXPECT_LE(encode(&raster, &image, options).size(), 700u);
      options.triangles = 20;
      EXPECT_LE(encode(&raster, &image, options).size(), 700u);
    }
  }
}

std::string sentenceOf(const Raster& raster, const Raster* image,
                       const tks_encode_options& options) {
  const tks_heights heights = raster.heights();
  const tks_image texture = image ? image->image() : tks_image{};
  tks_buffer buffer = {};
  char message[256] = "";
  EXPECT_EQ(tks_encode(&heights, image ? &texture : nullptr, &options, &buffer, message, 256),
            TKS_USAGE);
  return message;
}

TEST(SingleLine, IsSeenByNoCamera) {
  const tks_camera camera = {"low", {0, 9000, 9000}, {0, 0, 0}, {0, 1, 0}, 40, 64, 64, 1};
  const Raster image = make({Pattern::kRidges, 40, 30, 3, TKS_U8});
  for (const auto& [width, height] : kSizes) {
    tks_encode_options options = budget(900);
    options.cameras = &camera;
    options.camera_count = 1;
    EXPECT_EQ(sentenceOf(make({Pattern::kRidges, width, height, 1, TKS_I16}), &image, options),
              "Heights of one column or row have no area that a camera could see.");
  }
}

/// Whole and cut, of every call that makes one.
TEST(SingleLine, HasNoMesh) {
  for (const auto& [width, height] : kSizes) {
    const Raster raster = make({Pattern::kRidges, width, height, 1, TKS_I16});
    Stream stream(encode(&raster, nullptr, lossless()));
    const std::string sentence = "Heights of " + std::to_string(width) + " x " +
                                 std::to_string(height) + " samples have no area, and so no mesh.";
    tks_mesh mesh = {};
    tks_mesh_tree* tree = nullptr;
    for (const tks_mesh_kind kind : {TKS_MESH_CODED, TKS_MESH_BUDGET}) {
      EXPECT_EQ(tks_decode_mesh(stream.get(), kind, 40, &mesh), TKS_USAGE);
      EXPECT_EQ(tks_message(stream.get()), sentence);
      EXPECT_EQ(tks_decode_mesh_tree(stream.get(), kind, 40, &tree), TKS_USAGE);
      EXPECT_EQ(tks_message(stream.get()), sentence);
    }
    EXPECT_EQ(tks_decode_screen_mesh(stream.get(), nullptr, 40, &mesh), TKS_USAGE);
    EXPECT_EQ(tks_message(stream.get()), sentence);
    for (const tks_part part : {TKS_PART_HEIGHTS, TKS_PART_CODED_MESH, TKS_PART_BUDGET_MESH})
      EXPECT_EQ(tks_check_memory(stream.get(), part, nullptr, 40, 0, nullptr), TKS_OK);
  }
}

/// A plan covers what is missing, whatever a camera sees of a line.
TEST(SingleLine, IsFetchedByPlans) {
  tks_encode_options options = inRegions(lossless());
  options.index = TKS_INDEX_PACKETS;
  for (const auto& [width, height] : kSizes) {
    const Raster raster = make({Pattern::kRidges, width, height, 1, TKS_I16});
    const Bytes bytes = encode(&raster, nullptr, options);
    Stream stream(Prefix(bytes).first(readHeader(bytes)->bytes));
    const tks_screen_camera camera = {
        sizeof camera, 64, 64, {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 300}, 1, nullptr};
    const tks_fetch all = {sizeof all, bytes.size(), 0, 0};
    for (const tks_screen_camera* view :
         {&camera, static_cast<const tks_screen_camera*>(nullptr)}) {
      tks_ranges ranges = {};
      ASSERT_EQ(tks_plan(stream.get(), view, &all, &ranges), TKS_OK) << tks_message(stream.get());
      for (size_t i = 0; view == nullptr && i < ranges.count; ++i) {
        const auto& [offset, size, gain] = ranges.ranges[i];
        ASSERT_EQ(tks_put(stream.get(), offset, bytes.data() + offset, size), TKS_OK);
      }
      tks_free_ranges(&ranges);
    }
    EXPECT_TRUE(stream.heights() == raster.data);
  }
}

}  // namespace
}  // namespace tetrakis::test

// SPDX-License-Identifier: Apache-2.0
// Mosaics through the C interface: the streams of their targets, restarts, damaged parts.
#include <algorithm>
#include <random>

#include "tests/support/mosaic_source.hpp"

namespace tetrakis::test {
namespace {

TEST(MosaicStream, RestoresSamplesOfEveryType) {
  for (const tks_sample sample : {TKS_U8, TKS_I8, TKS_U16, TKS_I16, TKS_U32, TKS_I32}) {
    for (const bool voids : {false, true}) {
      Source source(hills(sample, 200, 150));
      if (voids) dig(source, samples::VoidShape::kCoast);
      tks_mosaic_options options = mosaicOptions();
      options.lossless = 1;
      Stream stream(mosaicOf(source, options));
      ASSERT_EQ(stream.status(), TKS_OK) << sample << stream.message();
      EXPECT_TRUE(stream.info().lossless);
      EXPECT_EQ(tks_verify(stream.get()), TKS_OK);
      std::vector<std::byte> samples(stream.heightsBytes());
      ASSERT_EQ(tks_decode_heights(stream.get(), samples.data(), samples.size()), TKS_OK);
      EXPECT_TRUE(samples == source.raster.data) << sample << voids;
    }
  }
}

/// As files say of masks that have become something else.
TEST(MosaicStream, ANodataValueThatNoSampleCanHaveIsNone) {
  for (const double nodata : {-9999.0, 0.5, 1e30}) {
    Source source(hills(TKS_U8, 200, 150));
    source.heights.has_nodata = 1;
    source.heights.nodata = nodata;
    tks_mosaic_options options = mosaicOptions();
    options.lossless = 1;
    Stream stream(mosaicOf(source, options));
    std::vector<std::byte> samples(stream.heightsBytes());
    ASSERT_EQ(tks_decode_heights(stream.get(), samples.data(), samples.size()), TKS_OK);
    EXPECT_TRUE(samples == source.raster.data);
  }
}

/// Floats in quarters, with voids that are NaN or -9999.
Raster quarters() {
  Raster raster = hills(TKS_I16);
  std::vector<std::byte> floats(raster.data.size() * 2);
  for (size_t i = 0; i < raster.data.size() / 2; ++i) {
    int16_t whole = 0;
    std::memcpy(&whole, raster.data.data() + 2 * i, 2);
    const float value = static_cast<float>(whole) / 4;
    std::memcpy(floats.data() + 4 * i, &value, 4);
  }
  raster.sample = TKS_F32;
  raster.data = std::move(floats);
  return raster;
}

TEST(MosaicStream, RestoresFloatsThatHaveAStep) {
  Source source(quarters());
  dig(source, samples::VoidShape::kHoles);
  tks_mosaic_options options = mosaicOptions();
  options.lossless = 1;
  Stream stream(mosaicOf(source, options));
  std::vector<std::byte> samples(stream.heightsBytes());
  ASSERT_EQ(tks_decode_heights(stream.get(), samples.data(), samples.size()), TKS_OK);
  EXPECT_TRUE(samples == source.raster.data);
}

/// Floats that have no step.
Raster roots() {
  Raster rough = quarters();
  for (size_t i = 0; i < rough.data.size() / 4; ++i) {
    const auto value = std::sqrt(static_cast<float>(i));
    std::memcpy(rough.data.data() + 4 * i, &value, 4);
  }
  return rough;
}

TEST(MosaicStream, RestoresNegativeZeros) {
  Source source(quarters());
  constexpr float kZero = -0.0f;
  for (size_t i = 0; i < source.raster.data.size() / 4; i += 977)
    std::memcpy(source.raster.data.data() + 4 * i, &kZero, 4);
  tks_mosaic_options options = mosaicOptions();
  options.lossless = 1;
  Stream stream(mosaicOf(source, options));
  EXPECT_TRUE(stream.info().lossless);
  std::vector<std::byte> samples(stream.heightsBytes());
  ASSERT_EQ(tks_decode_heights(stream.get(), samples.data(), samples.size()), TKS_OK);
  EXPECT_TRUE(samples == source.raster.data);
}

/// An error that is smaller than any steps can promise is kept by samples as they are.
TEST(MosaicStream, RestoresFloatsWithoutAStep) {
  for (const double error : {0.0, 1e-7}) {
    for (const bool voids : {false, true}) {
      Source source(roots());
      if (voids) dig(source, samples::VoidShape::kCoast);
      tks_mosaic_options options = mosaicOptions();
      options.max_error = error;
      options.lossless = error == 0 ? 1 : 0;
      Stream stream(mosaicOf(source, options));
      EXPECT_EQ(stream.info().lossless, options.lossless);
      std::vector<std::byte> samples(stream.heightsBytes());
      ASSERT_EQ(tks_decode_heights(stream.get(), samples.data(), samples.size()), TKS_OK);
      EXPECT_TRUE(samples == source.raster.data) << error << voids;
    }
  }
}

/// Smooth ground, and copies of one another: corrections behind a cut are what these need.
TEST(MosaicStream, TakesAboutTheBytesOfAnEncoder) {
  for (const Pattern pattern : {Pattern::kHills, Pattern::kSteps, Pattern::kRidges}) {
    Source source(make({pattern, 330, 310, 1, TKS_I16, 5}));
    for (const double error : {0., 1., 20.}) {
      tks_mosaic_options options = mosaicOptions();
      options.regions = options.tile = 128;
      options.max_error = error;
      options.lossless = error == 0 ? 1 : 0;
      const Bytes mosaic = mosaicOf(source, options);
      const tks_encode_options whole = inRegions(error == 0 ? lossless() : within(error), 128);
      const size_t of_encoder = encode(&source.raster, nullptr, whole).size();
      constexpr double kShort = 800;  // 20 regions with codewords of their own
      EXPECT_LT(static_cast<double>(mosaic.size()), 1.1 * static_cast<double>(of_encoder) + kShort)
          << static_cast<int>(pattern) << ", " << error;
    }
  }
}

double largestError(Stream& stream, const Raster& raster) {
  std::vector<float> heights(size_t{raster.width} * raster.height);
  EXPECT_EQ(tks_decode_surface(stream.get(), heights.data(), heights.size()), TKS_OK);
  double largest = 0;
  for (size_t i = 0; i < heights.size(); ++i) {
    float sample = 0;
    std::memcpy(&sample, raster.data.data() + 4 * i, 4);
    largest =
        std::max(largest, std::abs(static_cast<double>(heights[i]) - static_cast<double>(sample)));
  }
  return largest;
}

TEST(MosaicStream, KeepsALargestError) {
  Raster rough = quarters();  // and no step at all
  for (size_t i = 0; i < rough.data.size() / 4; ++i) {
    float value = 0;
    std::memcpy(&value, rough.data.data() + 4 * i, 4);
    value = value * 1.01f + std::sqrt(static_cast<float>(i % 97));
    std::memcpy(rough.data.data() + 4 * i, &value, 4);
  }
  size_t before = SIZE_MAX;
  for (const double error : {0.01, 0.5, 7.0}) {
    Source source(rough);
    tks_mosaic_options options = mosaicOptions();
    options.max_error = error;
    const Bytes bytes = mosaicOf(source, options);
    EXPECT_LT(bytes.size(), before);
    before = bytes.size();
    Stream stream((Prefix(bytes)));
    EXPECT_EQ(stream.info().max_error, error);
    EXPECT_LE(largestError(stream, source.raster), error);
  }
}

/// A height that would be the nodata value becomes the next one.
TEST(MosaicStream, KeepsALargestErrorBesideANodataValue) {
  for (const tks_sample sample : {TKS_U8, TKS_I16}) {
    for (const double error : {1., 2., 9.}) {
      Source source(hills(sample));
      source.heights.has_nodata = 1;  // in the middle of heights that become void
      source.heights.nodata = sampleAt(source.raster.data, sample, 12345);
      tks_mosaic_options options = mosaicOptions();
      options.max_error = error;
      Stream stream(mosaicOf(source, options));
      const Raster& raster = source.raster;
      std::vector<std::byte> samples(stream.heightsBytes());
      ASSERT_EQ(tks_decode_heights(stream.get(), samples.data(), samples.size()), TKS_OK);
      for (size_t i = 0; i < size_t{raster.width} * raster.height; ++i) {
        const double truth = sampleAt(raster.data, sample, i), shown = sampleAt(samples, sample, i);
        const double nodata = source.heights.nodata;
        ASSERT_EQ(truth == nodata, shown == nodata) << i;
        ASSERT_LE(std::abs(truth - shown), error) << i;
      }
    }
  }
}

/// Squared errors of all samples of a stream of TKS_I16.
double squaresOf(const Bytes& bytes, const Raster& raster) {
  Stream stream((Prefix(bytes)));
  std::vector<int16_t> heights(size_t{raster.width} * raster.height);
  EXPECT_EQ(tks_decode_heights(stream.get(), heights.data(), 2 * heights.size()), TKS_OK);
  double squares = 0;
  for (size_t i = 0; i < heights.size(); ++i) {
    int16_t sample = 0;
    std::memcpy(&sample, raster.data.data() + 2 * i, 2);
    squares += std::pow(heights[i] - sample, 2);
  }
  return squares;
}

TEST(MosaicStream, IsAboutAsGoodAsAnEncodersWithinABudget) {
  Source source(hills(TKS_I16, 420, 400));
  for (const uint64_t bytes : {2000, 8000, 24000}) {
    tks_mosaic_options options = mosaicOptions();
    options.bytes = bytes;
    const Bytes mosaic = mosaicOf(source, options);
    EXPECT_LE(mosaic.size(), bytes);
    EXPECT_GT(mosaic.size(), bytes - 8);
    const Bytes whole = encode(&source.raster, nullptr, inRegions(budget(bytes), 32));
    EXPECT_LT(squaresOf(mosaic, source.raster), 1.1 * squaresOf(whole, source.raster)) << bytes;
  }
}

TEST(MosaicStream, ReachesAPsnr) {
  Source source(hills(TKS_I16));
  const auto [low, high] = std::pair(-32768, 32767);
  double least = high, most = low;
  for (size_t i = 0; i < source.raster.data.size() / 2; ++i) {
    int16_t sample = 0;
    std::memcpy(&sample, source.raster.data.data() + 2 * i, 2);
    least = std::min<double>(least, sample);
    most = std::max<double>(most, sample);
  }
  for (const double psnr : {30.0, 45.0}) {
    tks_mosaic_options options = mosaicOptions();
    options.psnr = psnr;
    const double mean = squaresOf(mosaicOf(source, options), source.raster) /
                        static_cast<double>(source.raster.data.size() / 2);
    const double reached = 10 * std::log10((most - least) * (most - least) / mean);
    EXPECT_GT(reached, psnr);
    EXPECT_LT(reached, psnr + 1.2);
  }
}

TEST(MosaicStream, WindowsHoldWhatThePlaneHoldsThere) {
  Source source(hills(TKS_I16, 900, 800));
  tks_mosaic_options options = mosaicOptions();
  options.lossless = 1;
  const Bytes bytes = mosaicOf(source, options, TKS_LAYOUT_WINDOWS);
  Stream stream((Prefix(bytes)));
  const tks_window window = {100, 60, 77, 81};
  std::vector<int16_t> samples(size_t{window.width} * window.height), expected(samples.size());
  ASSERT_EQ(tks_decode_heights_window(stream.get(), &window, samples.data(), 2 * samples.size()),
            TKS_OK);
  Source::read(&source, &window, expected.data());
  EXPECT_EQ(samples, expected);
  tks_ranges ranges = {};
  ASSERT_EQ(tks_needed_ranges(stream.get(), TKS_PART_HEIGHTS, &window, &ranges), TKS_OK);
  uint64_t needed = 0;
  for (size_t i = 0; i < ranges.count; ++i) needed += ranges.ranges[i].size;
  EXPECT_LT(needed, bytes.size() / 2);
  tks_free_ranges(&ranges);
}

TEST(MosaicStream, EveryPrefixDecodes) {
  Source source(hills(TKS_I16, 200, 180));
  dig(source, samples::VoidShape::kHoles);
  tks_mosaic_options options = mosaicOptions();
  options.lossless = 1;
  const Bytes bytes = mosaicOf(source, options);
  for (size_t end = 0; end <= bytes.size(); end += 1 + end / 50) {
    Stream stream(Prefix(bytes).first(end));
    if (stream.status() != TKS_OK) {
      EXPECT_EQ(stream.status(), TKS_TRUNCATED);
      continue;
    }
    std::vector<std::byte> samples(stream.heightsBytes());
    EXPECT_EQ(tks_decode_heights(stream.get(), samples.data(), samples.size()), TKS_OK);
  }
}

/// Whoever works, in whatever order each tile comes behind those that it needs, and whatever was
/// lost on the way: the stream has the same bytes.
TEST(MosaicStream, DoesNotDependOnWhoWorkedWhen) {
  Source source(hills(TKS_I16));
  dig(source, samples::VoidShape::kCoast);
  tks_mosaic_options options = mosaicOptions();
  options.lossless = 1;
  const Bytes expected = mosaicOf(source, options), plan = planOf(source, options);
  std::vector<tks_tile> tiles = tilesOf(plan);
  std::mt19937 random(1);
  for (int round = 0; round < 3; ++round) {
    Files files;
    std::shuffle(tiles.begin(), tiles.end(), random);
    size_t left = tiles.size(), runs = 0;
    while (left > 0 && ++runs < 20 * tiles.size()) {
      for (const tks_tile& tile : tiles) {
        if (isDone(plan, tile, files)) continue;
        const tks_status status =
            code(plan, tile, source, files, 1 + static_cast<uint32_t>(random() % 3));
        EXPECT_TRUE(status == TKS_OK || (status == TKS_IO && tile.group > 0));
        // A worker that is killed leaves a part, or nothing.
        if (random() % 4 == 0 && !files.all.empty())
          files.all.erase(
              std::next(files.all.begin(), static_cast<ptrdiff_t>(random() % files.all.size())));
      }
      left = static_cast<size_t>(std::count_if(
          tiles.begin(), tiles.end(), [&](const tks_tile& t) { return !isDone(plan, t, files); }));
    }
    Bytes stream;
    EXPECT_EQ(merge(plan, files, stream), TKS_OK);
    EXPECT_TRUE(stream == expected);
  }
}

TEST(MosaicStream, FindsEveryDamagedByteOfAPart) {
  Source source(hills(TKS_I16, 130, 70));
  dig(source, samples::VoidShape::kCoast);
  tks_mosaic_options options = mosaicOptions();
  options.lossless = 1;
  const Bytes plan = planOf(source, options);
  Files files;
  for (const tks_tile& tile : tilesOf(plan)) ASSERT_EQ(code(plan, tile, source, files), TKS_OK);
  Bytes expected;
  ASSERT_EQ(merge(plan, files, expected), TKS_OK);
  constexpr size_t kTable = 32;  // behind it may lie codewords, at which only the merge looks
  for (auto& [name, bytes] : files.all) {
    const bool is_low = name.ends_with(".low");
    for (size_t i = 0; i < bytes.size(); i += 1 + i / 16) {
      bytes[i] ^= 0x10;
      Bytes stream;
      const tks_status status = merge(plan, files, stream);
      EXPECT_TRUE(is_low ? status == TKS_OK && stream == expected : status == TKS_IO) << name << i;
      const std::vector<tks_tile> tiles = tilesOf(plan);
      const auto lost = [&](const tks_tile& tile) { return !isDone(plan, tile, files); };
      if (is_low || i < kTable) {
        EXPECT_TRUE(std::any_of(tiles.begin(), tiles.end(), lost)) << name << i;
      }
      bytes[i] ^= 0x10;
    }
    const Bytes whole = bytes;
    bytes.pop_back();
    Bytes stream;
    EXPECT_EQ(merge(plan, files, stream), is_low ? TKS_OK : TKS_IO);
    bytes = whole;
  }
}

TEST(MosaicStream, FindsEveryDamagedByteOfAPlan) {
  Source source(hills(TKS_I16, 130, 70));
  tks_mosaic_options options = mosaicOptions();
  options.lossless = 1;
  Bytes plan = planOf(source, options);
  size_t count = 0;
  for (size_t i = 0; i < plan.size(); ++i) {
    plan[i] ^= 1;
    const tks_status status = tks_mosaic_tiles(plan.data(), plan.size(), nullptr, 0, &count);
    EXPECT_TRUE(status == TKS_CORRUPT || (status == TKS_UNSUPPORTED && i == 4)) << i;
    plan[i] ^= 1;
    EXPECT_EQ(tks_mosaic_tiles(plan.data(), i, nullptr, 0, &count), TKS_CORRUPT);
  }
}

/// Parts of another plan are missing ones.
TEST(MosaicStream, TellsPlansApart) {
  Source source(hills(TKS_I16));
  tks_mosaic_options options = mosaicOptions();
  options.lossless = 1;
  const Bytes plan = planOf(source, options);
  Files files;
  for (const tks_tile& tile : tilesOf(plan)) ASSERT_EQ(code(plan, tile, source, files), TKS_OK);
  options.lossless = 0;
  options.max_error = 3;
  const Bytes other = planOf(source, options);
  for (const tks_tile& tile : tilesOf(other)) EXPECT_FALSE(isDone(other, tile, files));
  Bytes stream;
  EXPECT_EQ(merge(other, files, stream), TKS_IO);
}

TEST(MosaicStream, RefusesWhatItCannotPromise) {
  Source source(roots());
  tks_mosaic_options options = mosaicOptions();
  options.regions = options.tile = 512;
  options.lossless = 1;
  planOf(source, options, TKS_USAGE);  // floats without a step, in one region
  options = mosaicOptions();
  options.lossless = 1;
  options.bytes = 100;
  planOf(source, options, TKS_USAGE);  // two targets
  options = mosaicOptions();
  planOf(source, options, TKS_USAGE);  // none
  options.max_error = 1;
  options.tile = 16;
  planOf(source, options, TKS_USAGE);  // less than a region
  options.tile = 100;
  planOf(source, options, TKS_USAGE);
  options.tile = 64;
  source.heights.domain = TKS_DOMAIN_CYLINDER;
  planOf(source, options, TKS_USAGE);
  source.heights.domain = TKS_DOMAIN_PLANE;
  const tks_heights small = source.heights;
  source.heights.width = (1 << 20) + 1;
  planOf(source, options, TKS_USAGE);
  source.heights = small;
  source.fails = true;
  planOf(source, options, TKS_IO);
}

/// A source that changes under way cannot make a stream that lies.
TEST(MosaicStream, RefusesSamplesThatThePlanDoesNotAllow) {
  Source source(quarters());
  tks_mosaic_options options = mosaicOptions();
  options.lossless = 1;
  const Bytes plan = planOf(source, options);
  Files files;
  constexpr float kInfinite = std::numeric_limits<float>::infinity();
  for (const float other : {0.1f, -0.0f, 1e9f, std::nanf(""), kInfinite}) {
    std::memcpy(source.raster.data.data(), &other, sizeof other);
    EXPECT_EQ(code(plan, {0, 0, 0}, source, files), TKS_USAGE) << other;
  }
  EXPECT_EQ(files.writes, 0u);
  EXPECT_EQ(code(plan, {0, 4, 2}, source, files), TKS_OK);
  EXPECT_EQ(code(plan, {7, 0, 0}, source, files), TKS_USAGE);
  source.heights.width = 300;
  EXPECT_EQ(code(plan, {0, 1, 0}, source, files), TKS_USAGE);
}

/// What a task asks for does not grow with the plane.
TEST(MosaicStream, ReadsNoMoreThanATileAndItsHalo) {
  Source source(hills(TKS_U8, 1200, 900));
  tks_mosaic_options options = mosaicOptions();
  options.lossless = 1;
  const Bytes plan = planOf(source, options);
  source.largest = 0;
  Files files;
  EXPECT_EQ(code(plan, {0, 3, 3}, source, files), TKS_OK);
  EXPECT_EQ(source.largest, uint64_t{64 + 256} * (64 + 256));
}

}  // namespace
}  // namespace tetrakis::test

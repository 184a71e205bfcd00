// SPDX-License-Identifier: Apache-2.0
// Encoder targets: byte budgets are obeyed and used, error bounds hold, one order serves all
// budgets, and neither threads nor repetition change a byte.
#include <algorithm>
#include <cmath>

#include "bitstream/stream/header.hpp"
#include "conformance/samples/void_masks.hpp"
#include "tests/support/stream_fixture.hpp"

namespace tetrakis::test {
namespace {

using samples::make;
using samples::Pattern;
using samples::Raster;

Raster terrain() {
  return make({Pattern::kRidges, 161, 140, 1, TKS_U16});
}
/// At most the budget; at least 99 % of it as long as the lossless stream has that much to send (95
/// % below 4 kB, where a last packet that counts only when complete may not fit).
void expectBudgetUsed(const Raster* heights, const Raster* image) {
  const size_t everything = encode(heights, image, lossless()).size();
  for (const size_t bytes : {500, 1000, 2222, 4096, 10000, 32768}) {
    if (bytes >= everything) break;
    const size_t used = encode(heights, image, budget(bytes)).size();
    EXPECT_LE(used, bytes);
    EXPECT_GE(used, (bytes < 4096 ? 0.95 : 0.99) * static_cast<double>(bytes)) << "of " << bytes;
  }
  EXPECT_LE(encode(heights, image, budget(10 * everything)).size(), 3 * everything);
}

TEST(StreamRate, BudgetIsObeyedAndUsed) {
  const Raster heights = terrain(), image = photograph();
  expectBudgetUsed(&heights, nullptr);
  expectBudgetUsed(nullptr, &image);
  expectBudgetUsed(&heights, &image);
}

/// A budget beyond everything there is to send restores every sample.
TEST(StreamRate, AmpleBudgetIsLossless) {
  const Raster heights = make({Pattern::kRidges, 33, 20, 1, TKS_I16});
  const Raster image = make({Pattern::kRidges, 30, 31, 3, TKS_U8});
  for (const uint64_t ample : {uint64_t{1} << 20, (uint64_t{1} << 63) + 7, UINT64_MAX}) {
    const Bytes bytes = encode(&heights, &image, budget(ample));
    Stream stream(bytes);
    EXPECT_TRUE(stream.info().lossless);
    EXPECT_TRUE(stream.heights() == heights.data);
    EXPECT_TRUE(stream.texture() == image.data);
  }
}

/// Each component takes its own way to the last bit, whatever the other one does.
TEST(StreamRate, AmpleBudgetsOfBothTakeWhatEachTakes) {
  constexpr size_t kHeads = 1000;  // packets are shorter where two components take turns
  const Raster heights = make({Pattern::kRidges, 161, 140, 1, TKS_I16});
  for (const Raster& image : {make({Pattern::kRidges, 192, 160, 3, TKS_U8, 7}),
                              make({Pattern::kRidges, 192, 160, 3, TKS_U16, 7}),
                              make({Pattern::kRidges, 96, 80, 1, TKS_U8, 7})}) {
    const auto ample = budget(1 << 20);
    const Bytes both = encode(&heights, &image, ample);
    EXPECT_TRUE(Stream(both).info().lossless);
    EXPECT_LE(both.size(), encode(&heights, nullptr, ample).size() +
                               encode(nullptr, &image, ample).size() + kHeads);
  }
}

/// Hidden colours of a cut-out are not kept, so that such a stream is never lossless as a whole.
TEST(StreamRate, AmpleBudgetsEndHeightsExactBesideCutouts) {
  const Raster heights = make({Pattern::kRidges, 161, 140, 1, TKS_I16});
  Raster cutout = make({Pattern::kRidges, 192, 160, 4, TKS_U8, 7});
  for (size_t i = 3; i < cutout.data.size(); i += 4)
    cutout.data[i] = cutout.data[i] > std::byte{99} ? std::byte{255} : std::byte{0};
  const auto ample = budget(1 << 20);
  const Bytes both = encode(&heights, &cutout, ample);
  Stream stream(both);
  EXPECT_TRUE(stream.heights() == heights.data);
  const size_t alone = encode(nullptr, &cutout, ample).size();
  EXPECT_LE(both.size(), alone + encode(&heights, nullptr, lossless()).size() * 5 / 4);
}

/// Who can afford the last bit gets it behind prefixes that are as good as without it, but for the
/// bytes of a checksum.
TEST(StreamRate, AmpleBudgetsKeepPrefixes) {
  const Raster heights = terrain(), image = photograph();
  const Bytes ample = encode(&heights, nullptr, budget(1 << 20)),
              texels = encode(nullptr, &image, budget(1 << 20));
  EXPECT_TRUE(Stream(ample).info().lossless && Stream(texels).info().lossless);
  const size_t least = encode(&heights, nullptr, lossless()).size();
  const Bytes lossy = encode(&heights, nullptr, budget(least * 4 / 5)),
              photo = encode(nullptr, &image, budget(texels.size() / 2));
  const auto promises = [](const Bytes& whole, const Bytes& part) {
    return Stream(whole).info().header_bytes - Stream(part).info().header_bytes;
  };
  for (const size_t bytes : {500, 1500, 4000, 9000}) {
    EXPECT_LE(squaredError(heights,
                           Stream(Prefix(ample).first(bytes + promises(ample, lossy))).heights()),
              squaredError(heights, Stream(Prefix(lossy).first(bytes)).heights()) * 1.02)
        << bytes;
    EXPECT_LE(squaredError(image,
                           Stream(Prefix(texels).first(bytes + promises(texels, photo))).texture()),
              squaredError(image, Stream(Prefix(photo).first(bytes)).texture()) * 1.05)
        << bytes;
  }
}

/// The samples of a raster as floats, or as integers of all 32 bits: no steps show them.
Raster onNoGrid(const Raster& raster, tks_sample type) {
  Raster out{raster.width, raster.height, 1, type, {}};
  const size_t count = size_t{raster.width} * raster.height;
  out.data.resize(count * 4);
  for (size_t i = 0; i < count; ++i) {
    const double value = sampleAt(raster.data, raster.sample, i);
    const auto real = static_cast<float>(std::sqrt(value + 2) / 7);
    const auto wide = static_cast<int32_t>(value * 32768 - 1e9) + static_cast<int32_t>(i % 17);
    std::memcpy(&out.data[4 * i], type == TKS_F32 ? static_cast<const void*>(&real) : &wide, 4);
  }
  return out;
}

/// Such heights come back too, and what restores them comes behind the lossy stream.
TEST(StreamRate, AmpleBudgetsRestoreWhatIsOnNoGrid) {
  for (const tks_sample type : {TKS_F32, TKS_I32}) {
    const Raster heights = onNoGrid(terrain(), type);
    const size_t least = encode(&heights, nullptr, lossless()).size();
    const Bytes ample = encode(&heights, nullptr, budget(least * 5 / 4)),
                lossy = encode(&heights, nullptr, budget(least / 2));
    Stream stream(ample);
    EXPECT_TRUE(stream.info().lossless) << type;
    EXPECT_TRUE(stream.heights() == heights.data) << type;
    const size_t header = static_cast<size_t>(stream.info().header_bytes);
    const size_t lossy_header = static_cast<size_t>(Stream(lossy).info().header_bytes);
    for (const size_t bytes : {300, 1500, 4000, 9000}) {
      EXPECT_LE(
          squaredError(heights, Stream(Prefix(ample).first(header + bytes)).heights()),
          squaredError(heights, Stream(Prefix(lossy).first(lossy_header + bytes)).heights()) * 1.02)
          << bytes;
    }
  }
}

/// Whole metres of a surface as smooth as it may be.
Raster roundedHills(double height) {
  Raster hills = make({Pattern::kRidges, 120, 90, 1, TKS_I16});
  auto* out = reinterpret_cast<int16_t*>(hills.data.data());
  for (uint32_t y = 0; y < 90; ++y) {
    for (uint32_t x = 0; x < 120; ++x)
      *out++ = static_cast<int16_t>(std::lround(height * std::sin(x / 29.) * std::cos(y / 23.)));
  }
  return hills;
}

/// Of smooth heights the coefficients are cut, and corrections restore the samples: no budget finds
/// a shorter stream to the last bit. A third of it is as good as of the stream for an ample budget,
/// whose cut lies later.
TEST(StreamRate, LosslessIsTheShortestWayToTheLastBit) {
  for (const double height : {40., 90.}) {
    const Raster hills = roundedHills(height);
    const Bytes whole = encode(&hills, nullptr, lossless()),
                ample = encode(&hills, nullptr, budget(1 << 20));
    Stream stream(whole), exact(ample);
    EXPECT_TRUE(stream.heights() == hills.data && exact.heights() == hills.data);
    EXPECT_LE(whole.size(), ample.size());
    const size_t third = whole.size() / 3;
    EXPECT_LE(squaredError(hills, Stream(Prefix(whole).first(third)).heights()),
              squaredError(hills, Stream(Prefix(ample).first(third)).heights()) * 1.1);
  }
}

/// Woods on open ground, whose height is far below the middle of all.
TEST(StreamRate, HeightsOfWhichNothingIsKnownAreAtTheirMean) {
  Raster woods = make({Pattern::kRidges, 150, 130, 1, TKS_U16, 4});
  auto* const heights = reinterpret_cast<uint16_t*>(woods.data.data());
  const size_t count = woods.data.size() / sizeof *heights;
  std::vector<uint16_t> sorted(heights, heights + count);
  std::sort(sorted.begin(), sorted.end());
  const uint16_t ground = sorted[count * 8 / 10];
  double sum = 0, squares = 0;
  for (size_t i = 0; i < count; ++i) {
    heights[i] = static_cast<uint16_t>(heights[i] > ground ? heights[i] - ground : 0);
    const double height = heights[i];
    sum += height;
    squares += height * height;
  }
  const double spread = squares - sum * sum / static_cast<double>(count);
  for (const tks_encode_options& options : {lossless(), budget(3000), within(9)}) {
    const Bytes stream = encode(&woods, nullptr, options);
    const size_t header = static_cast<size_t>(Stream(stream).info().header_bytes);
    EXPECT_LE(squaredError(woods, Stream(Prefix(stream).first(header)).heights()), spread * 1.01);
  }
}

/// Corrected samples are what surfaces and meshes pass through, as far as a prefix tells.
TEST(StreamRate, SurfacesPassThroughCorrectedSamples) {
  const Raster hills = roundedHills(90);
  const Bytes whole = encode(&hills, nullptr, lossless());
  const size_t samples = size_t{hills.width} * hills.height;
  const auto exactly = [&](Prefix prefix) {
    Stream stream(prefix);
    std::vector<float> surface(samples);
    EXPECT_EQ(tks_decode_surface(stream.get(), surface.data(), samples), TKS_OK);
    size_t count = 0;
    for (size_t i = 0; i < samples; ++i)
      count += surface[i] == static_cast<float>(sampleAt(hills.data, TKS_I16, i));
    return count;
  };
  EXPECT_EQ(exactly(whole), samples);
  size_t last = 0;
  for (const size_t eighths : {4, 6, 7, 8}) {
    const size_t now = exactly(Prefix(whole).first(whole.size() * eighths / 8));
    EXPECT_GT(now, last) << eighths;
    last = now;
  }
}

/// The smaller stream begins as the larger one does, behind the header. How errors fall beyond half
/// of a budget is extrapolated, so that the order may differ from there on.
TEST(StreamRate, BudgetsShareOneOrder) {
  const Raster heights = terrain(), image = photograph();
  const Bytes small = encode(&heights, &image, budget(6000));
  const Bytes large = encode(&heights, &image, budget(24000));
  const auto payload = [](const Bytes& bytes) {
    return Prefix(bytes).subspan(static_cast<size_t>(Stream(bytes).info().header_bytes));
  };
  const Prefix a = payload(small), b = payload(large);
  ASSERT_LT(a.size(), b.size());
  const auto equal = std::mismatch(a.begin(), a.end(), b.begin()).first - a.begin();
  EXPECT_GE(static_cast<size_t>(equal), a.size() / 3);
}

TEST(StreamRate, MoreBytesMeanLessError) {
  const Raster heights = terrain(), image = photograph();
  double last_heights = HUGE_VAL, last_texture = HUGE_VAL;
  for (const size_t bytes : {1000, 4000, 16000, 64000}) {
    const Bytes coded = encode(&heights, &image, budget(bytes));
    Stream stream(coded);
    const double h = squaredError(heights, stream.heights());
    const double t = squaredError(image, stream.texture());
    // The picture may need the bytes in one of them alone.
    EXPECT_LE(h, last_heights) << bytes;
    EXPECT_LE(t, last_texture) << bytes;
    EXPECT_TRUE(h < last_heights || t < last_texture) << bytes;
    last_heights = h;
    last_texture = t;
  }
}

TEST(StreamRate, MaxErrorHolds) {
  for (const Pattern pattern : {Pattern::kRidges, Pattern::kSteps, Pattern::kExtreme}) {
    const Raster raster = make({pattern, 60, 45, 1, TKS_I16});
    tks_heights heights = raster.heights();
    heights.scale = 0.5;
    heights.unit = "m";
    for (const double bound : {0.5, 3.0, 40.0, 1000.0}) {
      const Bytes bytes = encodeHeights(heights, within(bound));
      Stream stream(bytes);
      const double largest = largestError(raster, stream.heights()) * heights.scale;
      EXPECT_LE(largest, bound);
      EXPECT_GE(stream.info().max_error, largest) << "what the header guarantees";
      EXPECT_LE(stream.info().max_error, bound);
    }
  }
}

TEST(StreamRate, PsnrIsReached) {
  const Raster heights = terrain(), image = photograph();
  const double range = [&] {
    double low = HUGE_VAL, high = -HUGE_VAL;
    for (size_t i = 0; i < heights.data.size() / 2; ++i) {
      low = std::min(low, sampleAt(heights.data, TKS_U16, i));
      high = std::max(high, sampleAt(heights.data, TKS_U16, i));
    }
    return high - low;
  }();
  size_t last = 0;
  for (const double target : {30.0, 40.0, 50.0}) {
    tks_encode_options options = budget(0);
    options.psnr = target;
    const Bytes bytes = encode(&heights, &image, options);
    Stream stream(bytes);
    const double h = squaredError(heights, stream.heights()) / (161 * 140);
    const double t = squaredError(image, stream.texture()) / (192 * 160 * 3);
    EXPECT_GE(10 * std::log10(range * range / h), target);
    EXPECT_GE(10 * std::log10(255 * 255 / t), target);
    EXPECT_GT(bytes.size(), last);
    last = bytes.size();
  }
}

tks_encode_options psnr(double target) {
  tks_encode_options options = budget(0);
  options.psnr = target;
  return options;
}

double psnrOf(const Raster& image, Prefix bytes) {
  const double squares = squaredError(image, Stream(bytes).texture());
  return 10 * std::log10(255 * 255 * static_cast<double>(image.data.size()) / squares);
}

TEST(StreamRate, PsnrTakesNoMoreBytesThanItNeeds) {
  const Raster image = photograph();
  for (const double target : {28.0, 33.0, 41.0}) {
    const Bytes bytes = encode(nullptr, &image, psnr(target));
    EXPECT_GE(psnrOf(image, bytes), target);
    EXPECT_LT(psnrOf(image, Prefix(bytes).first(bytes.size() - bytes.size() / 50)), target);
    EXPECT_LE(Stream(bytes).info().texture_psnr, psnrOf(image, bytes) + 1e-9) << "what is stated";
  }
}

TEST(StreamRate, NoPsnrIsDearerThanTheLastBit) {
  const Raster image = photograph(), heights = terrain();
  const size_t most = encode(&heights, &image, lossless()).size();
  for (const double target : {60.0, 90.0})
    EXPECT_LE(encode(&heights, &image, psnr(target)).size(), most) << target;
}

/// Where the lossless stream nearly fits, its header and heads included, the lossy one goes on.
TEST(StreamRate, LargerBudgetsNextToTheLastBitAreNoWorse) {
  const Raster image = make({Pattern::kRidges, 96, 80, 3, TKS_U8, 7});
  const uint64_t most = encode(nullptr, &image, budget(1 << 20)).size();
  double before = 0;
  for (uint64_t bytes = most - 60; bytes < most + 20; bytes += 2) {
    const double now = psnrOf(image, encode(nullptr, &image, budget(bytes)));
    EXPECT_GE(now, before - 0.03) << bytes << " of " << most;
    before = now;
  }
  EXPECT_EQ(before, HUGE_VAL);
}

/// A drawing is complete for few bytes; the wavelet reaches what is asked for with fewer.
TEST(StreamRate, PsnrOfDrawingsTakesNoMoreBytesThanWavelets) {
  Raster ramp = make({Pattern::kRamp, 200, 180, 1, TKS_U8});
  for (std::byte& sample : ramp.data) sample &= std::byte{0xf8};
  for (const double target : {30.0, 35.0, 40.0}) {
    const Bytes stream = encode(nullptr, &ramp, psnr(target));
    const size_t fewer = std::max(stream.size() * 3 / 4, readHeader(stream)->bytes);
    EXPECT_LT(psnrOf(ramp, encode(nullptr, &ramp, budget(fewer))), target) << stream.size();
  }
}

/// What is drawn over a photograph may be coded by itself, but not before that pays.
TEST(StreamRate, LargerBudgetsOfOverlaysAreNoWorse) {
  Raster image = make({Pattern::kRidges, 200, 150, 3, TKS_U8, 4});
  samples::drawOver(image, samples::validity(samples::VoidShape::kCoast, 200, 150));
  double before = 0;
  for (const uint64_t bytes : {400, 800, 1200, 1600, 2400, 3200, 6400}) {
    const double now = psnrOf(image, encode(nullptr, &image, budget(bytes)));
    EXPECT_GT(now, before - 0.03) << bytes;
    before = now;
  }
}

TEST(StreamRate, ThreadsAndRepetitionChangeNothing) {
  const Raster heights = terrain(), image = photograph();
  tks_encode_options options = budget(12000);
  const Bytes once = encode(&heights, &image, options);
  for (const uint32_t threads : {1u, 2u, 4u}) {
    options.threads = threads;
    EXPECT_TRUE(encode(&heights, &image, options) == once) << threads << " threads";
  }
}

/// Seen at a flat angle, heights matter more than from above, where they still matter.
TEST(StreamRate, CamerasShareTheBytes) {
  // 255 metres high, 5 kilometres wide.
  const Raster heights = make({Pattern::kRidges, 161, 140, 1, TKS_U8}), image = photograph();
  const auto geometryBytes = [&](double up, double back) {
    tks_camera camera = {"one", {0, up, back}, {0, 0, 0}, {0, 1, -0.01}, 40, 768, 512, 1};
    tks_encode_options options = budget(8000);
    options.cameras = &camera;
    options.camera_count = 1;
    return Stream(encode(&heights, &image, options)).info().geometry_bytes;
  };
  const uint64_t above = geometryBytes(8e3, 1), aside = geometryBytes(3e3, 6e3);
  EXPECT_LT(above, aside);
  EXPECT_GT(above, 0u);
}

/// A renderer that sees squared errors of either component.
struct Taste {
  double heights, texels;
  const Raster *surface, *photo;
  size_t asked = 0;
};

template <class T>
double squaresOfSamples(const Raster& raster, const void* shown) {
  double sum = 0;
  for (size_t i = 0; i < raster.data.size() / sizeof(T); ++i) {
    const auto truth = static_cast<double>(reinterpret_cast<const T*>(raster.data.data())[i]);
    const double error = static_cast<double>(static_cast<const T*>(shown)[i]) - truth;
    sum += error * error;
  }
  return sum;
}

int errorByTaste(void* user, const void* heights, const void* texels, double* sum, double* values) {
  auto& likes = *static_cast<Taste*>(user);
  ++likes.asked;
  *sum = likes.heights * squaresOfSamples<uint16_t>(*likes.surface, heights) +
         likes.texels * squaresOfSamples<uint8_t>(*likes.photo, texels);
  *values = 1;
  return 0;
}

/// The encoder asks a renderer for pairs of samples as the caller gave them, and shares the bytes
/// by what it says. One that fails is done without.
TEST(StreamRate, RenderersShareTheBytes) {
  const Raster heights = terrain(), image = photograph();
  tks_encode_options options = budget(8000);
  options.picture_error = errorByTaste;
  const auto geometryBytes = [&](double likes_heights) {
    Taste taste{likes_heights, 1, &heights, &image};
    options.picture_user = &taste;
    const Bytes stream = encode(&heights, &image, options);
    EXPECT_GT(taste.asked, 4u);
    EXPECT_LE(taste.asked, 90u);
    return Stream(stream).info().geometry_bytes;
  };
  EXPECT_LT(geometryBytes(1e-4), geometryBytes(100));
  options.picture_error = [](void*, const void*, const void*, double*, double*) { return 1; };
  EXPECT_FALSE(encode(&heights, &image, options).empty());
}

}  // namespace
}  // namespace tetrakis::test

// SPDX-License-Identifier: Apache-2.0
// Masks of many holes lie behind some of the coefficients: every prefix decodes, shows voids as
// ground until it knows of them, and never a valid sample as void. The reference decoder agrees.
#include <limits>
#include <random>

#include "bitstream/stream/header.hpp"
#include "conformance/reference_decoder.hpp"
#include "conformance/samples/void_masks.hpp"
#include "tests/support/stream_fixture.hpp"

namespace tetrakis::test {
namespace {

using samples::hash;
using samples::make;
using samples::Pattern;
using samples::Raster;
using samples::VoidShape;

/// Heights of which some are void.
struct Holed {
  Raster raster;
  std::vector<uint8_t> valid;

  tks_heights heights() const {
    tks_heights h = raster.heights();
    h.has_nodata = raster.sample != TKS_F32;
    h.nodata = h.has_nodata ? -32768 : 0;
    return h;
  }
};

/// One in `of` samples is void at random, and two corners with a frame.
Holed holed(uint32_t width, uint32_t height, tks_sample sample, uint32_t of, bool frame = false) {
  Holed h{make({Pattern::kRidges, width, height, 1, sample}), {}};
  for (uint32_t y = 0; y < height; ++y) {
    for (uint32_t x = 0; x < width; ++x) {
      const bool outside = frame && (x + y < height / 2 || x + y > width + height / 2);
      const size_t i = h.valid.size();
      h.valid.push_back(hash(x, y, 7) % of != 0 && !outside);
      if (sample == TKS_I16) {  // to the last bit noise would not be worth bridging
        const auto step = static_cast<int16_t>(sampleAt(h.raster.data, sample, i) / 256);
        std::memcpy(h.raster.data.data() + 2 * i, &step, sizeof step);
      }
      const float nan = std::numeric_limits<float>::quiet_NaN();
      const int16_t nodata = -32768;
      if (h.valid[i]) continue;
      if (sample == TKS_F32) std::memcpy(h.raster.data.data() + 4 * i, &nan, sizeof nan);
      if (sample == TKS_I16) std::memcpy(h.raster.data.data() + 2 * i, &nodata, sizeof nodata);
    }
  }
  return h;
}

/// One in `of` samples is valid, at random.
Holed soundings(uint32_t width, uint32_t height, uint32_t of) {
  Holed h{make({Pattern::kRidges, width, height, 1, TKS_I16}), {}};
  for (uint32_t y = 0; y < height; ++y) {
    for (uint32_t x = 0; x < width; ++x) {
      const size_t i = h.valid.size();
      h.valid.push_back(hash(x, y, 7) % of == 0);
      const int16_t nodata = -32768;
      if (!h.valid[i]) std::memcpy(h.raster.data.data() + 2 * i, &nodata, sizeof nodata);
    }
  }
  return h;
}

GeometryLayers layersOf(const Bytes& bytes) {
  return readHeader(bytes)->header.layers;
}

/// Squared error over the valid samples.
double squaresOf(const Holed& h, const std::vector<std::byte>& decoded) {
  double squares = 0;
  for (size_t i = 0; i < h.valid.size(); ++i) {
    if (!h.valid[i]) continue;
    const double error =
        sampleAt(decoded, h.raster.sample, i) - sampleAt(h.raster.data, h.raster.sample, i);
    squares += error * error;
  }
  return squares;
}

struct Case {
  const char* name;
  Holed heights;
  tks_encode_options options;
};

std::vector<Case> cases() {
  const Holed third = holed(95, 80, TKS_I16, 3), some = holed(110, 81, TKS_F32, 5);
  const Holed framed = holed(210, 190, TKS_I16, 4, true);
  tks_encode_options psnr = budget(0);
  psnr.psnr = 45;
  return {{"a third, lossless", third, lossless()},
          {"a third, in a budget", third, budget(2500)},
          {"floats, in a budget", some, budget(2500)},
          {"floats, within a bound", some, within(30)},
          {"floats, of a PSNR", some, psnr},
          {"in a frame, lossless", framed, lossless()},
          {"in a frame, in regions", framed, inRegions(lossless())},
          {"in a frame, in regions and a budget", framed, inRegions(budget(11000))}};
}

/// Once the opening is there, voids are found one by one, and no valid sample is taken for one. So
/// prefixes know at least as much of the heights as those whose mask comes first.
TEST(LateMask, PrefixesShowGroundUntilTheyKnowOfVoids) {
  for (const Case& c : cases()) {
    SCOPED_TRACE(c.name);
    const Bytes bytes = encodeHeights(c.heights.heights(), c.options);
    const GeometryLayers layers = layersOf(bytes);
    ASSERT_TRUE(layers.late_mask);
    ASSERT_LE(layers.validity_after, layers.validity_bytes);
    const size_t header = readHeader(bytes)->bytes;
    const size_t step = std::max<size_t>(1, (bytes.size() - header) / 150);
    std::vector<uint8_t> before(c.heights.valid.size(), 1);
    bool opened = false, known = false;
    for (size_t n = header; n <= bytes.size();
         n = n < bytes.size() ? std::min(n + step, bytes.size()) : n + 1) {
      Stream stream(Prefix(bytes).first(n));
      ASSERT_EQ(stream.status(), TKS_OK) << n;
      const std::vector<uint8_t> valid = stream.validity();
      opened |= stream.info().geometry_bytes > layers.openingBytes() + 64;
      for (size_t i = 0; i < valid.size() && opened; ++i) {
        ASSERT_LE(c.heights.valid[i], valid[i]) << n;
        ASSERT_LE(valid[i], before[i]) << n;
      }
      if (opened) before = valid;
      known = stream.info().voids_known != 0;
      ASSERT_TRUE(!known || valid == c.heights.valid) << n;
    }
    EXPECT_TRUE(known);
    EXPECT_TRUE(before == c.heights.valid);
  }
}

TEST(LateMask, HalfOfAPrefixIsHeights) {
  const Holed h = holed(120, 100, TKS_I16, 2);
  const Bytes bytes = encodeHeights(h.heights(), lossless());
  const GeometryLayers layers = layersOf(bytes);
  ASSERT_TRUE(layers.late_mask);
  EXPECT_EQ(layers.lifted_bytes, 0u);
  EXPECT_GT(layers.validity_after, layers.validity_bytes * 2 / 5);
  Raster filled = h.raster;
  for (size_t i = 0; i < h.valid.size(); ++i)
    if (!h.valid[i]) std::memset(filled.data.data() + 2 * i, 0, 2);
  const size_t masked = readHeader(bytes)->bytes + layers.maskEnd() + 64;
  Stream before(Prefix(bytes).first(readHeader(bytes)->bytes + layers.validity_bytes / 2));
  Stream behind(Prefix(bytes).first(masked));
  EXPECT_EQ(before.info().voids_known, 0);
  EXPECT_EQ(behind.info().voids_known, 1);
  double range = 0;
  for (size_t i = 0; i < h.valid.size(); ++i) range += h.valid[i] ? 256. * 256 : 0;
  EXPECT_LT(squaresOf(h, before.heights()), range / 100) << "a tenth of the range";
  EXPECT_LT(squaresOf(h, behind.heights()), squaresOf(h, before.heights()));
}

TEST(LateMask, SolidAndShortMasksComeFirst) {
  for (const VoidShape shape : {VoidShape::kFrame, VoidShape::kHalf, VoidShape::kOneVoid}) {
    Holed h = holed(96, 96, TKS_I16, 1u << 31);
    const int16_t nodata = -32768;
    const std::vector<uint8_t> valid = samples::validity(shape, 96, 96);
    for (size_t i = 0; i < valid.size(); ++i)
      if (!valid[i]) std::memcpy(h.raster.data.data() + 2 * i, &nodata, sizeof nodata);
    EXPECT_FALSE(layersOf(encodeHeights(h.heights(), lossless())).late_mask) << shape;
  }
  const Holed few = holed(40, 31, TKS_I16, 30);
  EXPECT_FALSE(layersOf(encodeHeights(few.heights(), lossless())).late_mask);
}

/// The mask is in every stream that has room for it, also where a texture is worth more to cameras.
TEST(LateMask, BudgetsHoldIt) {
  const Holed h = holed(100, 90, TKS_I16, 3);
  const Raster image = make({Pattern::kRidges, 128, 128, 3, TKS_U8, 3});
  const tks_heights heights = h.heights();
  const tks_image texels = image.image();
  for (const uint64_t bytes : {2500u, 4000u, 9000u}) {
    for (const tks_image* texture : {static_cast<const tks_image*>(nullptr), &texels}) {
      const Bytes stream = encodeGiven(&heights, texture, budget(bytes));
      ASSERT_LE(stream.size(), bytes);
      ASSERT_TRUE(layersOf(stream).late_mask);
      Stream opened(stream);
      EXPECT_EQ(opened.info().voids_known, 1) << bytes;
      EXPECT_TRUE(opened.validity() == h.valid) << bytes;
    }
  }
}

/// Streams of so many bytes, and a sixth more each time, hold next to nothing of the heights
/// in none, and all of the mask from some size on.
void expectNoStarving(const Holed& h, uint64_t bytes, uint64_t most) {
  double least = std::numeric_limits<double>::infinity();
  bool unknown = false, known = false;
  for (; bytes < most; bytes += bytes / 6) {
    Stream stream(encodeHeights(h.heights(), budget(bytes)));
    const bool held = stream.info().voids_known != 0;
    EXPECT_TRUE(held || !known) << bytes;
    (held ? known : unknown) = true;
    const double squares = squaresOf(h, stream.heights());
    EXPECT_LE(squares, 4 * least) << bytes;
    least = std::min(least, squares);
  }
  EXPECT_TRUE(unknown && known);
}

TEST(LateMask, DoesNotStarveTheHeights) {
  expectNoStarving(holed(100, 90, TKS_I16, 3), 900, 3200);
}

/// Bridges over most of the plane cost more than they save, but for the mask, which is the dearest.
TEST(LateMask, MaskOfFewSoundingsDoesNotStarveThem) {
  const Holed h = soundings(200, 180, 60);
  expectNoStarving(h, 300, 2500);
  const double all = squaresOf(h, Stream(encodeHeights(h.heights(), budget(150))).heights());
  EXPECT_LT(4 * squaresOf(h, Stream(encodeHeights(h.heights(), budget(1000))).heights()), all);
}

TEST(LateMask, ReferenceDecoderAgrees) {
  for (const Case& c : cases()) {
    SCOPED_TRACE(c.name);
    const Bytes bytes = encodeHeights(c.heights.heights(), c.options);
    const size_t header = readHeader(bytes)->bytes;
    const size_t parts = c.heights.valid.size() < 20000 ? 12 : 3;  // that takes a second
    for (size_t part = 0; part <= parts; ++part) {
      const Prefix prefix = Prefix(bytes).first(header + (bytes.size() - header) * part / parts);
      for (const int level : {0, 2}) {
        const reference::Decoded decoded =
            reference::decode(prefix, reference::kMaxSamples, {level, level});
        Stream stream(prefix);
        ASSERT_EQ(tks_set_levels(stream.get(), static_cast<uint32_t>(level), 0), TKS_OK);
        std::vector<std::byte> ours(decoded.heights->size());
        ASSERT_EQ(tks_decode_heights(stream.get(), ours.data(), ours.size()), TKS_OK);
        ASSERT_EQ(std::memcmp(ours.data(), decoded.heights->data(), ours.size()), 0) << part;
      }
    }
  }
}

/// A decoder that gets more and more bytes remembers masks and coefficients; so does one that gets
/// them in any order.
TEST(LateMask, GrowingStreamsAreLikeFreshOnes) {
  for (const Case& c : cases()) {
    SCOPED_TRACE(c.name);
    tks_encode_options options = c.options;
    options.index = TKS_INDEX_PACKETS;
    const Bytes bytes = encodeHeights(c.heights.heights(), options);
    const size_t header = readHeader(bytes)->bytes;
    Stream growing(Prefix(bytes).first(header)), put(Prefix(bytes).first(header));
    std::mt19937 random(4);
    for (size_t n = header; n < bytes.size();) {
      const size_t more = std::min<size_t>(1 + random() % 1500, bytes.size() - n);
      ASSERT_EQ(tks_append(growing.get(), bytes.data() + n, more), TKS_OK);
      n += more;
      Stream fresh(Prefix(bytes).first(n));
      ASSERT_TRUE(growing.heights() == fresh.heights()) << n;
    }
    for (size_t end = bytes.size(); end > header;) {
      const size_t begin = std::max(header, end - std::min<size_t>(end, 700));
      ASSERT_EQ(tks_put(put.get(), begin, bytes.data() + begin, end - begin), TKS_OK);
      put.heights();
      end = begin;
    }
    EXPECT_TRUE(put.heights() == Stream(bytes).heights());
  }
}

TEST(LateMask, WindowsAndMeshesOfPrefixes) {
  const Holed h = holed(330, 290, TKS_I16, 4, true);
  for (const uint32_t regions : {1u, 16u}) {
    const Bytes bytes = encodeHeights(h.heights(), inRegions(lossless(), regions));
    const size_t header = readHeader(bytes)->bytes;
    for (size_t part = 1; part <= 6; ++part) {
      const Prefix prefix = Prefix(bytes).first(header + (bytes.size() - header) * part / 6);
      Stream stream(prefix), windows(prefix);
      const std::vector<std::byte> whole = stream.heights();
      const std::vector<uint8_t> valid = stream.validity();
      for (const tks_window& window : {tks_window{0, 0, 33, 20}, tks_window{41, 37, 69, 53}}) {
        std::vector<int16_t> samples(size_t{window.width} * window.height);
        ASSERT_EQ(tks_decode_heights_window(windows.get(), &window, samples.data(),
                                            samples.size() * sizeof(int16_t)),
                  TKS_OK);
        for (size_t i = 0; i < samples.size(); ++i) {
          const size_t at = (window.y + i / window.width) * 330 + window.x + i % window.width;
          ASSERT_EQ(samples[i], sampleAt(whole, TKS_I16, at)) << part;
        }
      }
      tks_mesh mesh = {};
      ASSERT_EQ(tks_decode_mesh(stream.get(), TKS_MESH_BUDGET, 300, &mesh), TKS_OK);
      for (uint32_t i = 0; i < mesh.vertex_count; ++i)
        EXPECT_TRUE(valid[mesh.grid_index[i]]) << part;
      tks_free_mesh(&mesh);
    }
  }
}

/// Whatever byte is damaged, decoding ends, with samples or with a status.
TEST(LateMask, DamagedBytesReturn) {
  const Holed h = holed(95, 80, TKS_I16, 2);
  const Bytes bytes = encodeHeights(h.heights(), lossless());
  const size_t step = std::max<size_t>(1, bytes.size() / 500);
  for (size_t i = 0; i < bytes.size(); i += step) {
    Bytes damaged = bytes;
    damaged[i] ^= 0x41;
    const tks_limits limits = smallLimits();
    Stream stream(damaged, &limits);
    if (stream.status() != TKS_OK) continue;
    std::vector<std::byte> out(stream.heightsBytes());
    const tks_status status = tks_decode_heights(stream.get(), out.data(), out.size());
    EXPECT_TRUE(status == TKS_OK || status == TKS_LIMIT) << i;
  }
}

}  // namespace
}  // namespace tetrakis::test

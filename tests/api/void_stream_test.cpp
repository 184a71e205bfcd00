// SPDX-License-Identifier: Apache-2.0
// Whole streams of heights with voids: nodata and NaN come back where they were, whatever the type,
// the shape of the voids and the target; every prefix decodes; meshes stay off voids.
#include <limits>
#include <optional>
#include <type_traits>

#include "conformance/samples/void_masks.hpp"
#include "tests/support/stream_fixture.hpp"

namespace tetrakis::test {
namespace {

using samples::kVoidShapes;
using samples::make;
using samples::Pattern;
using samples::Raster;
using samples::validity;
using samples::VoidShape;

/// A raster of which some samples hold a nodata value that no height has.
struct Holed {
  Raster raster;
  std::vector<uint8_t> valid;
  std::optional<double> nodata;  ///< without: NaN

  tks_heights heights() const {
    tks_heights h = raster.heights();
    h.has_nodata = nodata.has_value();
    h.nodata = nodata.value_or(0);
    return h;
  }
};

template <class T>
void put(Raster& raster, size_t index, T value) {
  std::memcpy(raster.data.data() + index * sizeof value, &value, sizeof value);
}

/// 16-bit heights get -32768, floats NaN.
Holed holed(VoidShape shape, tks_sample sample, uint32_t width, uint32_t height) {
  Holed h{make({Pattern::kRidges, width, height, 1, sample}), validity(shape, width, height), {}};
  if (sample == TKS_I16) h.nodata = -32768;
  for (size_t i = 0; i < h.valid.size(); ++i) {
    if (sample == TKS_I16 && sampleAt(h.raster.data, sample, i) == -32768)
      put(h.raster, i, int16_t{-32767});
    if (h.valid[i]) continue;
    if (sample == TKS_I16) put(h.raster, i, int16_t{-32768});
    if (sample == TKS_F32) put(h.raster, i, std::numeric_limits<float>::quiet_NaN());
  }
  return h;
}

Bytes encodeHoled(const Holed& h, const tks_encode_options& options) {
  return encodeHeights(h.heights(), options);
}

/// Largest error over valid samples; fails where void and valid samples are mixed up.
double checkedError(const Holed& h, Stream& stream) {
  EXPECT_EQ(stream.validity(), h.valid);
  const auto decoded = stream.heights();
  double largest = 0;
  for (size_t i = 0; i < h.valid.size(); ++i) {
    const double value = sampleAt(decoded, h.raster.sample, i);
    const bool is_void = h.nodata ? value == *h.nodata : std::isnan(value);
    EXPECT_EQ(is_void, !h.valid[i]);
    if (h.valid[i])
      largest = std::max(largest, std::abs(value - sampleAt(h.raster.data, h.raster.sample, i)));
  }
  return largest;
}

TEST(VoidStream, LosslessRestoresEverything) {
  for (const VoidShape shape : kVoidShapes) {
    for (const tks_sample sample : {TKS_I16, TKS_F32}) {
      for (const uint32_t width : {2u, 5u, 70u}) {
        const Holed h = holed(shape, sample, width, width < 70 ? 9 : 33);
        const Bytes bytes = encodeHoled(h, lossless());
        Stream stream(bytes);
        ASSERT_EQ(stream.status(), TKS_OK);
        EXPECT_TRUE(stream.info().lossless);
        EXPECT_EQ(stream.info().has_nodata != 0, h.nodata.has_value());
        EXPECT_EQ(checkedError(h, stream), 0) << int(shape) << " " << width;
        EXPECT_EQ(tks_verify(stream.get()), TKS_OK);
      }
    }
  }
}

TEST(VoidStream, BoundsHoldForValidSamples) {
  for (const VoidShape shape : kVoidShapes) {
    for (const double error : {40.0, 900.0}) {
      const Holed h = holed(shape, TKS_I16, 50, 41);
      const Bytes bytes = encodeHoled(h, within(error));
      Stream stream(bytes);
      EXPECT_LE(checkedError(h, stream), error);
    }
  }
}

/// The last bits of a mask may tell of heights that are off by as much as voids count. They are
/// within the bound, so they have to be there.
TEST(VoidStream, BoundsHoldForTheLastHeightOfAColumn) {
  constexpr uint32_t kRows = 176;
  Holed h{make({Pattern::kFlat, 1, kRows, 1, TKS_U8}), std::vector<uint8_t>(kRows), 255};
  std::fill(h.raster.data.begin(), h.raster.data.end(), std::byte{255});
  for (const auto& [row, height] : {std::pair{4u, 0},
                                    {24u, 0},
                                    {32u, 0},
                                    {40u, 3},
                                    {46u, 0},
                                    {51u, 0},
                                    {52u, 0},
                                    {54u, 0},
                                    {74u, 0},
                                    {86u, 4},
                                    {99u, 0},
                                    {111u, 1},
                                    {138u, 4},
                                    {146u, 0},
                                    {149u, 1},
                                    {157u, 0},
                                    {163u, 3},
                                    {164u, 5},
                                    {173u, 4}}) {
    h.raster.data[row] = std::byte(height);
    h.valid[row] = 1;
  }
  for (const double error : {3., 8., 60.}) {
    const Bytes bytes = encodeHoled(h, within(error));
    Stream stream(bytes);
    EXPECT_LE(checkedError(h, stream), error);
  }
}

/// Where all valid heights are one, nothing but the mask is left to send.
TEST(VoidStream, PsnrIsReachedByOneHeightAndByNone) {
  Holed h{make({Pattern::kFlat, 64, 64, 1, TKS_I32}), std::vector<uint8_t>(64 * 64, 1), -5};
  tks_encode_options psnr = budget(0);
  psnr.psnr = 99;
  for (const size_t voids : {64 * 32, 64 * 64}) {
    for (size_t i = 0; i < voids; ++i) {
      put(h.raster, i, int32_t{-5});
      h.valid[i] = 0;
    }
    const Bytes bytes = encodeHoled(h, psnr);
    Stream stream(bytes);
    EXPECT_EQ(checkedError(h, stream), 0) << voids;
  }
}

/// Nothing of the nodata value is left in the heights beside it, at a rate where much is lost.
TEST(VoidStream, NodataDoesNotBleed) {
  Holed h = holed(VoidShape::kCoast, TKS_F32, 65, 65);
  h.nodata = -3e38;
  for (size_t i = 0; i < h.valid.size(); ++i) {
    if (!h.valid[i]) put(h.raster, i, static_cast<float>(*h.nodata));
  }
  h.nodata = static_cast<double>(static_cast<float>(*h.nodata));
  const Bytes bytes = encodeHoled(h, budget(1200));
  Stream stream(bytes);
  EXPECT_LT(checkedError(h, stream), 1500) << "the heights span 4096";
}

TEST(VoidStream, EveryPrefixDecodes) {
  const Holed h = holed(VoidShape::kCoast, TKS_I16, 28, 25);
  const Bytes bytes = encodeHoled(h, lossless());
  size_t before = SIZE_MAX;
  for (size_t n = 0; n <= bytes.size(); ++n) {
    Stream stream(Prefix(bytes).first(n));
    if (stream.status() == TKS_TRUNCATED) continue;
    ASSERT_EQ(stream.status(), TKS_OK) << n;
    const auto valid = stream.validity();
    size_t wrong = 0;
    for (size_t i = 0; i < valid.size(); ++i) wrong += valid[i] != h.valid[i];
    ASSERT_LE(wrong, before + before / 8 + 4) << "at byte " << n;
    before = std::min(before, wrong);
  }
  EXPECT_EQ(before, 0u);
}

/// A height that comes out as the nodata value would read as void: it becomes the next one.
TEST(VoidStream, HeightsNeverReadAsNodata) {
  Holed h = holed(VoidShape::kCoast, TKS_I16, 48, 48);
  h.nodata = 0;
  for (size_t i = 0; i < h.valid.size(); ++i) {
    const auto height = static_cast<int16_t>(sampleAt(h.raster.data, TKS_I16, i) / 2048);
    put(h.raster, i, h.valid[i] ? static_cast<int16_t>(height == 0 ? 1 : height) : int16_t{0});
  }
  for (const double error : {1.0, 3.0}) {
    const Bytes bytes = encodeHoled(h, within(error));
    Stream stream(bytes);
    EXPECT_LE(checkedError(h, stream), error);
  }
}

/// One of 16 samples around the nodata value; those that the type has, and the value itself never.
template <class T>
T around(T nodata, uint32_t number) {
  const double distance = number < 8 ? number + 1.0 : 7.0 - number;
  if constexpr (std::is_floating_point_v<T>) {
    if (std::abs(nodata) > 1000) return nodata * static_cast<T>(1 - std::abs(distance) / 64);
    return nodata + static_cast<T>(distance);
  } else {
    const double value = static_cast<double>(nodata) + distance;
    const bool there = value >= static_cast<double>(std::numeric_limits<T>::min()) &&
                       value <= static_cast<double>(std::numeric_limits<T>::max());
    return static_cast<T>(there ? value : static_cast<double>(nodata) - distance);
  }
}

void expectNodataWhereVoid(const std::vector<std::byte>& samples, tks_sample sample, double nodata,
                           const std::vector<uint8_t>& valid) {
  for (size_t i = 0; i < valid.size(); ++i)
    ASSERT_EQ(sampleAt(samples, sample, i) == nodata, !valid[i]) << i;
}

/// The whole, a window, and the first mip level.
void expectNodataWhereVoid(const Holed& h, Stream& stream) {
  const tks_sample sample = h.raster.sample;
  const std::vector<uint8_t> valid = stream.validity();
  expectNodataWhereVoid(stream.heights(), sample, *h.nodata, valid);
  const tks_window window = {5, 3, 21, 17};
  std::vector<std::byte> part(21 * 17 * tks_sample_bytes(sample));
  ASSERT_EQ(tks_decode_heights_window(stream.get(), &window, part.data(), part.size()), TKS_OK);
  std::vector<uint8_t> seen;
  for (size_t i = 0; i < 21 * 17; ++i) seen.push_back(valid[(3 + i / 21) * 40 + 5 + i % 21]);
  expectNodataWhereVoid(part, sample, *h.nodata, seen);
  ASSERT_EQ(tks_set_levels(stream.get(), 1, 0), TKS_OK);
  std::vector<std::byte> half(20 * 16 * tks_sample_bytes(sample));
  seen.resize(20 * 16);
  ASSERT_EQ(tks_decode_heights(stream.get(), half.data(), half.size()), TKS_OK);
  ASSERT_EQ(tks_decode_validity(stream.get(), seen.data(), seen.size()), TKS_OK);
  expectNodataWhereVoid(half, sample, *h.nodata, seen);
}

/// The declared value belongs to voids, whether a stream has any or not: whatever is cut off, no
/// valid sample equals it.
template <class T>
void expectNoValidSampleReadsAsNodata(tks_sample sample, T nodata, bool holes) {
  Holed h{make({Pattern::kRidges, 40, 31, 1, sample}), validity(VoidShape::kCoast, 40, 31), {}};
  if (!holes) h.valid.assign(h.valid.size(), 1);
  h.nodata = static_cast<double>(nodata);
  for (size_t i = 0; i < h.valid.size(); ++i) {
    const uint32_t number = samples::hash(static_cast<uint32_t>(i), 0, 9) % 16;
    put(h.raster, i, h.valid[i] ? around(nodata, number) : nodata);
  }
  for (tks_encode_options options : {lossless(), budget(400), within(2)}) {
    for (const uint32_t regions : {1u, 16u}) {
      options.regions = regions;
      const Bytes bytes = encodeHoled(h, options);
      for (const size_t n : {bytes.size() * 2 / 3, bytes.size()}) {
        Stream stream(Prefix(bytes).first(n));
        ASSERT_EQ(stream.status(), TKS_OK);
        expectNodataWhereVoid(h, stream);
      }
      Stream whole(bytes);
      const double most = options.max_error > 0 ? 2 : options.lossless ? 0 : HUGE_VAL;
      EXPECT_LE(checkedError(h, whole), most);
    }
  }
}

TEST(VoidStream, NoValidSampleReadsAsNodata) {
  constexpr float kLargest = std::numeric_limits<float>::max();
  for (const bool holes : {false, true}) {
    for (const int nodata : {0, 100, 255}) {
      SCOPED_TRACE(nodata);
      expectNoValidSampleReadsAsNodata<uint8_t>(TKS_U8, static_cast<uint8_t>(nodata), holes);
      expectNoValidSampleReadsAsNodata<int16_t>(TKS_I16, static_cast<int16_t>(nodata), holes);
    }
    expectNoValidSampleReadsAsNodata<int8_t>(TKS_I8, 127, holes);
    expectNoValidSampleReadsAsNodata<uint16_t>(TKS_U16, 65535, holes);
    expectNoValidSampleReadsAsNodata<int16_t>(TKS_I16, -32768, holes);
    expectNoValidSampleReadsAsNodata<uint32_t>(TKS_U32, 0xffffffffu, holes);
    expectNoValidSampleReadsAsNodata<int32_t>(TKS_I32, 0x7fffffff, holes);
    for (const float nodata : {0.0f, -0.0f, 100.0f, kLargest, -kLargest})
      expectNoValidSampleReadsAsNodata<float>(TKS_F32, nodata, holes);
  }
}

TEST(VoidStream, SurfaceIsNaNWhereVoidsAre) {
  const Holed h = holed(VoidShape::kCoast, TKS_I16, 20, 30);
  const Bytes bytes = encodeHoled(h, lossless());
  Stream stream(bytes);
  std::vector<float> surface(h.valid.size());
  ASSERT_EQ(tks_decode_surface(stream.get(), surface.data(), surface.size()), TKS_OK);
  for (size_t i = 0; i < surface.size(); ++i) EXPECT_EQ(std::isnan(surface[i]), !h.valid[i]);
}

TEST(VoidStream, DeclaredNodataThatNoSampleHasStaysDeclared) {
  Holed h = holed(VoidShape::kOneVoid, TKS_I16, 9, 9);
  h.nodata = 12345.5;
  h.valid.assign(h.valid.size(), 1);
  const Bytes bytes = encodeHoled(h, lossless());
  Stream stream(bytes);
  EXPECT_FALSE(stream.info().has_voids);
  EXPECT_TRUE(stream.info().has_nodata);
  EXPECT_EQ(stream.info().nodata, 12345.5);
  EXPECT_TRUE(sameBytes(stream.heights(), h.raster.data));
}

class VoidMesh : public ::testing::TestWithParam<VoidShape> {};

TEST_P(VoidMesh, StaysOffVoids) {
  const Holed h = holed(GetParam(), TKS_I16, 70, 45);
  const Bytes bytes = encodeHoled(h, budget(3000));
  Stream stream(bytes);
  const auto valid = stream.validity();
  for (const uint32_t triangles : {0u, 30u, 200u, 1500u}) {
    for (const tks_mesh_kind kind : {TKS_MESH_CODED, TKS_MESH_BUDGET}) {
      tks_mesh mesh = {};
      ASSERT_EQ(tks_decode_mesh(stream.get(), kind, triangles, &mesh), TKS_OK);
      for (uint32_t v = 0; v < mesh.vertex_count; ++v) {
        EXPECT_TRUE(valid[mesh.grid_index[v]]);
        EXPECT_TRUE(std::isfinite(mesh.height[v]));
      }
      for (uint32_t i = 0; i < 3 * mesh.triangle_count; ++i)
        ASSERT_LT(mesh.triangles[i], mesh.vertex_count);
      EXPECT_TRUE(kind == TKS_MESH_CODED || triangles == 0 || mesh.triangle_count <= triangles);
      tks_free_mesh(&mesh);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Shapes, VoidMesh, ::testing::ValuesIn(kVoidShapes),
                         ::testing::PrintToStringParamName());

/// The full mesh has every triangle whose corners are all valid, the budget mesh most of the land.
TEST(VoidMeshes, CoastIsNotEaten) {
  const Holed h = holed(VoidShape::kCoast, TKS_I16, 129, 129);
  const Bytes bytes = encodeHoled(h, lossless());
  Stream stream(bytes);
  const auto areaOf = [&](uint32_t triangles) {
    tks_mesh mesh = {};
    EXPECT_EQ(tks_decode_mesh(stream.get(), TKS_MESH_BUDGET, triangles, &mesh), TKS_OK);
    double area = 0;
    for (uint32_t t = 0; t < mesh.triangle_count; ++t) {
      double x[3], y[3];
      for (int k = 0; k < 3; ++k) {
        const uint32_t sample = mesh.grid_index[mesh.triangles[3 * t + static_cast<uint32_t>(k)]];
        x[k] = sample % 129;
        y[k] = sample / 129;
      }
      area += std::abs((x[1] - x[0]) * (y[2] - y[0]) - (y[1] - y[0]) * (x[2] - x[0])) / 2;
    }
    tks_free_mesh(&mesh);
    return area;
  };
  const double land = areaOf(0);
  EXPECT_GT(land, 4000);
  EXPECT_GT(areaOf(4000), 0.9 * land);
  EXPECT_LE(areaOf(4000), land);
  EXPECT_GT(areaOf(100), 0.6 * land);  // chosen among every second sample
}

}  // namespace
}  // namespace tetrakis::test

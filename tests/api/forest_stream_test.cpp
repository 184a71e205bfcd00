// SPDX-License-Identifier: Apache-2.0
// Streams of heights on forests: what comes back, what patches share, and what is refused.
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "base/forest.hpp"
#include "conformance/reference_decoder.hpp"
#include "tests/support/forest_raster.hpp"
#include "tests/support/forest_shapes.hpp"

namespace tetrakis::test {
namespace {

const std::vector<ForestShape>& shapes() {
  static const std::vector<ForestShape> all = forestShapes();
  return all;
}

ForestRaster surfaceOn(const ForestShape& shape, int depth) {
  return {Forest(depth, shape.sides), {samples::Pattern::kRidges, 0, 0, 1, TKS_I16, 3}};
}

ForestRaster pictureOn(const ForestShape& shape, int depth, uint32_t channels) {
  return {Forest(depth, shape.sides), {samples::Pattern::kRidges, 0, 0, channels, TKS_U8, 8}};
}

std::vector<int16_t> decoded(Stream& stream) {
  const std::vector<std::byte> bytes = stream.heights();
  std::vector<int16_t> samples(bytes.size() / 2);
  std::memcpy(samples.data(), bytes.data(), bytes.size());
  return samples;
}

TEST(ForestStream, RestoresEverySampleOfEveryShape) {
  for (const ForestShape& shape : shapes()) {
    for (int depth = 1; depth <= 6; ++depth) {
      const ForestRaster surface = surfaceOn(shape, depth);
      const Bytes bytes = encodeHeights(surface.heights(), lossless());
      Stream stream(bytes);
      ASSERT_EQ(stream.info().domain, TKS_DOMAIN_FOREST);
      ASSERT_EQ(stream.info().forest.patches, surface.forest.patches());
      ASSERT_EQ(decoded(stream), surface.samples<int16_t>()) << shape.name << ", depth " << depth;
    }
  }
}

/// More bands than 16 bits count: a colour plane has some on each patch.
TEST(ForestStream, RestoresTexelsOfManyPatches) {
  const std::vector<uint32_t> lone(size_t{4} * 4096, Forest::kBorder);
  const ForestRaster picture{Forest(3, lone), {samples::Pattern::kRidges, 0, 0, 3, TKS_U8, 8}};
  Stream stream(picture.encodedTexels(lossless()));
  EXPECT_EQ(stream.texture(), picture.raster.data);
}

TEST(ForestStream, SaysHowItsSidesAreGlued) {
  for (const ForestShape& shape : shapes()) {
    const ForestRaster surface = surfaceOn(shape, 3);
    const Bytes bytes = encodeHeights(surface.heights(), lossless());
    Stream stream(bytes);
    const tks_forest forest = stream.info().forest;
    ASSERT_EQ(forest.depth, 3u);
    EXPECT_EQ(std::vector<uint32_t>(forest.sides, forest.sides + 4 * forest.patches), shape.sides);
  }
}

TEST(ForestStream, GivesPatchesTheSamplesThatTheyShareAtEveryPrefix) {
  for (const ForestShape& shape : shapes()) {
    const ForestRaster surface = surfaceOn(shape, 5);
    for (const tks_encode_options& options : {lossless(), budget(1500), within(5)}) {
      const Bytes bytes = encodeHeights(surface.heights(), options);
      for (size_t cut = 0; cut <= bytes.size(); cut += 1 + cut / 16) {
        const Bytes prefix(bytes.begin(), bytes.begin() + static_cast<ptrdiff_t>(cut));
        tks_decoder* decoder = nullptr;
        if (tks_open(prefix.data(), prefix.size(), nullptr, &decoder, nullptr, 0) != TKS_OK)
          continue;
        tks_close(decoder);
        Stream stream(prefix);
        std::vector<int16_t> samples = decoded(stream), shared = samples;
        shareOwned(surface.forest, std::span(shared), surface.forest.side() - 1);
        ASSERT_EQ(samples, shared) << shape.name << ", " << cut << " bytes";
      }
    }
  }
}

TEST(ForestStream, KeepsTheErrorThatItPromises) {
  for (const ForestShape& shape : shapes()) {
    const ForestRaster surface = surfaceOn(shape, 6);
    const Bytes bytes = encodeHeights(surface.heights(), within(7));
    Stream stream(bytes);
    const std::vector<int16_t> samples = decoded(stream), source = surface.samples<int16_t>();
    for (size_t i = 0; i < samples.size(); ++i)
      ASSERT_LE(std::abs(samples[i] - source[i]), 7) << shape.name;
  }
}

TEST(ForestStream, KeepsConstantsAsTheyAre) {
  for (const ForestShape& shape : shapes()) {
    ForestRaster surface = surfaceOn(shape, 5);
    std::fill(surface.raster.data.begin(), surface.raster.data.end(), std::byte{12});
    const Bytes bytes = encodeHeights(surface.heights(), budget(400));
    Stream stream(bytes);
    EXPECT_EQ(decoded(stream), surface.samples<int16_t>()) << shape.name;
  }
}

/// What a level holds, and what it says of itself.
struct ShownLevel {
  Bytes samples;
  tks_info info = {};
};

ShownLevel levelOf(Stream& stream, uint32_t level, bool texture) {
  ShownLevel shown;
  shown.info.size = sizeof shown.info;
  EXPECT_EQ(tks_set_levels(stream.get(), texture ? 0 : level, texture ? level : 0), TKS_OK);
  EXPECT_EQ(tks_get_info(stream.get(), &shown.info), TKS_OK);
  const tks_info& info = shown.info;
  shown.samples.resize(texture ? size_t{info.texture_width} * info.texture_height *
                                     info.texture_channels
                               : size_t{2} * info.width * info.height);
  void* const out = shown.samples.data();
  EXPECT_EQ(texture ? tks_decode_texture(stream.get(), out, shown.samples.size())
                    : tks_decode_heights(stream.get(), out, shown.samples.size()),
            TKS_OK);
  return shown;
}

/// All levels of prefixes are those of the reference decoder.
void expectLevels(Prefix bytes, bool texture) {
  for (const size_t cut : {bytes.size(), bytes.size() * 2 / 3, bytes.size() / 3}) {
    Stream stream(bytes.first(cut));
    if (stream.status() != TKS_OK) continue;
    const tks_info& whole = stream.info();
    const uint32_t depth = texture ? whole.texture_forest.depth : whole.forest.depth;
    ASSERT_EQ(texture ? whole.texture_coarsest_level : whole.coarsest_level, depth - 1);
    for (uint32_t level = 0; level < depth; ++level) {
      const ShownLevel shown = levelOf(stream, level, texture);
      const tks_forest& forest = texture ? shown.info.texture_forest : shown.info.forest;
      const uint32_t side = (1u << (depth - level)) + 1;
      ASSERT_EQ(forest.depth, depth - level);
      ASSERT_EQ(texture ? shown.info.texture_width : shown.info.width, side);
      ASSERT_EQ(texture ? shown.info.texture_height : shown.info.height, side * forest.patches);
      const int k = static_cast<int>(level);
      const reference::Decoded expected =
          reference::decode(bytes.first(cut), reference::kMaxSamples, {k, k});
      ASSERT_EQ(texture ? expected.texture : expected.heights, shown.samples)
          << cut << " bytes, level " << level;
    }
  }
}

TEST(ForestStream, HasTheMipLevelsOfTheReferenceDecoder) {
  for (const ForestShape& shape : shapes()) {
    SCOPED_TRACE(shape.name);
    for (const samples::Pattern pattern :
         {samples::Pattern::kRidges, samples::Pattern::kSteps, samples::Pattern::kExtreme}) {
      const Forest forest(pattern == samples::Pattern::kRidges ? 4 : 3, shape.sides);
      const ForestRaster surface{forest, {pattern, 0, 0, 1, TKS_I16, 3}};
      for (const tks_encode_options& options : {lossless(), budget(1500), within(5)})
        expectLevels(surface.encoded(options), false);
      const ForestRaster picture{forest, {pattern, 0, 0, 3, TKS_U8, 8}};
      for (const tks_encode_options& options : {lossless(), budget(2500)})
        expectLevels(picture.encodedTexels(options), true);
      if (HasFatalFailure()) return;
    }
  }
}

/// Levels of smooth ground hold what lies at their places, whatever the filters multiply means by.
TEST(ForestStream, HasLevelsNearTheSamplesAtTheirPlaces) {
  for (const ForestShape& shape : shapes()) {
    const ForestRaster surface{Forest(6, shape.sides),
                               {samples::Pattern::kHills, 0, 0, 1, TKS_I16, 3}};
    const std::vector<int16_t> source = surface.samples<int16_t>();
    const auto [least, most] = std::minmax_element(source.begin(), source.end());
    for (const tks_encode_options& options : {lossless(), budget(4000)}) {
      Stream stream(surface.encoded(options));
      for (uint32_t level = 1; level <= 2; ++level) {
        const Bytes bytes = levelOf(stream, level, false).samples;
        const View places{static_cast<int>(level), {}, 0, surface.forest.side()};
        const std::vector<int16_t> expected =
            slice(std::span<const int16_t>(source), surface.forest.raster(), places);
        std::vector<int16_t> samples(bytes.size() / 2);
        std::memcpy(samples.data(), bytes.data(), bytes.size());
        ASSERT_EQ(samples.size(), expected.size());
        double sum = 0;
        for (size_t i = 0; i < samples.size(); ++i) sum += std::abs(samples[i] - expected[i]);
        EXPECT_LT(sum / static_cast<double>(samples.size()), 0.1 * (*most - *least))
            << shape.name << ", level " << level;
      }
    }
  }
}

TEST(ForestStream, MakesNoMeshOfALevel) {
  Stream stream(surfaceOn(shapes().front(), 4).encoded(lossless()));
  ASSERT_EQ(tks_set_levels(stream.get(), 1, 0), TKS_OK);
  tks_mesh mesh{};
  EXPECT_EQ(tks_decode_mesh(stream.get(), TKS_MESH_BUDGET, 100, &mesh), TKS_USAGE);
  ASSERT_EQ(tks_set_levels(stream.get(), 0, 0), TKS_OK);
  EXPECT_EQ(tks_decode_mesh(stream.get(), TKS_MESH_BUDGET, 100, &mesh), TKS_OK);
  tks_free_mesh(&mesh);
}

std::vector<uint8_t> texelsOf(Stream& stream) {
  const std::vector<std::byte> bytes = stream.texture();
  std::vector<uint8_t> texels(bytes.size());
  std::memcpy(texels.data(), bytes.data(), bytes.size());
  return texels;
}

TEST(ForestStream, RestoresEveryTexel) {
  for (const ForestShape& shape : shapes()) {
    for (const uint32_t channels : {1u, 2u, 3u, 4u}) {
      const ForestRaster picture = pictureOn(shape, 4, channels);
      const tks_image image = picture.image();
      const Bytes bytes = encodeGiven(nullptr, &image, lossless());
      Stream stream(bytes);
      ASSERT_EQ(stream.info().texture_domain, TKS_DOMAIN_FOREST);
      ASSERT_EQ(texelsOf(stream), picture.samples<uint8_t>()) << shape.name << ", " << channels;
    }
  }
}

TEST(ForestStream, GivesPatchesTheTexelsThatTheyShareAtEveryPrefix) {
  for (const ForestShape& shape : shapes()) {
    const ForestRaster picture = pictureOn(shape, 4, 3);
    const tks_image image = picture.image();
    for (const tks_encode_options& options : {lossless(), budget(2500)}) {
      const Bytes bytes = encodeGiven(nullptr, &image, options);
      for (size_t cut = 0; cut <= bytes.size(); cut += 1 + cut / 10) {
        Stream stream(Prefix(bytes).first(cut));
        if (stream.status() != TKS_OK) continue;
        std::vector<uint8_t> texels = texelsOf(stream), shared = texels;
        shareOwned(picture.forest, std::span(shared), picture.forest.side() - 1, 3);
        ASSERT_EQ(texels, shared) << shape.name << ", " << cut << " bytes";
      }
    }
  }
}

TEST(ForestStream, SharesABudgetBetweenHeightsAndTexture) {
  constexpr uint64_t kEach = 3000;  // bytes of a patch
  for (const ForestShape& shape : shapes()) {
    const ForestRaster surface = surfaceOn(shape, 5);
    const ForestRaster picture = pictureOn(shape, 6, 3);
    const tks_heights heights = surface.heights();
    const tks_image image = picture.image();
    const Bytes bytes = encodeGiven(&heights, &image, budget(kEach * shape.patches()));
    EXPECT_LE(bytes.size(), kEach * shape.patches());
    Stream stream(bytes);
    EXPECT_EQ(stream.info().texture_forest.depth, 6u);
    const std::vector<int16_t> samples = decoded(stream), source = surface.samples<int16_t>();
    double heights_off = 0, texels_off = 0;
    for (size_t i = 0; i < samples.size(); ++i) heights_off += std::abs(samples[i] - source[i]);
    const std::vector<uint8_t> texels = texelsOf(stream), painted = picture.samples<uint8_t>();
    for (size_t i = 0; i < texels.size(); ++i) texels_off += std::abs(int{texels[i]} - painted[i]);
    EXPECT_LT(heights_off / static_cast<double>(samples.size()), 40) << shape.name;
    EXPECT_LT(texels_off / static_cast<double>(texels.size()), 12) << shape.name;
  }
}

TEST(ForestStream, CutsWindowsOutOfPatches) {
  const ForestRaster surface = surfaceOn(octahedronShape(), 5);
  const ForestRaster picture = pictureOn(octahedronShape(), 5, 3);
  const tks_heights heights = surface.heights();
  const tks_image image = picture.image();
  const Bytes bytes = encodeGiven(&heights, &image, budget(6000));
  Stream stream(bytes);
  const std::vector<int16_t> all = decoded(stream);
  const std::vector<uint8_t> texels = texelsOf(stream);
  for (const tks_window& window :
       {tks_window{0, 0, 33, 66}, tks_window{5, 20, 9, 30}, tks_window{32, 65, 1, 1}}) {
    std::vector<int16_t> out(size_t{window.width} * window.height);
    ASSERT_EQ(tks_decode_heights_window(stream.get(), &window, out.data(), 2 * out.size()), TKS_OK);
    std::vector<uint8_t> shown(3 * out.size());
    ASSERT_EQ(tks_decode_texture_window(stream.get(), &window, shown.data(), shown.size()), TKS_OK);
    for (size_t i = 0; i < out.size(); ++i) {
      const size_t place = (window.y + i / window.width) * 33 + window.x + i % window.width;
      ASSERT_EQ(out[i], all[place]);
      for (size_t c = 0; c < 3; ++c) ASSERT_EQ(shown[3 * i + c], texels[3 * place + c]);
    }
  }
}

tks_status statusOf(const tks_heights* heights, const tks_image* image,
                    const tks_encode_options& options, std::string& message) {
  tks_buffer buffer = {};
  char sentence[256] = "";
  const tks_status status =
      tks_encode(heights, image, &options, &buffer, sentence, sizeof sentence);
  tks_free_buffer(&buffer);
  message = sentence;
  return status;
}

TEST(ForestStream, RefusesWhatIsNoForest) {
  const ForestRaster surface = surfaceOn(octahedronShape(), 4);
  std::string message;
  const auto refused = [&](auto change) {
    tks_heights heights = surface.heights();
    change(heights);
    return statusOf(&heights, nullptr, lossless(), message) == TKS_USAGE && !message.empty();
  };
  EXPECT_TRUE(refused([](tks_heights& h) { --h.height; }));
  EXPECT_TRUE(refused([](tks_heights& h) { h.forest.depth = 5; }));
  EXPECT_TRUE(refused([](tks_heights& h) { h.forest.depth = 400; }));
  EXPECT_TRUE(refused([](tks_heights& h) { h.forest.patches = 0; }));
  const ForestShape many = planeShape(4097, 1);
  EXPECT_TRUE(refused([&](tks_heights& h) {
    h.forest = {1, 4097, many.sides.data()};
    h.width = 3;
    h.height = 3 * 4097;
  }));
  EXPECT_EQ(message, "A forest has at most 4096 patches.");
  EXPECT_TRUE(refused([](tks_heights& h) { h.forest.sides = nullptr; }));
  const std::vector<uint32_t> one_way = {5, 4, 7, 6, 1, 0, 3, TKS_BORDER};
  EXPECT_TRUE(refused([&](tks_heights& h) { h.forest.sides = one_way.data(); }));
  const std::vector<uint32_t> itself = {0, 4, 7, 6, 1, TKS_BORDER, 3, 2};
  EXPECT_TRUE(refused([&](tks_heights& h) { h.forest.sides = itself.data(); }));
  std::vector<int16_t> torn = surface.samples<int16_t>();
  torn[3] = static_cast<int16_t>(torn[3] + 1);
  EXPECT_TRUE(refused([&](tks_heights& h) { h.data = torn.data(); }));
  EXPECT_TRUE(refused([&](tks_heights& h) { h.has_nodata = 1, h.nodata = torn[40]; }));
}

/// How often each pair of vertices is an edge, and whether it runs both ways equally often.
struct Edges {
  std::map<std::pair<uint32_t, uint32_t>, int> balance, count;

  explicit Edges(const tks_mesh& mesh) {
    for (uint32_t t = 0; t < mesh.triangle_count; ++t) {
      const uint32_t* const corner = mesh.triangles + 3 * size_t{t};
      for (int k = 0; k < 3; ++k) add(corner[k], corner[(k + 1) % 3]);
    }
  }
  void add(uint32_t a, uint32_t b) {
    const auto key = std::minmax(a, b);
    balance[key] += a < b ? 1 : -1;
    ++count[key];
  }
  /// Edges that have a triangle on one side alone.
  size_t open() const {
    return static_cast<size_t>(std::count_if(balance.begin(), balance.end(), [](const auto& edge) {
      return edge.second != 0 && edge.first.first != edge.first.second;
    }));
  }
};

/// V - E + F.
int64_t characteristic(const tks_mesh& mesh, const Edges& edges) {
  return int64_t{mesh.vertex_count} - static_cast<int64_t>(edges.count.size()) +
         mesh.triangle_count;
}

/// As an image of longitudes and latitudes over a globe on a cube.
TEST(ForestStream, MayHaveATextureThatLiesElsewhere) {
  const ForestRaster surface = surfaceOn(cubeShape(), 4);
  const tks_heights heights = surface.heights();
  const samples::Raster picture = samples::make({samples::Pattern::kRidges, 60, 30, 3, TKS_U8, 8});
  for (const tks_domain domain : {TKS_DOMAIN_PLANE, TKS_DOMAIN_CYLINDER}) {
    tks_image image = picture.image();
    image.domain = domain;
    Stream exact(encodeGiven(&heights, &image, lossless()));
    EXPECT_EQ(exact.info().domain, TKS_DOMAIN_FOREST);
    EXPECT_EQ(exact.info().texture_domain, domain);
    EXPECT_EQ(decoded(exact), surface.samples<int16_t>());
    EXPECT_EQ(exact.texture(), picture.data);
    const Bytes bytes = encodeGiven(&heights, &image, budget(3000));
    EXPECT_LE(bytes.size(), 3000u);
    for (const size_t cut : {bytes.size(), bytes.size() / 2}) {
      const reference::Decoded expected = reference::decode(Prefix(bytes).first(cut));
      Stream stream(Prefix(bytes).first(cut));
      EXPECT_EQ(levelOf(stream, 0, false).samples, expected.heights);
      EXPECT_EQ(levelOf(stream, 0, true).samples, expected.texture);
    }
  }
  std::string message;
  const ForestRaster patches = pictureOn(cubeShape(), 4, 3);
  const tks_image on_patches = patches.image();
  tks_heights flat = heights;
  flat.domain = TKS_DOMAIN_PLANE;
  flat.forest = {};
  EXPECT_EQ(statusOf(&flat, &on_patches, lossless(), message), TKS_USAGE);
}

TEST(ForestStream, MakesClosedMeshesOfAnyNumberOfTriangles) {
  for (const ForestShape& shape : shapes()) {
    const ForestRaster surface = surfaceOn(shape, 5);
    const bool is_closed = std::count(shape.sides.begin(), shape.sides.end(), TKS_BORDER) == 0;
    const Bytes bytes = encodeHeights(surface.heights(), budget(1800));
    Stream stream(bytes);
    uint32_t before = 0;
    for (uint32_t triangles = 1; triangles < 5000; triangles += 1 + triangles / 3) {
      tks_mesh mesh = {};
      ASSERT_EQ(tks_decode_mesh(stream.get(), TKS_MESH_BUDGET, triangles, &mesh), TKS_OK);
      const uint32_t base = 2 * surface.forest.patches();
      EXPECT_LE(mesh.triangle_count, std::max(triangles, base)) << shape.name;
      EXPECT_GE(mesh.triangle_count, before) << shape.name;
      before = mesh.triangle_count;
      const Edges edges(mesh);
      if (is_closed) {
        EXPECT_EQ(edges.open(), 0u) << shape.name << ", " << triangles;
      }
      tks_free_mesh(&mesh);
    }
  }
}

TEST(ForestStream, KeepsTheTopologyOfItsSurface) {
  for (const ForestShape& shape :
       {octahedronShape(), torusShape(), planeShape(2, 2), cylinderShape()}) {
    const ForestRaster surface = surfaceOn(shape, 4);
    const Bytes bytes = encodeHeights(surface.heights(), budget(1500));
    for (size_t cut = bytes.size() / 4; cut <= bytes.size(); cut += 1 + cut / 8) {
      Stream stream(Prefix(bytes).first(cut));
      for (const uint32_t triangles : {200u, 400u, 0u}) {
        tks_mesh mesh = {};
        ASSERT_EQ(tks_decode_mesh(stream.get(), TKS_MESH_BUDGET, triangles, &mesh), TKS_OK);
        if (mesh.triangle_count > 150) {
          EXPECT_EQ(characteristic(mesh, Edges(mesh)), shape.euler)
              << shape.name << ", " << triangles << " triangles of " << cut << " bytes";
        }
        tks_free_mesh(&mesh);
      }
    }
  }
}

TEST(ForestStream, MakesTheCodedMeshOfWhatHasArrived) {
  for (const ForestShape& shape : shapes()) {
    const ForestRaster surface = surfaceOn(shape, 5);
    const Bytes bytes = encodeHeights(surface.heights(), budget(1200));
    uint32_t before = 0;
    for (size_t cut = bytes.size() / 3; cut <= bytes.size(); cut += 1 + cut / 8) {
      Stream stream(Prefix(bytes).first(cut));
      tks_mesh mesh = {};
      ASSERT_EQ(tks_decode_mesh(stream.get(), TKS_MESH_CODED, 0, &mesh), TKS_OK);
      EXPECT_GE(mesh.triangle_count, before) << shape.name;
      before = mesh.triangle_count;
      tks_free_mesh(&mesh);
    }
    EXPECT_GT(before, 4 * surface.forest.patches()) << shape.name;
  }
}

}  // namespace
}  // namespace tetrakis::test

// SPDX-License-Identifier: Apache-2.0
// Cameras that the encoder is told of: those that can look at the ground share the bytes of every
// terrain, however odd it is, and each of the others is refused by its name.
#include <algorithm>
#include <array>
#include <cstring>
#include <functional>
#include <limits>
#include <string>

#include "tests/support/stream_fixture.hpp"

namespace tetrakis::test {
namespace {

using samples::make;
using samples::Pattern;
using samples::Raster;

/// From above, to the north. The ground is a kilometre wide, and 255 metres high at most.
tks_camera above() {
  return {"eagle", {0, 5000, 1}, {0, 0, 0}, {0, 1, 0}, 40, 768, 512, 1};
}

/// One sentence, or nothing if the stream was made.
std::string refusal(const tks_heights* heights, const tks_image* image,
                    const tks_encode_options& options) {
  tks_buffer buffer = {};
  char message[256] = "";
  const tks_status status = tks_encode(heights, image, &options, &buffer, message, sizeof message);
  EXPECT_TRUE(status == TKS_OK || status == TKS_USAGE);
  EXPECT_EQ(status == TKS_OK, message[0] == '\0');
  tks_free_buffer(&buffer);
  return message;
}

class Cameras : public testing::Test {
 protected:
  Raster surface_ = make({Pattern::kRidges, 33, 40, 1, TKS_U8});
  Raster picture_ = make({Pattern::kRidges, 50, 30, 3, TKS_U8});

  std::string told(const std::vector<tks_camera>& cameras) {
    tks_encode_options options = budget(2000);
    options.cameras = cameras.data();
    options.camera_count = static_cast<uint32_t>(cameras.size());
    const tks_heights heights = surface_.heights();
    const tks_image image = picture_.image();
    return refusal(&heights, &image, options);
  }
};

TEST_F(Cameras, ThoseThatCannotLookAreNamed) {
  const std::function<void(tks_camera&)> spoils[] = {
      [](tks_camera& c) { c.eye[0] = kNan; },
      [](tks_camera& c) { c.eye[1] = kInfinity; },
      [](tks_camera& c) { c.target[2] = kNan; },
      [](tks_camera& c) { c.up[1] = kNan; },
      [](tks_camera& c) { c.up[1] = 0; },
      [](tks_camera& c) { c.up[1] = 5000, c.up[2] = 1; },
      [](tks_camera& c) { c.target[1] = 5000, c.target[2] = 1; },
      [](tks_camera& c) { c.fov_y = 0; },
      [](tks_camera& c) { c.fov_y = 180; },
      [](tks_camera& c) { c.fov_y = kNan; },
      [](tks_camera& c) { c.width = 0; },
      [](tks_camera& c) { c.height = 8193; },
      [](tks_camera& c) { c.weight = -1; },
      [](tks_camera& c) { c.weight = kNan; },
      [](tks_camera& c) { c.weight = kInfinity; },
      [](tks_camera& c) { c.target[1] = 1e4; },                    // looks up
      [](tks_camera& c) { c.eye[0] = c.target[0] = 1e9; },         // looks down beside the ground
      [](tks_camera& c) { c.eye[1] = -1e6; },                      // below the ground, looks up
      [](tks_camera& c) { c.eye[0] = 1e5, c.eye[1] = -1e5; },      // and beside it
      [](tks_camera& c) { c.eye[1] = 1e300, c.eye[0] = -1e300; },  // sees nothing of so far a place
  };
  EXPECT_EQ(told({above()}), "");
  for (size_t i = 0; i < std::size(spoils); ++i) {
    tks_camera camera = above();
    spoils[i](camera);
    const std::string message = told({above(), camera});
    EXPECT_EQ(message.find("Camera 'eagle' "), 0u) << "case " << i << ": " << message;
    EXPECT_EQ(message.find('.'), message.size() - 1) << message;
    camera.name = nullptr;
    EXPECT_EQ(told({above(), camera}).find("Camera '2' "), 0u) << "case " << i;
  }
}

TEST_F(Cameras, FaultsAreCalledByTheirNames) {
  const std::pair<void (*)(tks_camera&), const char*> faults[] = {
      {[](tks_camera& c) { c.eye[0] = 1e300; }, "has its eye too far from its target"},
      {[](tks_camera& c) { c.up[0] = 1e300; }, "has an up that is too long"},
      {[](tks_camera& c) { c.weight = kNan; }, "has a weight that is not finite"},
      {[](tks_camera& c) { c.weight = kInfinity; }, "has a weight that is not finite"},
      {[](tks_camera& c) { c.weight = -1; }, "has a negative weight"},
  };
  for (const auto& [spoil, text] : faults) {
    tks_camera camera = above();
    spoil(camera);
    EXPECT_NE(told({camera}).find(text), std::string::npos) << told({camera});
  }
}

/// The ground is about 17 of its 393216 pixels.
TEST_F(Cameras, OneThatSeesLittleGroundSees) {
  tks_camera camera = above();
  camera.eye[1] = 2e5;
  EXPECT_EQ(told({camera}), "");
  EXPECT_EQ(told({above(), camera}), "");
}

TEST_F(Cameras, WeightsAreRelative) {
  tks_camera camera = above();
  camera.weight = 0;
  EXPECT_NE(told({camera}), "");
  EXPECT_EQ(told({camera, above()}), "");
  for (const double weight : {1e-320, 1e308}) {
    camera.weight = weight;
    EXPECT_EQ(told({above(), camera}), "") << weight;
  }
  const auto with = [&](double weight) {
    std::vector<tks_camera> cameras = {above(), above()};
    cameras[1].eye[0] = 3000;
    for (tks_camera& c : cameras) c.weight = weight;
    tks_encode_options options = budget(2000);
    options.cameras = cameras.data();
    options.camera_count = 2;
    return encode(&surface_, &picture_, options);
  };
  EXPECT_EQ(with(1), with(1e308));
}

/// With cameras and without, terrain of every shape becomes a stream within its budget.
TEST(CamerasOfOddTerrain, ShareItsBytes) {
  const std::pair<uint32_t, uint32_t> sides[] = {{2, 2}, {2, 90}, {90, 2}, {35, 34}};
  const std::pair<uint32_t, uint32_t> textures[] = {{1, 1}, {1, 70}, {70, 61}};
  for (const auto& [width, height] : sides) {
    for (const auto& [columns, rows] : textures) {
      const Raster surface = make({Pattern::kRidges, width, height, 1, TKS_I16});
      const Raster picture = make({Pattern::kRidges, columns, rows, 4, TKS_U8});
      for (const double spacing : {0.0, 1e-30, 1e300}) {
        tks_heights heights = surface.heights();
        heights.spacing_x = spacing;
        const tks_image image = picture.image();
        EXPECT_EQ(refusal(&heights, &image, budget(700)), "") << width << " " << columns;
      }
    }
  }
}

TEST(CamerasOfOddTerrain, VoidsAndEnormousHeightsAreSeen) {
  const Raster picture = make({Pattern::kRidges, 24, 20, 3, TKS_U8});
  const tks_image image = picture.image();
  std::vector<float> samples(20 * 25);
  tks_heights heights = {};
  heights.size = sizeof heights;
  heights.width = 20;
  heights.height = 25;
  heights.sample = TKS_F32;
  heights.data = samples.data();
  const auto fill = [&](const std::function<double(size_t)>& height) {
    for (size_t i = 0; i < samples.size(); ++i) samples[i] = static_cast<float>(height(i));
  };
  const std::function<double(size_t)> terrains[] = {
      [](size_t) { return kNan; },
      [](size_t i) { return i == 77 ? 5 : kNan; },
      [](size_t i) { return i % 2 ? 5.0 * static_cast<double>(i % 7) : kNan; },
      [](size_t) { return 0; },
      [](size_t i) { return i % 3 ? 3e38 : -3e38; },
      [](size_t i) { return static_cast<double>(i % 5) * 1e-40; },
  };
  for (size_t t = 0; t < std::size(terrains); ++t) {
    fill(terrains[t]);
    for (const double scale : {1.0, 1e300}) {
      heights.scale = scale;
      EXPECT_EQ(refusal(&heights, &image, budget(900)), "") << t << " at " << scale;
    }
  }
}

/// Where one component is alone there is nothing to share, but cameras are checked.
TEST_F(Cameras, OneComponentAloneDoesWithout) {
  tks_camera camera = above();
  tks_encode_options options = budget(900);
  options.cameras = &camera;
  options.camera_count = 1;
  const tks_heights heights = surface_.heights();
  const tks_image image = picture_.image();
  EXPECT_EQ(refusal(&heights, nullptr, options), "");
  EXPECT_EQ(refusal(nullptr, &image, options), "");
  EXPECT_EQ(encode(&surface_, nullptr, options), encode(&surface_, nullptr, budget(900)));
  EXPECT_EQ(encode(nullptr, &picture_, options), encode(nullptr, &picture_, budget(900)));
  camera.weight = -1;
  EXPECT_NE(refusal(&heights, nullptr, options), "");
  EXPECT_NE(refusal(nullptr, &image, options), "");
}

/// Squared errors of the north-western and of the south-eastern quarter.
std::array<double, 2> squaresOfQuarters(const Raster& truth, const std::vector<std::byte>& shown) {
  std::array<double, 2> sums{};
  for (uint32_t y = 0; y < truth.height; ++y) {
    for (uint32_t x = 0; x < truth.width; ++x) {
      const bool north = y < truth.height / 2, west = x < truth.width / 2;
      if (north != west) continue;
      for (uint32_t c = 0; c < truth.channels; ++c) {
        const size_t i = (size_t{y} * truth.width + x) * truth.channels + c;
        const double error =
            sampleAt(shown, truth.sample, i) - sampleAt(truth.data, truth.sample, i);
        sums[north ? 0 : 1] += error * error;
      }
    }
  }
  return sums;
}

/// From above, where heights are hardly seen, at a quarter of the ground.
TEST(ToldStreams, ComeFirstWhereTheCameraLooks) {
  const Raster surface = make({Pattern::kRidges, 200, 180, 1, TKS_U8});
  const Raster picture = make({Pattern::kRidges, 160, 180, 3, TKS_U8});
  const tks_camera corner = {
      nullptr, {-1500, 8000, -1350}, {-1500, 0, -1350}, {0, 0, -1}, 25, 256, 256, 1};
  tks_encode_options options = budget(6000);
  Stream alike(encode(&surface, &picture, options));
  options.cameras = &corner;
  options.camera_count = 1;
  const Bytes bytes = encode(&surface, &picture, options);
  Stream told(bytes);
  const auto heights = squaresOfQuarters(surface, told.heights());
  const auto texture = squaresOfQuarters(picture, told.texture());
  EXPECT_LT(texture[0], squaresOfQuarters(picture, alike.texture())[0] / 2);
  EXPECT_LT(heights[0], heights[1]);
  EXPECT_LT(texture[0], texture[1]);
}

/// From the north-east: the other two quarters are as far away as each other.
TEST(ToldStreams, TreatAlikeWhatIsSeenAlike) {
  const Raster surface = make({Pattern::kFlat, 256, 256, 1, TKS_U8});
  const Raster picture = make({Pattern::kExtreme, 256, 256, 3, TKS_U8});
  const tks_camera corner = {nullptr, {6000, 4000, -6000}, {0, 0, 0}, {0, 1, 0}, 80, 256, 256, 1};
  tks_encode_options options = budget(150000);
  options.cameras = &corner;
  options.camera_count = 1;
  const Bytes bytes = encode(&surface, &picture, options);
  Stream told(bytes);
  const auto [north, south] = squaresOfQuarters(picture, told.texture());
  EXPECT_LT(std::max(north, south), 1.2 * std::min(north, south));
}

/// A map of priorities is left out where its bytes buy more as samples, and no work that tells
/// whether it pays is reported twice.
TEST(ToldStreams, HaveMapsWhereTheyPay) {
  const Raster surface = make({Pattern::kRidges, 100, 90, 1, TKS_U8});
  const Raster picture = make({Pattern::kRidges, 80, 90, 3, TKS_U8});
  const tks_camera corner = {nullptr, {-750, 4000, -675}, {-750, 0, -675}, {0, 0, -1}, 25, 256, 256,
                             1};
  std::vector<double> reports;
  const auto headerOf = [&](uint64_t bytes, uint32_t cameras) {
    tks_encode_options options = budget(bytes);
    options.cameras = &corner;
    options.camera_count = cameras;
    options.progress = [](void* user, double done) {
      static_cast<std::vector<double>*>(user)->push_back(done);
      return 0;
    };
    options.user = &reports;
    reports.clear();
    const Bytes stream = encode(&surface, &picture, options);
    EXPECT_TRUE(std::is_sorted(reports.begin(), reports.end()));
    return Stream(stream).info().header_bytes;
  };
  EXPECT_GT(headerOf(3000, 1), headerOf(3000, 0) + 2);
  EXPECT_LE(headerOf(100, 1), headerOf(100, 0) + 2);
}

/// Tiny, flat, void and enormous ground becomes a stream, or the camera is named that sees none.
TEST(ToldStreams, TakeOddTerrain) {
  const std::function<float(size_t)> terrains[] = {
      [](size_t) { return 0.f; },
      [](size_t) { return std::numeric_limits<float>::quiet_NaN(); },
      [](size_t i) { return i == 1 ? 5.f : std::numeric_limits<float>::quiet_NaN(); },
      [](size_t i) { return i % 3 ? 3e38f : -3e38f; },
      [](size_t i) { return static_cast<float>(i % 5) * 1e-40f; },
  };
  const std::pair<uint32_t, uint32_t> sides[] = {{2, 2}, {2, 31}, {17, 16}};
  for (const auto& [width, height] : sides) {
    for (const auto& terrain : terrains) {
      Raster surface = make({Pattern::kRidges, width, height, 1, TKS_F32});
      for (size_t i = 0; i < size_t{width} * height; ++i) {
        const float sample = terrain(i);
        std::memcpy(surface.data.data() + i * sizeof sample, &sample, sizeof sample);
      }
      for (const uint32_t texels : {1u, 12u}) {
        const Raster picture = make({Pattern::kRidges, texels, texels, 3, TKS_U8});
        const tks_camera camera = {"low", {-20, 100, 1}, {0, 0, 0}, {0, 1, 0}, 70, 64, 48, 1};
        tks_encode_options options = budget(900);
        options.cameras = &camera;
        options.camera_count = 1;
        tks_heights heights = surface.heights();
        heights.has_nodata = 0;
        const tks_image image = picture.image();
        for (const double scale : {1.0, 1e300}) {
          heights.scale = scale;
          const bool meshes = texels == 1 && scale == 1 && width == 35;  // these take long
          for (const uint32_t triangles : {0u, 7u}) {
            if (triangles > 0 && !meshes) continue;
            options.triangles = triangles;
            const std::string sentence = refusal(&heights, &image, options);
            EXPECT_TRUE(sentence.empty() || sentence.find("'low'") != std::string::npos)
                << sentence;
          }
        }
      }
    }
  }
}

/// Decoders that remember tracks show what others show.
TEST(ToldStreams, GrowByteByByte) {
  const Raster surface = make({Pattern::kRidges, 33, 28, 1, TKS_U8});
  const Raster picture = make({Pattern::kRidges, 26, 31, 3, TKS_U8});
  const tks_camera corner = {nullptr, {-300, 3000, -200}, {-300, 0, -200}, {0, 0, -1}, 10, 128, 128,
                             1};
  tks_encode_options options = budget(700);
  options.cameras = &corner;
  options.camera_count = 1;
  const Bytes bytes = encode(&surface, &picture, options);
  const size_t header = static_cast<size_t>(Stream(bytes).info().header_bytes);
  Stream growing(Prefix(bytes).first(header));
  for (size_t size = header + 1; size <= bytes.size(); ++size) {
    ASSERT_EQ(tks_append(growing.get(), &bytes[size - 1], 1), TKS_OK);
    Stream fresh(Prefix(bytes).first(size));
    ASSERT_EQ(growing.heights(), fresh.heights()) << size;
    ASSERT_EQ(growing.texture(), fresh.texture()) << size;
  }
}

}  // namespace
}  // namespace tetrakis::test

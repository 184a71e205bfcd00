// SPDX-License-Identifier: Apache-2.0
// Objects beside the meshes that they were made of.
#include "apps/tools/report/surface_comparison.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace tetrakis::tools {
namespace {

/// A box of unequal sides, each with `steps` x `steps` squares, in one colour.
SurfaceFile box(uint32_t steps, uint8_t value) {
  SurfaceFile surface;
  const double sides[3] = {2, 3, 4};
  for (size_t axis = 0; axis < 3; ++axis) {
    for (const double end : {0.0, 1.0}) {
      const auto first = static_cast<uint32_t>(surface.points.size());
      for (uint32_t i = 0; i < (steps + 1) * (steps + 1); ++i) {
        std::array<double, 3> point{};
        point[axis] = sides[axis] * end;
        point[(axis + 1) % 3] = sides[(axis + 1) % 3] * (i % (steps + 1)) / steps;
        point[(axis + 2) % 3] = sides[(axis + 2) % 3] * (i / (steps + 1)) / steps;
        surface.points.push_back(point);
      }
      for (uint32_t i = 0; i < steps * steps; ++i) {
        const uint32_t a = first + i / steps * (steps + 1) + i % steps, b = a + 1,
                       c = a + steps + 1, d = c + 1;
        const bool outward = end > 0;
        surface.triangles.push_back(outward ? std::array{a, b, d} : std::array{a, d, b});
        surface.triangles.push_back(outward ? std::array{a, d, c} : std::array{a, c, d});
      }
    }
  }
  surface.texcoords.assign(3 * surface.triangles.size(), {0.3F, 0.6F});
  surface.texture = ImageFile{2, 2, 3, TKS_U8, std::vector<std::byte>(12, std::byte{value})};
  return surface;
}

Result<Buffer> encoded(const SurfaceFile& file) {
  tks_triangle_mesh mesh = makeTriangleMesh();
  mesh.vertex_count = static_cast<uint32_t>(file.points.size());
  mesh.triangle_count = static_cast<uint32_t>(file.triangles.size());
  mesh.positions = file.points.front().data();
  mesh.triangles = file.triangles.front().data();
  mesh.texcoords = file.texcoords.front().data();
  const tks_image image = asImage(*file.texture);
  tks_encode_options options = makeEncodeOptions();
  options.bytes = 4000;
  return encodeObject(mesh, &image, options);
}

TEST(SurfaceComparison, MeasuresWhatIsThere) {
  const SurfaceFile original = box(6, 100);
  const Result<Buffer> stream = encoded(original);
  ASSERT_TRUE(stream.ok()) << stream.status().message();
  Result<Decoder> decoder = Decoder::open(stream->bytes());
  ASSERT_TRUE(decoder.ok());
  const Result<SurfaceMeasurement> own = compareSurface(*decoder, original, 0);
  ASSERT_TRUE(own.ok());
  EXPECT_LT(own->distance.error, 0.1);
  EXPECT_GT(*own->colour_psnr, 45);
  // Of another colour, by as much; and of another place.
  EXPECT_NEAR(*compareSurface(*decoder, box(6, 150), 0)->colour_psnr, 20 * std::log10(255. / 50),
              0.3);
  SurfaceFile moved = original;
  for (auto& point : moved.points) point[2] += 20;
  EXPECT_GT(compareSurface(*decoder, moved, 0)->distance.error, 15);
  moved.texture.reset();
  EXPECT_FALSE(compareSurface(*decoder, moved, 0)->colour_psnr.has_value());
}

}  // namespace
}  // namespace tetrakis::tools

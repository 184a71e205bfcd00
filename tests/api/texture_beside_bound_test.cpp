// SPDX-License-Identifier: Apache-2.0
// Textures beside heights within a largest error: what they get falls as the bound grows, also
// where the heights take next to no bytes.
#include "tests/support/stream_fixture.hpp"

namespace tetrakis::test {
namespace {

using samples::make;
using samples::Pattern;
using samples::Raster;

/// A bound above the range too, where heights take no bytes and have no slope that says what texels
/// are worth. Single packets may be a tenth of a stream.
TEST(TextureBesideBound, FallsAsTheBoundGrows) {
  const Raster image = photograph();
  const Raster ridges = make({Pattern::kRidges, 161, 140, 1, TKS_U16});
  const Raster low = make({Pattern::kRidges, 161, 140, 1, TKS_U8, 3});
  for (const Raster* heights : {&ridges, &low}) {
    size_t finer = SIZE_MAX;
    for (const double bound : {1., 4., 16., 64., 256., 1024., 4096., 70000.}) {
      const size_t bytes = encode(heights, &image, within(bound)).size();
      EXPECT_LE(static_cast<double>(bytes), 1.1 * static_cast<double>(finer)) << bound;
      finer = bytes;
    }
    EXPECT_LT(finer, image.data.size() / 20) << "next to nothing is asked for";
  }
}

/// Flat ground says nothing about texels: they are whole, in the bytes of a lossless stream.
TEST(TextureBesideBound, IsLosslessOverFlatGround) {
  const Raster image = photograph();
  const Raster flat = make({Pattern::kFlat, 161, 140, 1, TKS_I16});
  const Bytes bytes = encode(&flat, &image, within(1));
  const size_t of_bound = 16;  // what the header says of it
  EXPECT_LE(bytes.size(), encode(&flat, &image, lossless()).size() + of_bound);
  Stream stream(bytes);
  EXPECT_TRUE(stream.heights() == flat.data);
  EXPECT_TRUE(stream.texture() == image.data);
}

}  // namespace
}  // namespace tetrakis::test

// SPDX-License-Identifier: Apache-2.0
// A decoder that goes on with more bytes decodes large textures in strips of rows. Their texels are
// those of one that begins anew.
#include "conformance/samples/void_masks.hpp"
#include "tests/support/stream_fixture.hpp"

namespace tetrakis::test {
namespace {

using samples::make;
using samples::Pattern;
using samples::Raster;

/// More than a strip, whose rows no power of two divides.
constexpr uint32_t kWidth = 700, kHeight = 1601;

struct Case {
  const char* name;
  Raster image;
  tks_encode_options options;
};

std::vector<Case> cases() {
  const Raster opaque = make({Pattern::kRidges, kWidth, kHeight, 3, TKS_U8});
  Raster cut_out = make({Pattern::kRidges, kWidth, kHeight, 4, TKS_U8, 4});
  samples::cutOut(cut_out, samples::validity(samples::VoidShape::kCoast, kWidth, kHeight));
  tks_encode_options regions = lossless();
  regions.regions = 256;
  return {{"one track", opaque, budget(40000)},
          {"lossless regions, whose fractions are carried", opaque, regions},
          {"a cut-out", cut_out, budget(60000)}};
}

TEST(TextureStrips, AreLikeTheWholeImage) {
  for (const Case& c : cases()) {
    SCOPED_TRACE(c.name);
    const Bytes bytes = encode(nullptr, &c.image, c.options);
    size_t there = readHeader(bytes)->bytes;
    Stream growing(Prefix(bytes).first(there));
    for (const size_t end : {there + 30, bytes.size() / 5, bytes.size()}) {
      ASSERT_EQ(tks_append(growing.get(), bytes.data() + there, end - there), TKS_OK);
      there = end;
      Stream anew(Prefix(bytes).first(end));
      ASSERT_TRUE(growing.texture() == anew.texture()) << end << " of " << bytes.size();
    }
  }
}

}  // namespace
}  // namespace tetrakis::test

// SPDX-License-Identifier: Apache-2.0
// Streams of later versions: components and parts that this decoder does not know stand among those
// that it does. It passes over them, at every prefix, and so does the reference decoder.
#include <iterator>
#include <vector>

#include "conformance/samples/header_parts.hpp"
#include "tests/conformance/agreement.hpp"
#include "tests/support/later_stream.hpp"

namespace tetrakis::test {
namespace {

/// Every prefix of `later` decodes to what as much of the plain stream decodes to.
void expectPassesOver(const Among& among) {
  for (size_t n = 0; n <= among.later.size(); ++n) {
    SCOPED_TRACE("prefix of " + std::to_string(n) + " of " + std::to_string(among.later.size()));
    const Prefix prefix = Prefix(among.later).first(n);
    expectAgreement(prefix);
    if (::testing::Test::HasFatalFailure()) return;
    if (among.as_much[n] == 0) continue;
    Stream later(prefix), plain(Prefix(among.plain).first(among.as_much[n]));
    ASSERT_EQ(later.status(), TKS_OK) << later.message();
    ASSERT_EQ(plain.status(), TKS_OK) << plain.message();
    ASSERT_EQ(later.heights(), plain.heights());
    ASSERT_EQ(later.texture(), plain.texture());
    ASSERT_EQ(later.info().heights_rmse, plain.info().heights_rmse);
    ASSERT_EQ(later.info().texture_psnr, plain.info().texture_psnr);
  }
}

TEST(ReferenceList, PassesOverComponentsThatNobodyKnows) {
  const Raster heights = make({Pattern::kRidges, 25, 9, 1, TKS_I16, 19});
  const Raster image = make({Pattern::kRidges, 6, 9, 3, TKS_U8, 20});
  const Domain sphere{9, {0, 0}}, grid{Domain::kGrid, {70, 3000}};
  const std::vector<std::vector<ListedComponent>> lists = {
      {unknown(7, grid, 0, "first")},
      {known(Component::kTexture), unknown(7, sphere, 2, ""), known(Component::kGeometry),
       unknown(ListedComponent::kColours, sphere, 0, "colours")},
      {known(Component::kGeometry), known(Component::kTexture),
       unknown(ListedComponent::kHeights, grid, 4, "second heights")}};
  tks_encode_options in_regions = lossless();
  in_regions.regions = 16;
  for (const tks_encode_options& options : {lossless(), in_regions}) {
    const Bytes plain = encode(&heights, &image, options);
    for (const auto& list : lists) {
      SCOPED_TRACE(std::to_string(list.size()) + " listed");
      expectPassesOver(LaterStream(plain, list).make());
      if (HasFatalFailure()) return;
    }
  }
}

/// A stream of heights and a texture beside something else, whose bytes are damaged.
TEST(ReferenceList, AgreesOnDamagedLists) {
  const Raster heights = make({Pattern::kRidges, 9, 7, 1, TKS_I16, 19});
  const Raster image = make({Pattern::kRidges, 6, 9, 3, TKS_U8, 20});
  const Bytes plain = encode(&heights, &image, lossless());
  const Domain sphere{9, {0, 0}};
  Bytes later =
      LaterStream(plain, {unknown(7, sphere, 2, "what"), known(Component::kTexture)}).make().later;
  HeaderParts body = bodyOf(later);
  body.add(99, {1, 2, 3});
  later = withBody(later, body);
  const size_t header = static_cast<size_t>(Stream(later).info().header_bytes);
  for (size_t at = 8; at < later.size(); ++at) {
    for (const int change : {1, 2, 4, 8, 16, 32, 64, 127, 128, 255}) {
      SCOPED_TRACE(std::to_string(at) + " changed by " + std::to_string(change));
      Bytes damaged = later;
      damaged[at] ^= static_cast<uint8_t>(change);
      if (at < header) sealHeader(damaged);
      expectAgreement(damaged);
      if (HasFatalFailure()) return;
    }
  }
}

/// Parts of any kind and size anywhere, and parts that stand twice or in another order.
TEST(ReferenceList, AgreesOnPartsOfAnyKind) {
  const Raster heights = make({Pattern::kRidges, 9, 7, 1, TKS_I16, 19});
  const Raster image = make({Pattern::kRidges, 6, 9, 3, TKS_U8, 20});
  const Bytes streams[] = {encode(&heights, nullptr, lossless()),
                           encode(nullptr, &image, lossless())};
  constexpr uint64_t kKinds[] = {0, 1, 2, 4, 9, 16, 19, 23, 63, 64, 66, 73, 1000, UINT64_MAX};
  int unsupported = 0, corrupt = 0, decoded = 0;
  for (const Bytes& stream : streams) {
    for (uint32_t trial = 0; trial < 600; ++trial) {
      SCOPED_TRACE(trial);
      HeaderParts body = bodyOf(stream), component = componentOfStream(stream);
      HeaderParts& changed = trial % 2 == 0 ? body : component;
      for (uint32_t i = 0; i <= trial % 3; ++i) {
        const uint32_t h = samples::hash(trial, i, 41);
        const uint64_t kind = kKinds[h % std::size(kKinds)];
        const Bytes bytes((h >> 8) % 4, static_cast<uint8_t>((h >> 16) % 3));
        const bool in_order = (h >> 20) % 4 > 0;
        const auto place = static_cast<ptrdiff_t>((h >> 24) % (changed.parts.size() + 1));
        if (in_order)
          changed.add(kind, bytes);
        else
          changed.parts.insert(changed.parts.begin() + place, {kind, bytes});
      }
      if (trial % 2 == 1) body.find(kComponentKind)->bytes = component.bytes();
      const Bytes made = withBody(stream, body);
      expectAgreement(made);
      if (HasFatalFailure()) return;
      const tks_status status = Stream(made).status();
      unsupported += status == TKS_UNSUPPORTED;
      corrupt += status == TKS_CORRUPT;
      decoded += status == TKS_OK;
    }
  }
  EXPECT_GT(unsupported, 100);
  EXPECT_GT(corrupt, 100);
  EXPECT_GT(decoded, 100);
}

}  // namespace
}  // namespace tetrakis::test

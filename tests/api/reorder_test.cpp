// SPDX-License-Identifier: Apache-2.0
// tks_reorder: the same packets in the order that serves cameras.
#include <cmath>

#include "conformance/samples/header_parts.hpp"
#include "tests/support/indexed_terrain.hpp"
#include "tests/support/later_stream.hpp"

namespace tetrakis::test {
namespace {

using samples::make;
using samples::Pattern;
using samples::Raster;

Bytes reordered(Stream& stream, const tks_screen_camera& view) {
  tks_buffer buffer = {};
  EXPECT_EQ(tks_reorder(stream.get(), &view, 1, &buffer), TKS_OK) << tks_message(stream.get());
  const Bytes bytes(buffer.data, buffer.data + buffer.size);
  tks_free_buffer(&buffer);
  return bytes;
}

TEST(Reorder, HoldsTheSamePacketsAndServesTheCamera) {
  const Raster image = make({Pattern::kRidges, 128, 128, 3, TKS_U8});
  const Bytes bytes = encodeRegions(nullptr, &image, lossless());
  Stream stream(bytes);
  const tks_window corner = {70, 75, 40, 40};
  const Bytes order = reordered(stream, mapOf(70, 75, 110, 115));
  ASSERT_EQ(order.size(), bytes.size());
  Stream whole(order);
  EXPECT_EQ(tks_verify(whole.get()), TKS_OK) << tks_message(whole.get());
  EXPECT_EQ(squaredError(image, whole.texture()), 0);
  const size_t third = bytes.size() / 6;
  Stream a(Prefix(order).first(third)), b(Prefix(bytes).first(third));
  EXPECT_LT(errorIn(image, a.texture(), corner), 0.4 * errorIn(image, b.texture(), corner));
  for (size_t n = static_cast<size_t>(whole.info().header_bytes); n < order.size(); n += 97)
    EXPECT_EQ(Stream(Prefix(order).first(n)).status(), TKS_OK);
}

/// The heads of packets of components that are not known.
std::vector<PacketHead> unknownHeads(const Bytes& bytes) {
  const ParsedHeader parsed = *readHeader(bytes);
  std::vector<PacketHead> heads =
      demultiplex(Prefix(bytes).subspan(parsed.bytes), parsed.bytes, trackCounts(parsed.header))
          ->heads;
  std::erase_if(heads, [](const PacketHead& h) { return h.component != Component::kOther; });
  return heads;
}

/// What nobody knows yet stays what it is: domains, components, parts.
TEST(Reorder, KeepsWhatNobodyKnows) {
  const IndexedTerrain terrain;
  const Domain sphere{9, {0, 0}};
  Bytes bytes =
      LaterStream(terrain.bytes, {unknown(5, sphere, 3, "what"), known(Component::kTexture),
                                  unknown(6, sphere, 0, "later")})
          .make()
          .later;
  HeaderParts body = bodyOf(bytes);
  for (HeaderPart& part : body.parts) {
    if (part.kind != kComponentKind || part.bytes[0] > 1) continue;
    HeaderParts component = componentOf(part.bytes);
    component.add(99, {4, 5, 6});
    part.bytes = component.bytes();
  }
  body.add(100, {1, 2, 3});
  body.add(70000, {});
  bytes = withBody(bytes, body);
  Stream stream(bytes);
  const Bytes order = reordered(stream, mapOf(70, 75, 110, 115));
  ASSERT_EQ(order.size(), bytes.size());
  EXPECT_NE(order, bytes);
  Stream whole(order);
  EXPECT_EQ(tks_verify(whole.get()), TKS_OK) << tks_message(whole.get());
  EXPECT_TRUE(whole.heights() == stream.heights());
  EXPECT_TRUE(whole.texture() == stream.texture());
  EXPECT_TRUE(unknownHeads(order) == unknownHeads(bytes));
  constexpr uint64_t kIndexKind = 70;
  HeaderParts after = bodyOf(order);
  ASSERT_EQ(after.parts.size(), body.parts.size());
  for (size_t i = 0; i < after.parts.size(); ++i) {
    EXPECT_EQ(after.parts[i].kind, body.parts[i].kind);
    if (after.parts[i].kind == kIndexKind) continue;
    EXPECT_EQ(after.parts[i].bytes, body.parts[i].bytes) << i;
  }
}

/// The stated error is that of the packets which are there now.
TEST(Reorder, StatesNoSmallerErrorThanThereIs) {
  const IndexedTerrain terrain;
  Stream stream(terrain.bytes);
  const Bytes order = reordered(stream, alongRows(45, -20, 900));
  for (size_t part = 9; part < 40; part += 5) {
    Stream prefix(Prefix(order).first(order.size() * part / 40));
    const double rmse = std::sqrt(squaredError(terrain.heights, prefix.heights()) / (90 * 70));
    EXPECT_LE(rmse, 1.2 * prefix.info().heights_rmse) << part;
  }
  EXPECT_EQ(Stream(order).info().heights_rmse, 0);
  EXPECT_EQ(Stream(order).info().texture_psnr, HUGE_VAL);
}

/// Ground of one height needs no packets, and so an index of none.
TEST(Reorder, TakesStreamsWithNothingToSend) {
  const Raster heights = make({Pattern::kFlat, 40, 31, 1, TKS_I16});
  tks_encode_options options = lossless();
  options.index = 1;
  const Bytes bytes = encode(&heights, nullptr, options);
  Stream stream(bytes);
  ASSERT_EQ(stream.info().header_bytes, bytes.size());
  EXPECT_EQ(reordered(stream, mapOf(0, 0, 10, 10)), bytes);
  tks_ranges ranges = {};
  EXPECT_EQ(tks_needed_ranges(stream.get(), TKS_PART_HEIGHTS, nullptr, &ranges), TKS_OK);
  EXPECT_EQ(ranges.count, 0u);
  tks_free_ranges(&ranges);
}

TEST(Reorder, PrefixesAndBudgetsKeepWhatTheyHave) {
  const IndexedTerrain terrain;
  const tks_screen_camera view = alongRows(45, -20, 900);
  const Bytes cut = encodeRegions(&terrain.heights, &terrain.image, budget(4000));
  for (const Bytes& bytes : {terrain.bytes, cut}) {
    for (size_t n = static_cast<size_t>(Stream(bytes).info().header_bytes); n <= bytes.size();
         n += 1 + bytes.size() / 23) {
      Stream prefix(Prefix(bytes).first(n));
      const Bytes order = reordered(prefix, view);
      ASSERT_EQ(order.size(), n);
      Stream stream(order);
      ASSERT_EQ(stream.status(), TKS_OK) << stream.message();
      EXPECT_TRUE(stream.heights() == prefix.heights()) << n;
      EXPECT_TRUE(stream.texture() == prefix.texture()) << n;
    }
  }
}

/// Each byte of the index, damaged: what is handed over holds what the stream holds.
TEST(Reorder, TrustsNoIndexThatLies) {
  const Raster heights = make({Pattern::kRidges, 40, 31, 1, TKS_I16});
  const Bytes bytes = encodeRegions(&heights, nullptr, lossless());
  const tks_screen_camera view = mapOf(0, 0, 10, 10);
  const size_t header = static_cast<size_t>(Stream(bytes).info().header_bytes);
  size_t refused = 0;
  for (size_t at = header / 2; at < header - 4; ++at) {
    Bytes damaged = bytes;
    damaged[at] ^= 4;
    sealHeader(damaged);
    Stream stream(damaged);
    if (stream.status() != TKS_OK) continue;
    tks_buffer buffer = {};
    const tks_status status = tks_reorder(stream.get(), &view, 1, &buffer);
    if (status == TKS_OK) {
      const Bytes order(buffer.data, buffer.data + buffer.size);
      EXPECT_TRUE(Stream(order).heights() == stream.heights()) << at;
    } else {
      EXPECT_EQ(status, TKS_CORRUPT) << stream.message();
      ++refused;
    }
    tks_free_buffer(&buffer);
  }
  EXPECT_GT(refused, 20u);
}

TEST(Reorder, IsRefusedWithoutIndexOrCameras) {
  const Raster heights = make({Pattern::kRidges, 40, 31, 1, TKS_I16});
  const Bytes bytes = encode(&heights, nullptr, lossless());
  Stream stream(bytes);
  const tks_screen_camera view = mapOf(0, 0, 10, 10);
  tks_buffer buffer = {};
  EXPECT_EQ(tks_reorder(stream.get(), &view, 1, &buffer), TKS_USAGE);
  EXPECT_NE(std::string(tks_message(stream.get())).find("no front index"), std::string::npos);
  const IndexedTerrain terrain;
  Stream indexed(terrain.bytes);
  EXPECT_EQ(tks_reorder(indexed.get(), nullptr, 0, &buffer), TKS_USAGE);
  EXPECT_EQ(tks_reorder(indexed.get(), &view, 1, nullptr), TKS_USAGE);
}

}  // namespace
}  // namespace tetrakis::test

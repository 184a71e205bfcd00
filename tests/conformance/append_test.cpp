// SPDX-License-Identifier: Apache-2.0
// A decoder that is given a stream bit by bit decodes what one decodes that is opened on all of it:
// over the conformance vectors, which hold every kind of stream.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "tests/support/stream_fixture.hpp"

namespace tetrakis::test {
namespace {

struct Vector {
  std::string name;
  Bytes bytes;
};

/// The vectors of at most so many bytes that are streams.
std::vector<Vector> vectors(size_t most_bytes) {
  std::vector<Vector> all;
  for (const auto& entry : std::filesystem::directory_iterator(TETRAKIS_VECTORS)) {
    if (entry.path().extension() != ".tks" || entry.file_size() > most_bytes) continue;
    std::ifstream file(entry.path(), std::ios::binary);
    Bytes bytes{std::istreambuf_iterator<char>(file), {}};
    if (Stream(bytes).status() == TKS_OK)
      all.push_back({entry.path().filename().string(), std::move(bytes)});
  }
  std::sort(all.begin(), all.end(),
            [](const Vector& a, const Vector& b) { return a.name < b.name; });
  EXPECT_GT(all.size(), 10u);
  return all;
}

/// Of the level that is set: what a decoder gives, and what it says.
struct Decoded {
  std::vector<std::byte> heights, texture;
  uint64_t available = 0, packets = 0;
  double rmse = 0, psnr = 0;
  bool operator==(const Decoded&) const = default;
};

Decoded decodedFrom(Stream& stream) {
  tks_info info = {};
  info.size = sizeof info;
  EXPECT_EQ(tks_get_info(stream.get(), &info), TKS_OK);
  return {stream.heights(), stream.texture(),  info.available_bytes,
          info.packets,     info.heights_rmse, info.texture_psnr};
}

uint64_t headerOf(const Bytes& bytes) {
  uint64_t header = 0;
  EXPECT_EQ(tks_header_bytes(bytes.data(), bytes.size(), &header), TKS_OK);
  return header;
}

/// Opens the first `opened` bytes and appends pieces of `stride` bytes, each in memory that is gone
/// afterwards.
void appendAndCompare(const Vector& vector, uint64_t opened, size_t stride) {
  const Bytes& bytes = vector.bytes;
  Bytes opening(bytes.begin(), bytes.begin() + static_cast<ptrdiff_t>(opened));
  Stream growing(opening);
  ASSERT_EQ(growing.status(), TKS_OK) << vector.name;
  for (size_t end = opening.size(); end < bytes.size();) {
    const size_t begin = end;
    end = std::min(begin + stride, bytes.size());
    {
      const Bytes piece(bytes.begin() + static_cast<ptrdiff_t>(begin),
                        bytes.begin() + static_cast<ptrdiff_t>(end));
      ASSERT_EQ(tks_append(growing.get(), piece.data(), piece.size()), TKS_OK)
          << vector.name << ": " << tks_message(growing.get());
    }
    if (begin == opened) opening.assign(opening.size(), 0xee);  // no longer needed
    growing.lookAgain();
    Stream fresh(Prefix(bytes).first(end));
    ASSERT_TRUE(decodedFrom(growing) == decodedFrom(fresh))
        << vector.name << ": " << end << " of " << bytes.size() << " bytes, by " << stride;
  }
  EXPECT_EQ(tks_verify(growing.get()), tks_verify(Stream(bytes).get())) << vector.name;
}

TEST(Append, ByteByByteIsAsFromTheStart) {
  for (const Vector& vector : vectors(400))
    ASSERT_NO_FATAL_FAILURE(appendAndCompare(vector, headerOf(vector.bytes), 1));
}

TEST(Append, InPiecesIsAsFromTheStart) {
  for (const Vector& vector : vectors(9000)) {
    const size_t tenth = std::max<size_t>(vector.bytes.size() / 10, 1);
    ASSERT_NO_FATAL_FAILURE(appendAndCompare(vector, headerOf(vector.bytes), tenth));
  }
}

/// The bytes that a decoder was opened on are no longer needed, though no call has decoded them.
TEST(Append, ToSomePacketsIsAsFromTheStart) {
  for (const Vector& vector : vectors(9000)) {
    const uint64_t header = headerOf(vector.bytes), payload = vector.bytes.size() - header;
    ASSERT_NO_FATAL_FAILURE(appendAndCompare(vector, header + payload * 3 / 4, payload / 8 + 1));
  }
}

/// Levels are remembered apart.
TEST(Append, LevelsInTurnAreAsFromTheStart) {
  for (const Vector& vector : vectors(3000)) {
    const Bytes& bytes = vector.bytes;
    uint64_t header = 0;
    ASSERT_EQ(tks_header_bytes(bytes.data(), bytes.size(), &header), TKS_OK);
    Stream growing(Prefix(bytes).first(header));
    const tks_info& info = growing.info();
    const auto sizes = [](Stream& stream, uint32_t level) {
      tks_info now = stream.info();
      EXPECT_EQ(tks_set_levels(stream.get(), std::min(level, now.coarsest_level),
                               std::min(level, now.texture_coarsest_level)),
                TKS_OK);
      tks_get_info(stream.get(), &now);
      std::vector<std::byte> heights(
          now.has_heights ? size_t{now.width} * now.height * tks_sample_bytes(now.sample) : 0);
      if (now.has_heights) {
        EXPECT_EQ(tks_decode_heights(stream.get(), heights.data(), heights.size()), TKS_OK);
      }
      std::vector<std::byte> texture(
          now.has_texture ? size_t{now.texture_width} * now.texture_height * now.texture_channels *
                                tks_sample_bytes(now.texture_sample)
                          : 0);
      if (now.has_texture) {
        EXPECT_EQ(tks_decode_texture(stream.get(), texture.data(), texture.size()), TKS_OK);
      }
      heights.insert(heights.end(), texture.begin(), texture.end());
      return heights;
    };
    EXPECT_GE(info.header_bytes, header);
    for (size_t step = 1; step <= 6; ++step) {
      const size_t begin = header + (bytes.size() - header) * (step - 1) / 6,
                   end = header + (bytes.size() - header) * step / 6;
      ASSERT_EQ(tks_append(growing.get(), bytes.data() + begin, end - begin), TKS_OK);
      Stream fresh(Prefix(bytes).first(end));
      for (const uint32_t level : {1u, 0u})
        ASSERT_TRUE(sizes(growing, level) == sizes(fresh, level)) << vector.name << " " << end;
    }
  }
}

/// The next bytes do not follow those that the decoder has.
TEST(Append, TakesNothingAfterARefusal) {
  const samples::Raster heights = samples::make({samples::Pattern::kRidges, 70, 45, 1, TKS_I16});
  const Bytes bytes = encode(&heights, nullptr, lossless());
  tks_limits limits = {};
  limits.size = sizeof limits;
  limits.max_memory = 600000;
  Stream stream(Prefix(bytes).first(500), &limits);
  ASSERT_EQ(stream.status(), TKS_OK);
  const std::vector<std::byte> before = Stream(Prefix(bytes).first(500)).heights();
  const Bytes many(700000, 7);
  EXPECT_EQ(tks_append(stream.get(), many.data(), many.size()), TKS_LIMIT);
  EXPECT_EQ(tks_append(stream.get(), bytes.data() + 700, 100), TKS_LIMIT);
  EXPECT_TRUE(stream.heights() == before);
}

TEST(Append, NonsenseIsRefused) {
  const samples::Raster heights = samples::make({samples::Pattern::kRidges, 30, 20, 1, TKS_I16});
  const Bytes bytes = encode(&heights, nullptr, lossless());
  Stream stream(bytes);
  EXPECT_EQ(tks_append(stream.get(), nullptr, 5), TKS_USAGE);
  EXPECT_EQ(tks_append(stream.get(), nullptr, 0), TKS_OK);
  EXPECT_EQ(tks_append(nullptr, bytes.data(), 5), TKS_USAGE);
  EXPECT_EQ(tks_put(stream.get(), UINT64_MAX, bytes.data(), 5), TKS_USAGE);
  EXPECT_EQ(tks_put_ranges(stream.get(), nullptr, nullptr, 0), TKS_OK);
  EXPECT_EQ(tks_put_ranges(stream.get(), nullptr, nullptr, 1), TKS_USAGE);
  const tks_range range{0, 5, 0};
  const uint8_t* const nothing = nullptr;
  EXPECT_EQ(tks_put_ranges(stream.get(), &range, &nothing, 1), TKS_USAGE);
}

/// Where memory does not suffice to remember tracks, they are decoded from their beginning.
TEST(Append, ForgetsWhereMemoryIsShort) {
  const samples::Raster heights = samples::make({samples::Pattern::kRidges, 300, 200, 1, TKS_I16});
  const Bytes bytes = encode(&heights, nullptr, lossless());
  const Stream whole(bytes);
  uint64_t needed = 0;
  ASSERT_EQ(tks_check_memory(whole.get(), TKS_PART_HEIGHTS, nullptr, 0, 0, &needed), TKS_OK);
  tks_limits limits = {};
  limits.size = sizeof limits;
  limits.max_memory = needed + 6 * bytes.size() + 100000;
  Stream stream(Prefix(bytes).first(bytes.size() / 2), &limits);
  ASSERT_EQ(
      tks_append(stream.get(), bytes.data() + bytes.size() / 2, bytes.size() - bytes.size() / 2),
      TKS_OK)
      << tks_message(stream.get());
  EXPECT_EQ(squaredError(heights, stream.heights()), 0);
}

}  // namespace
}  // namespace tetrakis::test

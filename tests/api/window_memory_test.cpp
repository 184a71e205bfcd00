// SPDX-License-Identifier: Apache-2.0
// What windows leave to those that come after them changes nothing: calls of one decoder, in any
// order and with more bytes in between, give what a decoder gives that was opened for each.
#include <array>
#include <random>

#include "conformance/samples/void_masks.hpp"
#include "tests/support/indexed_terrain.hpp"

namespace tetrakis::test {
namespace {

using samples::make;
using samples::Pattern;
using samples::Raster;

/// What is asked of a decoder.
struct Question {
  bool texture = false;
  std::optional<tks_window> window;
  uint32_t level = 0;
  uint32_t threads = 1;
};

/// Less than that.
uint32_t below(uint64_t count, std::mt19937& random) {
  return static_cast<uint32_t>(random() % count);
}

Question anyQuestion(const tks_info& info, std::mt19937& random) {
  Question question;
  question.texture = !info.has_heights || (info.has_texture && random() % 2 == 0);
  question.threads = 1 + below(3, random);
  const uint32_t width = question.texture ? info.texture_width : info.width,
                 height = question.texture ? info.texture_height : info.height;
  if (random() % 5 == 0) {
    question.level = below(3, random);
    return question;
  }
  const uint32_t x = below(width, random), y = below(height, random);
  const uint32_t most = random() % 3 == 0 ? 1 : 40;  // points, too
  question.window = tks_window{x, y, 1 + below(std::min(width - x, most), random),
                               1 + below(std::min(height - y, most), random)};
  return question;
}

std::vector<std::byte> answer(const Stream& stream, const Question& question) {
  const tks_info& info = stream.info();
  const bool texture = question.texture;
  const auto side = [&](uint32_t whole) { return ((whole - 1) >> question.level) + 1; };
  const size_t places = question.window ? size_t{question.window->width} * question.window->height
                        : texture ? size_t{side(info.texture_width)} * side(info.texture_height)
                                  : size_t{side(info.width)} * side(info.height);
  std::vector<std::byte> out(
      places * (texture ? info.texture_channels * tks_sample_bytes(info.texture_sample)
                        : tks_sample_bytes(info.sample)));
  tks_decoder* const decoder = stream.get();
  EXPECT_EQ(tks_set_threads(decoder, question.threads), TKS_OK);
  EXPECT_EQ(tks_set_levels(decoder, texture ? 0 : question.level, texture ? question.level : 0),
            TKS_OK);
  tks_status status = TKS_OK;
  if (question.window) {
    const auto call = texture ? tks_decode_texture_window : tks_decode_heights_window;
    status = call(decoder, &*question.window, out.data(), out.size());
  } else {
    status = (texture ? tks_decode_texture : tks_decode_heights)(decoder, out.data(), out.size());
  }
  EXPECT_EQ(status, TKS_OK) << tks_message(decoder);
  return out;
}

Raster terrain(tks_sample sample = TKS_I16) {
  return make({Pattern::kRidges, 110, 97, 1, sample, 3});
}

/// Streams with all that comes before coefficients or behind them.
std::vector<std::pair<std::string, Bytes>> makeStreams() {
  const Raster heights = terrain(), image = make({Pattern::kRidges, 90, 101, 3, TKS_U8, 3});
  Raster measured = terrain(TKS_F32), cut = make({Pattern::kRidges, 90, 81, 4, TKS_U8, 3});
  for (size_t i = 0; i < size_t{110} * 97; ++i) {
    const auto third = static_cast<float>(sampleAt(measured.data, TKS_F32, i) / 3);
    std::memcpy(measured.data.data() + 4 * i, &third, 4);
  }
  samples::cutOut(cut, samples::validity(samples::VoidShape::kHoles, 90, 81));
  const Raster holes = terrain();
  tks_heights voids = holes.heights();
  voids.has_nodata = 1;
  voids.nodata = sampleAt(holes.data, holes.sample, 55);
  return {{"lossless", encodeRegions(&heights, nullptr, lossless())},
          {"without regions", encode(&heights, nullptr, inRegions(lossless(), 1))},
          {"lossy, with texels", encodeRegions(&heights, &image, budget(12000))},
          {"lossless texels", encodeRegions(nullptr, &image, lossless())},
          {"a largest error", encodeRegions(&heights, nullptr, within(20))},
          {"corrected floats", encodeRegions(&measured, nullptr, lossless())},
          {"cut-out", encodeRegions(nullptr, &cut, budget(8000))},
          {"voids", encodeHeights(voids, inRegions(lossless()))},
          {"lossy voids", encodeHeights(voids, inRegions(budget(6000)))}};
}

const auto& streams() {
  static const auto all = makeStreams();
  return all;
}

/// So little that most tracks are forgotten again, less than a track takes, or enough for all.
std::vector<tks_limits> limits() {
  std::vector<tks_limits> all;
  for (const uint64_t most : {uint64_t{0}, uint64_t{8} << 20, uint64_t{5} << 20}) {
    tks_limits one = {};
    one.size = sizeof one;
    one.max_memory = most;
    all.push_back(one);
  }
  return all;
}

TEST(WindowMemory, ChangesNoAnswer) {
  std::mt19937 random(1);
  for (const auto& [name, bytes] : streams()) {
    for (const tks_limits& limit : limits()) {
      const Stream lasting(bytes, &limit);
      for (int i = 0; i < 20; ++i) {
        const Question question = anyQuestion(lasting.info(), random);
        const Stream fresh(bytes);
        ASSERT_TRUE(answer(lasting, question) == answer(fresh, question)) << name << ", " << i;
      }
    }
  }
}

TEST(WindowMemory, GrowsWithTheBytes) {
  std::mt19937 random(2);
  for (const auto& [name, bytes] : streams()) {
    size_t end = static_cast<size_t>(Stream(bytes).info().header_bytes);
    const Stream lasting(Prefix(bytes).first(end));
    while (end < bytes.size()) {
      const size_t more = std::min(1 + size_t{below(bytes.size() / 6, random)}, bytes.size() - end);
      ASSERT_EQ(tks_append(lasting.get(), bytes.data() + end, more), TKS_OK);
      end += more;
      for (int i = 0; i < 2; ++i) {
        const Question question = anyQuestion(lasting.info(), random);
        const Stream fresh(Prefix(bytes).first(end));
        ASSERT_TRUE(answer(lasting, question) == answer(fresh, question)) << name << ", " << end;
      }
    }
  }
}

/// Pieces come in any order, as do those of a map that is moved about.
TEST(WindowMemory, GrowsAroundGaps) {
  std::mt19937 random(3);
  for (const auto& named : streams()) {
    const Bytes& bytes = named.second;
    const Stream whole(bytes);
    if (whole.info().index == TKS_INDEX_NONE) continue;
    const auto header = static_cast<size_t>(whole.info().header_bytes);
    const Stream lasting(Prefix(bytes).first(header));
    std::vector<tks_range> pieces;
    for (size_t at = header; at < bytes.size();) {
      const size_t size = std::min(1 + size_t{below(bytes.size() / 5, random)}, bytes.size() - at);
      pieces.push_back({at, size, 0});
      at += size;
    }
    std::shuffle(pieces.begin(), pieces.end(), random);
    for (size_t count = 1; count <= pieces.size(); ++count) {
      const auto put = [&](const Stream& stream, const tks_range& piece) {
        ASSERT_EQ(tks_put(stream.get(), piece.offset, bytes.data() + piece.offset,
                          static_cast<size_t>(piece.size)),
                  TKS_OK);
      };
      put(lasting, pieces[count - 1]);
      for (int i = 0; i < 2; ++i) {
        const Question question = anyQuestion(lasting.info(), random);
        const Stream fresh(Prefix(bytes).first(header));
        for (size_t k = 0; k < count; ++k) put(fresh, pieces[k]);
        ASSERT_TRUE(answer(lasting, question) == answer(fresh, question))
            << named.first << ", " << count;
      }
    }
  }
}

}  // namespace
}  // namespace tetrakis::test

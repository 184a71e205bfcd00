// SPDX-License-Identifier: Apache-2.0
// Streams of several components: what is chosen is what its own stream holds, with its place, its
// unit and its promises; no prefix and no damage does worse than a status; and combined streams
// keep budgets and weights.
#include <cmath>
#include <cstring>
#include <optional>
#include <string>
#include <vector>

#include "conformance/reference_decoder.hpp"
#include "conformance/samples/header_seal.hpp"
#include "conformance/samples/void_masks.hpp"
#include "tests/conformance/agreement.hpp"
#include "tests/support/stream_fixture.hpp"
#include "tetrakis/components.h"
#include "tetrakis/tetrakis.hpp"

namespace tetrakis::test {
namespace {

using samples::Pattern;
using samples::Raster;

/// A stream, and what its components are called.
struct Named {
  Bytes stream;
  const char* name = nullptr;
  double weight = 0;
};

Result<Bytes> combined(const std::vector<Named>& streams, uint64_t bytes = 0) {
  std::vector<tks_combined> inputs;
  for (const Named& one : streams)
    inputs.push_back(
        {sizeof(tks_combined), one.stream.data(), one.stream.size(), one.name, one.weight});
  const Result<Buffer> made = combine(inputs, {sizeof(tks_combine_options), bytes, nullptr});
  if (!made) return made.status();
  return Bytes(made->bytes().begin(), made->bytes().end());
}

Raster dem() {
  return samples::make({Pattern::kRidges, 50, 41, 1, TKS_I16});
}

constexpr double kPlace[6] = {500000, 30, 0, 5200000, 0, -30};

/// Heights with voids, in feet, on the ground of the DEM.
Bytes laterAnew() {
  Raster raster = samples::make({Pattern::kHills, 50, 41, 1, TKS_I16, 5});
  const auto valid = samples::validity(samples::VoidShape::kCoast, 50, 41);
  for (size_t i = 0; i < valid.size(); ++i) {
    const int16_t nodata = -9999;
    if (valid[i] == 0) std::memcpy(raster.data.data() + 2 * i, &nodata, 2);
  }
  tks_heights heights = raster.heights();
  heights.unit = "ft";
  heights.scale = 1;
  heights.has_nodata = 1;
  heights.nodata = -9999;
  heights.crs = "EPSG:32632";
  heights.has_geotransform = 1;
  std::copy(std::begin(kPlace), std::end(kPlace), heights.geotransform);
  heights.description = "another year";
  return encodeHeights(heights, lossless());
}

Bytes baseAnew() {
  const Raster raster = dem(), picture = photograph();
  tks_heights heights = raster.heights();
  heights.unit = "m";
  heights.crs = "EPSG:32632";
  heights.has_geotransform = 1;
  std::copy(std::begin(kPlace), std::end(kPlace), heights.geotransform);
  const tks_image image = picture.image();
  return encodeGiven(&heights, &image, budget(6000));
}

Bytes classesAnew() {
  const Raster raster = samples::make({Pattern::kSteps, 50, 41, 1, TKS_U8, 3});
  tks_image image = raster.image();
  image.has_geotransform = 1;
  std::copy(std::begin(kPlace), std::end(kPlace), image.geotransform);
  image.crs = "EPSG:32632";
  return encodeGiven(nullptr, &image, lossless());
}

Bytes normalsAnew() {
  const Raster raster = samples::make({Pattern::kRidges, 61, 33, 3, TKS_U8, 8});
  return encode(nullptr, &raster, budget(2000));
}

/// Each is encoded once.
const Bytes& base() {
  static const Bytes stream = baseAnew();
  return stream;
}
const Bytes& later() {
  static const Bytes stream = laterAnew();
  return stream;
}
const Bytes& classes() {
  static const Bytes stream = classesAnew();
  return stream;
}
const Bytes& normals() {
  static const Bytes stream = normalsAnew();
  return stream;
}

const Bytes& everything() {
  static const Bytes stream =
      *combined({{base()}, {later(), "later"}, {classes(), "classes"}, {normals(), "normals"}});
  return stream;
}

uint32_t numberOf(const Decoder& decoder, const std::string& name) {
  for (uint32_t i = 0; i < decoder.info().components; ++i)
    if (decoder.component(i)->name == name) return i;
  return UINT32_MAX;
}

/// A decoder of `bytes` that has taken the component of that name.
Decoder chosen(Prefix bytes, const std::string& name) {
  Result<Decoder> decoder = Decoder::open(bytes);
  EXPECT_TRUE(decoder.ok());
  const Status status = decoder->choose(numberOf(*decoder, name));
  EXPECT_TRUE(status.ok()) << status.message();
  return std::move(*decoder);
}

TEST(Components, AreListed) {
  const auto decoder = Decoder::open(everything());
  ASSERT_TRUE(decoder.ok());
  ASSERT_EQ(decoder->info().components, 5u);
  const tks_component_kind kinds[] = {TKS_COMPONENT_HEIGHTS, TKS_COMPONENT_TEXTURE,
                                      TKS_COMPONENT_HEIGHTS, TKS_COMPONENT_TEXTURE,
                                      TKS_COMPONENT_TEXTURE};
  const char* const names[] = {"", "", "later", "classes", "normals"};
  uint64_t bytes = decoder->info().geometry_bytes;
  for (uint32_t i = 0; i < 5; ++i) {
    const tks_component one = *decoder->component(i);
    EXPECT_EQ(one.kind, kinds[i]);
    EXPECT_STREQ(one.name, names[i]);
    EXPECT_EQ(one.is_taken != 0, i < 2);
    EXPECT_GT(one.available_bytes, 0u);
    if (i > 0) bytes += one.available_bytes;
  }
  EXPECT_EQ(decoder->component(2)->width, 50u);
  EXPECT_EQ(decoder->component(4)->height, 33u);
  EXPECT_LT(bytes, everything().size());
  EXPECT_EQ(decoder->component(5).status().code(), TKS_USAGE);
}

TEST(Components, FirstOnesAreThoseOfTheFirstStream) {
  Stream alone{Prefix(base())}, among{Prefix(everything())};
  EXPECT_EQ(alone.heights(), among.heights());
  EXPECT_EQ(alone.texture(), among.texture());
  EXPECT_STREQ(among.info().unit, "m");
  EXPECT_EQ(among.info().geometry_bytes, alone.info().geometry_bytes);
}

TEST(Components, ChosenHeightsAreThoseOfTheirStream) {
  const Bytes own = later();
  Result<Decoder> alone = Decoder::open(own);
  Decoder taken = chosen(everything(), "later");
  EXPECT_EQ(*alone->heights(), *taken.heights());
  EXPECT_EQ(*alone->validity(), *taken.validity());
  const tks_info &a = alone->info(), &b = taken.info();
  EXPECT_STREQ(b.unit, "ft");
  EXPECT_STREQ(b.crs, a.crs);
  EXPECT_STREQ(b.description, "another year");
  EXPECT_EQ(b.nodata, a.nodata);
  EXPECT_EQ(b.exact_steps, 1);
  EXPECT_TRUE(std::equal(std::begin(kPlace), std::end(kPlace), b.geotransform));
  EXPECT_EQ(b.lossless, 0) << "the texture beside it is lossy";
  EXPECT_EQ(b.has_texture, 1);
}

TEST(Components, ChosenTexturesAreThoseOfTheirStream) {
  for (const auto& [name, own] : {std::pair("classes", classes()), {"normals", normals()}}) {
    SCOPED_TRACE(name);
    Stream alone{Prefix(own)};
    Decoder taken = chosen(everything(), name);
    EXPECT_EQ(alone.texture(), *taken.texture());
    EXPECT_EQ(taken.info().has_heights, 1);
    EXPECT_EQ(taken.info().texture_has_geotransform, alone.info().texture_has_geotransform);
  }
  Decoder taken = chosen(everything(), "classes");
  EXPECT_STREQ(taken.info().texture_crs, "EPSG:32632");
  EXPECT_TRUE(std::equal(std::begin(kPlace), std::end(kPlace), taken.info().texture_geotransform));
  EXPECT_STREQ(chosen(everything(), "normals").info().texture_crs, "");
}

TEST(Components, OfOneReferenceSystemSayItOnce) {
  const size_t header = Stream(everything()).info().header_bytes;
  size_t apart = 0;
  for (const Bytes& one : {base(), later(), classes(), normals()})
    apart += Stream{Prefix(one)}.info().header_bytes;
  EXPECT_LT(header, apart - 40);
}

/// Of every prefix both decoders show the same of each component.
TEST(Components, PrefixesAgreeWithTheReferenceDecoder) {
  const Bytes& stream = everything();
  for (size_t n = Stream(stream).info().header_bytes; n <= stream.size(); n += 997) {
    const Prefix cut = Prefix(stream).first(n);
    for (uint32_t i = 2; i < 5; ++i) {
      SCOPED_TRACE(std::to_string(n) + " bytes, component " + std::to_string(i));
      auto decoder = Decoder::open(cut);
      ASSERT_TRUE(decoder->choose(i).ok());
      const bool heights = decoder->component(i)->kind == TKS_COMPONENT_HEIGHTS;
      const auto expected = reference::decode(
          cut, 1 << 20, {}, heights ? reference::Choice{i, {}} : reference::Choice{{}, i});
      ASSERT_EQ(firstDifference(expected.heights, *decoder->heights()), expected.heights->size());
      ASSERT_EQ(firstDifference(expected.texture, *decoder->texture()), expected.texture->size());
    }
  }
}

TEST(Components, MayBeChosenInTurns) {
  auto decoder = Decoder::open(everything());
  const auto first = *decoder->texture();
  for (const uint32_t number : {3u, 4u, 2u, 3u, 1u, 0u}) {
    ASSERT_TRUE(decoder->choose(number).ok());
    EXPECT_TRUE(decoder->component(number)->is_taken);
  }
  EXPECT_EQ(*decoder->texture(), first);
  EXPECT_STREQ(decoder->info().unit, "m");
}

void appendVarint(uint64_t value, Bytes& out) {
  for (; value >= 0x80; value >>= 7) out.push_back(static_cast<uint8_t>(value | 0x80));
  out.push_back(static_cast<uint8_t>(value));
}

uint64_t varintAt(const Bytes& bytes, size_t& at) {
  uint64_t value = 0;
  for (int shift = 0;; shift += 7) {
    value |= uint64_t{bytes[at] & 0x7fu} << shift;
    if (bytes[at++] < 0x80) return value;
  }
}

/// The stream with a sketch (docs/FORMAT.md, section 2, part 75).
Bytes sketchedBy(const Bytes& sketch, const Bytes& stream) {
  size_t begin = 7;
  const uint64_t body_bytes = varintAt(stream, begin);
  size_t parts = begin;
  varintAt(stream, parts);  // payload_bytes
  Bytes part;
  appendVarint(75, part);
  appendVarint(sketch.size(), part);
  part.insert(part.end(), sketch.begin(), sketch.end());
  Bytes made(stream.begin(), stream.begin() + 7);
  appendVarint(body_bytes + part.size(), made);
  const auto from = [&](size_t at) { return stream.begin() + static_cast<ptrdiff_t>(at); };
  made.insert(made.end(), from(begin), from(parts));
  made.insert(made.end(), part.begin(), part.end());
  made.insert(made.end(), from(parts), stream.end());
  sealHeader(made);
  return made;
}

TEST(Components, OfSketchesStayChosenWhereTheStreamHasThem) {
  const Bytes sketch = *combined({{normals(), "a"}, {classes(), "classes"}});
  const auto texture_behind = [&](const Bytes& stream) {
    const Bytes bytes = sketchedBy(sketch, stream);
    Decoder decoder = chosen(Prefix(bytes).first(sketch.size() + 12), "classes");
    EXPECT_EQ(decoder.info().shows_sketch, 1);
    EXPECT_TRUE(decoder.append(Prefix(bytes).subspan(sketch.size() + 12)).ok());
    EXPECT_EQ(decoder.info().shows_sketch, 0);
    return *decoder.texture();
  };
  const auto whole = [](const Bytes& stream) { return *Decoder::open(stream)->texture(); };
  EXPECT_TRUE(texture_behind(*combined({{classes()}, {normals(), "b"}})) == whole(normals()));
  EXPECT_TRUE(texture_behind(classes()) == whole(classes())) << "there is one alone";
  EXPECT_TRUE(texture_behind(*combined({{classes()}, {later(), "later"}})) == whole(classes()));
}

TEST(Components, ThatAreNotThereAreRefused) {
  auto decoder = Decoder::open(everything());
  EXPECT_EQ(decoder->choose(5).code(), TKS_USAGE);
  EXPECT_EQ(decoder->info().texture_width, photograph().width);
  const Bytes more(1, 0);
  auto grown = Decoder::open(Prefix(everything()).first(2000));
  ASSERT_TRUE(grown->append(Prefix(everything()).subspan(2000, 100)).ok());
  EXPECT_EQ(grown->choose(3).code(), TKS_USAGE);
  tks_component out = {};
  EXPECT_EQ(tks_get_component(nullptr, 0, &out), TKS_USAGE);
  EXPECT_EQ(tks_choose_component(nullptr, 0), TKS_USAGE);
}

TEST(Components, GrowByBytesOnceTheyAreChosen) {
  const Bytes& stream = everything();
  Decoder grown = chosen(Prefix(stream).first(1500), "normals");
  ASSERT_TRUE(grown.append(Prefix(stream).subspan(1500)).ok());
  EXPECT_EQ(*grown.texture(), *chosen(stream, "normals").texture());
}

Bytes indexedHeights(Pattern pattern, uint32_t seed) {
  const Raster raster = samples::make({pattern, 150, 130, 1, TKS_U16, seed});
  tks_encode_options options = inRegions(lossless(), 32);
  options.index = TKS_INDEX_PACKETS;
  return encode(&raster, nullptr, options);
}

/// With indices on all sides the ranges of a window are enough for it.
TEST(Components, WindowsOfTheChosenTakeItsRangesAlone) {
  const Bytes own = indexedHeights(Pattern::kHills, 4);
  const Result<Bytes> both = combined({{indexedHeights(Pattern::kRidges, 1)}, {own, "second"}});
  ASSERT_TRUE(both.ok()) << both.status().message();
  const tks_window window{70, 60, 20, 20};
  const size_t header = Stream{Prefix(*both)}.info().header_bytes;
  Decoder taken = chosen(Prefix(*both).first(header), "second");
  EXPECT_EQ(taken.info().index, TKS_INDEX_PACKETS);
  const auto ranges = taken.neededRanges(TKS_PART_HEIGHTS, &window);
  ASSERT_TRUE(ranges.ok());
  uint64_t bytes = 0;
  for (const tks_range& range : *ranges) {
    ASSERT_TRUE(taken.put(range.offset, Prefix(*both).subspan(range.offset, range.size)).ok());
    bytes += range.size;
  }
  EXPECT_LT(bytes, own.size());
  auto alone = Decoder::open(own);
  EXPECT_EQ(*taken.heights(window), *alone->heights(window));
}

/// A budget cuts streams inside a packet, which the index of the combined stream says.
TEST(Components, OfCutStreamsKeepTheirIndex) {
  const Raster raster = samples::make({Pattern::kRidges, 150, 130, 1, TKS_U16, 1});
  tks_encode_options options = inRegions(budget(6000), 32);
  options.index = TKS_INDEX_PACKETS;
  const Bytes own = encode(&raster, nullptr, options);
  const Result<Bytes> both = combined({{own}, {own, "second"}});
  ASSERT_TRUE(both.ok());
  const size_t header = Stream{Prefix(*both)}.info().header_bytes;
  Decoder taken = chosen(Prefix(*both).first(header), "second");
  ASSERT_EQ(taken.info().index, TKS_INDEX_PACKETS);
  const auto ranges = taken.neededRanges(TKS_PART_HEIGHTS);
  ASSERT_TRUE(ranges.ok());
  for (const tks_range& range : *ranges)
    ASSERT_TRUE(taken.put(range.offset, Prefix(*both).subspan(range.offset, range.size)).ok());
  EXPECT_EQ(*taken.heights(), *Decoder::open(own)->heights());
}

TEST(Components, JoinHeightsAndATextureThatWereCodedApart) {
  const Raster heights = dem(), image = photograph();
  const Bytes ground = encode(&heights, nullptr, lossless()),
              picture = encode(nullptr, &image, lossless());
  for (const auto& order : {std::vector<Named>{{ground}, {picture}}, {{picture}, {ground}}}) {
    const Result<Bytes> joint = combined(order);
    ASSERT_TRUE(joint.ok());
    Stream stream{Prefix(*joint)};
    EXPECT_EQ(stream.heights(), heights.data);
    EXPECT_EQ(stream.texture(), image.data);
    EXPECT_EQ(stream.info().lossless, 1);
    EXPECT_EQ(tks_verify(stream.get()), TKS_OK);
  }
}

TEST(Components, OfCombinedStreamsStay) {
  const Result<Bytes> two = combined({{base()}, {later(), "later"}});
  const Result<Bytes> three = combined({{*two}, {classes(), "classes"}});
  const Result<Bytes> again = combined({{classes(), "only"}, {*three, "old"}});
  ASSERT_TRUE(again.ok()) << again.status().message();
  const Bytes own = later();
  Stream alone{Prefix(own)};
  EXPECT_EQ(*chosen(*three, "later").heights(), alone.heights());
  Decoder taken = chosen(*again, "later");
  EXPECT_EQ(*taken.heights(), alone.heights());
  EXPECT_STREQ(taken.info().unit, "ft");
  EXPECT_STREQ(taken.info().crs, "EPSG:32632");
  EXPECT_TRUE(std::equal(std::begin(kPlace), std::end(kPlace), taken.info().geotransform));
}

TEST(Components, OfPrefixesHoldWhatTheseHold) {
  const Bytes own = normals();
  const Stream whole{Prefix(own)};
  for (size_t n = whole.info().header_bytes; n < own.size(); n += 211) {
    const Result<Bytes> cut =
        combined({{base()}, {Bytes(own.begin(), own.begin() + static_cast<ptrdiff_t>(n)), "n"}});
    ASSERT_TRUE(cut.ok()) << cut.status().message();
    Stream alone(Prefix(own).first(n));
    EXPECT_EQ(*chosen(*cut, "n").texture(), alone.texture()) << n;
  }
}

/// One sample, a plain, voids alone, a row, and floats of all sizes, beside each other.
TEST(Components, OfAwkwardKindsComeBack) {
  Raster nothing = samples::make({Pattern::kFlat, 20, 30, 1, TKS_F32});
  const float nan = std::nanf("");
  for (size_t i = 0; i < nothing.data.size(); i += sizeof nan)
    std::memcpy(nothing.data.data() + i, &nan, sizeof nan);
  const std::vector<Raster> kinds = {samples::make({Pattern::kFlat, 1, 1, 1, TKS_I16}),
                                     samples::make({Pattern::kFlat, 50, 40, 1, TKS_U8}), nothing,
                                     samples::make({Pattern::kNoise, 300, 1, 1, TKS_I32}),
                                     samples::make({Pattern::kExtreme, 25, 25, 1, TKS_F32})};
  std::vector<Bytes> streams;
  for (const Raster& kind : kinds) streams.push_back(encode(&kind, nullptr, lossless()));
  for (size_t i = 0; i < kinds.size(); ++i) {
    for (size_t j = 0; j < kinds.size(); ++j) {
      SCOPED_TRACE(std::to_string(i) + " beside " + std::to_string(j));
      const Result<Bytes> both = combined({{streams[i]}, {streams[j], "second"}});
      ASSERT_TRUE(both.ok()) << both.status().message();
      Stream first{Prefix(*both)}, alone{Prefix(streams[j])};
      EXPECT_TRUE(sameBytes(first.heights(), Stream{Prefix(streams[i])}.heights()));
      EXPECT_TRUE(sameBytes(*chosen(*both, "second").heights(), alone.heights()));
    }
  }
}

TEST(Components, StayWithinABudget) {
  const std::vector<Named> all = {{base()}, {later(), "later"}, {classes(), "classes"}};
  const size_t whole = combined(all)->size();
  for (const size_t bytes :
       {size_t{400}, size_t{1000}, size_t{3333}, whole - 1, whole, whole + 1}) {
    const Result<Bytes> stream = combined(all, bytes);
    ASSERT_TRUE(stream.ok()) << stream.status().message();
    EXPECT_LE(stream->size(), bytes);
    EXPECT_GE(stream->size() + 8, std::min(bytes, whole)) << "a cut stream promises nothing";
    Decoder taken = chosen(*stream, "classes");
    EXPECT_EQ(tks_verify(Stream{Prefix(*stream)}.get()), TKS_OK);
    Decoder heights = chosen(*stream, "later");
    EXPECT_EQ(heights.info().lossless, 0);
  }
  EXPECT_EQ(combined(all, 50).status().code(), TKS_USAGE);
}

TEST(Components, GetMoreOfABudgetTheMoreTheyCount) {
  const Bytes ground = base(), picture = normals();
  uint64_t before = 0;
  for (const double weight : {0.001, 0.1, 1.0, 10.0, 1000.0}) {
    const Result<Bytes> stream = combined({{ground}, {picture, "n", weight}}, 3000);
    const auto decoder = Decoder::open(*stream);
    const uint64_t bytes = decoder->component(2)->available_bytes;
    EXPECT_GE(bytes, before) << weight;
    before = bytes;
  }
  EXPECT_GT(before, 1500u);
}

TEST(Components, ThatCannotBeCombinedAreRefused) {
  const auto codeOf = [](const std::vector<Named>& streams) {
    return combined(streams).status().code();
  };
  EXPECT_EQ(codeOf({}), TKS_USAGE);
  EXPECT_EQ(codeOf({{base()}, {normals()}}), TKS_USAGE) << "two textures without a name";
  EXPECT_EQ(codeOf({{base()}, {normals(), "n"}, {classes(), "n"}}), TKS_USAGE);
  EXPECT_EQ(codeOf({{base()}, {normals(), "n", -1}}), TKS_USAGE);
  EXPECT_EQ(codeOf({{base()}, {normals(), "n", kInfinity}}), TKS_USAGE);
  EXPECT_EQ(codeOf({{base()}, {normals(), "n", kNan}}), TKS_USAGE);
  EXPECT_EQ(codeOf({{base()}, {normals(), std::string(256, 'n').c_str()}}), TKS_USAGE);
  EXPECT_EQ(codeOf({{base()}, {Bytes(40, 7), "n"}}), TKS_CORRUPT);
  EXPECT_EQ(codeOf({{base()}, {Bytes(), "n"}}), TKS_TRUNCATED);
  std::vector<Named> many = {{base()}};
  std::vector<std::string> names;
  for (int i = 0; i < 15; ++i) names.push_back("n" + std::to_string(i));
  for (const std::string& name : names) many.push_back({normals(), name.c_str()});
  EXPECT_EQ(codeOf(many), TKS_USAGE) << "seventeen";
  many.pop_back();
  EXPECT_EQ(codeOf(many), TKS_OK) << "sixteen";
  EXPECT_NE(combined({{base()}, {Bytes(40, 7), "n"}}).status().message().find("Stream 1"),
            std::string::npos);
}

/// Whatever a byte becomes, there is a status.
TEST(Components, OfDamagedStreamsAreSafe) {
  const Bytes& stream = everything();
  const size_t header = Stream(stream).info().header_bytes;
  for (size_t at = 0; at < header + 400; at += 3) {
    Bytes damaged = stream;
    damaged[at] ^= 0x5a;
    sealHeader(damaged);
    const tks_limits limits = smallLimits();
    auto decoder = Decoder::open(damaged, limits);
    if (!decoder) continue;
    for (uint32_t i = 0; i < decoder->info().components; ++i) {
      if (!decoder->choose(i).ok()) continue;
      static_cast<void>(decoder->heights());
      static_cast<void>(decoder->texture());
    }
  }
}

TEST(Components, AreOrderedForTheFirstAlone) {
  const Bytes both = *combined(
      {{indexedHeights(Pattern::kRidges, 1)}, {indexedHeights(Pattern::kHills, 4), "second"}});
  Decoder taken = chosen(both, "second");
  tks_screen_camera camera = makeScreenCamera();
  camera.width = camera.height = 40;
  camera.clip[0] = camera.clip[5] = 0.01;
  camera.clip[15] = 1;
  EXPECT_EQ(taken.reordered({&camera, 1}).status().code(), TKS_USAGE);
  auto first = Decoder::open(both);
  const auto ordered = first->reordered({&camera, 1});
  ASSERT_TRUE(ordered.ok()) << ordered.status().message();
  EXPECT_EQ(*chosen(ordered->bytes(), "second").heights(), *taken.heights());
}

}  // namespace
}  // namespace tetrakis::test

// SPDX-License-Identifier: Apache-2.0
// What decoding allocates is at most what tks_check_memory says, for streams of every kind and all
// that can be asked of them; and what it says is not much more than that.
#include <algorithm>
#include <array>
#include <cstring>

#include "bitstream/stream/header.hpp"
#include "conformance/samples/facets.hpp"
#include "conformance/samples/few_texels.hpp"
#include "conformance/samples/few_values.hpp"
#include "conformance/samples/patches.hpp"
#include "conformance/samples/void_masks.hpp"
#include "tests/support/allocation_count.hpp"
#include "tests/support/coded_object.hpp"
#include "tests/support/decode_calls.hpp"
#include "tests/support/forest_raster.hpp"
#include "tests/support/forest_shapes.hpp"
#include "tests/support/mosaic_source.hpp"
#include "tests/support/sequences.hpp"
#include "tests/support/stream_fixture.hpp"
#include "tests/support/triangle_meshes.hpp"

namespace tetrakis::test {
namespace {

using samples::make;
using samples::patches;
using samples::Pattern;
using samples::Raster;

/// The whole of a stream, a part of it, and next to nothing. Parts are asked by one thread, and for
/// every third budget of triangles: the whole is what takes most. may_refuse: budget meshes, for
/// triangles in voids that are not known before.
void expectWithinBounds(const Bytes& bytes, const std::string& what, bool may_refuse = false) {
  for (const size_t size : {bytes.size(), bytes.size() / 3, size_t{0}}) {
    const size_t header = static_cast<size_t>(Stream(bytes).info().header_bytes);
    const Bytes cut(bytes.begin(), bytes.begin() + static_cast<ptrdiff_t>(std::max(size, header)));
    const bool whole = size == bytes.size();
    size_t budgets = 0;
    for (const DecodeCall& call : callsOn(Stream(cut).info())) {
      const bool mesh = call.part >= TKS_PART_CODED_MESH;
      if (call.part == TKS_PART_BUDGET_MESH && budgets++ % 3 > 0 && !whole) continue;
      for (const uint32_t threads : {1u, 3u}) {
        if (threads > 1 && (mesh || !whole)) continue;
        const MeasuredCall measured = measure(cut, call, threads);
        const bool refused = may_refuse && mesh && measured.status == TKS_LIMIT;
        EXPECT_TRUE(measured.status == TKS_OK || refused) << what << ", " << call.name;
        EXPECT_LE(measured.peak, may_refuse && mesh ? measured.limit : measured.bound)
            << what << " cut to " << cut.size() << ", " << call.name << ", " << threads
            << " threads";
      }
    }
  }
}

Bytes withVoids(const Raster& raster, const tks_encode_options& options) {
  tks_heights heights = raster.heights();
  heights.has_nodata = 1;
  heights.nodata = sampleAt(raster.data, raster.sample, raster.width / 2);
  return encodeHeights(heights, options);
}

/// Alpha 0 or 255 in blocks.
Raster cutOut(uint32_t width, uint32_t height) {
  Raster raster = make({Pattern::kRidges, width, height, 4, TKS_U8});
  for (uint32_t y = 0; y < height; ++y)
    for (uint32_t x = 0; x < width; ++x)
      raster.data[4 * (size_t{y} * width + x) + 3] = std::byte((x / 9 + y / 7) % 3 ? 255 : 0);
  return raster;
}

/// A few colours in blocks; `photograph`: lines of one colour over a photograph.
Raster drawing(uint32_t width, uint32_t height, uint32_t channels, bool photograph) {
  Raster raster = make({Pattern::kRidges, width, height, channels, TKS_U8});
  for (uint32_t y = 0; y < height; ++y) {
    for (uint32_t x = 0; x < width; ++x) {
      if (photograph && x % 40 > 1 && y % 40 > 1) continue;
      for (uint32_t c = 0; c < channels; ++c)
        raster.data[channels * (size_t{y} * width + x) + c] =
            std::byte(photograph ? 255 : (x / 30 * 50 + y / 20 * 90 + c * 20) % 256);
    }
  }
  return raster;
}

TEST(DecodeMemory, HeightsOfEveryKindStayBelowTheBound) {
  // A few more samples than those of which the encoder measures every prefix.
  const Raster heights = make({Pattern::kRidges, 151, 110, 1, TKS_U16});
  expectWithinBounds(encode(&heights, nullptr, lossless()), "lossless");
  expectWithinBounds(encode(&heights, nullptr, budget(8000)), "lossy");
  expectWithinBounds(encode(&heights, nullptr, inRegions(budget(9000), 32)), "regions");
  expectWithinBounds(encode(&heights, nullptr, inRegions(lossless(), 16)), "small regions");
  expectWithinBounds(encode(&heights, nullptr, within(100)), "corrections of steps");
  expectWithinBounds(withVoids(heights, lossless()), "voids");
  expectWithinBounds(withVoids(heights, inRegions(budget(9000), 64)), "voids in regions");
}

TEST(DecodeMemory, FramesStayBelowTheBound) {
  const FrameRasters frames = movingFrames({Pattern::kRidges, 90, 70, 1, TKS_U16}, 5);
  const FrameRasters images = movingFrames({Pattern::kHills, 80, 75, 3, TKS_U8}, 5);
  expectWithinBounds(encodeFrames(heightsOf(frames), {}, lossless()), "frames");
  expectWithinBounds(encodeFrames(heightsOf(frames), imagesOf(images), inRegions(lossless(), 32)),
                     "frames in regions");
  std::vector<tks_heights> holes = heightsOf(frames);
  for (tks_heights& heights : holes) {
    heights.has_nodata = 1;
    heights.nodata = sampleAt(frames[0].data, TKS_U16, 45);
  }
  expectWithinBounds(encodeFrames(holes, {}, lossless()), "frames with voids", true);
}

/// Encodes and decodes so many groups of four frames as they come, and returns the peak.
uint64_t peakOfSequence(const FrameRasters& frames, uint32_t groups) {
  const tks_encode_options encode = lossless();
  tks_sequence_options options = {};
  options.size = sizeof options;
  options.group = 4;
  options.encode = &encode;
  return peakBytes([&] {
    tks_sequence_encoder* encoder = nullptr;
    tks_sequence* sequence = nullptr;
    EXPECT_EQ(tks_sequence_encoder_open(&options, &encoder, nullptr, 0), TKS_OK);
    EXPECT_EQ(tks_sequence_open(nullptr, &sequence), TKS_OK);
    for (uint32_t t = 0; t < 4 * groups; ++t) {
      const tks_heights heights = frames[t % 4].heights();
      EXPECT_EQ(tks_sequence_push(encoder, &heights, nullptr, t, nullptr, 0), TKS_OK);
      tks_buffer ready = {};
      EXPECT_EQ(tks_sequence_take(encoder, &ready), TKS_OK);
      EXPECT_EQ(tks_sequence_append(sequence, ready.data, ready.size), TKS_OK);
      tks_free_buffer(&ready);
      if (t % 4 < 3) continue;
      tks_decoder* decoder = nullptr;
      std::vector<std::byte> samples(frames[0].data.size());
      EXPECT_EQ(tks_sequence_frame(sequence, t, &decoder), TKS_OK);
      EXPECT_EQ(tks_decode_heights(decoder, samples.data(), samples.size()), TKS_OK);
      EXPECT_TRUE(sameBytes(samples, frames[3].data));
      EXPECT_EQ(tks_sequence_forget(sequence, t), TKS_OK);
    }
    tks_sequence_close(sequence);
    tks_sequence_encoder_close(encoder);
  });
}

/// The first call of a group decodes the groups that it goes on from as well.
void expectSequenceWithinBounds(const Bytes& bytes, uint64_t frame) {
  for (size_t number = 0;; ++number) {
    Sequence sequence{bytes};
    tks_decoder* const decoder = sequence.decoder(frame);
    tks_info info = {};
    info.size = sizeof info;
    ASSERT_EQ(tks_get_info(decoder, &info), TKS_OK);
    const std::vector<DecodeCall> calls = callsOn(info);
    if (number >= calls.size()) return;
    const DecodeCall& call = calls[number];
    const bool texture = call.part == TKS_PART_TEXTURE;
    ASSERT_EQ(tks_set_levels(decoder, texture ? 0 : call.level, texture ? call.level : 0), TKS_OK);
    uint64_t bound = 0;
    ASSERT_EQ(tks_check_memory(decoder, call.part, call.asked(), call.max_triangles, 0, &bound),
              TKS_OK);
    tks_status status = TKS_OK;
    const uint64_t peak = peakBytes([&] { status = call.run(decoder); });
    EXPECT_EQ(status, TKS_OK) << call.name;
    EXPECT_LE(peak, bound) << call.name;
  }
}

TEST(DecodeMemory, FramesThatGoOnStayBelowTheBound) {
  const FrameRasters frames = movingFrames({Pattern::kRidges, 90, 70, 1, TKS_U16}, 13);
  const FrameRasters images = movingFrames({Pattern::kHills, 80, 75, 3, TKS_U8}, 13);
  const tks_encode_options encode = lossless();
  for (const uint32_t group : {1u, 4u}) {
    tks_sequence_options options = optionsOf(encode, group);
    options.reference = TKS_ALL_BYTES;
    expectSequenceWithinBounds(encodeSequence(frames, options, images).bytes, 12);
    expectSequenceWithinBounds(encodeSequence(frames, options).bytes, 5);
  }
}

TEST(DecodeMemory, SequencesTakeThatOfAGroup) {
  const FrameRasters frames = movingFrames({Pattern::kRidges, 24, 20, 1, TKS_U16}, 4);
  const uint64_t few = peakOfSequence(frames, 3), many = peakOfSequence(frames, 20);
  EXPECT_LE(many, few + 20 * 150);  // the encoder knows where its groups lie
}

/// Of coarse levels and small windows the masks take most.
TEST(DecodeMemory, BridgedHolesStayBelowTheBound) {
  constexpr uint32_t kWidth = 460, kHeight = 420;
  Raster heights = make({Pattern::kRidges, kWidth, kHeight, 1, TKS_U16});
  for (size_t i = 0; i < size_t{kWidth} * kHeight; ++i) {
    if (samples::hash(static_cast<uint32_t>(i), 0, 9) % 10 == 0)
      std::memset(heights.data.data() + 2 * i, 0xff, 2);
  }
  tks_heights holes = heights.heights();
  holes.has_nodata = 1;
  holes.nodata = 65535;
  const Bytes bytes = encodeHeights(holes, inRegions(budget(26000), 64));
  EXPECT_TRUE(readHeader(bytes)->header.layers.late_mask);
  expectWithinBounds(bytes, "bridged holes", true);
}

/// Mosaics with voids, whole and corrected behind a cut.
TEST(DecodeMemory, MasksOfRegionsStayBelowTheBound) {
  for (const double max_error : {0., 2.}) {
    Source source(hills(TKS_I16, 300, 220));
    dig(source, samples::VoidShape::kCoast);
    tks_mosaic_options options = mosaicOptions();
    options.regions = 16;
    options.max_error = max_error;
    options.lossless = max_error == 0;
    const Bytes bytes = mosaicOf(source, options);
    EXPECT_TRUE(readHeader(bytes)->header.layers.region_masks);
    expectWithinBounds(bytes, "masks of regions", true);
  }
}

/// Areas and heights between them in turns, or heights of few values.
TEST(DecodeMemory, FlatAreasAndTablesStayBelowTheBound) {
  Raster lakes = make({Pattern::kRidges, 161, 130, 1, TKS_I16, 3});
  for (uint32_t y = 0; y < 130; ++y) {
    for (uint32_t x = 0; x < 161; ++x) {
      if (x / 23 % 2 == 0 || y / 26 % 2 == 0) continue;
      const auto level = static_cast<int16_t>(100 + x / 23 + y / 26);
      std::memcpy(lakes.data.data() + 2 * (size_t{y} * 161 + x), &level, 2);
    }
  }
  const auto expectAreas = [&](const Bytes& bytes, const std::string& what) {
    EXPECT_GT(readHeader(bytes)->header.layers.flat_areas, 0u) << what;
    expectWithinBounds(bytes, what, readHeader(bytes)->header.layers.validity_bytes > 0);
  };
  expectAreas(encode(&lakes, nullptr, lossless()), "lakes");
  expectAreas(encode(&lakes, nullptr, budget(8000)), "lossy lakes");
  expectAreas(encode(&lakes, nullptr, inRegions(lossless(), 32)), "lakes in regions");
  expectAreas(withVoids(lakes, lossless()), "lakes beside voids");
  const Raster few = samples::withFewValues(make({Pattern::kRidges, 150, 140, 1, TKS_U8, 3}),
                                            samples::FewValues::kRare);
  for (const uint32_t side_of_regions : {1u, 32u}) {
    const Bytes bytes = encode(&few, nullptr, inRegions(lossless(), side_of_regions));
    EXPECT_GT(readHeader(bytes)->header.layers.table_bytes, 0u);
    expectWithinBounds(bytes, "few values");
  }
}

/// Samples that were copied to a grid three times as wide and twice as high.
TEST(DecodeMemory, RepeatedLinesStayBelowTheBound) {
  const Raster small = make({Pattern::kRidges, 60, 35, 1, TKS_U16});
  Raster large = make({Pattern::kRidges, 180, 70, 1, TKS_U16});
  for (size_t i = 0; i < size_t{180} * 70; ++i) {
    const size_t from = i / 360 * 60 + i % 180 / 3;
    std::memcpy(large.data.data() + 2 * i, small.data.data() + 2 * from, 2);
  }
  const auto expectCopies = [&](const Bytes& bytes, const std::string& what) {
    EXPECT_FALSE(readHeader(bytes)->header.geometry->repeats.none()) << what;
    expectWithinBounds(bytes, what);
  };
  expectCopies(encode(&large, nullptr, inRegions(budget(8000), 16)), "copies in regions");
  expectCopies(withVoids(large, lossless()), "copies beside voids");
}

/// Texels that were copied to a grid three times as wide, drawn, stored and by wavelet; and those
/// that tables hold.
TEST(DecodeMemory, TexturesOfKindsStayBelowTheBound) {
  for (const Pattern pattern : {Pattern::kRidges, Pattern::kSteps, Pattern::kExtreme}) {
    const Raster small = make({pattern, 50, 41, 3, TKS_U8, 3});
    Raster large = small;
    large.width = 150;
    large.data.clear();
    for (size_t i = 0; i < small.data.size(); i += 3) {
      const auto texel = small.data.begin() + static_cast<ptrdiff_t>(i);
      for (int copy = 0; copy < 3; ++copy) large.data.insert(large.data.end(), texel, texel + 3);
    }
    const Bytes bytes = encode(nullptr, &large, lossless());
    EXPECT_FALSE(readHeader(bytes)->header.texture->repeats.none());
    expectWithinBounds(bytes, "copied texels");
  }
  const Raster whole = make({Pattern::kRidges, 150, 141, 3, TKS_U8, 3});
  const Raster few = samples::withFewTexels(whole, 90, TKS_U16);
  const Bytes bytes = encode(nullptr, &few, lossless());
  EXPECT_TRUE(readHeader(bytes)->header.texture->tables.present);
  expectWithinBounds(bytes, "few values of channels");
}

/// Nearest neighbours of a grid that is turned: whole, in regions, in one long row.
TEST(DecodeMemory, ExactCorrectionsStayBelowTheBound) {
  const auto turned = [](uint32_t width, uint32_t height) {
    const Raster ridges = make({Pattern::kRidges, 300, 300, 1, TKS_I16, 3});
    Raster nearest = make({Pattern::kRidges, width, height, 1, TKS_I16, 3});
    const auto* from = reinterpret_cast<const int16_t*>(ridges.data.data());
    auto* to = reinterpret_cast<int16_t*>(nearest.data.data());
    for (uint32_t i = 0; i < width * height; ++i) {
      const uint32_t x = i % width, y = i / width;
      to[i] = from[(150 + 2 * y - x / 4) % 300 / 2 * 300 + (2 * x + y / 2) % 600 / 4];
    }
    return nearest;
  };
  for (const auto& [width, height, regions] :
       {std::array{190u, 170u, 0u}, {190u, 170u, 64u}, {1500u, 24u, 0u}}) {
    const Raster nearest = turned(width, height);
    const Bytes bytes = encode(&nearest, nullptr, inRegions(lossless(), regions));
    EXPECT_EQ(readHeader(bytes)->header.layers.correction_step, 1u) << width << ", " << regions;
    expectWithinBounds(bytes, "exact corrections");
  }
}

TEST(DecodeMemory, FacetsStayBelowTheBound) {
  for (const auto& [width, height, regions] :
       {std::array{190u, 170u, 0u}, {190u, 170u, 64u}, {1500u, 24u, 0u}}) {
    const Raster heights = samples::facets(width, height, 20.7);
    const Bytes bytes = encode(&heights, nullptr, inRegions(lossless(), regions));
    EXPECT_EQ(readHeader(bytes)->header.layers.corrections, CorrectionKind::kFacets) << width;
    expectWithinBounds(bytes, "facets");
  }
}

/// Few values in large shapes, whole, beside voids, counted by a table, beside corrections.
TEST(DecodeMemory, DrawnHeightsStayBelowTheBound) {
  const Raster few = patches(161, 130, 2000);
  const auto expectDrawn = [](const Bytes& bytes, const std::string& what) {
    EXPECT_EQ(Stream(bytes).info().heights_drawn, 1) << what;
    expectWithinBounds(bytes, what, readHeader(bytes)->header.layers.validity_bytes > 0);
  };
  expectDrawn(encode(&few, nullptr, lossless()), "drawn");
  expectDrawn(withVoids(few, lossless()), "drawn beside voids");
  for (const samples::FewValues kind : {samples::FewValues::kRescaled, samples::FewValues::kRare}) {
    const Raster floats = samples::withFewValues(few, kind);
    expectDrawn(encode(&floats, nullptr, lossless()), "drawn floats");
  }
}

TEST(DecodeMemory, StoredSamplesStayBelowTheBound) {
  Raster noise = make({Pattern::kExtreme, 161, 124, 1, TKS_I16});
  for (size_t i = 0; i < noise.data.size(); ++i)
    noise.data[i] = std::byte(samples::hash(static_cast<uint32_t>(i), 0, 17) % 256);
  const Bytes heights = encode(&noise, nullptr, lossless());
  EXPECT_EQ(Stream(heights).info().heights_drawn, 3);
  expectWithinBounds(heights, "stored");
  expectWithinBounds(withVoids(noise, lossless()), "stored beside voids", true);
  const Raster image = make({Pattern::kExtreme, 150, 140, 3, TKS_U16});
  const Bytes texels = encode(nullptr, &image, lossless());
  EXPECT_EQ(Stream(texels).info().texture_drawn, 3);
  expectWithinBounds(texels, "stored texture");
}

TEST(DecodeMemory, OtherHeightsStayBelowTheBound) {
  Raster measured = make({Pattern::kRidges, 130, 150, 1, TKS_F32});
  for (size_t i = 0; i < 130 * 150; ++i) {
    const auto value = static_cast<float>(sampleAt(measured.data, TKS_F32, i) / 3);
    std::memcpy(measured.data.data() + 4 * i, &value, 4);
  }
  expectWithinBounds(encode(&measured, nullptr, lossless()), "corrections of samples");
  expectWithinBounds(encode(&measured, nullptr, inRegions(lossless(), 64)), "and regions");
  for (const Pattern pattern : {Pattern::kFlat, Pattern::kChecker, Pattern::kExtreme}) {
    const Raster raster = make({pattern, 257, 70, 1, TKS_I32});
    expectWithinBounds(encode(&raster, nullptr, lossless()), "pattern");
    expectWithinBounds(withVoids(raster, lossless()), "pattern with voids", true);
  }
  // Of planes as small as these the encoder measures every prefix: twice as long takes four times.
  for (const auto& [width, height] : {std::pair(2u, 800u), {800u, 2u}, {5u, 9u}, {2u, 2u}}) {
    const Raster raster = make({Pattern::kRidges, width, height, 1, TKS_U8});
    expectWithinBounds(encode(&raster, nullptr, inRegions(lossless(), 1)), "narrow");
    expectWithinBounds(encode(&raster, nullptr, inRegions(lossless(), 16)), "narrow regions");
  }
}

TEST(DecodeMemory, TexturesOfEveryKindStayBelowTheBound) {
  for (const uint32_t channels : {1u, 2u, 3u, 4u}) {
    const Raster image = make({Pattern::kRidges, 233, 180, channels, TKS_U8});
    expectWithinBounds(encode(nullptr, &image, budget(9000)), "wavelet");
    expectWithinBounds(encode(nullptr, &image, inRegions(lossless(), 64)), "regions");
    const Raster drawn = drawing(220, 190, channels, false);
    expectWithinBounds(encode(nullptr, &drawn, lossless()), "drawn");
  }
  const Raster deep = make({Pattern::kRidges, 150, 140, 3, TKS_U16});
  expectWithinBounds(encode(nullptr, &deep, lossless()), "16 bits");
  const Raster cut = cutOut(190, 201);
  expectWithinBounds(encode(nullptr, &cut, lossless()), "cut-out");
  expectWithinBounds(encode(nullptr, &cut, inRegions(budget(7000), 32)), "hidden cut-out");
  const Raster lettered = drawing(256, 230, 3, true);
  expectWithinBounds(encode(nullptr, &lettered, budget(20000)), "overlay");
  Raster holes = make({Pattern::kRidges, 190, 201, 4, TKS_U8});
  samples::cutOut(holes, samples::validity(samples::VoidShape::kHoles, 190, 201));
  expectWithinBounds(encode(nullptr, &holes, budget(9000)), "bridged cut-out");
  expectWithinBounds(encode(nullptr, &holes, inRegions(budget(9000), 32)), "and regions");
}

/// Cubes, and more patches than samples in a patch; of more samples than those of which the encoder
/// measures every prefix.
TEST(DecodeMemory, ForestsStayBelowTheBound) {
  const auto rasterOf = [](const ForestShape& shape, int depth, samples::Recipe recipe) {
    return ForestRaster(Forest(depth, shape.sides), recipe);
  };
  for (const auto& [shape, depth] : {std::pair(cubeShape(), 6), {planeShape(45, 45), 1}}) {
    const ForestRaster surface = rasterOf(shape, depth, {Pattern::kRidges, 0, 0, 1, TKS_I16, 3});
    for (const tks_encode_options& options : {lossless(), budget(8000), within(40)}) {
      expectWithinBounds(surface.encoded(options), shape.name);
      expectWithinBounds(surface.encoded(inRegions(options)), shape.name + " in regions");
    }
    ForestRaster coast = surface;
    std::vector<int16_t> heights = coast.samples<int16_t>();
    std::vector<int16_t> sorted = heights;
    std::nth_element(sorted.begin(), sorted.begin() + sorted.size() / 2, sorted.end());
    for (int16_t& height : heights) height = std::max(height, sorted[sorted.size() / 2]);
    std::memcpy(coast.raster.data.data(), heights.data(), coast.raster.data.size());
    for (const tks_encode_options& options : {lossless(), within(40)})
      expectWithinBounds(coast.encoded(options), shape.name + " beside a sea");
    const ForestRaster picture = rasterOf(shape, depth, {Pattern::kRidges, 0, 0, 3, TKS_U8, 3});
    for (const tks_encode_options& options : {lossless(), budget(8000), inRegions(lossless())})
      expectWithinBounds(picture.encodedTexels(options), shape.name + " texture");
  }
}

/// What is left of the bound where there is much to allocate.
double excess(const Bytes& bytes, const DecodeCall& call) {
  const MeasuredCall measured = measure(bytes, call);
  EXPECT_EQ(measured.status, TKS_OK) << call.name;
  EXPECT_LE(measured.peak, measured.bound) << call.name;
  return static_cast<double>(measured.bound) / static_cast<double>(measured.peak);
}

TEST(DecodeMemory, BoundsOfLargePlanesAreLessThanTwiceWhatIsTaken) {
  const Raster heights = make({Pattern::kRidges, 560, 500, 1, TKS_U16});
  for (const uint32_t regions : {1u, 256u}) {
    const Bytes bytes = encode(&heights, nullptr, inRegions(lossless(), regions));
    const tks_info info = Stream(bytes).info();
    for (const DecodeCall& call :
         {heightsOf(info, 0), heightsOf(info, 2), meshOf(TKS_MESH_CODED, 0),
          surfaceOf(info, {100, 200, 280, 210}), meshOf(TKS_MESH_BUDGET, 0),
          meshOf(TKS_MESH_BUDGET, 15000), meshOf(TKS_MESH_BUDGET, 110000)})
      EXPECT_LE(excess(bytes, call), 2) << call.name << ", regions of " << regions;
  }
  const Bytes voids = withVoids(heights, lossless());
  for (const uint32_t triangles : {15000u, 110000u})
    EXPECT_LE(excess(voids, meshOf(TKS_MESH_BUDGET, triangles)), 2) << triangles << " beside voids";
  // The bound is that of voids nearly everywhere; beside few of them levels are left out.
  EXPECT_GE(excess(voids, meshOf(TKS_MESH_BUDGET, 500)), 4) << "few triangles beside voids";
  const Raster image = make({Pattern::kRidges, 560, 500, 3, TKS_U8});
  for (const uint32_t regions : {1u, 256u}) {
    // Every band holds something: those that do not take less than the bound.
    const Bytes bytes = encode(nullptr, &image, inRegions(lossless(), regions));
    const tks_info info = Stream(bytes).info();
    for (const DecodeCall& call :
         {textureOf(info, 0), textureOf(info, 1), textureOf(info, tks_window{210, 150, 350, 280})})
      EXPECT_LE(excess(bytes, call), 2) << call.name << ", regions of " << regions;
  }
}

/// Meshes for cameras have no part of tks_check_memory: what the call refuses is its bound.
TEST(DecodeMemory, MeshesForCamerasStayBelowTheLimitThatLetsThemPass) {
  const Raster heights = make({Pattern::kRidges, 500, 400, 1, TKS_U16});
  const Raster image = make({Pattern::kRidges, 300, 300, 3, TKS_U8});
  const tks_image texture = image.image();
  tks_screen_camera camera = {};
  camera.size = sizeof camera;
  camera.width = 2000;
  camera.height = 1000;
  const double clip[16] = {2.0 / 500, 0, 0, -1, 0, -2.0 / 400, 1e-5, 0.9, 0, 0, 0, 0, 0, 0, 0, 1};
  std::copy(clip, clip + 16, camera.clip);
  const tks_screen screen = {sizeof screen, &camera, 1, &texture};
  for (const Bytes& bytes : {encode(&heights, nullptr, lossless()), withVoids(heights, lossless())})
    for (const uint32_t triangles : {300u, 20000u, 500000u}) {
      MeasuredCall measured;
      measured.status = TKS_LIMIT;
      for (measured.limit = 8 << 20; measured.status == TKS_LIMIT;
           measured.limit += measured.limit / 4) {
        tks_limits limits = {};
        limits.size = sizeof limits;
        limits.max_memory = measured.limit;
        Stream stream(bytes, &limits);
        if (stream.status() != TKS_OK) continue;
        measured.peak = peakBytes([&] {
          tks_mesh mesh = {};
          measured.status = tks_decode_screen_mesh(stream.get(), &screen, triangles, &mesh);
          tks_free_mesh(&mesh);
        });
      }
      EXPECT_EQ(measured.status, TKS_OK);
      EXPECT_LE(measured.peak, measured.limit) << triangles;
      EXPECT_LE(measured.limit, 4 * measured.peak) << triangles;
    }
}

/// As are meshes round a globe.
TEST(DecodeMemory, GlobesStayBelowTheLimitThatLetsThemPass) {
  const Raster raster = make({Pattern::kRidges, 360, 180, 1, TKS_U16});
  tks_heights heights = raster.heights();
  heights.has_geotransform = 1;
  const double transform[] = {-180, 1, 0, 90, 0, -1};
  std::copy(std::begin(transform), std::end(transform), heights.geotransform);
  const tks_globe globe = {sizeof globe, 1, 1, 0, 0};
  tks_heights beside_voids = heights;
  beside_voids.has_nodata = 1;
  beside_voids.nodata = sampleAt(raster.data, raster.sample, 99);
  const ForestRaster cube(Forest(6, cubeShape().sides), {Pattern::kRidges, 0, 0, 1, TKS_U16});
  for (const Bytes& bytes : {encodeHeights(heights, lossless()),
                             encodeHeights(beside_voids, lossless()), cube.encoded(lossless())})
    for (const uint32_t triangles : {0u, 300u, 20000u, 500000u}) {
      MeasuredCall measured;
      measured.status = TKS_LIMIT;
      for (measured.limit = 4 << 20; measured.status == TKS_LIMIT;
           measured.limit += measured.limit / 4) {
        tks_limits limits = {};
        limits.size = sizeof limits;
        limits.max_memory = measured.limit;
        Stream stream(bytes, &limits);
        if (stream.status() != TKS_OK) continue;
        measured.peak = peakBytes([&] {
          tks_globe_mesh mesh = {};
          measured.status =
              tks_decode_globe(stream.get(), TKS_MESH_BUDGET, triangles, &globe, &mesh);
          tks_free_globe_mesh(&mesh);
        });
        if (measured.status == TKS_OK) {
          EXPECT_LE(measured.peak, measured.limit) << triangles;
        }
      }
      EXPECT_EQ(measured.status, TKS_OK);
    }
}

TriangleMesh crumbs(uint32_t count) {
  TriangleMesh all;
  for (uint32_t i = 0; i < count; ++i) {
    const double x = i % 100, y = i / 100;
    const auto first = static_cast<uint32_t>(all.points.size());
    all.points.insert(all.points.end(), {{x, y, 0}, {x + 0.5, y, 0.1}, {x, y + 0.5, 0.2}});
    all.triangles.push_back({first, first + 1, first + 2});
  }
  return all;
}

void expectObjectsBelowTheLimit(const Bytes& bytes) {
  for (const uint32_t triangles : {0u, 3000u, 40000u}) {
    MeasuredCall measured;
    measured.status = TKS_LIMIT;
    for (measured.limit = 4 << 20; measured.status == TKS_LIMIT;
         measured.limit += measured.limit / 4) {
      tks_limits limits = {};
      limits.size = sizeof limits;
      limits.max_memory = measured.limit;
      Stream stream(bytes, &limits);
      if (stream.status() != TKS_OK) continue;
      measured.peak = peakBytes([&] {
        tks_object_mesh mesh = {};
        measured.status = tks_decode_object(stream.get(), TKS_MESH_BUDGET, triangles, &mesh);
        tks_free_object_mesh(&mesh);
      });
      if (measured.status == TKS_OK) {
        EXPECT_LE(measured.peak, measured.limit) << triangles;
      }
    }
    EXPECT_EQ(measured.status, TKS_OK);
  }
}

/// And meshes of objects, whose places are fitted within a budget.
TEST(DecodeMemory, ObjectsStayBelowTheLimitThatLetsThemPass) {
  for (const tks_object_kind kind : {TKS_OBJECT_RESAMPLED, TKS_OBJECT_TRIANGLES})
    expectObjectsBelowTheLimit(encodeMesh(made::torus(128, 64), budget(60000), kind).stream);
  // Each triangle has three vertices of its own.
  expectObjectsBelowTheLimit(encodeMesh(crumbs(5000), budget(60000), TKS_OBJECT_TRIANGLES).stream);
}

/// Levels and windows of streams in regions take memory in proportion to themselves.
TEST(DecodeMemory, FollowsWhatIsAsked) {
  const Raster image = make({Pattern::kRidges, 1024, 1024, 3, TKS_U8});
  const Bytes bytes = encode(nullptr, &image, inRegions(budget(100000), 64));
  const tks_info info = Stream(bytes).info();
  const auto peak = [&](const DecodeCall& call) {
    return static_cast<double>(measure(bytes, call).peak);
  };
  const double whole = peak(textureOf(info, 0));
  EXPECT_LT(peak(textureOf(info, 1)), 0.3 * whole);
  EXPECT_LT(peak(textureOf(info, 2)), 0.1 * whole);
  // With the tracks that later windows find.
  EXPECT_LT(peak(textureOf(info, tks_window{400, 300, 64, 64})), 0.15 * whole);
  const Raster map = drawing(1024, 1024, 3, false);
  const Bytes drawn = encode(nullptr, &map, lossless());
  const double drawn_whole = static_cast<double>(measure(drawn, textureOf(info, 0)).peak);
  constexpr double kModels = 3 << 20;
  EXPECT_LT(static_cast<double>(measure(drawn, textureOf(info, 2)).peak),
            0.1 * drawn_whole + kModels);
}

/// The limit is that of the decoder and the call together, and refuses in a sentence.
TEST(DecodeMemory, IsRefusedByEachCall) {
  const Raster heights = make({Pattern::kRidges, 500, 400, 1, TKS_U16});
  const Bytes bytes = encode(&heights, nullptr, inRegions(lossless(), 64));
  tks_limits limits = {};
  limits.size = sizeof limits;
  limits.max_memory = bytes.size() * 4 + (700 << 10);
  Stream stream(bytes, &limits);
  ASSERT_EQ(stream.status(), TKS_OK) << stream.message();
  std::vector<std::byte> out(stream.heightsBytes(), std::byte(7));
  EXPECT_EQ(tks_decode_heights(stream.get(), out.data(), out.size()), TKS_LIMIT);
  EXPECT_EQ(std::count(out.begin(), out.end(), std::byte(7)), std::ssize(out));
  EXPECT_NE(std::string(tks_message(stream.get())).find("Decoding 500 x 400 heights takes "),
            std::string::npos)
      << tks_message(stream.get());
  std::vector<float> part(50 * 40);
  const tks_window window = {100, 200, 50, 40};
  EXPECT_EQ(tks_decode_surface_window(stream.get(), &window, part.data(), part.size()), TKS_OK)
      << tks_message(stream.get());
  tks_mesh mesh = {};
  EXPECT_EQ(tks_decode_mesh(stream.get(), TKS_MESH_CODED, 0, &mesh), TKS_LIMIT);
  ASSERT_EQ(tks_set_levels(stream.get(), 2, 0), TKS_OK);
  std::vector<std::byte> quarter(2 * 125 * 100);
  EXPECT_EQ(tks_decode_heights(stream.get(), quarter.data(), quarter.size()), TKS_OK)
      << tks_message(stream.get());
  EXPECT_EQ(tks_check_memory(stream.get(), TKS_PART_HEIGHTS, nullptr, 0, 0, nullptr), TKS_OK);
  EXPECT_EQ(tks_check_memory(stream.get(), TKS_PART_HEIGHTS, nullptr, 0, UINT64_MAX, nullptr),
            TKS_LIMIT);
  EXPECT_EQ(tks_check_memory(stream.get(), TKS_PART_TEXTURE, nullptr, 0, 0, nullptr), TKS_USAGE);
}

/// Windows all over a plane keep their share of the limit, not the plane.
TEST(DecodeMemory, WindowsKeepTheirShare) {
  const Raster heights = make({Pattern::kRidges, 600, 500, 1, TKS_U16});
  const Bytes bytes = encode(&heights, nullptr, inRegions(lossless(), 64));
  tks_limits limits = {};
  limits.size = sizeof limits;
  limits.max_memory = 12 << 20;
  const uint64_t share = limits.max_memory / 32;
  Stream stream(bytes, &limits);
  std::vector<std::byte> out(2 * 50 * 50);
  const auto peakOfWindows = [&](uint32_t columns) {
    return peakBytes([&] {
      for (uint32_t x = 0; x < columns; x += 50) {
        for (uint32_t y = 0; y < (columns > 50 ? 500 : 50); y += 50) {
          const tks_window window = {x, y, 50, 50};
          EXPECT_EQ(tks_decode_heights_window(stream.get(), &window, out.data(), out.size()),
                    TKS_OK);
        }
      }
    });
  };
  const uint64_t one = peakOfWindows(50);
  EXPECT_LE(peakOfWindows(600), one + share);
}

/// Windows of forests take no more than they say, and hardly more of larger forests.
TEST(DecodeMemory, WindowsOfForestsFollowTheirSize) {
  uint64_t before = 0;
  for (const int depth : {7, 8, 9}) {
    const ForestRaster cube(Forest(depth, cubeShape().sides), {Pattern::kRidges, 0, 0, 1, TKS_U16});
    const Bytes bytes = cube.encoded(inRegions(budget(30000), 32));
    tks_limits limits = {};
    limits.size = sizeof limits;
    limits.max_memory = 8 << 20;  // which leaves little to keep of windows
    Stream stream(bytes, &limits);
    const tks_window window = {40, cube.forest.side() + 50, 40, 40};
    std::vector<std::byte> out(2 * 40 * 40);
    uint64_t bound = 0;
    ASSERT_EQ(tks_check_memory(stream.get(), TKS_PART_HEIGHTS, &window, 0, 0, &bound), TKS_OK);
    const uint64_t peak = peakBytes([&] {
      EXPECT_EQ(tks_decode_heights_window(stream.get(), &window, out.data(), out.size()), TKS_OK);
    });
    EXPECT_LE(peak, bound);
    if (before > 0) {
      EXPECT_LE(peak, before + (before >> 1)) << "depth " << depth;
    }
    before = peak;
  }
}

/// Opening takes memory in proportion to the bytes that are there.
TEST(DecodeMemory, OpeningFollowsThePayload) {
  const Raster heights = make({Pattern::kExtreme, 400, 300, 1, TKS_U16});
  for (const uint32_t regions : {1u, 16u}) {
    const Bytes bytes = encode(&heights, nullptr, inRegions(lossless(), regions));
    EXPECT_LE(peakBytes([&] { Stream stream(bytes); }), 4 * bytes.size() + (64 << 10));
    tks_limits limits = {};
    limits.size = sizeof limits;
    limits.max_memory = bytes.size();
    Stream stream(bytes, &limits);
    EXPECT_EQ(stream.status(), TKS_LIMIT);
    EXPECT_NE(stream.message().find("Opening the stream takes "), std::string::npos)
        << stream.message();
  }
}

}  // namespace
}  // namespace tetrakis::test

// SPDX-License-Identifier: Apache-2.0
// Fields of wavelets that no encoder writes: shears and priorities for any levels, roundings that
// begin elsewhere, low bands that are doubled elsewhere.
#include <array>
#include <functional>

#include "codec/geometry/heights_encoder.hpp"
#include "codec/wavelet/priority_map.hpp"
#include "conformance/cases/cases.hpp"
#include "conformance/cases/crafted_streams.hpp"

namespace tetrakis::conformance {
namespace {

/// Sets of shears for more levels than there are, or for fewer.
VectorCase shearCase(uint32_t width, uint32_t height, size_t sets, int planes) {
  StreamHeader header = textureHeader(width, height, 3, TKS_U16, planes);
  header.texture->colour_shears.resize(sets + 1);
  uint32_t count = 0;
  for (auto& shears : header.texture->colour_shears) {
    for (int64_t& shear : shears) {
      const uint32_t h = samples::hash(++count, width, 42);
      shear = planes > 20 ? h % 65535 - int64_t{32767} : h % 301 - int64_t{150};
    }
  }
  header.texture->colour_order = static_cast<uint8_t>(sets % 6);
  const std::string size = std::to_string(width) + "x" + std::to_string(height);
  return crafted("shears_" + std::to_string(sets) + "_" + size,
                 "noise: " + std::to_string(sets) + " sets of shears of coefficients",
                 streamOf(header, noise(700, static_cast<uint32_t>(sets))));
}

VectorCase weightCase(uint32_t channels, uint8_t levels) {
  StreamHeader header = textureHeader(100, 60, channels, TKS_U8, 9);
  header.texture->weights.levels = levels;
  for (size_t c = 0; c < channels; ++c) {
    header.texture->priority[c] = c % 2 == 0 ? -128 : 128;
    for (size_t i = 0; i < size_t{2} * levels; ++i) {
      const uint32_t h = samples::hash(static_cast<uint32_t>(i), levels, 43 + channels);
      header.texture->weights.priority[c][i] = h % 257 - int64_t{128};
    }
  }
  const std::string name = std::to_string(levels);
  return crafted("weights_" + name + "_100x60", "noise: weights of " + name + " levels",
                 streamOf(header, noise(900, levels)));
}

/// A complete stream with other fields of the wavelet than its encoder wrote.
VectorCase waveletCase(const std::string& name, const std::string& purpose,
                       const VectorCase& source,
                       const std::function<void(WaveletHeader&)>& change) {
  const auto stream = encodeCase(source);
  if (!stream.ok()) return crafted(name, purpose, {0});
  ParsedHeader parsed = *readHeader(*stream);
  change(parsed.header.geometry->wavelet);
  Bytes bytes = writeHeader(parsed.header);
  bytes.insert(bytes.end(), stream->begin() + static_cast<ptrdiff_t>(parsed.bytes), stream->end());
  return crafted(name, purpose, std::move(bytes));
}

/// Tables of noise: values in any order, and coefficients of noise.
VectorCase tablesOfNoise(const std::string& name, const std::string& purpose, StreamHeader header,
                         const std::array<uint32_t, 4>& values, size_t bytes) {
  header.texture->tables = {true, values, {}};
  for (const uint8_t byte : noise(bytes, values[0])) header.texture->tables.code += char(byte);
  return crafted(name, purpose, streamOf(header, noise(900, values[1])));
}

/// Two tiers of a band with passes of one key in one plane. The delays of these passes have to
/// differ by 16, as only those do of a likely pass where most coefficients of a tier are
/// significant and of a rest pass where none of 8192 is. So the map gives priority 1 to everything
/// but the last tile, which has three coefficients of the finest HL: two are large, and the third
/// is small.
VectorCase tiedTiers() {
  constexpr uint32_t kWidth = 194, kHeight = 184;
  constexpr int kTileLog2 = 4;
  PriorityMap map{{kWidth, kHeight}, kTileLog2, {}};
  map.priorities.assign(size_t{map.columns()} * map.rows(), 1);
  map.priorities.back() = 0;
  StreamHeader header = heightsHeader(kWidth, kHeight, TKS_I16, 0);
  header.geometry->priorities = headerOf(map);
  std::vector<int32_t> heights(size_t{kWidth} * kHeight);
  const auto last = [&](uint32_t y) -> int32_t& { return heights[(y + 1) * kWidth - 1]; };
  last(178) = last(180) = 100;
  last(182) = 12;
  const std::vector<EncodedTrack> tracks =
      encodeCoefficients({heights, {kWidth, kHeight}}, header.geometry->wavelet,
                         {.flat = nullptr, .priorities = &map});
  header.geometry->planes = static_cast<uint8_t>(tracks[0].planes);
  return crafted("tied_tiers_194x184", "passes of two tiers with one key in one plane",
                 streamOf(header, tracks[0].codeword));
}

}  // namespace

std::vector<VectorCase> weightCases() {
  return {weightCase(3, 2), weightCase(4, 8)};
}

/// Maps of priorities of noise: one that ends early, and tiles smaller than what the coefficients
/// of coarse levels reach. And sums of joint lifting that leave 32 bits or do not.
std::vector<VectorCase> priorityCases() {
  const auto mapped = [](uint32_t width, uint32_t height, size_t map_bytes) {
    StreamHeader header = heightsHeader(width, height, TKS_I16, 14);
    header.geometry->priorities.tile_log2 = 4;
    for (const uint8_t byte : noise(map_bytes, width))
      header.geometry->priorities.code += char(byte);
    return header;
  };
  const auto summed = [](uint8_t bits) {
    StreamHeader header = heightsHeader(70, 40, TKS_I32, 30);
    header.geometry->wavelet.filters = {3, 3, 3};
    header.geometry->wavelet.bits = bits;
    return header;
  };
  const auto separate = [&](uint8_t filter, uint8_t fraction_bits, uint8_t bits) {
    StreamHeader header = summed(bits);
    header.geometry->wavelet.filters = {filter, filter, filter};
    header.geometry->wavelet.fraction_bits = fraction_bits;
    return header;
  };
  return {crafted("noise_map_ends_200x150", "noise: a map of priorities that ends early",
                  streamOf(mapped(200, 150, 9), noise(2500, 96))),
          tiedTiers(),
          crafted("noise_map_260x200", "noise: priorities of coefficients that reach many tiles",
                  streamOf(mapped(260, 200, 120), noise(6000, 97))),
          crafted("noise_joint_15_bits_70x40", "noise: joint sums of 32 bits, which wrap",
                  streamOf(summed(15), noise(2500, 98, 3))),
          crafted("noise_joint_16_bits_70x40", "noise: joint sums of 64 bits",
                  streamOf(summed(16), noise(2500, 98, 3))),
          crafted("noise_15_bits_70x40", "noise: sums of four steps of 32 bits, which wrap",
                  streamOf(separate(2, 0, 15), noise(2500, 99, 3))),
          crafted("noise_16_bits_70x40", "noise: sums of four steps of 64 bits",
                  streamOf(separate(2, 0, 16), noise(2500, 99, 3))),
          crafted("noise_20_bits_70x40", "noise: sums of two steps of 32 bits, which wrap",
                  streamOf(separate(4, 1, 20), noise(2500, 100, 3))),
          crafted("noise_21_bits_70x40", "noise: sums of two steps of 64 bits",
                  streamOf(separate(4, 1, 21), noise(2500, 100, 3)))};
}

std::vector<VectorCase> channelTableCases() {
  StreamHeader eighths = textureHeader(40, 33, 3, TKS_U8, 9),
               one = textureHeader(31, 9, 1, TKS_U8, 8);
  eighths.texture->wavelet.fraction_bits = 3;
  StreamHeader deep = textureHeader(30, 41, 4, TKS_U16, 30);
  deep.texture->wavelet.fraction_bits = 8;
  return {tablesOfNoise("noise_tables_40x33", "noise: tables in any order, three fraction bits",
                        eighths, {40, 0, 256, 0}, 400),
          tablesOfNoise("noise_tables_end_30x41", "noise: tables that end early, beside one value",
                        deep, {1, 300, 65536, 5}, 900),
          tablesOfNoise("noise_tables_one_31x9", "noise: more values than the type has", one,
                        {700, 0, 0, 0}, 900)};
}

std::vector<VectorCase> shearCases() {
  return {shearCase(40, 33, 5, 30), shearCase(41, 22, 2, 12), shearCase(20, 20, 7, 30),
          shearCase(8, 8, 3, 12)};
}

std::vector<VectorCase> roundedCases() {
  VectorCase flat, voids;
  flat.name = voids.name = "regions";
  flat.options.size = voids.options.size = sizeof(tks_encode_options);
  flat.options.lossless = voids.options.lossless = 1;
  flat.options.regions = voids.options.regions = 16;
  flat.heights = samples::Recipe{samples::Pattern::kRidges, 40, 37, 1, TKS_I8};
  voids.heights = flat.heights;
  voids.voids = samples::VoidShape::kSpeckle;
  voids.nodata = -128;
  const auto halved = [](WaveletHeader& wavelet) { wavelet.rounded_bytes /= 2; };
  VectorCase half = waveletCase("rounded_half_40x37",
                                "regions round from half of the encoder's bytes on", flat, halved);
  VectorCase layers = waveletCase("rounded_layers_40x37",
                                  "bytes of validity are none of coefficients", voids, halved);
  for (VectorCase* each : {&half, &layers}) each->dense = true;
  return {half,
          layers,
          waveletCase("rounded_never_40x37", "a complete stream without roundings", flat,
                      [](WaveletHeader& wavelet) { wavelet.rounded_bytes = 1 << 20; }),
          waveletCase("rounded_always_40x37", "the inverse rounds from the first byte on", flat,
                      [](WaveletHeader& wavelet) { wavelet.rounded_bytes = 0; }),
          waveletCase("joint_smooth_40x37", "the filter for smooth ground, lifted jointly", flat,
                      [](WaveletHeader& wavelet) {
                        wavelet.filters = {4, 4, 4};
                      }),
          waveletCase("voids_smooth_40x37", "the filter for smooth ground beside voids", voids,
                      [](WaveletHeader& wavelet) {
                        wavelet.filters = {4, 3, 4};
                      }),
          waveletCase("doubled_0_40x37", "no low band is doubled", flat,
                      [](WaveletHeader& wavelet) { wavelet.first_doubled = 0; }),
          waveletCase("doubled_1_40x37", "levels 1 and 2 are doubled", flat,
                      [](WaveletHeader& wavelet) { wavelet.first_doubled = 1; }),
          waveletCase("joint_17_bits_40x37", "joint sums of 64 bits", flat,
                      [](WaveletHeader& wavelet) { wavelet.bits = 17; }),
          waveletCase("joint_not_40x37", "21 bits: rows, then columns, and doubled", flat,
                      [](WaveletHeader& wavelet) { wavelet.bits = 21; })};
}

}  // namespace tetrakis::conformance

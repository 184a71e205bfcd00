// SPDX-License-Identifier: Apache-2.0
// Streams that no encoder makes: headers at the ends of their ranges before codewords of noise.
// Here are those of heights; their corrections, wavelets and drawings have files of their own.
#include <limits>

#include "bitstream/stream/geometry_header.hpp"
#include "codec/geometry/flat/flat_encoder.hpp"
#include "codec/lattice/validity.hpp"
#include "codec/lines/shown_lines.hpp"
#include "conformance/cases/cases.hpp"
#include "conformance/cases/crafted_streams.hpp"

namespace tetrakis::conformance {
namespace {

/// Coefficients of all bit-planes: sums leave 32 bits.
std::vector<VectorCase> wideCases() {
  StreamHeader plain = heightsHeader(70, 40, TKS_I32, 30);
  StreamHeader holed = plain;
  holed.layers.validity_bytes = 60;
  holed.layers.has_nodata = 1;
  holed.layers.nodata = 7;
  StreamHeader deep = heightsHeader(2, 300, TKS_I32, 30);
  deep.geometry->wavelet.fraction_bits = 8;
  StreamHeader smooth = heightsHeader(60, 45, TKS_I32, 30);
  smooth.geometry->wavelet.filters = {4, 4, 4};
  Bytes mask = noise(60, 2);
  append(mask, noise(2500, 3, 3));
  return {crafted("noise_i32_70x40", "noise: sums wrap at 32 bits, but not above level 3",
                  streamOf(plain, noise(2500, 1, 3))),
          crafted("noise_voids_i32_70x40", "noise: sums are wide where there are voids",
                  streamOf(holed, mask)),
          crafted("noise_smooth_i32_60x45", "noise: sums of the filter for smooth ground wrap",
                  streamOf(smooth, noise(2500, 5, 3))),
          crafted("noise_fraction_2x300", "noise: eight fraction bits, levels of one side",
                  streamOf(deep, noise(900, 4, 2)))};
}

/// What there is of a table of noise.
struct NoiseTable {
  tks_sample sample;
  uint32_t values;
  uint32_t seed;
  uint64_t after = 0;                 ///< bytes of coefficients
  std::vector<TableKnot> knots = {};  ///< that stand in for it
  uint8_t fraction_bits = 0;
  int planes = 12;
};

/// Tables of noise: gaps of all sizes, words that wrap, floats that are no numbers. Corrections lie
/// behind the coefficients, of which there are 300 bytes.
VectorCase noiseTable(const std::string& name, const std::string& purpose, const NoiseTable& of) {
  StreamHeader header = heightsHeader(28, 23, of.sample, of.planes);
  header.geometry->step = 3;
  header.geometry->wavelet.fraction_bits = of.fraction_bits;
  header.layers.corrections = CorrectionKind::kSamples;
  header.layers.table_bytes = 500;
  header.layers.table_values = of.values;
  header.layers.table_after = of.after;
  header.layers.table_knots = of.knots;
  header.layers.coefficient_bytes = 300;
  const Bytes coefficients = noise(300, of.seed + 1);
  Bytes codeword(coefficients.begin(), coefficients.begin() + static_cast<ptrdiff_t>(of.after));
  append(codeword, noise(500, of.seed));
  codeword.insert(codeword.end(), coefficients.begin() + static_cast<ptrdiff_t>(of.after),
                  coefficients.end());
  append(codeword, noise(900, of.seed + 2, 9));
  return crafted(name, purpose, streamOf(header, codeword));
}

std::vector<VectorCase> craftedTableCases() {
  constexpr int64_t kSteep = GeometryLayers::kMostRise;
  const std::vector<TableKnot> wild = {{0, -kSteep}, {1, kSteep}, {30, -17}, {59, 250}};
  return {noiseTable("noise_table_i16_28x23", "noise: a table of which words leave their type",
                     {TKS_I16, 40, 71}),
          noiseTable("noise_table_f32_28x23", "noise: a table of any floats", {TKS_F32, 60, 74}),
          noiseTable("noise_table_unknown_28x23",
                     "noise: the bytes of the table do not decide all of its values",
                     {TKS_I32, 1 << 20, 77}),
          noiseTable("noise_table_knots_28x23",
                     "noise: a table among the coefficients, knots of any rise",
                     {TKS_F32, 60, 80, 130, wild}),
          noiseTable("noise_table_behind_28x23",
                     "noise: an undecided table behind the coefficients, six fraction bits",
                     {TKS_I32, 1 << 20, 83, 300, {{400000, -300}, {524288, 300}, {700000, 9}}, 6}),
          noiseTable("noise_table_far_28x23",
                     "noise: an undecided table, steps beyond the line that stands in for it",
                     {TKS_I32, 1 << 20, 86, 300, {{400000, -296}, {524288, 296}}, 0, 30})};
}

/// A mask of flat areas whose header tells of so many more, or of fewer, with heights for more than
/// there are: nothing is held.
VectorCase otherAreas(const std::string& name, const std::string& purpose, int more) {
  StreamHeader header = heightsHeader(30, 30, TKS_I16, 12);
  const Extent extent = header.geometry->extent();
  std::vector<uint8_t> flat = samples::validity(samples::VoidShape::kSpeckle, 30, 30);
  NumberedAreas numbered = numberAreas(PlaneView<const uint8_t>(flat, extent));
  FlatAreas areas{std::move(numbered.numbers), std::vector<int32_t>(numbered.count, 500)};
  Bytes codeword = encodeFlatAreas(areas, extent, {});
  append(codeword, noise(60, 96));
  header.layers.flat_bytes = codeword.size();
  header.layers.flat_areas = numbered.count + static_cast<uint32_t>(more);
  append(codeword, noise(900, 97));
  return crafted(name, purpose, streamOf(header, codeword));
}

/// Flat areas of any shape and any height, and noise for coefficients.
VectorCase flatNoise(const std::string& name, const std::string& purpose, StreamHeader header,
                     samples::VoidShape shape, uint32_t seed) {
  const Extent extent = header.geometry->extent();
  std::vector<uint8_t> flat = samples::validity(shape, extent.width, extent.height);
  NumberedAreas numbered = numberAreas(PlaneView<const uint8_t>(flat, extent));
  FlatAreas areas{std::move(numbered.numbers), std::vector<int32_t>(numbered.count)};
  for (uint32_t i = 0; i < numbered.count; ++i)
    areas.heights[i] = static_cast<int32_t>(samples::hash(i % 11, seed, 43) >> (i % 5 * 5));
  Bytes codeword = encodeFlatAreas(areas, extent, {});
  header.layers.flat_bytes = codeword.size();
  header.layers.flat_areas = numbered.count;
  append(codeword, noise(2000, seed, 3));
  return crafted(name, purpose, streamOf(header, codeword));
}

std::vector<VectorCase> flatCases() {
  using samples::VoidShape;
  StreamHeader wrong = heightsHeader(30, 30, TKS_I16, 12);
  wrong.layers.flat_bytes = 60;
  wrong.layers.flat_areas = 3;
  StreamHeader more = wrong;
  more.layers.flat_areas = 60000;
  StreamHeader deep = heightsHeader(40, 51, TKS_F32, 20);
  deep.geometry->wavelet.fraction_bits = 4;
  deep.geometry->wavelet.filters = {2, 2, 2};
  return {flatNoise("noise_flat_i32_70x40", "noise beside flat areas of any level",
                    heightsHeader(70, 40, TKS_I32, 30), VoidShape::kSpeckle, 81),
          flatNoise("noise_flat_fraction_40x51",
                    "noise beside flat areas, with fraction bits and the filter of four steps",
                    deep, VoidShape::kCoast, 84),
          flatNoise("noise_flat_long_3x90", "noise beside flat areas; one side is split",
                    heightsHeader(3, 90, TKS_I16, 14), VoidShape::kChecker, 87),
          otherAreas("flat_less_by_one_30x30", "one flat area fewer than is announced", 1),
          otherAreas("flat_more_by_one_30x30", "one flat area more than is announced", -1),
          crafted("noise_flat_none_30x30", "noise: other flat areas than are announced",
                  streamOf(wrong, noise(900, 90))),
          crafted("noise_flat_fewer_30x30", "noise: fewer flat areas than are announced",
                  streamOf(more, noise(900, 95)))};
}

/// A late mask of noise between noise for coefficients: beside flat areas among lifted samples;
/// before, at and behind the place of a table.
std::vector<VectorCase> lateMaskCases() {
  const auto withMask = [](StreamHeader header, uint64_t after) {
    header.layers.late_mask = true;
    header.layers.validity_bytes = 150;
    header.layers.validity_after = after;
    header.layers.has_nodata = 1;
    header.layers.nodata = 5;
    return header;
  };
  StreamHeader flat = withMask(heightsHeader(45, 37, TKS_I16, 14), 400);
  const Extent extent = flat.geometry->extent();
  const std::vector<uint8_t> lifted = samples::validity(samples::VoidShape::kCoast, 45, 37);
  std::vector<uint8_t> water = samples::validity(samples::VoidShape::kSpeckle, 45, 37);
  for (size_t i = 0; i < water.size(); ++i) water[i] = water[i] != 0 && lifted[i] != 0;
  NumberedAreas numbered = numberAreas(PlaneView<const uint8_t>(water, extent));
  FlatAreas areas{std::move(numbered.numbers), std::vector<int32_t>(numbered.count)};
  for (uint32_t i = 0; i < numbered.count; ++i) areas.heights[i] = static_cast<int32_t>(40 * i);
  Bytes opening = encodeValidity({lifted, extent});
  flat.layers.lifted_bytes = opening.size();
  const Bytes flat_codeword = encodeFlatAreas(areas, extent, lifted);
  flat.layers.flat_bytes = flat_codeword.size();
  flat.layers.flat_areas = numbered.count;
  append(opening, flat_codeword);
  append(opening, noise(1500, 101, 3));
  std::vector<VectorCase> cases = {crafted("noise_late_flat_45x37",
                                           "noise: a late mask, flat areas among what is lifted",
                                           streamOf(flat, opening))};
  for (const uint64_t after : {60u, 130u, 200u}) {
    StreamHeader header = withMask(heightsHeader(28, 23, TKS_F32, 12), after);
    header.layers.corrections = CorrectionKind::kSamples;
    header.layers.table_bytes = 200;
    header.layers.table_values = 40;
    header.layers.table_after = 130;
    header.layers.coefficient_bytes = 300;
    cases.push_back(crafted("noise_late_table_" + std::to_string(after) + "_28x23",
                            "noise: a late mask, a table and corrections",
                            streamOf(header, noise(1300, 102))));
  }
  return cases;
}

/// Lines that repeat others, in runs of any lengths, and noise for coefficients.
std::vector<VectorCase> repeatedCases() {
  const auto runs = [](uint32_t lines, uint32_t seed) {
    std::vector<uint8_t> repeated(lines);
    for (uint32_t i = 1; i < lines; ++i) repeated[i] = samples::hash(i, seed, 46) % 3 == 0;
    return repeated;
  };
  StreamHeader corrected = heightsHeader(70, 31, TKS_F32, 14),
               ends = heightsHeader(40, 60, TKS_U16, 12), one = heightsHeader(1, 50, TKS_I16, 12);
  corrected.geometry->repeats = encodeRepeats(runs(70, 1), runs(31, 2));
  corrected.layers.corrections = CorrectionKind::kSamples;
  corrected.layers.coefficient_bytes = 300;
  StreamHeader texels = textureHeader(61, 44, 4, TKS_U16, 14);
  texels.texture->repeats = encodeRepeats(runs(61, 5), runs(44, 6));
  ends.geometry->repeats = {{40, 60}, std::string("\x35\x17", 2)};
  one.geometry->repeats = encodeRepeats(std::vector<uint8_t>{0, 1, 1, 1, 1, 1, 1}, runs(50, 3));
  return {crafted("noise_repeats_7x50", "noise: one column, which all others repeat",
                  streamOf(one, noise(300, 93))),
          crafted("noise_repeats_f32_70x31", "noise: repeated lines in runs of any lengths",
                  streamOf(corrected, noise(900, 91))),
          crafted("noise_repeats_end_40x60", "noise: a map of repeated lines that ends early",
                  streamOf(ends, noise(700, 92))),
          crafted("noise_repeats_texels_61x44", "noise: repeated lines of four channels",
                  streamOf(texels, noise(900, 94)))};
}

/// base + q · step for few q, of which some are the declared nodata value.
struct NodataSteps {
  double base, step, nodata;
  bool voids;
};

VectorCase nodataCase(const std::string& name, const std::string& purpose, const NodataSteps& of) {
  StreamHeader header = heightsHeader(24, 20, TKS_F32, 3);
  header.geometry->base = of.base;
  header.geometry->step = of.step;
  header.layers.has_nodata = 1;
  header.layers.nodata = of.nodata;
  header.layers.validity_bytes = of.voids ? 40 : 0;
  Bytes codeword = of.voids ? noise(40, 20) : Bytes();
  append(codeword, noise(300, 21));
  return crafted(name, purpose, streamOf(header, codeword));
}

std::vector<VectorCase> nodataCases() {
  constexpr double kLargest = std::numeric_limits<float>::max();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  StreamHeader halves = heightsHeader(20, 20, TKS_I16, 4);
  halves.geometry->base = -2.5;
  return {crafted("halves_i16_20x20", "halves below 0 are rounded away from it",
                  streamOf(halves, noise(300, 22))),
          nodataCase("nodata_zero_24x20", "voids are 0, heights neither 0 nor -0",
                     {.base = -1e-60, .step = 1e-45, .nodata = 0, .voids = true}),
          nodataCase("nodata_minus_zero_24x20", "no voids, nodata that becomes -0",
                     {.base = -1e-60, .step = 1e-45, .nodata = -1e-60, .voids = false}),
          nodataCase("nodata_infinity_24x20", "no voids, nodata and heights beyond the floats",
                     {.base = kLargest, .step = 1e38, .nodata = kInfinity, .voids = false}),
          nodataCase("nodata_largest_24x20", "voids are the largest float",
                     {.base = kLargest, .step = 3e31, .nodata = kLargest, .voids = true}),
          nodataCase("nodata_least_24x20", "voids are minus infinity",
                     {.base = -3.6e38, .step = 1e37, .nodata = -kInfinity, .voids = true})};
}

}  // namespace

std::vector<VectorCase> craftedCases() {
  std::vector<VectorCase> all = weightCases();
  for (const auto& cases : {priorityCases(), wideCases(), craftedTableCases(), flatCases(),
                            lateMaskCases(), repeatedCases(), correctionCases(), nodataCases(),
                            shearCases(), channelTableCases(), drawnCases(), roundedCases()})
    all.insert(all.end(), cases.begin(), cases.end());
  return all;
}

}  // namespace tetrakis::conformance

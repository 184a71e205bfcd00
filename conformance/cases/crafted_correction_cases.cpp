// SPDX-License-Identifier: Apache-2.0
// Corrections of heights that no encoder writes: noise, and numbers at the ends of their ranges.
#include "bitstream/stream/geometry_header.hpp"
#include "codec/geometry/corrections/corrections_encoder.hpp"
#include "codec/geometry/facets/facets_encoder.hpp"
#include "codec/geometry/heights_encoder.hpp"
#include "conformance/cases/cases.hpp"
#include "conformance/cases/crafted_streams.hpp"

namespace tetrakis::conformance {
namespace {

constexpr uint8_t kFacetUnit = 130;  // an exponent field

/// Corrections that bring decoded heights, in such steps, to the very samples.
StreamHeader sampleCorrections(tks_sample sample, double step, int planes = 12) {
  StreamHeader header = heightsHeader(30, 20, sample, planes);
  header.geometry->step = step;
  header.layers.corrections = CorrectionKind::kSamples;
  return header;
}

/// From relative steps: multiples and rests of all sizes, samples that are no numbers.
StreamHeader relativeCorrections(tks_sample sample, RelativeSteps relative) {
  StreamHeader header = heightsHeader(30, 20, sample, 12);
  header.geometry->step = 3;
  header.layers.corrections = CorrectionKind::kRelative;
  header.layers.relative = relative;
  return header;
}

/// From facets: differences of all sizes, samples that are no numbers.
StreamHeader facetCorrections(double step, uint8_t unit) {
  StreamHeader header = heightsHeader(30, 20, TKS_F32, 12);
  header.geometry->step = step;
  header.layers.corrections = CorrectionKind::kFacets;
  header.layers.facet_unit = unit;
  return header;
}

/// Likewise, of a base that is more than 2^62 units of 2^-30 away from 0.
StreamHeader facetsFarAway() {
  StreamHeader header = facetCorrections(1, 150);
  header.geometry->base = 1e20;
  return header;
}

/// Behind coefficients of noise.
VectorCase correctionsOfNoise(const std::string& name, const std::string& purpose,
                              StreamHeader header, uint32_t seed) {
  header.layers.coefficient_bytes = 200;
  Bytes codeword = noise(200, seed);
  append(codeword, noise(2000, seed + 1, 9));
  return crafted(name, "noise: " + purpose, streamOf(header, codeword));
}

/// Noise in regions: coefficients of all tracks, and corrections of all parts but the last.
VectorCase correctionsInRegions(const std::string& name, const std::string& purpose,
                                StreamHeader header, uint32_t seed) {
  GeometryHeader& geometry = *header.geometry;
  geometry.width = 40;
  geometry.height = 33;
  geometry.regions.side_log2 = 4;
  header.layers.coefficient_bytes = 200;
  std::vector<Bytes> tracks;
  for (uint32_t i = 0; i + 1 < trackCounts(header)[0].tracks; ++i) {
    const bool coefficients = i < coefficientTracks(geometry);
    tracks.push_back(coefficients ? noise(i == 0 ? 230 : 60, seed + i) : noise(300, seed + i, 9));
  }
  return crafted(name, "noise: " + purpose, streamOf(header, tracks));
}

/// Every error of 2^15 stands behind one of 1, and adds 2^17 to the same factor of the forecast;
/// behind errors of -1 it takes off as much.
VectorCase largestFactors() {
  constexpr uint32_t kWidth = 36, kHeight = 25;
  StreamHeader header = heightsHeader(kWidth, kHeight, TKS_I32, 0);
  header.layers.corrections = CorrectionKind::kSteps;
  header.layers.correction_step = 1;
  const std::vector<int32_t> flat(kWidth * kHeight);
  std::vector<int32_t> steps = flat;
  for (size_t y = 2; y < kHeight; y += 5) {
    for (size_t x = 2; x + 1 < kWidth; x += 6) {
      steps[y * kWidth + x] = y < kHeight / 2 ? 1 : -1;
      steps[y * kWidth + x + 1] = 1 << 15;
    }
  }
  return crafted("factors_36x25", "the largest and the least factor of a forecast",
                 streamOf(header, encodeExactSteps(steps, {flat, {kWidth, kHeight}}, 0)));
}

/// Heights beyond 2^29 steps, beside floats that are as far away: LL alone.
VectorCase farFacets() {
  constexpr Extent kExtent{4, 4};
  std::vector<int32_t> steps;
  std::vector<float> samples;
  for (int32_t i = 0; i < 16; ++i) {
    const int32_t away = (1 << 29) + i;
    steps.push_back(i % 5 == 0 ? -away : away);
    samples.push_back(static_cast<float>(steps.back()) *
                      (1 + 0x1p-20f * static_cast<float>(i % 3)));
  }
  StreamHeader header = heightsHeader(kExtent.width, kExtent.height, TKS_F32, 30);
  const Bytes coefficients =
      encodeCoefficients({steps, kExtent}, header.geometry->wavelet, {})[0].codeword;
  header.layers.corrections = CorrectionKind::kFacets;
  header.layers.facet_unit = kFacetUnit;
  header.layers.coefficient_bytes = coefficients.size();
  tks_heights heights = {};
  heights.size = sizeof heights;
  heights.width = kExtent.width;
  heights.height = kExtent.height;
  heights.sample = TKS_F32;
  heights.data = samples.data();
  heights.scale = 1;
  Bytes codeword = coefficients;
  append(codeword, encodeFacets(heights, {steps, kExtent}, {0, 0, kExtent.width, kExtent.height},
                                *header.geometry, kFacetUnit));
  return crafted("far_facets_4x4", "facets of heights beyond 2^29 steps",
                 streamOf(header, codeword));
}

}  // namespace

std::vector<VectorCase> correctionCases() {
  StreamHeader steps = heightsHeader(33, 21, TKS_I32, 12);
  steps.layers.corrections = CorrectionKind::kSteps;
  steps.layers.coefficient_bytes = 200;
  steps.layers.correction_step = uint32_t{1} << 26;
  Bytes codeword = noise(200, 10);
  append(codeword, noise(1500, 11, 9));
  StreamHeader exact = steps;
  exact.layers.correction_step = 1;
  return {
      largestFactors(),
      crafted("noise_exact_i32_33x21", "noise: exact corrections of all classes",
              streamOf(exact, codeword)),
      crafted("noise_steps_i32_33x21", "noise: corrections of 32 digits wrap",
              streamOf(steps, codeword)),
      correctionsInRegions("noise_exact_regions_40x33", "exact corrections of regions", exact, 120),
      correctionsInRegions("noise_steps_regions_40x33", "corrections of steps, of regions", steps,
                           140),
      correctionsInRegions("noise_relative_regions_40x33", "relative steps of regions",
                           relativeCorrections(TKS_F32, {0.7, 1}), 160),
      correctionsOfNoise("noise_corrections_u32_30x20", "corrections of samples of all classes",
                         sampleCorrections(TKS_U32, 1), 12),
      correctionsOfNoise("noise_corrections_f32_30x20", "hints of floats of all sizes",
                         sampleCorrections(TKS_F32, 1e-30), 14),
      correctionsOfNoise("noise_hints_u8_30x20", "the largest hint",
                         sampleCorrections(TKS_U8, 1e100), 16),
      correctionsOfNoise("noise_subnormal_30x20", "hints of floats without an exponent",
                         sampleCorrections(TKS_F32, 0x1p-137, 13), 24),
      correctionsOfNoise("noise_hints_f32_30x20", "the smallest hints",
                         sampleCorrections(TKS_F32, 1, 28), 18),
      correctionsOfNoise("noise_relative_f32_30x20", "relative steps of floats",
                         relativeCorrections(TKS_F32, {0.7, 1}), 91),
      correctionsOfNoise("noise_relative_u8_30x20", "relative steps of bytes",
                         relativeCorrections(TKS_U8, {2.5, 3}), 92),
      correctionsOfNoise("noise_relative_i32_30x20", "relative steps beyond the type",
                         relativeCorrections(TKS_I32, {0x1p1000, 4}), 93),
      correctionsOfNoise("noise_relative_tiny_30x20", "the smallest relative steps",
                         relativeCorrections(TKS_F32, {0x1p-1074, 2}), 94),
      correctionsOfNoise("noise_facets_30x20", "facets of floats of all sizes",
                         facetCorrections(0.75, 100), 110),
      correctionsOfNoise("noise_facets_least_30x20", "facets in the smallest unit",
                         facetCorrections(1e-41, 1), 112),
      correctionsOfNoise("noise_facets_most_30x20", "facets in the largest unit",
                         facetCorrections(1e30, 254), 114),
      correctionsOfNoise("noise_facets_largest_30x20", "facets about the largest floats",
                         facetCorrections(1e36, 254), 118),
      correctionsOfNoise("noise_facets_away_30x20", "facets beyond 2^62 units", facetsFarAway(),
                         124),
      farFacets()};
}

}  // namespace tetrakis::conformance

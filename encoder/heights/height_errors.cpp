// SPDX-License-Identifier: Apache-2.0
#include "encoder/heights/coded_heights.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>
#include <vector>

#include "base/samples.hpp"
#include "codec/geometry/drawn_heights/drawn_heights_encoder.hpp"
#include "codec/geometry/heights_encoder.hpp"
#include "codec/geometry/plane_corrections.hpp"
#include "codec/geometry/steps/decoded_heights.hpp"

namespace tetrakis::inline heights {

namespace {

DecodedHeights decodePrefix(const CodedHeights& heights, const Codewords& prefix, uint32_t threads,
                            HeightsMemory* memory) {
  assert(prefix.size() == heights.tracks.size());
  return decodeHeights(heights.header, heights.layers, prefix, {}, {threads, memory});
}

bool isWhole(const Codewords& prefix, const std::vector<EncodedTrack>& tracks) {
  return std::equal(
      prefix.begin(), prefix.end(), tracks.begin(), tracks.end(),
      [](const auto& some, const auto& track) { return some.size() == track.codeword.size(); });
}

}  // namespace

double squaresOf(const CodedHeights& heights, const Codewords& prefix, uint32_t threads,
                 HeightsMemory* memory) {
  const QuantisedHeights& truth = *heights.quantised;
  const bool exact_at_the_end = heights.corrects() || heights.header.stored();
  if (exact_at_the_end && isWhole(prefix, heights.tracks)) return 0;
  DecodedHeights decoded = decodePrefix(heights, prefix, threads, memory);
  const std::vector<uint8_t>& known = decoded.geometry.valid;
  std::vector<uint8_t> counted = truth.steps.valid;
  assert(known.empty() || known.size() == counted.size());
  const Mask lifted = truth.steps.lifted;
  double unknown = 0;
  for (size_t i = 0; i < known.size(); ++i) {
    if (known[i] == counted[i]) continue;
    const bool shown_void = heights.layers.late_mask && known[i] != 0 && lifted[i];
    unknown += shown_void ? heights.shown_void : truth.validityWorth();
    counted[i] = 0;
  }
  const int fraction_bits = decoded.geometry.fraction_bits;
  const double squares = truth.squaresOf(std::move(decoded), counted);
  // Heights with fractions that round to the right samples are not exact while more bytes follow,
  // because meshes are made of the fractions.
  const bool may_be_exact =
      fraction_bits <= heights.header.wavelet.fraction_bits || isWhole(prefix, heights.tracks);
  const double left = may_be_exact ? heights.left : QuantisedHeights::kInexact;
  return unknown + std::max(squares, std::min(left, QuantisedHeights::kInexact));
}

HeightsMemory memoryFor(const CodedHeights& heights) {
  HeightsMemory memory;
  if (heights.correction_bytes > 0 && heights.quantised->isSmall())
    memory.corrected =
        prefixesOfCorrections(heights.header, heights.layers, heights.tracks.front().codeword);
  if (!heights.header.drawn) return memory;
  const TakenLayers taken = takeApart(codewordsOf(heights.tracks), heights.header, heights.layers);
  memory.drawing = prefixesOfDrawing(heights.header, joinCoefficients(taken).codewords.front(),
                                     heights.quantised->steps.valid);
  return memory;
}

SampleErrors sampleErrorsOf(const CodedHeights& heights, const Codewords& prefix,
                            uint32_t threads) {
  const DecodedHeights decoded = decodePrefix(heights, prefix, threads, nullptr);
  const tks_heights& input = *heights.quantised->samples;
  const std::vector<uint8_t>& valid = heights.quantised->steps.valid;
  return withSampleType(input.sample, [&](auto type) {
    using T = decltype(type);
    std::vector<T> samples(decoded.geometry.heights.size());
    fromSteps(decoded, heights.header, heights.layers, samples.data());
    const T* truth = static_cast<const T*>(input.data);
    SampleErrors errors;
    double squares = 0;
    for (size_t i = 0; i < samples.size(); ++i) {
      if (!valid.empty() && !valid[i]) continue;
      const double error =
          std::abs(static_cast<double>(samples[i]) - static_cast<double>(truth[i]));
      squares += error * error;
      errors.largest = std::max(errors.largest, error);
    }
    errors.mean_square = squares / heights.counted();
    return errors;
  });
}

}  // namespace tetrakis::inline heights

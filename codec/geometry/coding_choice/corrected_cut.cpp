// SPDX-License-Identifier: Apache-2.0
#include "codec/geometry/coding_choice/corrected_cut.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <span>
#include <utility>

#include "codec/geometry/corrected_heights.hpp"
#include "codec/geometry/corrections/corrections_encoder.hpp"
#include "codec/geometry/corrections/exact_corrections_encoder.hpp"

namespace tetrakis::inline coding_choice {

int32_t nearestMultiple(int64_t q, int64_t largest) {
  const int64_t unit = 2 * largest + 1, shifted = q + largest;
  return static_cast<int32_t>((shifted - (shifted % unit + unit) % unit) / unit);
}

namespace {

/// Corrections of a part in units of so many steps.
std::vector<uint8_t> encodeWithinBound(const DecodedGeometry& decoded,
                                       std::span<const int32_t> corrections, const Window& part) {
  const Extent plane = decoded.extent();
  const CutOut<int32_t> of_part(corrections, plane, part);
  const CutOut<uint8_t> valid(decoded.valid, plane, part);
  const CutOut<uint8_t> significant(decoded.significant, plane, part);
  const std::vector<uint8_t> hints = activityHints(significant.values(), part.extent());
  return encodeCorrections(of_part.values(), {hints, part.extent(), valid.values()});
}

/// Corrections of a part to whole steps.
std::vector<uint8_t> encodeExact(const DecodedGeometry& decoded, std::span<const int32_t> steps,
                                 const Window& part) {
  const Extent plane = decoded.extent();
  const CutOut<int32_t> exact(steps, plane, part), heights(decoded.heights, plane, part);
  const CutOut<uint8_t> valid(decoded.valid, plane, part);
  return encodeExactSteps(exact.values(), {heights.values(), part.extent(), valid.values()},
                          decoded.fraction_bits);
}

}  // namespace

Corrected correct(const HeightSteps& steps, const GeometryHeader& header,
                  const DecodedGeometry& decoded, int32_t largest, uint32_t threads) {
  std::vector<int32_t> corrections = wholeSteps(decoded);
  Corrected result;
  bool any = false;
  for (size_t i = 0; i < corrections.size(); ++i) {
    const int64_t error = int64_t{steps.steps[i]} - corrections[i];
    corrections[i] = nearestMultiple(error, largest);
    any |= corrections[i] != 0;
    const auto rest = static_cast<double>(error - corrections[i] * (2 * int64_t{largest} + 1));
    result.before += static_cast<double>(error) * static_cast<double>(error);
    result.after += rest * rest;
  }
  if (!any) return result;
  result.codewords = encodeParts(header, threads, [&](const Window& part) {
    return largest > 0 ? encodeWithinBound(decoded, corrections, part)
                       : encodeExact(decoded, steps.steps, part);
  });
  return result;
}

/// Decodes a cut, from where the longest known cut ends that is no longer than it.
DecodedGeometry CorrectedCut::decoded(uint64_t bytes) {
  const auto longer = known_.upper_bound(bytes);
  TrackMemory memory = longer == known_.begin() ? TrackMemory() : std::prev(longer)->second;
  DecodedGeometry geometry = decodeGeometry(
      header_, {std::span(coefficients_.codeword).first(bytes)},
      {steps_.valid, flat_.held(), steps_.lifting(header_.extent()).valid}, {}, {1, &memory});
  known_[bytes] = std::move(memory);
  return geometry;
}

/// Cuts to be tried lie about the shortest in all: what helps most is known of it and of the next
/// one before it.
void CorrectedCut::forgetFarthest() {
  constexpr size_t kKept = 2;
  while (known_.size() > kKept) {
    const auto last = std::prev(known_.end());
    known_.erase(last->first > shortest_ ? last : known_.begin());
  }
}

uint64_t CorrectedCut::total(uint64_t bytes) {
  const auto tried = totals_.find(bytes);
  if (tried != totals_.end()) return tried->second;
  const uint64_t total = bytes + bytesOf(correct(bytes).codewords);
  if (totals_.empty() || total < totals_[shortest_]) shortest_ = bytes;
  totals_[bytes] = total;
  forgetFarthest();
  return total;
}

Corrected CorrectedCut::correct(uint64_t bytes) {
  return coding_choice::correct(steps_, header_, decoded(bytes), largest_, 1);
}

uint64_t CorrectedCut::bytesFor(double mean_square) const {
  const auto samples = static_cast<double>(steps_.validCount());
  for (const RatePoint& point : coefficients_.points) {
    if (point.distortion <= mean_square * samples) return point.bytes;
  }
  return coefficients_.codeword.size();
}

/// Behind a cut the error falls row by row, so that prefixes of exact heights lose by early cuts.
/// So exact heights count as 5 % more bytes for each halving of the cut against all bytes.
double CorrectedCut::cost(uint64_t bytes) {
  constexpr double kHalving = 0.05;
  const auto all = static_cast<double>(total(bytes));
  if (largest_ > 0) return all;
  return all * (1 + kHalving * std::log2(all / static_cast<double>(std::max<uint64_t>(bytes, 1))));
}

/// The cost has one minimum, near the usual cut: descent from there with ever smaller strides.
/// Every turn but the last of each stride costs less than the one before. The shorter neighbour is
/// tried first, because the usual cut goes on from it.
uint64_t CorrectedCut::best(uint64_t rival) {
  constexpr double kWidest = 1.3;
  constexpr double kClearly = 1.03;  // smaller strides save less
  const auto scaled = [&](uint64_t bytes, double factor) {
    return std::min<uint64_t>(static_cast<uint64_t>(static_cast<double>(bytes) * factor),
                              coefficients_.codeword.size());
  };
  const double finest = largest_ > 0 ? 1.04 : 1.1;  // exact heights gain less than 1 % by 1.04
  uint64_t best = bytesFor(usualCut(largest_));
  total(scaled(best, 1 / kWidest));
  double least = cost(best);
  for (const double stride : {kWidest, 1.1, 1.04}) {
    if (stride < finest) break;
    const auto bytes = static_cast<double>(total(best));
    const bool lost = bytes > kClearly * static_cast<double>(rival);
    if (lost && stride < kWidest) break;
    for (const double factor : {1 / stride, stride}) {
      for (;;) {
        const uint64_t cut = scaled(best, factor);
        const double next = cost(cut);
        if (next >= least) break;
        best = cut;
        least = next;
      }
    }
  }
  return best;
}

}  // namespace tetrakis::inline coding_choice

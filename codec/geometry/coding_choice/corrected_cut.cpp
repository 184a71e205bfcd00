// SPDX-License-Identifier: Apache-2.0
#include "codec/geometry/coding_choice/cuts.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <span>
#include <utility>

#include "base/parallel.hpp"
#include "codec/geometry/corrections/corrections_decoder.hpp"
#include "codec/geometry/corrections/corrections_encoder.hpp"

namespace tetrakis::inline coding_choice {

int32_t nearestMultiple(int64_t q, int64_t largest) {
  const int64_t unit = 2 * largest + 1, shifted = q + largest;
  return static_cast<int32_t>((shifted - (shifted % unit + unit) % unit) / unit);
}

namespace {

/// Decoded cuts that are kept, from which the decoding of others goes on. More of them take memory,
/// and save little time.
constexpr size_t kKeptCuts = 2;
/// The factors of bytes by which the search for the best cut goes on, in this order. Closer ones
/// save bytes, and take the time of decoding and correcting each cut.
constexpr std::array<double, 3> kStrides = {1.3, 1.1, 1.04};
/// The search ends after its first factor where a cut takes this many times the bytes of another
/// way: smaller factors save less. A larger number takes time.
constexpr double kClearlyLost = 1.03;

/// A part of the plane: its steps, and the heights decoded from its cut.
struct DecodedPart {
  WindowValues<int32_t> steps, heights;
  WindowValues<uint8_t> valid;
  Extent extent;
  int fraction_bits;

  DecodedPart(const HeightSteps& whole, Extent plane, const DecodedWindow& decoded,
              const Window& part)
      : steps(whole.steps, plane, part),
        heights(decoded.heights.heights, decoded.window.extent(), inside(decoded, part)),
        valid(decoded.heights.valid, decoded.window.extent(), inside(decoded, part)),
        extent(part.extent()),
        fraction_bits(decoded.heights.fraction_bits) {}

  static Window inside(const DecodedWindow& decoded, const Window& part) {
    return {part.x - decoded.window.x, part.y - decoded.window.y, part.width, part.height};
  }
  int64_t error(size_t i) const {
    return int64_t{steps.values()[i]} - wholeStep(heights.values()[i], fraction_bits);
  }
};

/// Corrections of a part, in multiples of 2 * largest + 1 steps.
std::vector<uint8_t> encodeWithinBound(const DecodedPart& part,
                                       std::span<const uint8_t> significant, int32_t largest) {
  std::vector<int32_t> corrections(part.extent.samples());
  for (size_t i = 0; i < corrections.size(); ++i)
    corrections[i] = nearestMultiple(part.error(i), largest);
  const std::vector<uint8_t> hints = activityHints(significant, part.extent);
  return encodeCorrections(corrections, {hints, part.extent, part.valid.values()});
}

/// Corrections of a part to whole steps.
std::vector<uint8_t> encodeExact(const DecodedPart& part) {
  return encodeExactSteps(part.steps.values(),
                          {part.heights.values(), part.extent, part.valid.values()},
                          part.fraction_bits);
}

Corrected correctPart(const DecodedPart& part, std::span<const uint8_t> significant,
                      int32_t largest) {
  Corrected result;
  const std::span<const uint8_t> valid = part.valid.values();
  for (size_t i = 0; i < part.extent.samples(); ++i) {
    if (!valid.empty() && valid[i] == 0) continue;
    const int64_t error = part.error(i), correction = nearestMultiple(error, largest);
    const auto rest = static_cast<double>(error - correction * (2 * int64_t{largest} + 1));
    result.any |= correction != 0;
    result.before += static_cast<double>(error) * static_cast<double>(error);
    result.after += rest * rest;
  }
  if (largest == 0) {
    result.codewords.push_back(encodeExact(part));
    return result;
  }
  result.codewords.push_back(encodeWithinBound(part, significant, largest));
  return result;
}

}  // namespace

void Corrected::append(Corrected more) {
  for (std::vector<uint8_t>& codeword : more.codewords) codewords.push_back(std::move(codeword));
  any |= more.any;
  before += more.before;
  after += more.after;
}

Corrected correct(const HeightSteps& steps, uint32_t width, const DecodedWindow& decoded,
                  int32_t largest, uint32_t threads) {
  const Extent plane = {width, static_cast<uint32_t>(steps.steps.size() / width)};
  std::vector<Corrected> of_parts(decoded.parts.size());
  parallelFor(threads, decoded.parts.size(), [&](size_t i) {
    const Window& part = decoded.parts[i];
    const WindowValues<uint8_t> significant(decoded.heights.significant, decoded.window.extent(),
                                            DecodedPart::inside(decoded, part));
    of_parts[i] =
        correctPart(DecodedPart(steps, plane, decoded, part), significant.values(), largest);
  });
  Corrected all;
  for (Corrected& part : of_parts) all.append(std::move(part));
  return all;
}

Corrected correct(const HeightSteps& steps, const DecodedGeometry& decoded, int32_t largest) {
  const Window whole = {0, 0, decoded.width, decoded.height};
  return correct(steps, decoded.width, {decoded, whole, {&whole, 1}}, largest, 1);
}

/// Decodes a cut. Decoding goes on from the end of the longest known cut that is no longer.
DecodedGeometry CorrectedCut::decoded(uint64_t bytes) {
  const auto longer = known_.upper_bound(bytes);
  TrackMemory memory = longer == known_.begin() ? TrackMemory() : std::prev(longer)->second;
  DecodedGeometry geometry =
      decodeCoefficients(header_, {std::span(coefficients_.codeword).first(bytes)},
                         {sharedBits(steps_.valid, header_.extent()), flat_.held(),
                          sharedBits(steps_.lifting(header_.extent()).valid, header_.extent())},
                         {}, {1, &memory});
  known_[bytes] = std::move(memory);
  return geometry;
}

/// Forgets all decoded cuts but kKeptCuts. Cuts still to be tried lie about the cut with the fewest
/// bytes in all, so its state and that of the cut before it help most.
void CorrectedCut::forgetFarthest() {
  while (known_.size() > kKeptCuts) {
    const auto last = std::prev(known_.end());
    known_.erase(last->first > shortest_ ? last : known_.begin());
  }
}

uint64_t CorrectedCut::total(uint64_t bytes) {
  const auto tried = totals_.find(bytes);
  if (tried != totals_.end()) return tried->second;
  const Corrected corrected = correct(bytes);
  const uint64_t total = bytes + (corrected.any ? bytesOf(corrected.codewords) : 0);
  if (totals_.empty() || total < totals_[shortest_]) shortest_ = bytes;
  totals_[bytes] = total;
  forgetFarthest();
  return total;
}

Corrected CorrectedCut::correct(uint64_t bytes) {
  return coding_choice::correct(steps_, decoded(bytes), largest_);
}

uint64_t CorrectedCut::bytesFor(double mean_square) const {
  const auto samples = static_cast<double>(steps_.validCount());
  for (const RatePoint& point : coefficients_.points) {
    if (point.distortion <= mean_square * samples) return point.bytes;
  }
  return coefficients_.codeword.size();
}

/// The total has one minimum, near the usual cut: descent from there with ever smaller strides.
/// Within a stride every turn but the last costs less than the one before. The shorter neighbour is
/// tried first, because the usual cut goes on from it.
uint64_t CorrectedCut::best(uint64_t rival) {
  const auto scaled = [&](uint64_t bytes, double factor) {
    return std::min<uint64_t>(static_cast<uint64_t>(static_cast<double>(bytes) * factor),
                              coefficients_.codeword.size());
  };
  uint64_t best = bytesFor(usualCut(largest_));
  total(scaled(best, 1 / kStrides.front()));
  uint64_t least = total(best);
  for (const double stride : kStrides) {
    const bool lost = static_cast<double>(least) > kClearlyLost * static_cast<double>(rival);
    if (lost && stride < kStrides.front()) break;
    for (const double factor : {1 / stride, stride}) {
      for (;;) {
        const uint64_t cut = scaled(best, factor);
        const uint64_t next = total(cut);
        if (next >= least) break;
        best = cut;
        least = next;
      }
    }
  }
  return best;
}

}  // namespace tetrakis::inline coding_choice

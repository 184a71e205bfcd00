// SPDX-License-Identifier: Apache-2.0
// FacetCoder codes the samples of facets behind decoded heights, row by row, once for both sides.
// Each prediction of a sample (facet_rows.hpp) is asked for, one after the other: is the sample the
// float nearest to it, or one of the next two on either side? If none is right, the sample lies
// beyond an edge. Then its difference from the decoded height, to which its forecast error is added
// (codec/geometry/corrections/error_forecast.hpp), is coded.
//
// A sample is known better than its float says, if a prediction was right: facets lie where their
// samples were before they were rounded. So it counts as a quarter of the way from the prediction
// to its float, or nearer to that where it would have been rounded to another one.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <span>
#include <vector>

#include "base/plane.hpp"
#include "bitstream/coder/mixture.hpp"
#include "bitstream/stream/geometry_header.hpp"
#include "codec/geometry/corrections/correction_coder.hpp"
#include "codec/geometry/corrections/error_forecast.hpp"
#include "codec/geometry/facets/facet_rows.hpp"
#include "codec/geometry/steps/decoded_heights.hpp"
#include "codec/geometry/steps/sample_order.hpp"
#include "codec/geometry/steps/step_units.hpp"

namespace tetrakis::inline facets {

/// What decoded heights say of a sample.
struct ForetoldSample {
  int32_t step;  ///< with the forecast error
  size_t level;  ///< by how much forecasts nearby have missed (levelOf())
  float sample;  ///< the one nearest to the step

  /// forecast: which has looked at the sample. height: in whole steps.
  ForetoldSample(int32_t height, const ErrorForecast& forecast, const StepGrid& grid)
      : step(static_cast<int32_t>(static_cast<uint32_t>(height) +
                                  static_cast<uint32_t>(forecast.foretold()))),
        level(forecast.missedLevel()),
        sample(grid.sampleNear<float>(step)) {}
};

/// How far a prediction lies from the foretold sample, beside how far those miss: 16 classes.
inline size_t classOfDistance(int32_t predicted, const ForetoldSample& foretold) {
  constexpr int kMiddle = 9, kMost = 15;
  const auto off = static_cast<uint64_t>(std::abs(int64_t{predicted} - foretold.step));
  const int level = static_cast<int>(levelOf(off)) - static_cast<int>(foretold.level);
  return static_cast<size_t>(std::clamp(level + kMiddle, 0, kMost));
}

/// Io: DecisionEncoding or DecisionDecoding (bitstream/coder/).
template <class Io>
class FacetCoder {
 public:
  /// grid: of the base and step of the decoded heights.
  FacetCoder(const StepGrid& grid, const FacetUnit& unit, Io& io)
      : grid_(grid), unit_(unit), io_(io), beyond_(io) {}

  /// A sample, and where it lies before it is rounded, in units.
  struct Located {
    float sample;
    int64_t multiples;
  };

  /// rows: which have looked at the sample. known: it, or anything in decoders. Where io has
  /// stopped the result means nothing.
  Located code(FacetRows& rows, const ForetoldSample& foretold, float known) {
    for (size_t asked = 0; rows.more(); ++asked) {
      const FacetPrediction next = rows.next();
      const Turn turn{std::min(asked, kAsked - 1), !rows.more()};
      if (const auto near = codeNear(next, turn, foretold, known)) return *near;
    }
    const float sample = codeBeyond(foretold, known);
    return {sample, unit_.multiplesOf(sample)};
  }

 private:
  static constexpr size_t kAsked = 6, kAgreeing = 8, kDistances = 16;
  static constexpr size_t kBefore = size_t{1} << FacetRows::kNeighbours;
  static constexpr size_t kRests = 4;

  /// How many predictions came before one, up to kAsked - 1, and whether none comes behind it.
  struct Turn {
    size_t before;
    bool last;
  };

  std::optional<Located> codeNear(const FacetPrediction& one, Turn turn,
                                  const ForetoldSample& foretold, float known) {
    constexpr int32_t kFarthest = 2;
    const NearestFloat nearest = unit_.nearest(one.multiples);
    const auto float_there = fromOrder<float>(nearest.order);
    const int32_t rest =
        toSide(static_cast<int32_t>(orderOf(known) - nearest.order), nearest.below);
    const size_t agreeing = std::min(one.agreeing, kAgreeing) - 1;
    const size_t distance = classOfDistance(grid_.nearest(float_there), foretold);
    const bool right = decide(
        Mixture<2>(
            {&right_[(turn.before * kBefore + one.right_before) * kWays + one.way],
             &far_[((turn.before * kAgreeing + agreeing) * kDistances + distance) * 2 + turn.last]},
            right_weights_[turn.before], odds_),
        rest >= -kFarthest && rest <= kFarthest);
    if (!right) return {};
    const int32_t found = codeRest(one, agreeing * kFloatPlaces + nearest.place, rest);
    const auto sample =
        fromOrder<float>(nearest.order + static_cast<uint32_t>(toSide(found, nearest.below)));
    return Located{sample, unrounded(one.multiples, sample)};
  }

  /// How many floats beside the nearest one the sample is, to the side of the prediction.
  int32_t codeRest(const FacetPrediction& one, size_t place, int32_t known) {
    const size_t way = one.way * kBefore + one.right_before;
    const auto ask = [&](size_t question, bool answer) {
      return decide(
          Mixture<2>({&rest_place_[place * kRests + question], &rest_way_[way * kRests + question]},
                     rest_weights_[question], odds_),
          answer);
    };
    if (!ask(0, known != 0)) return 0;
    const bool negative = ask(1, known < 0);
    const int32_t size = ask(negative ? 3 : 2, std::abs(int64_t{known}) > 1) ? 2 : 1;
    return negative ? -size : size;
  }

  int64_t unrounded(int64_t predicted, float sample) const {
    const int64_t there = unit_.multiplesOf(sample), half = unit_.halfSpacing(sample);
    return std::clamp(predicted + (there - predicted) / 4, there - half, there + half);
  }

  /// The sample by its difference from the foretold one.
  float codeBeyond(const ForetoldSample& foretold, float known) {
    const uint32_t from = orderOf(foretold.sample);
    const int spacings = grid_.exponent() - spacingExponent(foretold.sample);
    constexpr int kMost = int{NumberSize::kLevels} - 1;
    const int level = std::clamp(static_cast<int>(foretold.level) + 2 * spacings, 0, kMost);
    const auto difference = static_cast<int32_t>(orderOf(known) - from);
    const int32_t found = beyond_.code({}, {static_cast<size_t>(level), 0}, difference);
    return fromOrder<float>(from + static_cast<uint32_t>(found));
  }

  template <size_t kModels>
  bool decide(Mixture<kModels> mixture, bool known) {
    const bool answer = io_.decideOf(mixture.zero(), known);
    mixture.learn(answer);
    return answer;
  }

  using Models = std::vector<AdaptiveBit>;
  template <size_t kDecisions>
  using Weights = std::array<MixtureWeights<2>, kDecisions>;
  template <size_t kDecisions>
  static Weights<kDecisions> fresh() {
    Weights<kDecisions> weights;
    weights.fill(freshWeights<2>());
    return weights;
  }

  const StepGrid& grid_;
  const FacetUnit& unit_;
  Io& io_;
  Models right_ = Models(kAsked * kBefore * kWays);  ///< by the way, and where it was right before
  Models far_ = Models(kAsked * kAgreeing * kDistances * 2);  ///< by how many agree, how far off
  Models rest_place_ = Models(kAgreeing * kFloatPlaces * kRests);
  Models rest_way_ = Models(kWays * kBefore * kRests);
  NumberCoder<Io> beyond_;
  Weights<kAsked> right_weights_ = fresh<kAsked>();
  Weights<kRests> rest_weights_ = fresh<kRests>();
  const OddsTable odds_ = makeOddsTable();
};

/// What facets are restored from.
struct FacetedHeights {
  const GeometryHeader& header;  ///< base and step
  FacetUnit unit;
  PlaneView<const int32_t> plane;  ///< in units of 2^-fraction_bits steps
  int fraction_bits;
};

/// exact(sample): the float that it comes from, or anything in decoders. take(sample, float): takes
/// these one after the other, up to the first undecided one.
template <class Io, class ExactSample, class TakeSample>
void codeFacets(const FacetedHeights& faceted, Io& io, const ExactSample& exact,
                const TakeSample& take) {
  const auto& [header, unit, heights, fraction_bits] = faceted;
  ErrorForecast forecast(heights.width);
  FacetRows rows(heights.width);
  const StepGrid grid(header.base, header.step);
  FacetCoder<Io> coder(grid, unit, io);
  for (uint32_t y = 0; y < heights.height; ++y) {
    forecast.nextRow();
    rows.nextRow();
    for (uint32_t x = 0; x < heights.width; ++x) {
      const size_t i = size_t{y} * heights.width + x;
      if (!heights.valid[i]) continue;
      const int32_t height = wholeStep(heights.data[i], fraction_bits);
      forecast.look(x);
      const ForetoldSample foretold(height, forecast, grid);
      rows.look(x, unit.multiplesOf(foretold.sample));
      const auto found = coder.code(rows, foretold, exact(i));
      if (io.stopped()) return;
      take(i, found.sample);
      rows.put(x, found.multiples);
      forecast.learn(x, int64_t{grid.nearest(found.sample)} - height);
    }
  }
}

// restoreFacets() restores samples of facets from a codeword and decoded heights.

/// The heights with the samples restored, row by row, as far as they are decided; meshes pass
/// through these as well. decoded: first rows of what encodeFacets() coded, whole, without
/// corrections. header: of floats. unit: of FacetUnit. codeword: any prefix of its one. Safe on any
/// bytes.
DecodedHeights restoreFacets(DecodedHeights decoded, const GeometryHeader& header, int unit,
                             std::span<const uint8_t> codeword);

}  // namespace tetrakis::inline facets

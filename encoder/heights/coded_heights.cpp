// SPDX-License-Identifier: Apache-2.0
#include "encoder/heights/coded_heights.hpp"

#include <algorithm>
#include <utility>

#include "encoder/heights/joined_layers.hpp"

namespace tetrakis::inline heights {

namespace {

/// A late mask comes where coefficients leave this many times the squared error of the target, 6 dB
/// before it. A larger factor shows prefixes their voids earlier, with coarser heights.
constexpr double kBeforeEnd = 4;

}  // namespace

bool CodedHeights::restoresSamples() const {
  return header.stored() || header.exact || corrects();
}

WaveletHeader chooseHeightFilters(const QuantisedHeights& heights, Purpose purpose) {
  const HeightSteps& steps = heights.steps;
  return chooseWavelet(steps.lifting(extentOf(*heights.samples)), steps.range_bits, purpose);
}

std::vector<EncodedTrack> codeCoefficients(const QuantisedHeights& heights,
                                           const WaveletHeader& wavelet,
                                           CoefficientOptions options) {
  const HeightSteps& steps = heights.steps;
  options.share = steps.liftedShare();
  return encodeCoefficients(steps.lifting(extentOf(*heights.samples)), wavelet, options);
}

CodedHeights tryHeights(std::shared_ptr<const QuantisedHeights> quantised,
                        const HeightTarget& target, const CoefficientOptions& options) {
  const HeightSteps& steps = quantised->steps;
  FlatChoice choice =
      chooseFlatAreas(steps.lifting(extentOf(*quantised->samples)), quantised->mayBeFlat(),
                      {steps.range_bits, target.purpose, target.bytes, target.mean_square,
                       options.threads, target.purpose == Purpose::kLossy});
  if (options.windows) choice.wavelet = withShortReach(choice.wavelet);
  HeightLayers layers = layersAround(*quantised, std::move(choice), options.priorities);
  layers.mask_room = target.mask_room;
  layers.mask_room.squares = kBeforeEnd * target.mean_square * quantised->counted();
  std::vector<EncodedTrack> coefficients =
      codeCoefficients(*quantised, layers.wavelet, layers.flat.beside(options));
  std::vector<Account> accounts = accountsOf(coefficients);
  if (layers.wavelet.fraction_bits == 0) layers.wavelet.rounded_bytes = exactBytes(coefficients);
  CodedHeights coded =
      joinLayers(std::move(quantised), layers, std::move(coefficients), options.region_log2);
  coded.accounts = std::move(accounts);
  return coded;
}

CodedHeights codeHeights(std::shared_ptr<const QuantisedHeights> quantised,
                         const HeightTarget& target, const CoefficientOptions& options) {
  return withRounding(tryHeights(std::move(quantised), target, options));
}

CodedHeights withRounding(CodedHeights coded) {
  const std::vector<Account> accounts = std::exchange(coded.accounts, {});
  WaveletHeader& wavelet = coded.header.wavelet;
  const auto complete = [](const EncodedTrack& track) { return track.complete; };
  if (accounts.empty() || wavelet.fraction_bits > 0 ||
      !std::all_of(coded.tracks.begin(), coded.tracks.end(), complete))
    return coded;
  const QuantisedHeights& quantised = *coded.quantised;
  const double squares = roundedSquares(quantised.steps.lifting(extentOf(*quantised.samples)),
                                        coded.flat.areas.held(), wavelet);
  wavelet.rounded_bytes = roundedBytes(accounts, quantised.steps.liftedShare() * squares);
  return coded;
}

}  // namespace tetrakis::inline heights

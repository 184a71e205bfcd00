// SPDX-License-Identifier: Apache-2.0
#include "encoder/heights/coded_heights.hpp"

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "codec/geometry/drawn_heights/drawn_heights_encoder.hpp"
#include "codec/geometry/heights_encoder.hpp"

namespace tetrakis::inline heights {

namespace {

/// An account with a point after the mask and one after each plane of bytes.
std::vector<RatePoint> accountOfStored(const CodedHeights& stored, uint32_t threads) {
  const std::span<const uint8_t> codeword = stored.tracks.front().codeword;
  const auto at = [&](uint64_t bytes) {
    return RatePoint{bytes, squaresOf(stored, {codeword.first(bytes)}, threads)};
  };
  const size_t sample_bytes = tks_sample_bytes(stored.quantised->samples->sample);
  const uint64_t opening = stored.layers.validity_bytes;
  assert(opening <= codeword.size() && (codeword.size() - opening) % sample_bytes == 0);
  const uint64_t plane = (codeword.size() - opening) / sample_bytes;
  std::vector<RatePoint> points = {at(0)};
  for (uint64_t planes = 0; planes <= sample_bytes; ++planes) {
    const RatePoint point = at(opening + planes * plane), &last = points.back();
    if (point.bytes > last.bytes && point.distortion < last.distortion) points.push_back(point);
  }
  return points;
}

}  // namespace

std::optional<CodedHeights> drawHeights(std::shared_ptr<const QuantisedHeights> quantised) {
  const HeightSteps& steps = quantised->steps;
  std::optional<EncodedTrack> track =
      encodeDrawnHeights({steps.steps, extentOf(*quantised->samples), steps.valid});
  if (!track) return {};
  HeightLayers layers = layersAround(*quantised, {}, nullptr);
  layers.stated = quantised->layers;
  layers.stated.bridge = 0;
  std::vector<EncodedTrack> tracks;
  tracks.push_back(*std::move(track));
  CodedHeights drawn = joinLayers(std::move(quantised), layers, std::move(tracks), 0);
  assert(drawn.header.direct());
  drawn.header.drawn = true;
  return drawn;
}

CodedHeights storeHeights(std::shared_ptr<const QuantisedHeights> quantised, uint32_t threads) {
  const QuantisedHeights& heights = *quantised;
  GeometryHeader header = headerOf(heights);
  header.planes = GeometryHeader::kDirectPlanes;
  std::vector<uint8_t> codeword = heights.validity;
  const std::vector<uint8_t> samples = encodeStoredHeights(*heights.samples, heights.steps.valid);
  codeword.insert(codeword.end(), samples.begin(), samples.end());
  std::vector<EncodedTrack> tracks;
  tracks.push_back({std::move(codeword), {}, GeometryHeader::kDirectPlanes});
  CodedHeights stored{.quantised = std::move(quantised),
                      .header = std::move(header),
                      .layers = {.validity_bytes = heights.layers.validity_bytes,
                                 .has_nodata = heights.layers.has_nodata,
                                 .nodata = heights.layers.nodata},
                      .tracks = std::move(tracks),
                      .left = QuantisedHeights::kInexact};
  stored.tracks.front().points = accountOfStored(stored, threads);
  return stored;
}

namespace {

/// Subtracts the error that the complete tracks leave from their accounts, and returns the sum.
RatePoint takeRest(std::vector<EncodedTrack>& tracks) {
  RatePoint rest{0, 0};
  for (EncodedTrack& track : tracks) {
    const RatePoint last = track.points.back();
    for (RatePoint& point : track.points) {
      point.distortion -= last.distortion;
      point.beyond -= last.beyond;
    }
    rest.distortion += last.distortion;
    rest.beyond += last.beyond;
  }
  return rest;
}

/// A single codeword lies at the end of the first track; several are tracks of their own.
std::vector<EncodedTrack> withCorrections(std::vector<EncodedTrack> tracks,
                                          const PartCodewords& corrections, double corrected_to) {
  assert(!corrections.empty());
  const RatePoint rest = takeRest(tracks);
  if (corrections.size() == 1) {
    EncodedTrack& first = tracks.front();
    for (RatePoint& point : first.points) {
      point.distortion += rest.distortion;
      point.beyond += rest.beyond;
    }
    first.codeword.insert(first.codeword.end(), corrections[0].begin(), corrections[0].end());
    first.points.push_back({first.codeword.size(), corrected_to});
    return tracks;
  }
  const auto all = static_cast<double>(bytesOf(corrections));
  for (const std::vector<uint8_t>& codeword : corrections) {
    EncodedTrack track{codeword, {}, tracks.front().planes};
    const double share = all > 0 ? static_cast<double>(codeword.size()) / all : 0;
    track.points.push_back({0, rest.distortion * share, false, rest.beyond * share});
    if (!codeword.empty()) track.points.push_back({codeword.size(), corrected_to * share});
    tracks.push_back(std::move(track));
  }
  return tracks;
}

}  // namespace

CodedHeights followedBy(CodedHeights heights, GeometryLayers layers,
                        const PartCodewords& corrections, double corrected_to) {
  const uint64_t before = heights.tracks.front().codeword.size();
  layers.coefficient_bytes = before - layers.besideCoefficients();
  heights.layers = std::move(layers);
  heights.tracks = withCorrections(std::move(heights.tracks), corrections, corrected_to);
  heights.correction_bytes = heights.tracks.front().codeword.size() - before;
  return heights;
}

CodedHeights restoredBy(CodedHeights heights, GeometryLayers layers,
                        const PartCodewords& corrections, double left) {
  assert(left > 0);
  for (RatePoint& point : heights.tracks.front().points) point.distortion += left;
  CodedHeights restored = followedBy(std::move(heights), std::move(layers), corrections, 0);
  restored.left = left;
  return restored;
}

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

namespace {

/// The same as codeHeights(), for one of several attempts: withRounding() follows for the best one.
CodedHeights tryHeights(std::shared_ptr<const QuantisedHeights> quantised,
                        const HeightTarget& target, const CoefficientOptions& options) {
  const HeightSteps& steps = quantised->steps;
  FlatChoice choice =
      chooseFlatAreas(steps.lifting(extentOf(*quantised->samples)), quantised->mayBeFlat(),
                      {steps.range_bits, target.purpose, target.bytes, target.mean_square,
                       options.threads, target.purpose == Purpose::kLossy, quantised->forest});
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

}  // namespace

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

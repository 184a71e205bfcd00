// SPDX-License-Identifier: Apache-2.0
#include "encoder/heights/ways/relative_heights.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "codec/geometry/relative/relative_encoder.hpp"
#include "encoder/heights/height_options.hpp"
#include "encoder/heights/ways/restored_heights.hpp"
#include "ratecontrol/curves/track_order.hpp"

namespace tetrakis::inline ways {

namespace {

/// The mean squared error of the cut, in steps.
double squaresOfCut(const HeightSteps& steps, double relative_step) {
  const double rmse = kRelativeCut * relative_step / steps.step;
  return rmse * rmse;
}

/// The first bytes of a track: up to a point of its account.
EncodedTrack firstOf(const EncodedTrack& whole, uint64_t bytes) {
  EncodedTrack first = whole;
  first.codeword.resize(bytes);
  std::erase_if(first.points, [&](const RatePoint& point) { return point.bytes > bytes; });
  first.complete = whole.complete && bytes == whole.codeword.size();
  return first;
}

/// The heights cut where their squared error, in steps, falls to so much: what takes off most error
/// a byte is kept of all tracks. Nothing if they do not come so far.
std::optional<CodedHeights> cutAt(const CodedHeights& whole, double squares) {
  const auto is_near = [&](const RatePoint& point) { return point.distortion <= squares; };
  CodedHeights cut = whole;
  if (whole.tracks.size() == 1) {  // its packets are longer than its passes
    const EncodedTrack& track = whole.tracks.front();
    const auto end = std::find_if(track.points.begin(), track.points.end(), is_near);
    if (end == track.points.end() || end->bytes < whole.layers.maskEnd()) return {};
    cut.tracks.front() = firstOf(track, end->bytes);
    return cut;
  }
  const OrderedTracks order = orderTracks(whole.accounted(), TrackOrder::kSlopes);
  const auto end = std::find_if(order.points.begin(), order.points.end(), is_near);
  if (end == order.points.end()) return {};
  const Codewords kept = prefixAfter(whole.accounted(), order.packets, end->bytes);
  if (kept.front().size() < whole.layers.maskEnd()) return {};
  for (size_t i = 0; i < kept.size(); ++i) cut.tracks[i] = firstOf(whole.tracks[i], kept[i].size());
  return cut;
}

/// The tracks with the corrections behind the first one, which then leaves what all of them leave,
/// until the corrections restore all samples.
std::vector<EncodedTrack> tracksWithCorrections(std::vector<EncodedTrack> tracks,
                                                const std::vector<uint8_t>& corrections) {
  RatePoint left{0, QuantisedHeights::kInexact};
  for (size_t i = 1; i < tracks.size(); ++i) {
    const RatePoint last = tracks[i].points.back();
    for (RatePoint& point : tracks[i].points) {
      point.distortion -= last.distortion;
      point.beyond -= last.beyond;
    }
    left.distortion += last.distortion;
    left.beyond += last.beyond;
  }
  EncodedTrack& first = tracks.front();
  for (RatePoint& point : first.points) {
    point.distortion += left.distortion;
    point.beyond += left.beyond;
  }
  first.codeword.insert(first.codeword.end(), corrections.begin(), corrections.end());
  first.points.push_back({first.codeword.size(), 0});
  return tracks;
}

/// The corrections behind what there is of the coefficients, and the pull that makes them short.
struct RelativeCorrections {
  RelativeSteps relative;
  std::vector<uint8_t> codeword;
};

RelativeCorrections relativeCorrections(const CodedHeights& cut, double relative_step,
                                        uint32_t threads) {
  const HeightSteps shown = shownSteps(cut, threads);
  const auto pulled = [&](uint8_t quarters) {
    const RelativeSteps relative{relative_step, quarters};
    return RelativeCorrections{
        relative,
        encodeRelative(*cut.quantised->samples, {shown.steps, cut.header.extent(), shown.valid},
                       cut.header, relative)};
  };
  RelativeCorrections all = pulled(4), quarter = pulled(1);
  return quarter.codeword.size() < all.codeword.size() ? std::move(quarter) : std::move(all);
}

CodedHeights followedByCorrections(CodedHeights cut, double relative_step, uint32_t threads) {
  const RelativeCorrections corrections = relativeCorrections(cut, relative_step, threads);
  GeometryLayers layers = cut.layers;
  layers.corrections = CorrectionKind::kRelative;
  layers.relative = corrections.relative;
  layers.coefficient_bytes = cut.tracks.front().codeword.size() - layers.besideCoefficients();
  return {.quantised = cut.quantised,
          .header = cut.header,
          .layers = std::move(layers),
          .tracks = tracksWithCorrections(std::move(cut.tracks), corrections.codeword),
          .closing = corrections.codeword.size(),
          .left = QuantisedHeights::kInexact,
          .shown_void = cut.shown_void,
          .flat = std::move(cut.flat)};
}

}  // namespace

double relativeStepOf(const CodedHeights& lossy) {
  const QuantisedHeights& quantised = *lossy.quantised;
  const bool possible = !quantised.restored() && quantised.steps.table.empty() &&
                        !lossy.header.direct() && lossy.closing == 0 && lossy.tracks.size() == 1;
  return possible ? relativeStepOf(quantised) : 0;
}

std::optional<CodedHeights> codeRelative(const CodedHeights& lossy, double relative_step,
                                         uint32_t threads) {
  std::optional<CodedHeights> cut =
      cutAt(lossy, squaresOfCut(lossy.quantised->steps, relative_step) * lossy.counted());
  if (!cut) return {};
  return followedByCorrections(*std::move(cut), relative_step, threads);
}

/// Coding ends with a whole bit-plane of all tracks; the cut lies before that.
CodedHeights codeRelative(const EncodeInputs& inputs,
                          const std::shared_ptr<const QuantisedHeights>& quantised,
                          double relative_step) {
  HeightTarget target(Purpose::kLossy);
  target.mean_square = squaresOfCut(quantised->steps, relative_step);
  CoefficientOptions options = heightOptions(inputs);
  options.enough = target.mean_square * quantised->counted();
  CodedHeights coded = codeHeights(quantised, target, options);
  std::optional<CodedHeights> cut = cutAt(coded, options.enough);
  return followedByCorrections(cut ? *std::move(cut) : std::move(coded), relative_step,
                               inputs.options.threads);
}

}  // namespace tetrakis::inline ways

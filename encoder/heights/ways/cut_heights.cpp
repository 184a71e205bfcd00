// SPDX-License-Identifier: Apache-2.0
#include "encoder/heights/ways/cut_heights.hpp"

#include <algorithm>
#include <utility>

#include "encoder/heights/height_options.hpp"
#include "ratecontrol/curves/track_order.hpp"

namespace tetrakis::inline ways {

namespace {

/// The first bytes of a track: up to a point of its account.
EncodedTrack firstOf(const EncodedTrack& whole, uint64_t bytes) {
  EncodedTrack first = whole;
  first.codeword.resize(bytes);
  std::erase_if(first.points, [&](const RatePoint& point) { return point.bytes > bytes; });
  first.complete = whole.complete && bytes == whole.codeword.size();
  return first;
}

/// The fewest bytes of the first track that a cut keeps: the opening, and a late mask with the
/// coefficients before it.
uint64_t leastCut(const GeometryLayers& layers) {
  return std::max(layers.openingBytes(), layers.maskEnd());
}

}  // namespace

std::optional<CodedHeights> cutAt(const CodedHeights& whole, double squares) {
  const auto is_near = [&](const RatePoint& point) { return point.distortion <= squares; };
  CodedHeights cut = whole;
  if (whole.tracks.size() == 1) {  // its packets are longer than its passes
    const EncodedTrack& track = whole.tracks.front();
    const auto end = std::find_if(track.points.begin(), track.points.end(), is_near);
    if (end == track.points.end() || end->bytes < leastCut(whole.layers)) return {};
    cut.tracks.front() = firstOf(track, end->bytes);
    return cut;
  }
  const OrderedTracks order = orderTracks(whole.accounted(), TrackOrder::kSlopes);
  const auto end = std::find_if(order.points.begin(), order.points.end(), is_near);
  if (end == order.points.end()) return {};
  const Codewords kept = prefixAfter(whole.accounted(), order.packets, end->bytes);
  if (kept.front().size() < leastCut(whole.layers)) return {};
  for (size_t i = 0; i < kept.size(); ++i) cut.tracks[i] = firstOf(whole.tracks[i], kept[i].size());
  return cut;
}

/// Coding ends with a whole bit-plane of all tracks; the cut lies before its end.
CodedHeights codeUpTo(const EncodeInputs& inputs, std::shared_ptr<const QuantisedHeights> quantised,
                      double mean_square) {
  HeightTarget target(Purpose::kLossy);
  target.mean_square = mean_square;
  CoefficientOptions options = heightOptions(inputs);
  options.enough = mean_square * quantised->counted();
  CodedHeights coded = codeHeights(std::move(quantised), target, options);
  std::optional<CodedHeights> cut = cutAt(coded, options.enough);
  return cut ? *std::move(cut) : std::move(coded);
}

}  // namespace tetrakis::inline ways

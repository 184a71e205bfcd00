// SPDX-License-Identifier: Apache-2.0
#include "encoder/heights/coded_heights.hpp"

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <span>
#include <utility>

#include "codec/wavelet/priority_map.hpp"
#include "ratecontrol/curves/component_curve.hpp"

namespace tetrakis::inline heights {

namespace {

/// Squared error, in steps, of flat areas that are not known.
double squaresOf(const FlatLayer& flat) {
  double squares = 0;
  for (const uint16_t number : flat.areas.numbers) {
    if (number == 0) continue;
    const double height = flat.areas.heights[number - 1u];
    squares += height * height;
  }
  return squares;
}

/// Bytes of coefficients that are to come before a table of `bytes` bytes: all coefficients that
/// take off more error a byte than the table does. error: squared error while the table is missing.
uint64_t bytesBeforeTable(const EncodedTrack& coefficients, size_t bytes, double error) {
  return bytesWorth(coefficients.points, error / static_cast<double>(bytes));
}

/// A layer that lies among the coefficients of the first track.
struct LayerAmong {
  uint64_t after;  ///< bytes of coefficients that come before the layer
  std::span<const uint8_t> codeword;
  double without;  ///< squared error, in steps, while the layer is missing
};

/// Puts the layer into the codeword and into the account of the coefficients. The last layer is put
/// in first, so that `after` counts coefficients alone.
EncodedTrack withLayer(EncodedTrack coefficients, const LayerAmong& layer) {
  const std::span<const uint8_t> added = layer.codeword;
  std::vector<RatePoint> points;
  for (const RatePoint& point : coefficients.points) {
    if (point.bytes <= layer.after)
      points.push_back({point.bytes, point.distortion + layer.without, point.dips, point.beyond});
    if (point.bytes >= layer.after)
      points.push_back({point.bytes + added.size(), point.distortion, point.dips, point.beyond});
  }
  std::vector<uint8_t> codeword = std::move(coefficients.codeword);
  codeword.insert(codeword.begin() + static_cast<ptrdiff_t>(layer.after), added.begin(),
                  added.end());
  return {std::move(codeword), std::move(points), coefficients.planes, coefficients.complete};
}

/// The account of the track. Its first point is the error of a decoder that lacks the opening.
std::vector<RatePoint> accountBehind(const QuantisedHeights& heights, const HeightLayers& layers,
                                     const std::vector<RatePoint>& coefficients) {
  const uint64_t opening = layers.stated.openingBytes();
  std::vector<RatePoint> points;
  if (opening > 0) {
    const RatePoint& first = coefficients.front();
    const HeightSteps& steps = heights.steps;
    const size_t told = layers.stated.late_mask ? steps.liftedCount() : steps.validCount();
    const auto voids = static_cast<double>(steps.steps.size() - told);
    const double unknown =
        first.distortion + heights.left + voids * heights.validityWorth() + squaresOf(layers.flat);
    points.push_back({0, unknown, false, first.beyond});
  }
  for (const RatePoint& point : coefficients) {
    points.push_back(
        {point.bytes + opening, point.distortion + heights.left, point.dips, point.beyond});
  }
  return points;
}

/// Puts the layers that open the track in front of the coefficients and of the layers among them.
EncodedTrack behindOpening(const QuantisedHeights& heights, const HeightLayers& layers,
                           const EncodedTrack& coefficients) {
  std::vector<uint8_t> codeword = layers.stated.late_mask ? heights.late.lifted : heights.validity;
  for (const std::span<const uint8_t> layer :
       {std::span(layers.flat.codeword), std::span(coefficients.codeword)})
    codeword.insert(codeword.end(), layer.begin(), layer.end());
  std::vector<RatePoint> points = accountBehind(heights, layers, coefficients.points);
  assert(points.back().bytes == codeword.size());
  return {std::move(codeword), std::move(points), coefficients.planes, coefficients.complete};
}

/// The layers that lie among the coefficients, in their order, with the header fields that state
/// their places.
struct PlacedLayers {
  GeometryLayers stated;  ///< HeightLayers::stated, with the places
  std::vector<LayerAmong> among = {};
  double shown_void = 0;  ///< CodedHeights::shown_void
};

PlacedLayers placeLayers(const QuantisedHeights& heights, const HeightLayers& layers,
                         std::span<const EncodedTrack> coefficients) {
  PlacedLayers placed{.stated = layers.stated};
  if (placed.stated.late_mask) {
    const std::span<const uint8_t> mask = heights.late.validity;
    const MaskPlace place = placeOfMask(coefficients, mask.size(), layers.mask_room);
    placed.stated.validity_after = place.after;
    placed.among.push_back({place.after, mask, place.worth});
    placed.shown_void =
        place.worth / static_cast<double>(heights.steps.liftedCount() - heights.steps.validCount());
  }
  if (!heights.table.empty()) {
    const uint64_t after =
        bytesBeforeTable(coefficients.front(), heights.table.size(), heights.without_table);
    placed.stated.table_after = after;
    placed.among.push_back({after, heights.table, heights.without_table});
  }
  std::stable_sort(placed.among.begin(), placed.among.end(),
                   [](const auto& a, const auto& b) { return a.after < b.after; });
  return placed;
}

}  // namespace

HeightLayers layersAround(const QuantisedHeights& heights, FlatChoice choice,
                          const PriorityMap* priorities) {
  HeightLayers layers{
      .stated = heights.layers,
      .wavelet = choice.wavelet,
      .priorities = priorities != nullptr ? headerOf(*priorities) : PriorityHeader(),
      .flat = std::move(choice.flat)};
  const WaveletHeader domain = headerOf(heights).wavelet;
  layers.wavelet.ring = domain.ring;
  layers.wavelet.forest = domain.forest;
  layers.stated.flat_bytes = layers.flat.codeword.size();
  layers.stated.flat_areas = static_cast<uint32_t>(layers.flat.areas.heights.size());
  if (heights.late.none()) return layers;
  layers.stated.bridge = 0;
  layers.stated.late_mask = true;
  layers.stated.lifted_bytes = heights.late.lifted.size();
  layers.stated.validity_bytes = heights.late.validity.size();
  return layers;
}

GeometryHeader headerOf(const QuantisedHeights& heights, const HeightLayers& layers, int planes) {
  GeometryHeader header = headerOf(heights);
  header.wavelet = layers.wavelet;
  header.priorities = layers.priorities;
  header.planes = static_cast<uint8_t>(planes);
  return header;
}

CodedHeights joinLayers(std::shared_ptr<const QuantisedHeights> quantised,
                        const HeightLayers& layers, std::vector<EncodedTrack> coefficients,
                        int region_log2) {
  assert(!coefficients.empty() && (region_log2 == 0) == (coefficients.size() == 1));
  const QuantisedHeights& heights = *quantised;
  const PlacedLayers placed = placeLayers(heights, layers, coefficients);
  GeometryHeader header = headerOf(heights, layers, coefficients.front().planes);
  header.regions.side_log2 = static_cast<uint8_t>(region_log2);
  EncodedTrack first = std::move(coefficients.front());
  for (auto layer = placed.among.rbegin(); layer != placed.among.rend(); ++layer)
    first = withLayer(std::move(first), *layer);
  coefficients.front() = behindOpening(heights, layers, first);
  CodedHeights coded{.quantised = quantised,
                     .header = std::move(header),
                     .layers = placed.stated,
                     .tracks = std::move(coefficients),
                     .left = heights.left,
                     .shown_void = placed.shown_void,
                     .flat = layers.flat};
  if (heights.corrections.empty()) return coded;
  return followedBy(std::move(coded), placed.stated, heights.corrections, 0);
}

}  // namespace tetrakis::inline heights

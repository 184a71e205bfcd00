// SPDX-License-Identifier: Apache-2.0
#include "encoder/heights/coded_heights.hpp"

#include <algorithm>
#include <cassert>
#include <utility>

#include "codec/geometry/drawn_heights/drawn_heights_encoder.hpp"
#include "codec/geometry/stored_heights_encoder.hpp"
#include "encoder/heights/followed_heights.hpp"
#include "encoder/heights/height_errors.hpp"
#include "ratecontrol/curves/hull.hpp"
#include "wavelet/priority_map_encoder.hpp"

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

/// Bytes of coefficients that are to come before a table of so many bytes: all those that take off
/// more error a byte than the table does, which leaves `error` while it is missing.
uint64_t bytesBeforeTable(const EncodedTrack& coefficients, size_t bytes, double error) {
  const double slope = error / static_cast<double>(bytes);
  const std::vector<RatePoint> hull = lowerHull(coefficients.points, 0);
  uint64_t before = 0;
  for (size_t i = 1; i < hull.size(); ++i) {
    const RatePoint &a = hull[i - 1], &b = hull[i];
    if (a.distortion - b.distortion < slope * static_cast<double>(b.bytes - a.bytes)) break;
    before = b.bytes;
  }
  return before;
}

/// What lies among coefficients.
struct AmongThem {
  uint64_t after;  ///< bytes of coefficients
  std::span<const uint8_t> codeword;
  double without;  ///< squared error, in steps, while it is missing
};

/// Coefficients with a layer among them, and in their account. What lies behind it comes before.
EncodedTrack withLayer(EncodedTrack coefficients, const AmongThem& layer) {
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

/// The account of such a track of coefficients behind the opening.
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

/// The coefficients, with what lies among them, behind the layers that open the track.
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

/// An account with a point for the mask and for each plane of bytes.
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

HeightLayers layersAround(const QuantisedHeights& heights, FlatChoice choice,
                          const PriorityMap* priorities) {
  HeightLayers layers{
      .stated = heights.layers,
      .wavelet = choice.wavelet,
      .priorities = priorities != nullptr ? headerOf(*priorities) : PriorityHeader(),
      .flat = std::move(choice.flat)};
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
  GeometryLayers described = layers.stated;
  std::vector<AmongThem> among;
  double shown_void = 0;
  if (described.late_mask) {
    const std::span<const uint8_t> mask = heights.late.validity;
    const MaskPlace place = placeOfMask(coefficients, mask.size(), layers.mask_room);
    described.validity_after = place.after;
    among.push_back({place.after, mask, place.worth});
    shown_void =
        place.worth / static_cast<double>(heights.steps.liftedCount() - heights.steps.validCount());
  }
  EncodedTrack first = std::move(coefficients.front());
  GeometryHeader header = headerOf(heights, layers, first.planes);
  header.regions.side_log2 = static_cast<uint8_t>(region_log2);
  if (!heights.table.empty()) {
    described.table_after = bytesBeforeTable(first, heights.table.size(), heights.without_table);
    among.push_back({described.table_after, heights.table, heights.without_table});
  }
  std::stable_sort(among.begin(), among.end(),
                   [](const auto& a, const auto& b) { return a.after < b.after; });
  for (auto layer = among.rbegin(); layer != among.rend(); ++layer)
    first = withLayer(std::move(first), *layer);
  coefficients.front() = behindOpening(heights, layers, first);
  const PartCodewords& corrections = heights.corrections;
  CodedHeights coded{.quantised = quantised,
                     .header = std::move(header),
                     .layers = described,
                     .tracks = std::move(coefficients),
                     .left = heights.left,
                     .shown_void = shown_void,
                     .flat = layers.flat};
  if (corrections.empty()) return coded;
  return followedBy(std::move(coded), std::move(described), corrections, 0);
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
  constexpr double kBeforeEnd = 4;  // of squared error: the mask comes 6 dB before the target
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

}  // namespace tetrakis::inline heights

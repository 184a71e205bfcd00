// SPDX-License-Identifier: Apache-2.0
#include "encoder/heights/coded_heights.hpp"

#include <algorithm>
#include <cassert>
#include <utility>

#include "codec/geometry/drawn_heights/drawn_heights_encoder.hpp"
#include "codec/geometry/stored_heights_encoder.hpp"
#include "encoder/heights/height_errors.hpp"
#include "ratecontrol/hull.hpp"
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

/// Puts the table to its place within the coefficients, and into their account.
void putTable(const QuantisedHeights& heights, GeometryLayers& layers, EncodedTrack& track) {
  const std::vector<uint8_t>& table = heights.table;
  if (table.empty()) return;
  layers.table_after = bytesBeforeTable(track, table.size(), heights.without_table);
  track.codeword.insert(track.codeword.begin() + static_cast<ptrdiff_t>(layers.table_after),
                        table.begin(), table.end());
  std::vector<RatePoint> points;
  for (const RatePoint& point : track.points) {
    const bool before = point.bytes <= layers.table_after;
    if (before) {
      points.push_back(
          {point.bytes, point.distortion + heights.without_table, point.dips, point.beyond});
    }
    if (point.bytes >= layers.table_after)
      points.push_back({point.bytes + table.size(), point.distortion, point.dips, point.beyond});
  }
  track.points = std::move(points);
}

/// Moves the account of the coefficients to behind the opening, and lets it end with the
/// corrections.
void joinAccount(const QuantisedHeights& heights, const HeightLayers& layers, EncodedTrack& track) {
  const uint64_t opening = layers.layers.openingBytes();
  for (RatePoint& point : track.points) {
    point.bytes += opening;
    point.distortion += heights.left;
  }
  if (opening > 0) {
    const auto voids = static_cast<double>(heights.steps.steps.size() - heights.steps.validCount());
    const double unknown =
        track.points.front().distortion + voids * heights.validityWorth() + squaresOf(layers.flat);
    track.points.insert(track.points.begin(), {0, unknown, false, track.points.front().beyond});
  }
  if (!layers.corrections.empty())
    track.points.push_back({track.codeword.size(), layers.corrected_to});
}

/// An account with a point for the mask and for each plane of bytes.
std::vector<RatePoint> accountOfStored(const CodedHeights& stored, uint32_t threads) {
  const std::span<const uint8_t> codeword = stored.tracks.front().codeword;
  const auto at = [&](uint64_t bytes) {
    return RatePoint{bytes, squaresOf(stored, {codeword.first(bytes)}, threads)};
  };
  const size_t sample_bytes = tks_sample_bytes(stored.of->samples->sample);
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
  return chooseWavelet({steps.steps, extentOf(*heights.samples), steps.valid}, steps.range_bits,
                       purpose);
}

std::vector<EncodedTrack> codeCoefficients(const QuantisedHeights& heights,
                                           const WaveletHeader& wavelet,
                                           const CoefficientOptions& options) {
  const HeightSteps& steps = heights.steps;
  return encodeCoefficients({steps.steps, extentOf(*heights.samples), steps.valid}, wavelet,
                            options);
}

HeightLayers layersAround(const QuantisedHeights& heights, FlatChoice choice,
                          const PriorityMap* priorities) {
  HeightLayers layers{
      .layers = heights.layers,
      .corrections = heights.corrections,
      .wavelet = choice.wavelet,
      .priorities = priorities != nullptr ? headerOf(*priorities) : PriorityHeader(),
      .flat = std::move(choice.flat)};
  layers.layers.flat_bytes = layers.flat.codeword.size();
  layers.layers.flat_areas = static_cast<uint32_t>(layers.flat.areas.heights.size());
  return layers;
}

GeometryHeader headerOf(const QuantisedHeights& heights, const HeightLayers& layers, int planes) {
  GeometryHeader header = headerOf(heights);
  header.wavelet = layers.wavelet;
  header.priorities = layers.priorities;
  header.planes = static_cast<uint8_t>(planes);
  return header;
}

CodedHeights joinLayers(std::shared_ptr<const QuantisedHeights> of, const HeightLayers& layers,
                        std::vector<EncodedTrack> coefficients, int region_log2) {
  assert(!coefficients.empty() && (region_log2 == 0) == (coefficients.size() == 1));
  const QuantisedHeights& heights = *of;
  const std::span<const uint8_t> corrections = layers.corrections;
  const std::vector<uint8_t>& flat = layers.flat.codeword;
  CodedHeights coded{.of = std::move(of),
                     .header = headerOf(heights, layers, coefficients.front().planes),
                     .layers = layers.layers,
                     .tracks = std::move(coefficients),
                     .closing = corrections.size(),
                     .left = heights.left,
                     .flat = layers.flat};
  coded.header.regions.side_log2 = static_cast<uint8_t>(region_log2);
  EncodedTrack& track = coded.tracks.front();
  std::vector<uint8_t>& codeword = track.codeword;
  if (!corrections.empty()) coded.layers.coefficient_bytes = codeword.size();
  putTable(heights, coded.layers, track);
  codeword.insert(codeword.begin(), flat.begin(), flat.end());
  codeword.insert(codeword.begin(), heights.validity.begin(), heights.validity.end());
  codeword.insert(codeword.end(), corrections.begin(), corrections.end());
  joinAccount(heights, layers, track);
  assert(track.points.back().bytes == codeword.size());
  return coded;
}

CodedHeights codeHeights(std::shared_ptr<const QuantisedHeights> of, const HeightTarget& target,
                         const CoefficientOptions& options) {
  const HeightSteps& steps = of->steps;
  FlatChoice choice =
      chooseFlatAreas({steps.steps, extentOf(*of->samples), steps.valid},
                      {steps.range_bits, target.purpose, target.bytes, target.mean_square,
                       options.threads, target.purpose == Purpose::kLossy});
  if (options.windows) choice.wavelet = withShortReach(choice.wavelet);
  HeightLayers layers = layersAround(*of, std::move(choice), options.priorities);
  std::vector<EncodedTrack> coefficients =
      codeCoefficients(*of, layers.wavelet, layers.flat.beside(options));
  std::vector<Account> accounts = accountsOf(coefficients);
  if (layers.wavelet.fraction_bits == 0) layers.wavelet.rounded_bytes = exactBytes(coefficients);
  CodedHeights coded =
      joinLayers(std::move(of), layers, std::move(coefficients), options.region_log2);
  coded.accounts = std::move(accounts);
  return target.tried ? coded : withRounding(std::move(coded));
}

CodedHeights withRounding(CodedHeights coded) {
  const std::vector<Account> accounts = std::exchange(coded.accounts, {});
  WaveletHeader& wavelet = coded.header.wavelet;
  const auto complete = [](const EncodedTrack& track) { return track.complete; };
  if (accounts.empty() || wavelet.fraction_bits > 0 ||
      !std::all_of(coded.tracks.begin(), coded.tracks.end(), complete))
    return coded;
  const QuantisedHeights& of = *coded.of;
  const PlaneView<const int32_t> plane(of.steps.steps, extentOf(*of.samples), of.steps.valid);
  wavelet.rounded_bytes =
      roundedBytes(accounts, roundedSquares(plane, coded.flat.areas.held(), wavelet));
  return coded;
}

std::optional<CodedHeights> drawHeights(std::shared_ptr<const QuantisedHeights> of) {
  const HeightSteps& steps = of->steps;
  std::optional<EncodedTrack> track =
      encodeDrawnHeights({steps.steps, extentOf(*of->samples), steps.valid});
  if (!track) return {};
  const HeightLayers layers = layersAround(*of, {}, nullptr);
  std::vector<EncodedTrack> tracks;
  tracks.push_back(*std::move(track));
  CodedHeights drawn = joinLayers(std::move(of), layers, std::move(tracks), 0);
  assert(drawn.header.direct());
  drawn.header.drawn = true;
  return drawn;
}

CodedHeights storeHeights(const CodedHeights& replaced, uint32_t threads) {
  CodedHeights stored{replaced.of, replaced.header,           replaced.layers, {},
                      0,           QuantisedHeights::kInexact};
  stored.header.wavelet = {};
  stored.header.regions = {};
  stored.header.priorities = {};
  stored.header.planes = GeometryHeader::kDirectPlanes;
  stored.header.drawn = false;
  stored.layers.corrections = CorrectionKind::kNone;
  stored.layers.coefficient_bytes = 0;
  stored.layers.table_bytes = stored.layers.table_values = 0;
  stored.layers.table_after = 0;
  stored.layers.table_knots.clear();
  stored.layers.flat_bytes = stored.layers.flat_areas = 0;
  const QuantisedHeights& heights = *stored.of;
  EncodedTrack& track = stored.tracks.emplace_back();
  track.codeword = heights.validity;
  const std::vector<uint8_t> samples = storeSamples(*heights.samples, heights.steps.valid);
  track.codeword.insert(track.codeword.end(), samples.begin(), samples.end());
  track.planes = GeometryHeader::kDirectPlanes;
  track.points = accountOfStored(stored, threads);
  return stored;
}

}  // namespace tetrakis::inline heights

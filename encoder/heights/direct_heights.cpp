// SPDX-License-Identifier: Apache-2.0
#include "encoder/heights/direct_heights.hpp"

#include <cassert>
#include <span>
#include <utility>
#include <vector>

#include "codec/geometry/drawn_heights/drawn_heights_encoder.hpp"
#include "codec/geometry/stored_heights_encoder.hpp"
#include "encoder/heights/height_errors.hpp"
#include "encoder/heights/joined_layers.hpp"

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

}  // namespace tetrakis::inline heights

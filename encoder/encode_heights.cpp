// SPDX-License-Identifier: Apache-2.0
// The track of the heights: validity, coefficients, corrections of the samples.
#include <algorithm>
#include <cmath>

#include "codec/geometry/corrections_encoder.hpp"
#include "codec/geometry/geometry_encoder.hpp"
#include "codec/geometry/stored_heights.hpp"
#include "encoder/encode_job.hpp"
#include "lattice/validity_encoder.hpp"

namespace tetrakis {

/// The layers that do not depend on the coefficients: validity, and corrections of the samples.
void EncodeJob::encodeSideLayers(bool restore_samples) {
  EncodedHeights& g = *geometry_;
  const bool infinite_integer = heights_->sample != TKS_F32 && !std::isfinite(heights_->nodata);
  g.layers.has_nodata =
      heights_->has_nodata != 0 && !std::isnan(heights_->nodata) && !infinite_integer;
  if (g.layers.has_nodata) g.layers.nodata = heights_->nodata + 0.0;  // -0 equals 0: one of them
  if (!g.steps.valid.empty()) {
    g.validity = encodeValidity({g.steps.valid, {heights_->width, heights_->height}});
    g.layers.validity_bytes = g.validity.size();
  }
  if (!restore_samples) return;
  g.layers.corrections = CorrectionKind::kSamples;
  const StreamHeader header = makeHeader(0, false);
  const std::vector<uint8_t> hints = sampleHints(g.steps.steps, *header.geometry);
  g.corrections = encodeCorrections(sampleCorrections(*heights_, g.steps),
                                    {hints, header.geometry->extent(), g.steps.valid});
  g.left = std::max(g.squaresOf(*heights_, g.steps), EncodedHeights::kSomething);
}

void EncodeJob::encodeGeometry(Purpose purpose) {
  geometry_->wavelet = waveletFor(purpose);
  joinLayers(encodeCoefficients());
}

WaveletHeader EncodeJob::waveletFor(Purpose purpose) const {
  const HeightSteps& steps = geometry_->steps;
  return chooseWavelet({steps.steps, {heights_->width, heights_->height}, steps.valid},
                       steps.range_bits, purpose);
}

std::vector<EncodedTrack> EncodeJob::encodeCoefficients() const {
  const HeightSteps& steps = geometry_->steps;
  return tetrakis::encodeGeometry({steps.steps, {heights_->width, heights_->height}, steps.valid},
                                  geometry_->wavelet, trackOptions(TrackId::kGeometry));
}

/// Validity before the coefficients of the first track, corrections of the samples behind them.
void EncodeJob::joinLayers(std::vector<EncodedTrack> coefficients) {
  EncodedHeights& g = *geometry_;
  g.tracks = std::move(coefficients);
  const bool complete =
      std::all_of(g.tracks.begin(), g.tracks.end(), [](const auto& t) { return t.complete; });
  g.regions.side_log2 = static_cast<uint8_t>(trackOptions(TrackId::kGeometry).region_log2);
  g.regions.whole_bytes = g.regions.side_log2 > 0 && complete ? bytesOf(g.tracks) : 0;
  if (g.validity.empty() && g.corrections.empty() && g.left == 0) return;
  EncodedTrack& track = g.tracks.front();
  g.layers.coefficient_bytes = g.corrections.empty() ? 0 : track.codeword.size();
  track.codeword.insert(track.codeword.begin(), g.validity.begin(), g.validity.end());
  track.codeword.insert(track.codeword.end(), g.corrections.begin(), g.corrections.end());
  for (RatePoint& point : track.points) {
    point.bytes += g.validity.size();
    point.distortion += g.left;
  }
  if (!g.validity.empty()) {
    const auto voids = static_cast<double>(g.steps.steps.size() - g.steps.validCount());
    const double unknown = track.points.front().distortion + voids * g.validityWorth();
    track.points.insert(track.points.begin(), {0, unknown});
  }
  if (!g.corrections.empty()) track.points.push_back({track.codeword.size(), 0});
}

/// In place of coefficients and corrections.
void EncodeJob::storeHeights() {
  EncodedHeights& g = *geometry_;
  g.wavelet = {};
  g.corrections.clear();
  g.layers.corrections = CorrectionKind::kNone;
  g.layers.coefficient_bytes = 0;
  g.regions = {};
  g.left = EncodedHeights::kSomething;
  EncodedTrack track;
  track.codeword = g.validity;
  const std::vector<uint8_t> samples = storeSamples(*heights_, g.steps.valid);
  track.codeword.insert(track.codeword.end(), samples.begin(), samples.end());
  track.planes = GeometryHeader::kStoredPlanes;
  g.tracks = {std::move(track)};
  accountForStored();
}

/// An account with a point for the mask and for each plane of bytes.
void EncodeJob::accountForStored() {
  EncodedTrack& track = geometry_->tracks.front();
  const size_t sample_bytes = tks_sample_bytes(heights_->sample);
  const uint64_t opening = geometry_->validity.size();
  const uint64_t plane = (track.codeword.size() - opening) / sample_bytes;
  track.points.push_back({0, geometrySquares(0)});
  for (uint64_t planes = 0; planes <= sample_bytes; ++planes) {
    const uint64_t end = opening + planes * plane;
    const RatePoint point{end, geometrySquares(end)}, &last = track.points.back();
    if (end > last.bytes && point.distortion < last.distortion) track.points.push_back(point);
  }
}

}  // namespace tetrakis

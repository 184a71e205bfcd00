// SPDX-License-Identifier: Apache-2.0
// The track of the heights: validity, coefficients, corrections of the samples.
#include <algorithm>
#include <cmath>

#include "api/encode_job.hpp"
#include "codec/corrections_encoder.hpp"
#include "codec/geometry_encoder.hpp"
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
    g.validity = encodeValidity(g.steps.valid, heights_->width, heights_->height);
    g.layers.validity_bytes = g.validity.size();
  }
  if (!restore_samples) return;
  g.layers.corrections = CorrectionKind::kSamples;
  const StreamHeader header = makeHeader(0, false);
  const std::vector<uint8_t> hints = sampleHints(g.steps.steps, *header.geometry);
  g.corrections = encodeCorrections(sampleCorrections(*heights_, g.steps),
                                    {heights_->width, heights_->height, g.steps.valid, hints});
  g.left = std::max(errorsOf(*heights_, g.steps).squares / (g.steps.step * g.steps.step),
                    EncodedHeights::kSomething);
}

void EncodeJob::encodeGeometry(Purpose purpose) {
  const HeightSteps& steps = geometry_->steps;
  geometry_->wavelet = chooseWavelet(steps.steps, steps.valid, heights_->width, heights_->height,
                                     steps.range_bits, purpose);
  joinLayers(encodeCoefficients());
}

std::vector<EncodedTrack> EncodeJob::encodeCoefficients() const {
  return tetrakis::encodeGeometry(geometry_->steps.steps, heights_->width, heights_->height,
                                  geometry_->wavelet, trackOptions(TrackId::kGeometry),
                                  geometry_->steps.valid);
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

}  // namespace tetrakis

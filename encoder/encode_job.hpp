// SPDX-License-Identifier: Apache-2.0
// One encoding: inputs, tracks, joint order of the packets, and the stream cut to its target.
#pragma once

#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "bitstream/stream/packet.hpp"
#include "bitstream/track/track_encoder.hpp"
#include "codec/geometry/height_layers.hpp"
#include "codec/geometry/height_steps.hpp"
#include "ratecontrol/allocation.hpp"
#include "ratecontrol/audit.hpp"
#include "texture_wavelet/mask/cutout.hpp"
#include "texture_wavelet/texture_choice.hpp"
#include "texture_wavelet/texture_decoder.hpp"
#include "wavelet/filter_choice.hpp"

namespace tetrakis {

/// The heights in steps, and their tracks. The first holds the validity codeword, coefficients,
/// corrections; others coefficients alone.
struct EncodedHeights {
  HeightSteps steps;
  WaveletHeader wavelet;
  GeometryLayers layers;
  std::vector<uint8_t> validity;     ///< codeword; empty: all samples are valid
  std::vector<uint8_t> corrections;  ///< codeword
  /// Squared error that exact steps leave in the samples, in steps, until corrections of the
  /// samples are complete.
  double left = 0;
  static constexpr double kSomething = 1e-200;  ///< -0 for 0 is no distance, but not exact
  std::vector<EncodedTrack> tracks;
  RegionHeader regions;

  bool stored() const {
    return !tracks.empty() && tracks.front().planes == GeometryHeader::kStoredPlanes;
  }
  /// The complete tracks restore every sample.
  bool restoresSamples() const {
    return stored() || steps.exact || layers.corrections == CorrectionKind::kSamples;
  }

  /// What a sample costs whose validity is not yet known rightly, in squared steps: as much as a
  /// height that is off by a quarter of their range.
  double validityWorth() const { return std::exp2(2.0 * steps.range_bits - 4); }

  /// Squared error, in steps, that a sample counts at most while packets are ordered: four times
  /// the range. An exception of the steps may be off by 1e38, beside which nothing else
  /// would count.
  double mostOfASample() const { return std::exp2(2.0 * steps.range_bits + 4); }

  /// Squared error of such steps, in steps.
  double squaresOf(const tks_heights& truth, const HeightSteps& of) const {
    const double unit = steps.step * steps.step;
    return errorsOf(truth, of, mostOfASample() * unit).squares / unit;
  }
};

/// Decoded samples against the input's, over the valid ones; in sample units.
struct HeightErrors {
  double mean_square = 0, largest = 0, range = 0;
};

Codewords codewordsOf(const std::vector<EncodedTrack>& tracks);

/// RMSE in steps, or texel units, below which the last bit is worth a try.
inline constexpr double kNearlyExact = 0.6;

/// That meets a PSNR.
inline double worstMeanSquare(double peak, double psnr) {
  return peak * peak / std::pow(10, psnr / 10);
}

/// done: from 0 to 1. TKS_USAGE if the caller wants no more.
Status reportProgress(const tks_encode_options& options, double done);

class EncodeJob {
 public:
  /// The arguments have passed checkArguments() and outlive the job.
  EncodeJob(const tks_heights* heights, const tks_image* image, const tks_encode_options& options);

  /// The finished stream, or why there is none.
  Result<std::vector<uint8_t>> run();

 private:
  /// How much of each component the target wants, in payload bytes of its packets in their order.
  using Needs = std::array<uint64_t, kComponents>;

  Status quantise();
  Status encodeTracks();
  bool nearlyExact() const;
  void reachTarget();
  void encodeLosslessIfItFits();
  Status report(double done) const;

  // encode_heights.cpp: the tracks of the heights.
  void encodeSideLayers(bool restore_samples);
  void encodeGeometry(Purpose purpose);
  WaveletHeader waveletFor(Purpose purpose) const;
  std::vector<EncodedTrack> codedCoefficients() const;
  void joinLayers(std::vector<EncodedTrack> coefficients);
  void storeHeights();
  void accountForStored();
  Purpose geometryPurpose() const;
  Purpose texturePurpose() const;
  TextureOptions trackOptions(Component component) const;
  bool budgeted() const { return options_.bytes != 0; }

  // encode_order.cpp: the joint order of the packets.
  void order();
  ComponentCurve geometryCurve() const;
  ComponentCurve textureCurve() const;
  double texelsPerMetre(double step) const;
  double meshFloor() const;
  const std::vector<EncodedTrack>& tracksOf(Component component) const;
  Codewords cutAt(Component component, uint64_t bytes) const;
  double samplesOf(Component component) const;
  AuditScope auditScope(uint64_t samples) const;
  // memory: of calls for fewer bytes of a component with one track.
  DecodedHeights decodedHeights(uint64_t bytes, HeightsMemory* memory = nullptr) const;
  Texels decodedTexels(uint64_t bytes, TextureMemory* memory = nullptr) const;
  double geometrySquares(uint64_t bytes, HeightsMemory* memory = nullptr) const;
  double textureSquares(uint64_t bytes, TextureMemory* memory = nullptr) const;

  // encode_bound.cpp: heights within a largest error.
  void boundHeights();
  bool widenSteps(double bound);
  void roundHeights(int32_t largest);
  void encodeRounded();
  double floatSpacing() const;
  bool boundWithin(int32_t largest, double bound);
  void correctHeights(int32_t largest, std::optional<double> mean_square);
  bool withinBound() const;

  // encode_target.cpp: how much of each track a quality target needs.
  Result<Needs> needs() const;
  Result<uint64_t> geometryNeed() const;
  HeightErrors heightErrors(uint64_t bytes) const;
  uint64_t textureNeed(const Needs& so_far) const;
  bool geometryMeetsTarget(uint64_t bytes) const;
  bool textureMeetsTarget(uint64_t bytes) const;
  void preferLossless(Needs& needs);
  void preferStored(Needs& needs);
  void keepNeeded(const Needs& needs);
  uint8_t qualityAfter(Component component, uint64_t bytes) const;

  // encode_stream.cpp: the finished stream.
  StreamHeader makeHeader(uint64_t payload_bytes, bool lossless) const;
  Result<std::vector<uint8_t>> assemble() const;
  void keepWithinBudget();
  uint64_t totalPayload() const;
  bool restoresEverything() const;
  bool isLossless() const;

  const tks_heights* heights_;
  const tks_image* image_;
  const tks_encode_options& options_;
  std::optional<EncodedHeights> geometry_;
  std::optional<TextureSource> source_;
  std::optional<EncodedTexture> texture_;
  std::vector<Packet> packets_;
};

}  // namespace tetrakis

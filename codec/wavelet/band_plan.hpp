// SPDX-License-Identifier: Apache-2.0
// PlaneLayout takes the pyramid of a plane and returns the bands of its tracks, each with the
// weight of its errors (SynthesisNorms), by which bit-planes of all bands are put in one order.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "bitstream/track/track.hpp"
#include "codec/wavelet/priority_map.hpp"
#include "codec/wavelet/pyramid.hpp"
#include "codec/wavelet/wavelet.hpp"

namespace tetrakis::inline wavelet {

// SynthesisNorms gives the weight of an error in a wavelet coefficient of each band: the L2 norm of
// the synthesis function of the band.

/// The norms of a transform. It is separable, so a band's norm is the product of two norms of the
/// one-dimensional synthesis, over the factor of two for each doubling of the low band. Integer
/// only: the order of the bit-planes depends on them.
class SynthesisNorms {
 public:
  /// levels: the most splits that will be asked for. The work doubles with each.
  SynthesisNorms(const WaveletSpec& spec, int levels);

  /// 16 log2 of the band's norm, rounded.
  int log16(const Subband& band) const { return (fine(band) + 8) >> 4; }

  /// The band's squared norm, for rate-distortion weights.
  double energy(const Subband& band) const;

 private:
  static constexpr int kFineSteps = 256;
  using Table = std::array<int, kMaxLevels + 1>;

  int fine(const Subband& band) const;

  WaveletSpec spec_;
  Table low_{}, high_{};  ///< kFineSteps log2 of the norm after so many splits
};

// PlaneLayout turns the subbands of a transformed plane into the bands of a track. Encoders gather
// coefficients by it; decoders put them back with codec/wavelet/synthesis/view_synthesis.hpp.

/// The classes of contexts that the bands of one plane use: levels 1, 2, 3, all coarser levels, LL.
inline constexpr uint32_t kPlaneModels = 5;

/// A rectangle of a subband's coefficients: what one track holds of it.
struct BandPart {
  size_t subband = 0;  ///< index in Pyramid::subbands()
  uint32_t column = 0, row = 0, columns = 0, rows = 0;

  BandShape shape() const { return {rows, columns}; }
};

/// What a region holds of each of the subbands, in coding order.
std::vector<BandPart> partsOf(std::span<const Subband> subbands, const Region& region);

/// The subbands of planes that share one size, one transform and the samples that exist and are
/// held.
class PlaneLayout {
 public:
  /// norms: those of an earlier layout of the same transform and size.
  PlaneLayout(const WaveletSpec& spec, Pyramid pyramid, const PriorityMap& priorities = {},
              const std::optional<SynthesisNorms>& norms = {});

  const Pyramid& pyramid() const { return pyramid_; }
  const std::vector<Subband>& subbands() const { return pyramid_.subbands(); }
  const SynthesisNorms& norms() const { return norms_; }
  /// The squared error of the plane for a unit squared error of one of the subband's coefficients.
  double energy(size_t subband) const { return norms_.energy(subbands()[subband]); }

  std::vector<BandPart> parts(const Region& region) const { return partsOf(subbands(), region); }

  /// Returns one entry for each part of a region, without its absent coefficients. The indices of
  /// parents and siblings count from `first`, the place that the first entry will have in the plan
  /// of the track. priority: added to every log_norm. Of whole numbers it is the floor of the keys
  /// of all but the finest details: at the end, where the inverse rounds, nothing else is missing;
  /// one coarse coefficient that is off by 1 changes the rounding of hundreds of samples. models:
  /// the class of contexts of the first band.
  std::vector<BandPlan> plan(std::span<const BandPart> parts, int first = 0, int priority = 0,
                             uint32_t models = 0) const;

  /// Returns the plan of the parts with the coefficients of samples that do not exist, or are held,
  /// marked as absent, and with the others in tiers by priority.
  std::vector<BandPlan> marked(std::span<const BandPart> parts, std::vector<BandPlan> plan) const;

  /// Returns the coefficients of a part of a transformed plane, in the cell layout of its shape.
  std::vector<int32_t> gather(std::span<const int32_t> plane, const BandPart& part) const;

 private:
  void markAbsent(std::span<const BandPart> parts, std::span<BandPlan> bands) const;
  /// Absent coefficients are of no tier.
  void markTiers(std::span<const BandPart> parts, std::span<BandPlan> bands) const;

  bool whole_;
  Pyramid pyramid_;
  SynthesisNorms norms_;
  std::optional<CoefficientPriorities> priorities_;
};

/// Sets absent coefficients to 0: what lifting leaves where samples are held is no coefficient.
/// values: as gathered for the band.
void clearAbsent(const BandPlan& band, std::span<int32_t> values);

}  // namespace tetrakis::inline wavelet

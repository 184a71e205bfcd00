// SPDX-License-Identifier: Apache-2.0
// How a transformed plane becomes the bands of a track, and back.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bitstream/track/regions.hpp"
#include "bitstream/track/track.hpp"
#include "wavelet/norms.hpp"
#include "wavelet/subbands.hpp"

namespace tetrakis {

/// Classes of contexts that the bands of one plane use: levels 1, 2, 3, all coarser ones, and LL.
inline constexpr uint32_t kPlaneModels = 5;

/// A rectangle of a subband's coefficients: what one track holds of it.
struct BandPart {
  size_t subband = 0;  ///< index in PlaneLayout::subbands()
  uint32_t column = 0, row = 0, columns = 0, rows = 0;

  BandShape shape() const { return {rows, columns}; }
};

/// What a region holds of each of the subbands, in coding order.
std::vector<BandPart> partsOf(std::span<const Subband> subbands, const Region& region);

/// The subbands of planes of one size under one transform.
class PlaneLayout {
 public:
  PlaneLayout(const WaveletSpec& spec, uint32_t width, uint32_t height);

  std::vector<BandPart> parts(const Region& region) const { return partsOf(subbands_, region); }

  /// One entry for each part of a region. The indices of parents and siblings count from `first`,
  /// the place that the first entry will have in the plan of the track.
  /// priority: added to every log_norm; models: class of contexts of the first band.
  std::vector<BandPlan> plan(std::span<const BandPart> parts, int first, int priority,
                             uint32_t models) const;

  const std::vector<Subband>& subbands() const { return subbands_; }
  size_t size() const { return subbands_.size(); }
  /// Squared error of the plane for a unit squared error of one of the subband's coefficients.
  double energy(size_t subband) const { return norms_.energy(subbands_[subband]); }

 private:
  std::vector<Subband> subbands_;
  SynthesisNorms norms_;
};

/// Marks the coefficients of void samples as absent. bands: those of the parts. valid: width *
/// height of the plane; empty: there are no voids.
void markAbsent(const PlaneLayout& layout, std::span<const BandPart> parts, Validity valid,
                uint32_t width, std::span<BandPlan> bands);

/// The part's coefficients in the cell layout of its shape.
std::vector<int32_t> gather(std::span<const int32_t> plane, uint32_t width, const Subband& subband,
                            const BandPart& part);

/// Puts what is known of the part's coefficients into the plane, with `fraction_bits` binary
/// places more than they were coded with.
void scatter(const Band& band, int fraction_bits, const Subband& subband, const BandPart& part,
             std::span<int32_t> plane, uint32_t width);

}  // namespace tetrakis

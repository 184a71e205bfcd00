// SPDX-License-Identifier: Apache-2.0
// TriedPlane estimates the cost of the coefficients of a plane where areas of it are held, from
// typical parts that stand for the plane.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <vector>

#include "base/plane.hpp"
#include "codec/geometry/flat/flat_areas.hpp"
#include "codec/geometry/flat/flat_encoder.hpp"
#include "codec/wavelet/band_plan.hpp"
#include "codec/wavelet/choice/plane_cost.hpp"
#include "codec/wavelet/wavelet.hpp"

namespace tetrakis::inline coding_choice {

/// A part, copied from the plane.
struct CopiedPart {
  SampledPart place;
  std::vector<int32_t> heights;
  std::vector<uint8_t> lifted, valid;

  /// plane: with the samples that are lifted.
  CopiedPart(const PlaneView<const int32_t>& plane, Mask valid_samples, const SampledPart& sampled);
  Extent extent() const { return place.window.extent(); }
};

/// A part, transformed. It keeps its costs once they are computed.
class TriedPart {
 public:
  /// The part outlives this object.
  TriedPart(const CopiedPart& part, FlatAreas flat, const WaveletHeader& wavelet);
  TriedPart(const TriedPart&) = delete;  // the layout refers to it
  TriedPart& operator=(const TriedPart&) = delete;

  PlaneCost cost(double step);
  bool holds(const FlatAreas& flat) const { return flat_.numbers == flat.numbers; }
  size_t bytesOfAreas() const { return bytes_of_areas_; }

 private:
  FlatAreas flat_;
  std::vector<int32_t> values_, area_heights_;
  PlaneLayout layout_;
  size_t bytes_of_areas_ = 0;
  std::map<double, PlaneCost> costs_;  ///< by the step
};

/// The costs of a part with one wavelet and the areas of several shapes, which are often alike in
/// the part.
class PartTrials {
 public:
  /// The part outlives this object.
  explicit PartTrials(const CopiedPart& part) : part_(&part) {}

  TriedPart& tried(FlatAreas flat, const WaveletHeader& wavelet);
  double standsFor() const { return part_->place.stands_for; }

 private:
  /// How many shapes are kept: the first, which often has no areas, and the last one. More would
  /// take memory.
  static constexpr size_t kKept = 2;

  const CopiedPart* part_;
  std::vector<std::unique_ptr<TriedPart>> tried_;
};

/// The parts that stand for a plane, and the estimated cost of the plane.
class TriedPlane {
 public:
  /// trials: of the wavelet; they outlive this. areas: of each part. threads: nothing depends on
  /// them.
  TriedPlane(std::vector<PartTrials>& trials, std::vector<FlatAreas> areas,
             const WaveletHeader& wavelet, uint32_t threads);

  PlaneCost cost(double step) const;
  double bitsOfAreas() const;
  /// The least power of two at which the coefficients cost at most `bits` bits.
  double step(double bits) const;

 private:
  struct Part {
    TriedPart* tried = nullptr;
    double stands_for = 0;
  };
  std::vector<Part> parts_;
  uint32_t threads_;
};

}  // namespace tetrakis::inline coding_choice

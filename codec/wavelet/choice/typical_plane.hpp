// SPDX-License-Identifier: Apache-2.0
// TypicalPlane estimates the cost of coding a plane from typical parts of it, under the filters
// that suit the plane. Encoder only.
#pragma once

#include <cstdint>
#include <deque>
#include <vector>

#include "base/plane.hpp"
#include "codec/wavelet/band_plan.hpp"
#include "codec/wavelet/choice/filter_choice.hpp"
#include "codec/wavelet/choice/plane_cost.hpp"
#include "codec/wavelet/choice/typical_parts.hpp"
#include "codec/wavelet/wavelet_header.hpp"

namespace tetrakis::inline choice {

class TypicalPlane {
 public:
  /// Looks at a plane whose samples have `bits` bits. It need not outlive the call.
  TypicalPlane(const PlaneView<const int32_t>& plane, int bits, Purpose purpose)
      : TypicalPlane(plane, bits, purpose, plane.valid) {}
  /// Looks where samples are shown, and at their errors alone, if those that are coded are more.
  TypicalPlane(const PlaneView<const int32_t>& plane, int bits, Purpose purpose, Mask shown);

  /// About what the coefficients of the whole plane cost that is coded with a step; 0: to the last
  /// bit.
  PlaneCost cost(double step) const;
  /// The least power of two at which the coefficients cost at most so many bits.
  double step(double bits) const;

  /// A part of the plane beside what coefficients make of it.
  struct Shown {
    const PlanePart& samples;
    std::vector<int32_t> values;  ///< in units of 2^-fraction_bits
    int fraction_bits;
  };
  /// Each part as it is decoded from coefficients with a step > 0. They refer to this.
  std::vector<Shown> shown(double step) const;
  /// For how many samples of the plane a sample of the parts stands.
  double standsFor() const { return whole_; }

 private:
  struct Part {
    PlanePart samples;
    PlaneLayout layout;  ///< refers to the samples
    std::vector<int32_t> coefficients;
    double share;  ///< of the coded samples, those that are shown
    WaveletHeader wavelet;

    Part(PlanePart part, const WaveletHeader& header, size_t shown);
    Part(const Part&) = delete;
  };

  std::deque<Part> parts_;
  double unit_;   ///< units of coefficients in one of the plane
  double whole_;  ///< shown samples of the plane for each of the parts'
};

/// The cost of a plane coded with one step.
PlaneCost typicalCost(const PlaneView<const int32_t>& plane, int bits, double step);

}  // namespace tetrakis::inline choice

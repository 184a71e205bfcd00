// SPDX-License-Identifier: Apache-2.0
// typicalParts() chooses the parts of a plane that stand for all of it, and TypicalPlane estimates
// the cost of the plane from them, because trying a choice on a whole plane would take too long.
// Encoder only.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <span>
#include <vector>

#include "base/plane.hpp"
#include "base/view.hpp"
#include "codec/wavelet/band_plan.hpp"
#include "codec/wavelet/choice/filter_choice.hpp"
#include "codec/wavelet/choice/plane_cost.hpp"
#include "codec/wavelet/pyramid.hpp"
#include "codec/wavelet/wavelet.hpp"

namespace tetrakis::inline choice {

// typicalParts() chooses the parts of a plane by which encoders judge a choice before they code the
// whole plane.

/// Samples along a side of a part. Larger parts judge choices better, and take time.
inline constexpr uint32_t kUsualSide = 96;

/// Whether a sample, by its place in the plane, has to be coded; empty: all have to.
using IsCoded = std::function<bool(size_t)>;

/// Returns the parts that stand for a plane where trying all of it would take too long: the whole
/// plane if neither side is above 256. Otherwise there is a part of each field of a grid of 3 by 3,
/// with at most `side` samples along each side, because a single part may be water, or a lawn. It
/// lies in the middle, or where more than twice as many samples are coded: parts of voids say
/// nothing. There is at least one part. patch_rows: as of PlaneView; no part reaches into two
/// patches.
std::vector<Window> typicalParts(Extent plane, uint32_t side = kUsualSide,
                                 const IsCoded& is_coded = {}, uint32_t patch_rows = 0);

/// What a part of a plane holds.
struct PlanePart {
  Extent extent;
  std::vector<int32_t> values;
  std::vector<uint8_t> valid;  ///< empty: all
  std::vector<uint16_t> held;  ///< empty: none
  /// Those of what is held (HeldSamples::values): of all areas of the plane.
  std::span<const int32_t> area_values;
};

/// The typical parts of planes that have one size and one mask: of each part every plane's.
std::vector<PlanePart> typicalPartsOf(std::span<const PlaneView<const int32_t>> planes,
                                      const HeldSamples& held = {}, uint32_t side = kUsualSide);

/// What a window of a plane holds.
PlanePart partOf(const PlaneView<const int32_t>& plane, const HeldSamples& held,
                 const Window& window);

/// How many of a plane's samples the mask marks.
size_t markedIn(Extent plane, const Mask& mask);

// TypicalPlane estimates the cost of coding a plane from typical parts of it, under the filters
// that suit the plane.

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

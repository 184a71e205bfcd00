// SPDX-License-Identifier: Apache-2.0
// typicalParts() chooses the parts of a plane by which encoders judge a choice before they code the
// whole plane.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "base/plane.hpp"
#include "base/view.hpp"
#include "codec/wavelet/held_samples.hpp"

namespace tetrakis::inline choice {

/// Samples along a side of a part. Larger parts judge choices better, and take time.
inline constexpr uint32_t kUsualSide = 96;

/// Whether a sample, by its place in the plane, has to be coded; empty: all have to.
using IsCoded = std::function<bool(size_t)>;

/// Returns the parts that stand for a plane where trying all of it would take too long: the whole
/// plane if neither side is above 256. Otherwise there is a part of each field of a grid of 3 by 3,
/// with at most `side` samples along each side, because a single part may be water, or a lawn. It
/// lies in the middle, or where more than twice as many samples are coded: parts of voids say
/// nothing. There is at least one part.
std::vector<Window> typicalParts(Extent plane, uint32_t side = kUsualSide,
                                 const IsCoded& is_coded = {});

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

}  // namespace tetrakis::inline choice

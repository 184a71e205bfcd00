// SPDX-License-Identifier: Apache-2.0
// Layout says where sea, plain and mountains lie on the sample terrain, before any water has run.
#pragma once

#include <cstdint>

#include "apps/tools/synth/noise.hpp"

namespace tetrakis::tools::synth {

/// Positions are shares of the terrain's extent: (0, 0) its north-western, (1, 1) its south-eastern
/// corner; points beyond are allowed.
class Layout {
 public:
  explicit Layout(uint64_t seed);

  /// 0 at the sea's end of the terrain, 1 at the mountains', about kCoast at the shore.
  double inland(Point p) const;
  bool isSea(Point p) const;  ///< inland(p) < kCoast, mostly from fewer octaves

  /// Uplift in 0 to about 1: mountains ridged and warped, hills in places, almost nothing on the
  /// plain.
  double uplift(Point p) const;

  /// Middle of the lake, at the foot of the mountains.
  Point lake() const;
  uint64_t seed() const { return seed_; }

 private:
  double belt(Point p) const;  ///< inland() without its noise

  static constexpr double kCoast = 0.2, kFoot = 0.4, kRange = 0.72;

  uint64_t seed_;
  Point inland_direction_;  // unit length, towards the mountains, in the northern half
};

}  // namespace tetrakis::tools::synth

// SPDX-License-Identifier: Apache-2.0
// Rivers draws the rivers of the sample terrain as smooth bands of natural width.
#pragma once

#include <functional>
#include <vector>

#include "apps/tools/synth/relief.hpp"

namespace tetrakis::tools::synth {

/// Farther than this from any bank, distances are cut off. Metres.
inline constexpr double kRiverReach = 120;

/// Rows [first, end) of texels, two a sample, over the terrain without its margin.
struct RiverStrip {
  uint32_t first, end, texels;  ///< texels in a row
  uint32_t top;                 ///< the row before the first, if there is one
  std::vector<double> metres;   ///< from there to the row behind the last

  /// Metres from the middle of a texel to the nearest bank, negative in the water, at most
  /// kRiverReach.
  double distance(uint32_t x, uint32_t y) const { return metres[size_t{y - top} * texels + x]; }
};

class Rivers {
 public:
  Rivers(const Relief& relief, uint32_t texels);

  /// Calls work(strip) for strips that make up all rows, on all processors.
  void forStrips(const std::function<void(const RiverStrip&)>& work) const;

 private:
  /// In texels; the bank lies half_width (metres) beside it.
  struct Segment {
    Point a, b;
    double half_width;
    double reach() const;
  };

  static constexpr uint32_t kStrip = 64;  // rows

  void add(const Segment& segment);
  RiverStrip strip(uint32_t index) const;

  uint32_t texels_;
  std::vector<Segment> segments_;
  std::vector<std::vector<uint32_t>> strips_;  // segments within reach of each
};

}  // namespace tetrakis::tools::synth

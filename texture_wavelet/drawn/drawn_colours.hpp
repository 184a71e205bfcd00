// SPDX-License-Identifier: Apache-2.0
// A drawn texture has a list of colours, in the order in which they first appear. Encoder and
// decoder both build it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace tetrakis::inline drawn {

using DrawnColour = std::array<uint16_t, 4>;  ///< one value for each channel, the others 0

/// Index of a colour; the vertices that nothing is known of have kNoColour.
using ColourIndex = uint16_t;

inline constexpr int kColourIndexBits = 12;
inline constexpr size_t kMostColours = size_t{1} << kColourIndexBits;
inline constexpr ColourIndex kNoColour = 0xffff;

/// Of an overlay: the first colour of its list, grey, which is not shown.
inline constexpr ColourIndex kSeeThrough = 0;

class DrawnColours {
 public:
  size_t size() const { return colours_.size(); }
  bool full() const { return colours_.size() == kMostColours; }
  const DrawnColour& operator[](ColourIndex i) const { return colours_[i]; }

  ColourIndex add(const DrawnColour& colour) {
    colours_.push_back(colour);
    return static_cast<ColourIndex>(colours_.size() - 1);
  }

 private:
  std::vector<DrawnColour> colours_;
};

}  // namespace tetrakis::inline drawn

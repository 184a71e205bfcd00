// SPDX-License-Identifier: Apache-2.0
// DrawnColours is the list of colours of a drawn texture, and codes each new colour.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/texels.hpp"
#include "codec/drawing/drawing_index.hpp"
#include "codec/drawing/drawing_neighbours.hpp"
#include "codec/drawing/drawing_residual.hpp"

namespace tetrakis::inline drawn {

using DrawnColour = std::array<uint16_t, 4>;  ///< one value for each channel, the others 0

/// The first colour in the list of an overlay, grey, which is not shown.
inline constexpr DrawnIndex kSeeThrough = 0;

class DrawnColours {
 public:
  DrawnColours() = default;
  /// format: channels, bits.
  explicit DrawnColours(const Texels& format) : channels_(format.channels), bits_(format.bits) {}

  size_t size() const { return colours_.size(); }
  const DrawnColour& operator[](DrawnIndex i) const { return colours_[i]; }

  /// 0 for one colour, 1 for two.
  uint32_t difference(DrawnIndex a, DrawnIndex b) const { return a != b; }
  void add(const DrawnColour& colour) { colours_.push_back(colour); }

  /// Codes the colour of a texel that the list lacks. Each channel as the difference to the mean of
  /// the first two candidates, plus the difference that the channel before had.
  template <class Io>
  void code(const Candidates& around, size_t texel, Io& io) {
    const int half = 1 << (bits_ - 1), most = 2 * half - 1;
    const DrawnColour& ours = io.value(texel);
    DrawnColour colour{};
    int carried = 0;
    for (uint32_t c = 0; c < channels_; ++c) {
      int mean = half;
      if (around.count() > 0) {
        const VotedIndex &a = around[0], &b = around[std::min(around.count() - 1, 1)];
        mean = (colours_[a.index][c] + colours_[b.index][c]) / 2;
      }
      const int expected = std::clamp(mean + carried, 0, most);
      const int residual = codeResidual(residuals_[c], ours[c] - expected, io);
      const int value = std::clamp(expected + residual, 0, most);
      if (io.stopped()) return;
      colour[c] = static_cast<uint16_t>(value);
      carried = value - mean;
    }
    colours_.push_back(colour);
  }

 private:
  static constexpr size_t kClasses = 17;  ///< of a residual: bits of its magnitude

  uint32_t channels_ = 1;
  int bits_ = 8;
  std::vector<DrawnColour> colours_;
  std::array<ResidualModels<kClasses>, 4> residuals_;
};

}  // namespace tetrakis::inline drawn

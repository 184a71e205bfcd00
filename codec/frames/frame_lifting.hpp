// SPDX-License-Identifier: Apache-2.0
// forwardFrames() lifts the frames of a group over time, sample by sample, before the wavelet in
// space turns each of the resulting planes into coefficients. inverseFrames() takes them back,
// exactly if all values are known. FrameNorms says what an error in a plane is worth, by which the
// bit-planes of all planes are put in one order, so that a group is one embedded codeword.
//
// Level 1 splits the frames, level l + 1 what level l leaves at multiples of 2^l, until one plane
// is left: plane 0, the mean of the group, about. Plane t stays at its place. Any number of frames
// goes: 5/3 is mirrored at both ends, and a Haar pair without its second frame is not changed.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bitstream/stream/coding_headers.hpp"

namespace tetrakis::inline frames {

/// Planes of the frames of a group, one for each, of as many values.
using FrameViews = std::vector<std::span<int32_t>>;

/// Lifts frames over time, in place. Where frames have scales, each is foretold in the steps of the
/// component and then rounded to its own. Haar makes differences one bit wider than samples. 5/3
/// makes them two bits wider, and the mean wider by a factor of 1.5 a level at most.
/// fraction_bits: of the values.
void forwardFrames(const FramesHeader& header, int fraction_bits, const FrameViews& frames);

/// Undoes it, in place. Defined for all values: differences wrap, sums have 64 bits.
void inverseFrames(const FramesHeader& header, int fraction_bits, const FrameViews& frames);

/// The norms of what one unit of a plane makes of the frames, in steps of the component.
class FrameNorms {
 public:
  explicit FrameNorms(const FramesHeader& header);

  /// 16 log2 of the norm, rounded.
  int log16(uint32_t plane) const { return (fine_[plane] + 8) >> 4; }
  /// The squared norm.
  double energy(uint32_t plane) const;

 private:
  static constexpr int kFineSteps = 256;
  std::vector<int> fine_;  ///< of each plane: kFineSteps log2 of its norm
};

/// The plane of the next coarser level in whose time a plane lies; the plane itself if there is
/// none. Its coefficients tell of the magnitudes of those of the plane.
uint32_t coarserFrame(uint32_t plane, uint32_t frames);

}  // namespace tetrakis::inline frames

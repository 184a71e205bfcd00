// SPDX-License-Identifier: Apache-2.0
// encodeFramePlanes() lifts the planes of the frames of a group over time, transforms and codes
// them. chooseTimeCoding() and chooseFrameWavelet() choose the filters over time and in space
// before. Encoder only.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "base/bit_plane.hpp"
#include "bitstream/stream/coding_headers.hpp"
#include "bitstream/track/track_encoder.hpp"
#include "codec/frames/frame_planes.hpp"
#include "codec/wavelet/choice/filter_choice.hpp"

namespace tetrakis::inline frames {

using Planes = std::vector<std::vector<int32_t>>;

/// The planes of a group, as FrameLayout numbers them.
struct FrameSource {
  FrameLayout layout;  ///< without `bit_planes`
  SharedBits lifted;   ///< samples that have coefficients; null: all
  Planes planes;       ///< whole steps; others than the lifted samples may be anything
  std::vector<double> squares = {1};  ///< errors of the samples by those of each colour
  double share = 1;                   ///< of the lifted samples, those whose errors count

  /// What the frames go on from, in whole steps of each colour; null: nothing.
  std::shared_ptr<const FrameReference> before() const { return referenceOf(layout.frames); }
};

/// How a group is lifted over time.
struct TimeCoding {
  TimeFilter filter = TimeFilter::kNone;
  double bits = 0;  ///< that coefficients to the last bit take, estimated
};

/// Chooses the filter over time that leaves the fewest bits. bits: of the samples. The layout need
/// not have filters yet.
TimeCoding chooseTimeCoding(const FrameSource& source, int bits);

/// Chooses the wavelet that suits what a filter over time leaves. It takes as long as the other
/// choice: of several ways to code a group only the one that is taken needs it.
WaveletHeader chooseFrameWavelet(const FrameSource& source, TimeFilter filter, int bits,
                                 Purpose purpose);

/// One track for each region. Distortion is in squared units of the samples, summed over the lifted
/// ones of all frames and multiplied by the share.
std::vector<EncodedTrack> encodeFramePlanes(FrameSource source, const TrackOptions& options);

}  // namespace tetrakis::inline frames

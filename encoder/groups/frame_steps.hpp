// SPDX-License-Identifier: Apache-2.0
// stepsOfFrames() turns the frames of heights into integer steps of one step for all of them, with
// a mask for each frame. filled() gives the samples that are void in a frame, but not in all, the
// heights that they have before and after, which lifting over time takes for nothing.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "bitstream/stream/geometry_header.hpp"
#include "codec/frames/frame_masks.hpp"
#include "codec/frames/frames_encoder.hpp"
#include "tetrakis/result.hpp"
#include "tetrakis/tetrakis.h"

namespace tetrakis::inline groups {

struct FrameSteps {
  Planes steps;  ///< one plane a frame; of voids any
  FrameMasks masks;
  double base = 0, step = 1;
  std::vector<FrameScale> scales;  ///< of each frame; empty: all have this base and step
  bool exact = false;              ///< every valid sample comes back bit for bit
  int range_bits = 0;              ///< heights of all frames span less than 2^range_bits steps

  FrameScale scale(size_t frame) const { return scales.empty() ? FrameScale() : scales[frame]; }
  uint64_t validSamples() const;
};

/// Steps that suit the target of the options. frames: one or more, alike but for their samples.
/// Exact steps may have a scale for each frame: fields of weather models are packed one by one.
/// TKS_UNSUPPORTED: the target needs samples that no steps show, and that a group of a single
/// frame may restore in another way.
Result<FrameSteps> stepsOfFrames(std::span<const tks_heights> frames,
                                 const tks_encode_options& options);

/// Likewise with a base and a step that are given: those of the group before. Nothing if they do
/// not suit the target, or if frames have scales.
std::optional<FrameSteps> stepsLike(const GeometryHeader& before,
                                    std::span<const tks_heights> frames,
                                    const tks_encode_options& options);

/// The steps with values for voids: between the valid samples before and after in time, or that of
/// the only one. A sample that is valid in no frame stays.
FrameSteps filled(FrameSteps steps);

}  // namespace tetrakis::inline groups

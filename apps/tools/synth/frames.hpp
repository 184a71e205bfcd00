// SPDX-License-Identifier: Apache-2.0
// synthesizeFrames() makes sample terrain that changes over time, frame by frame: mountains that
// erode, a flood that rises over them, the shadow of clouds that moves over their photograph, and
// the ground that a rover has seen so far.
#pragma once

#include <array>
#include <cstdint>
#include <functional>

#include "apps/tools/synth/synth.hpp"
#include "tetrakis/result.hpp"

namespace tetrakis::tools {

enum class FrameKind { kErosion, kFlood, kClouds, kRover };

/// Their names, in order.
inline constexpr std::array<const char*, 4> kFrameKinds = {"erosion", "flood", "clouds", "rover"};

/// Takes one frame: heights, or a texture; the other one is null. What it returns ends the work
/// unless it is fine.
using TakeFrame =
    std::function<Status(uint32_t frame, const HeightFile* heights, const ImageFile* texture)>;

/// Frames over the mountains of the size and the seed. Heights are TKS_U16 in steps of 0.1 m; what
/// the rover has not seen is the nodata value 65535.
Status synthesizeFrames(const SynthOptions& options, FrameKind kind, uint32_t count,
                        const TakeFrame& take);

}  // namespace tetrakis::tools

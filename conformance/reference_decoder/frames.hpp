// SPDX-License-Identifier: Apache-2.0
// Reference decoder: the planes of frames (docs/FORMAT.md, section 9.4).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "conformance/reference_decoder/stream.hpp"
#include "conformance/reference_decoder/wavelet.hpp"

namespace tetrakis::reference {

/// What heights and textures say of their frames.
struct FrameLayout {
  const WaveletHeader& wavelet;
  const RegionHeader& regions;
  const FramesHeader& frames;
  int bitPlanes = 0;
  std::vector<int> priorities;  ///< of the planes of a frame
};

struct FramePlanes {
  std::vector<Plane> planes;  ///< of a level, plane c of frame t at t * C + c
  int f = 0;
};

/// lifted: what section 7 takes for valid, without values.
FramePlanes decodeFrames(const FrameLayout& layout, const Plane& lifted,
                         const std::vector<std::span<const uint8_t>>& coefficients, int level);

/// All frames of heights, one behind the other.
std::vector<uint8_t> decodeHeightFrames(const GeometryHeader& header, const Layers& layers,
                                        const Codewords& codewords, int level);

/// FORMAT 9.4, Reference: what the next group goes on from.
ReferencePlanes lastHeights(const GeometryHeader& header, const Layers& layers,
                            const Codewords& codewords);
ReferencePlanes lastTexels(const TextureHeader& header, const Codewords& codewords);

/// "R[c]" of the values of a plane.
std::vector<int32_t> wholeSteps(const Plane& plane, int f);

}  // namespace tetrakis::reference

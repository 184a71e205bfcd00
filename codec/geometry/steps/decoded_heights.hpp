// SPDX-License-Identifier: Apache-2.0
// DecodedHeights are heights in steps as a decoder knows them, and fromSteps() turns them into
// samples of the file's type.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/plane.hpp"
#include "bitstream/stream/geometry_header.hpp"

namespace tetrakis::inline steps {

// DecodedHeights are heights as a decoder knows them: steps, which later become samples, and
// corrections of these samples.

/// Decoded heights of a view, row by row.
struct DecodedGeometry {
  uint32_t width = 0, height = 0;
  /// Heights in units of 2^-fraction_bits steps; 0 where samples are void.
  std::vector<int32_t> heights;
  int fraction_bits = 0;
  /// 1 where the vertex of a sample has a non-zero coefficient. Empty in windows of corrected,
  /// drawn and stored heights.
  std::vector<uint8_t> significant;
  std::vector<uint8_t> valid;  ///< 1 where a sample is valid, 0 where it is void; empty: all valid
  /// The number of finest levels of the view that have no significant coefficient. 0 in a window.
  uint32_t quiet_levels = 0;

  Extent extent() const { return {width, height}; }
};

struct DecodedHeights {
  DecodedGeometry geometry;          ///< corrections of steps are applied
  std::vector<int32_t> corrections;  ///< of the samples; empty where there are none
};

/// Rounds a height in units of 2^-fraction_bits steps to whole steps, half up.
inline int32_t wholeStep(int32_t height, int fraction_bits) {
  const int some = fraction_bits > 0;
  return (height >> fraction_bits) + ((height >> (fraction_bits - some)) & some);
}

/// Returns all heights in whole steps.
std::vector<int32_t> wholeSteps(DecodedGeometry decoded);

// fromSteps() turns the steps of decoded heights into samples: sample = base + q * step, plus a
// correction where there is one.

/// Writes samples of header.sample, one for each height of `decoded`; integers saturate at their
/// type's range. Voids become layers.nodata or NaN; a height that would be the declared nodata
/// value becomes the next sample, whether there are voids or not.
void fromSteps(const DecodedHeights& decoded, const GeometryHeader& header,
               const GeometryLayers& layers, void* out);

/// The hints (codec/geometry/corrections/correction_coder.hpp) of corrections of samples, from the
/// heights that the samples come from, as decoders know them.
std::vector<uint8_t> sampleHints(std::span<const int32_t> heights, int fraction_bits,
                                 const GeometryHeader& header);

}  // namespace tetrakis::inline steps

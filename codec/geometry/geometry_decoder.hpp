// SPDX-License-Identifier: Apache-2.0
// Decodes the coefficients of a height field and turns them into heights. Integer arithmetic only.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "base/view.hpp"
#include "bitstream/stream/geometry_header.hpp"
#include "bitstream/stream/packet.hpp"
#include "codec/geometry/flat/flat_areas.hpp"
#include "wavelet/region_decoder.hpp"

namespace tetrakis::inline geometry {

/// What is known of a plane before its coefficients.
struct KnownSamples {
  std::vector<uint8_t> valid;  ///< 1 where a sample is valid, 0 where it is void; empty: all valid
  HeldSamples flat = {};       ///< of flat areas, which outlive the call

  KnownSamples() = default;
  KnownSamples(std::vector<uint8_t> valid_samples, HeldSamples flat_samples = {})
      : valid(std::move(valid_samples)), flat(flat_samples) {}
};

/// What a view shows of decoded heights, row by row.
struct DecodedGeometry {
  uint32_t width = 0, height = 0;
  /// In units of 2^-fraction_bits steps; 0 where samples are void.
  std::vector<int32_t> heights;
  int fraction_bits = 0;
  /// 1 where the vertex of a sample has a non-zero coefficient. Empty if the view is a window.
  std::vector<uint8_t> significant;
  std::vector<uint8_t> valid;  ///< 1 where a sample is valid, 0 where it is void; empty: all valid
  /// How many of the finest levels of the view have no significant coefficient. 0 in a window.
  uint32_t quiet_levels = 0;

  Extent extent() const { return {width, height}; }
};

/// Decodes what a view shows; in a window the time follows its size if the plane has regions.
/// codewords: any prefix of the coefficients of each track, one for each of regionsOf(). known: of
/// the whole plane. Safe on any bytes and on any header that readHeader() accepts. The memory is
/// that of earlier calls with the same header, known samples and view, which is no window.
DecodedGeometry decodeGeometry(const GeometryHeader& header, const Codewords& codewords,
                               KnownSamples known = {}, const View& view = {},
                               const DecodeContext<TrackMemory>& context = {});

/// Rounds a height in units of 2^-fraction_bits steps to whole steps, half up.
inline int32_t wholeStep(int32_t height, int fraction_bits) {
  const int some = fraction_bits > 0;
  return (height >> fraction_bits) + ((height >> (fraction_bits - some)) & some);
}

/// Returns all heights in whole steps.
std::vector<int32_t> wholeSteps(DecodedGeometry decoded);

}  // namespace tetrakis::inline geometry

// SPDX-License-Identifier: Apache-2.0
// decodeCoefficients() decodes the coefficients of a height field and turns them into heights in
// steps. It uses integers only.
#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "base/bit_plane.hpp"
#include "base/view.hpp"
#include "bitstream/stream/geometry_header.hpp"
#include "bitstream/stream/packet.hpp"
#include "codec/geometry/flat/flat_areas.hpp"
#include "codec/geometry/steps/decoded_heights.hpp"
#include "codec/wavelet/region_decoder.hpp"

namespace tetrakis::inline geometry {

/// The samples of a plane that are known before its coefficients.
struct KnownSamples {
  SharedBits valid = {};                  ///< which samples are valid; the others are void
  HeldSamples flat = {};                  ///< of flat areas, which outlive the call
  std::optional<SharedBits> lifted = {};  ///< of liftedSamples(), if voids are bridged
};

/// Decodes the heights of a view; in a window the time follows its size if the plane has regions.
/// codewords: any prefix of the coefficients of each track, one for each of regionsOf(). known: of
/// the whole plane. Safe on any bytes and on any header that readHeader() accepts. The memory is
/// that of earlier calls with the same header, known samples and view, which is no window.
DecodedGeometry decodeCoefficients(const GeometryHeader& header, const Codewords& codewords,
                                   KnownSamples known = {}, const View& view = {},
                                   const DecodeContext<TrackMemory>& context = {});

}  // namespace tetrakis::inline geometry

// SPDX-License-Identifier: Apache-2.0
// takeApart() splits any prefix of the tracks of heights into the codewords of their layers, and
// corrected() applies the corrections among them to decoded heights, region by region. Decoder
// only; the layers in between are those of heights_decoder.hpp.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/kept_items.hpp"
#include "base/view.hpp"
#include "bitstream/stream/geometry_header.hpp"
#include "bitstream/stream/packet.hpp"
#include "codec/geometry/steps/decoded_heights.hpp"

namespace tetrakis::inline geometry {

// takeApart() splits the tracks of heights into the codewords of their layers, by the lengths that
// the header states (bitstream/stream/geometry_header.hpp). Encoders join them in
// encoder/heights/coded_heights.hpp.

/// The bytes of each layer, as far as they are there. The codewords that they are taken from
/// outlive this object.
struct TakenLayers {
  const GeometryHeader& header;
  const GeometryLayers& stated;            ///< the layers as the stream header states them
  std::span<const uint8_t> validity = {};  ///< with masks of regions, that of the base
  Codewords region_validity = {};          ///< with those: of each of the other tracks
  std::span<const uint8_t> lifted = {};    ///< of heights whose mask comes late
  std::span<const uint8_t> flat = {};
  std::span<const uint8_t> table = {};
  /// The coefficients of the first track, in the pieces into which the layers among them cut them.
  Codewords first_coefficients = {};
  Codewords other_coefficients = {};  ///< of each of the other tracks
  Codewords corrections = {};         ///< of each part of the plane
  bool masks_whole = true;            ///< of region_validity

  bool isCorrected() const;
  /// Whether all layers that come before the coefficients are there.
  bool isOpened() const;
};

/// codewords: any prefix of each track.
TakenLayers takeApart(const Codewords& codewords, const GeometryHeader& header,
                      const GeometryLayers& layers);

/// A codeword of coefficients, a drawing or stored samples for each track.
struct JoinedCoefficients {
  std::vector<uint8_t> bytes;  ///< of the first, if it was in pieces
  Codewords codewords;
};

/// The layers outlive the result.
JoinedCoefficients joinCoefficients(const TakenLayers& taken);

// corrected() adds the corrections of a plane, or of its regions, to the heights that coefficients
// or a drawing give.

/// The view that has to be decoded so that the samples of a view of the coded lines can be
/// corrected: whole parts of the plane (bitstream/stream/geometry_header.hpp), or, in a plane in
/// one track, all rows up to the last one.
View correctedView(const GeometryHeader& header, const GeometryLayers& layers, const View& view);

/// A part of the plane, of which later calls with the same heights and codeword need no more.
struct CorrectedPart {
  DecodedHeights before;
  size_t codeword_bytes = 0;
  DecodedHeights after;

  /// codewords begin with the same bytes.
  bool isOf(const DecodedHeights& heights, std::span<const uint8_t> codeword) const;
  uint64_t bytes() const;
};
using CorrectedParts = KeptItems<CorrectedPart>;

/// The heights with their corrections. decoded: of the view correctedView(), at level 0. Safe on
/// any bytes. The memory is that of earlier calls of the same plane.
DecodedHeights corrected(DecodedHeights decoded, const TakenLayers& taken, const View& view,
                         const DecodeContext<CorrectedParts>& context = {});

/// The heights of a view of decoded ones, which are a whole plane or a window of it. They have no
/// marks of vertices if those have none.
DecodedHeights viewOf(const DecodedHeights& decoded, const View& view);

}  // namespace tetrakis::inline geometry

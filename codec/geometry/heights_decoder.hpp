// SPDX-License-Identifier: Apache-2.0
// decodeHeights() decodes heights from the layers of their tracks: validity, flat areas,
// coefficients or a drawing with the layers among them, corrections
// (bitstream/stream/geometry_header.hpp), or stored samples.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "base/bit_plane.hpp"
#include "base/view.hpp"
#include "bitstream/stream/geometry_header.hpp"
#include "codec/geometry/coefficients_decoder.hpp"

namespace tetrakis::inline geometry {

/// The memory of one call of decodeHeights() for the next call, whose tracks begin with the same
/// bytes. It is empty before the first call.
struct HeightsMemory {
  SharedBits valid;    ///< once it is whole
  SharedBits lifted;   ///< if voids are bridged, once all before the coefficients is there
  FlatAreas flat;      ///< likewise
  TrackMemory tracks;  ///< likewise: what exists of them follows from those
  /// Of encoders, which have all of a drawing: the heights that its first bytes show behind the
  /// opening.
  std::function<DecodedGeometry(uint64_t bytes)> drawing = {};
  /// Of encoders, which have all corrections: the heights behind the first bytes of these.
  std::function<DecodedHeights(uint64_t bytes)> corrected = {};

  uint64_t bytes() const;
};

/// The part of the coded lines that a view needs. A stored sample's place depends on the voids
/// before it, contexts of drawings come from the whole plane, and contexts of corrections from the
/// samples before and from the corrected heights (correctedView()).
View decodedView(const GeometryHeader& header, const GeometryLayers& layers, const View& view);

/// Decodes the heights of a view. In a window the time follows its size if there are regions.
/// Levels above 0 have no corrections, which belong to the samples. codewords: any prefix of each
/// track; the layers are those of the first. Safe on any bytes. The memory is that of earlier calls
/// with the same headers and view, which is no window.
DecodedHeights decodeHeights(const GeometryHeader& header, const GeometryLayers& layers,
                             const Codewords& codewords, const View& view = {},
                             const DecodeContext<HeightsMemory>& context = {});

/// Decodes which samples of a view are valid, and nothing else; empty: all are valid.
std::vector<uint8_t> decodeValidityLayer(const GeometryHeader& header, const GeometryLayers& layers,
                                         const Codewords& codewords, const View& view);

}  // namespace tetrakis::inline geometry

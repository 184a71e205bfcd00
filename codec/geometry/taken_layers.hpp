// SPDX-License-Identifier: Apache-2.0
// takeApart() splits the tracks of heights into the codewords of their layers, by the lengths that
// the header states (bitstream/stream/geometry_header.hpp). Encoders join them in
// encoder/heights/joined_layers.hpp.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bitstream/stream/geometry_header.hpp"
#include "bitstream/stream/packet.hpp"

namespace tetrakis::inline geometry {

/// The bytes of each layer, as far as they are there. The codewords that they are taken from
/// outlive this object.
struct TakenLayers {
  const GeometryHeader& header;
  const GeometryLayers& stated;  ///< the layers as the stream header states them
  std::span<const uint8_t> validity = {};
  std::span<const uint8_t> lifted = {};  ///< of heights whose mask comes late
  std::span<const uint8_t> flat = {};
  std::span<const uint8_t> table = {};
  /// The coefficients of the first track, in the pieces into which the layers among them cut them.
  Codewords first_coefficients = {};
  Codewords other_coefficients = {};  ///< of each of the other tracks
  Codewords corrections = {};         ///< of each part of the plane

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

}  // namespace tetrakis::inline geometry

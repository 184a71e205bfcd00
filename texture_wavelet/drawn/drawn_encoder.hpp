// SPDX-License-Identifier: Apache-2.0
// encodeDrawn() and encodeOverlay() code an image of few colours, or what is drawn over a
// photograph, as a drawing. DrawnError and prefixesOfDrawing() tell what prefixes of the drawing
// show. Encoder only.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "base/samples.hpp"
#include "bitstream/stream/encoded_texture.hpp"
#include "bitstream/stream/texture_header.hpp"
#include "codec/drawing/drawing_neighbours.hpp"
#include "codec/lattice/levels.hpp"
#include "texture_wavelet/drawn/drawn_decoder.hpp"

namespace tetrakis::inline drawn {

// DrawnError measures the squared error of an image of which only some texels are decoded, again
// and again while their number grows.

/// Measures an image again and again while more of it becomes known.
class DrawnError {
 public:
  /// Both outlive this. levels: those of the grid, coarse to fine.
  DrawnError(const Texels& original, std::span<const Level> levels)
      : original_(original), levels_(levels), shown_(original) {}

  /// The squared error of all samples when texels with an index show what they are, and fillDrawn()
  /// gives the others their colours.
  double squares(std::span<const KeptIndex> indices);

 private:
  const Texels& original_;
  std::span<const Level> levels_;
  Texels shown_;
};

// encodeDrawn() codes an image of few colours as the track of a drawn texture, and encodeOverlay()
// codes the overlay of a photograph.

/// Lossless, whole. Nothing if there are more than kMostDrawnValues colours; or if fewer than half
/// of the texels are like the one before or above them, unless so the drawing takes about `most`
/// bytes or fewer: else that is no drawing.
std::optional<EncodedTexture> encodeDrawn(const Texels& texels, uint64_t most = 0);

/// Returns the codeword of an overlay: which texels the photograph does not mark, and the colours
/// of those. There are fewer than kMostDrawnValues colours.
std::vector<uint8_t> encodeOverlay(const Texels& texels, Mask photograph);

// prefixesOfDrawing() and prefixesOfOverlay() decode a drawn texture or an overlay once and give
// the texels of any prefix of it, because encoders look at many prefixes.

/// Returns what gives the same as decodeDrawn() of the first bytes of the codeword at level 0, in
/// less time. codeword: all of it, as an encoder wrote it.
std::function<Texels(uint64_t bytes)> prefixesOfDrawing(const TextureHeader& header,
                                                        std::span<const uint8_t> codeword);

/// The same for decodeOverlay().
std::function<DrawnOverlay(uint64_t bytes)> prefixesOfOverlay(const TextureHeader& header,
                                                              std::span<const uint8_t> codeword);

}  // namespace tetrakis::inline drawn

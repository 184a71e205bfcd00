// SPDX-License-Identifier: Apache-2.0
// takeOpening() decodes the layers that lie before the coefficients of a texture: the mask of a
// cut-out, then an overlay.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "base/bit_plane.hpp"
#include "base/plane.hpp"
#include "base/texels.hpp"
#include "base/view.hpp"
#include "bitstream/stream/texture_header.hpp"
#include "texture_wavelet/drawn/drawn_decoder.hpp"

namespace tetrakis::inline texture {

struct TextureOpening {
  SharedBits seen;  ///< texels whose alpha is not 0; null: not a cut-out
  DrawnOverlay overlay;
  SharedBits coded;   ///< texels whose coefficients count; null: all
  SharedBits lifted;  ///< texels that have coefficients: those, with liftedSamples() if bridged

  /// Draws what a view of the whole image shows of the overlay over the texels of that view.
  void paint(Extent whole, const View& view, Texels& texels) const;
};

/// What one call of takeOpening() leaves to the next, of the same track.
struct OpeningMemory {
  std::shared_ptr<const TextureOpening> whole;  ///< once it is
  /// Of encoders, which have all of an overlay: what its first bytes show.
  std::function<DrawnOverlay(uint64_t bytes)> overlay = {};
};

/// Decodes what a track opens with, or a prefix of it, and takes it off the codeword. memory: null:
/// there is none.
std::shared_ptr<const TextureOpening> takeOpening(const TextureHeader& header,
                                                  OpeningMemory* memory,
                                                  std::span<const uint8_t>& codeword);

}  // namespace tetrakis::inline texture

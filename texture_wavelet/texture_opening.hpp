// SPDX-License-Identifier: Apache-2.0
// What comes before the coefficients of a texture: the mask of a cut-out, then an overlay.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "base/texels.hpp"
#include "bitstream/stream/header.hpp"
#include "texture_wavelet/drawn/drawn_decoder.hpp"

namespace tetrakis {

struct TextureOpening {
  std::vector<uint8_t> seen;  ///< of all texels: 1 where alpha is not 0; empty: not a cut-out
  DrawnOverlay overlay;
  std::vector<uint8_t> coded;  ///< of all texels: 1 where coefficients count; empty: everywhere

  /// Draws the overlay over texels that lie `step` apart in the whole image, from (x0, y0) on.
  /// width: of the whole image.
  void paint(uint32_t width, uint32_t x0, uint32_t y0, uint32_t step, Texels& texels) const;
};

/// Decodes what a track opens with, or a prefix of it, and takes it off the codeword. memory: holds
/// the opening of the same track once it is whole; null: none.
std::shared_ptr<const TextureOpening> takeOpening(const TextureHeader& header,
                                                  std::shared_ptr<const TextureOpening>* memory,
                                                  std::span<const uint8_t>& codeword);

}  // namespace tetrakis

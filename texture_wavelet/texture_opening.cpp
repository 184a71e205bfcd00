// SPDX-License-Identifier: Apache-2.0
#include "texture_wavelet/texture_opening.hpp"

#include <algorithm>
#include <cassert>
#include <cstddef>

#include "codec/lattice/validity_decoder.hpp"
#include "codec/wavelet/bridges.hpp"

namespace tetrakis::inline texture {

namespace {

/// The first so many bytes, which are taken off.
std::span<const uint8_t> take(uint64_t bytes, std::span<const uint8_t>& codeword) {
  const auto taken =
      codeword.first(static_cast<size_t>(std::min<uint64_t>(bytes, codeword.size())));
  codeword = codeword.subspan(taken.size());
  return taken;
}

/// seen: null: all texels.
BitPlane notDrawnOver(const DrawnOverlay& overlay, Extent plane, const BitPlane* seen) {
  BitPlane coded = seen != nullptr ? *seen : BitPlane(plane);
  if (seen == nullptr) coded.invert();
  for (uint32_t y = 0; y < plane.height; y += overlay.step) {
    uint64_t* const row = coded.row(y);
    const size_t first = size_t{y} * plane.width;
    for (uint32_t x = 0; x < plane.width; x += overlay.step)
      row[x / kWordBits] &= ~(uint64_t{overlay.covers(first + x)} << x % kWordBits);
  }
  return coded;
}

TextureOpening decodeOpening(const TextureHeader& header, std::span<const uint8_t> alpha,
                             std::span<const uint8_t> drawn, const OpeningMemory* memory) {
  TextureOpening opening;
  if (header.alpha_bytes > 0) opening.seen = shared(decodeValidity(alpha, header.extent()));
  if (header.hidden) opening.coded = opening.seen;
  if (header.overlay_bytes > 0) {
    opening.overlay = memory != nullptr && memory->overlay ? memory->overlay(drawn.size())
                                                           : decodeOverlay(header, drawn);
    opening.coded = shared(notDrawnOver(opening.overlay, header.extent(), opening.coded.get()));
  }
  opening.lifted = liftedSamples(opening.coded, header.bridge);
  return opening;
}

}  // namespace

void TextureOpening::paint(Extent whole, const View& view, Texels& texels) const {
  if (overlay.indices.size() == 0) return;
  assert(texels.extent() == view.extentIn(whole));
  uint16_t* out = texels.samples.data();
  for (uint32_t y = 0; y < texels.height; ++y) {
    const size_t row =
        view.firstColumn() + (view.firstRow() + size_t{y} * view.step()) * whole.width;
    for (uint32_t x = 0; x < texels.width; ++x, out += texels.channels) {
      const size_t texel = row + size_t{x} * view.step();
      if (!overlay.covers(texel)) continue;
      std::copy_n(overlay.colours[overlay.indices[texel]].begin(), texels.channels, out);
    }
  }
}

std::shared_ptr<const TextureOpening> takeOpening(const TextureHeader& header,
                                                  OpeningMemory* memory,
                                                  std::span<const uint8_t>& codeword) {
  const auto alpha = take(header.alpha_bytes, codeword);
  const auto drawn = take(header.overlay_bytes, codeword);
  const bool whole = alpha.size() == header.alpha_bytes && drawn.size() == header.overlay_bytes;
  if (memory != nullptr && whole && memory->whole != nullptr) return memory->whole;
  auto opening =
      std::make_shared<const TextureOpening>(decodeOpening(header, alpha, drawn, memory));
  if (memory != nullptr && whole) memory->whole = opening;
  return opening;
}

}  // namespace tetrakis::inline texture

// SPDX-License-Identifier: Apache-2.0
// TextureSource holds an image and what follows from it alone, such as the mask of a cut-out.
// TextureOptions says how to code it. An image is often coded several times before the best way is
// known, so TextureSource finds its masks only once.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "base/texels.hpp"
#include "codec/wavelet/choice/filter_choice.hpp"
#include "codec/wavelet/priority_map.hpp"
#include "texture_wavelet/mask/cutout.hpp"
#include "texture_wavelet/passed_texture.hpp"

namespace tetrakis::inline texture {

struct TextureSource {
  /// Any image is a source.
  TextureSource(Texels image, bool goes_round = false)
      : texels(std::move(image)),
        cutout(cutoutOf(texels)),
        softly_seen(softlySeen(texels)),
        ring(goes_round) {}

  /// Marks the texels that have colours. hidden: those that a cut-out does not show have none.
  Mask coloured(bool hidden) const { return hidden ? Mask(cutout) : Mask(); }

  /// Marks the texels whose colours count in errors: lossy ones are free where alpha is 0.
  Mask counted(Purpose purpose) const {
    if (purpose == Purpose::kLossless) return {};
    return Mask(cutout.empty() ? softly_seen : cutout);
  }

  /// Channels that are colour planes: all but the alpha of a cut-out.
  uint32_t colours() const { return texels.channels - (cutout.empty() ? 0 : 1); }

  Texels texels;
  std::vector<uint8_t> cutout;       ///< cutoutOf(texels)
  std::vector<uint8_t> softly_seen;  ///< softlySeen(texels)
  bool ring;                         ///< WaveletHeader::ring
};

struct TextureOptions {
  uint64_t limit = UINT64_MAX;  ///< bytes worth coding, of all tracks together
  int region_log2 = 0;          ///< bitstream/track/regions.hpp; 0: one track
  uint32_t threads = 1;         ///< nothing depends on them
  bool windows = false;         ///< withShortReach()
  bool visual = false;          ///< what is seen comes first, not what is off most
  uint64_t room = UINT64_MAX;   ///< bytes that will be sent at most, if there is a budget
  double mean_square = 0;       ///< error that a lossy texture is to reach, if there is a target
  bool tables = true;           ///< of values: lossless textures may have them
  const PriorityMap* priorities = nullptr;  ///< what comes earlier; null: nothing
  /// Takes the attempts that are passed over; null: nobody asked for them.
  PassedTextures* passed = nullptr;
};

}  // namespace tetrakis::inline texture

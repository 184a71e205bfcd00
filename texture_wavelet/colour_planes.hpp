// SPDX-License-Identifier: Apache-2.0
// colourPlanesOf() takes the channels of an image and returns the planes that the wavelet codes:
// after tables and the colour transform, with values for texels that are hidden or drawn over, some
// of which are bridged. Encoder only.
#pragma once

#include <cstdint>
#include <vector>

#include "base/plane.hpp"
#include "bitstream/stream/texture_header.hpp"
#include "codec/wavelet/choice/bridge_choice.hpp"
#include "codec/wavelet/choice/filter_choice.hpp"
#include "texture_wavelet/colour/colour.hpp"
#include "texture_wavelet/tables/channel_tables_encoder.hpp"
#include "texture_wavelet/texture_source.hpp"

namespace tetrakis::inline texture {

// chooseTextureBridges() chooses the texels that are hidden or drawn over and that the wavelet of a
// texture nevertheless codes (codec/wavelet/morphology.hpp): thin lines and single holes would cut
// its planes into pieces.

/// Which texels the wavelet goes over.
struct TextureBridges {
  uint8_t reach = 0;            ///< 0: none is bridged; the mask is empty then
  std::vector<uint8_t> lifted;  ///< liftedSamples(); empty: all
  double share = 1;             ///< of the texels that are lifted, those that are shown

  /// Which texels have coefficients. coded: those that are neither hidden nor drawn over.
  Mask lifting(Mask coded) const { return reach == 0 ? coded : Mask(lifted); }
};

/// The channels that are coded, before any transform.
struct ChannelPlanes {
  Extent extent;
  Mask coded;  ///< texels that are neither hidden nor drawn over
  std::vector<std::vector<int32_t>> planes;
};

/// Chooses bridges by grey, or green, of so many bits. Frames stay without them: there they cost
/// more than typical parts tell.
TextureBridges chooseTextureBridges(const ChannelPlanes& channels, int bits, BridgeTarget target);

/// Bridges of a reach that was chosen before; 0 is none.
TextureBridges textureBridges(Extent extent, Mask coded, uint8_t reach);

/// Fills the bridged texels of all channels smoothly.
ChannelPlanes withBridges(ChannelPlanes channels, const TextureBridges& bridges);

// colourPlanesOf() turns the channels of an image into the colour planes that the wavelet codes.
// Channels of few values become places in their tables, texels without coefficients take the values
// that cost least, and shears turn the colours.

/// What is coded by wavelet, and how.
struct WaveletCoding {
  const TextureSource& source;
  Purpose purpose;
  const TextureOptions& options;
  Mask photograph;            ///< texels that are not drawn over
  const TextureHeader* like;  ///< colours, filters and bridges are taken over; null: chosen
  FewValues few;              ///< tables of the channels; none: there are no tables

  /// Colours that a cut-out hides are not coded.
  bool hides() const { return !source.cutout.empty() && purpose == Purpose::kLossy; }
};

/// The colour planes of an image, and what they were made with.
struct ColourPlanes {
  std::vector<std::vector<int32_t>> planes;
  ColourTransform colour;
  WaveletHeader wavelet;
  TextureBridges bridges;
};

/// coded: texels that are neither hidden nor drawn over. opening_bytes: what lies before the
/// coefficients, which leave as much less for them.
ColourPlanes colourPlanesOf(const WaveletCoding& coding, Mask coded, uint64_t opening_bytes);

}  // namespace tetrakis::inline texture

// SPDX-License-Identifier: Apache-2.0
// The functions here choose the texels that are hidden or drawn over and that the wavelet of a
// texture nevertheless codes (codec/wavelet/bridges.hpp): thin lines and single holes would cut its
// planes into pieces. Encoder only.
#pragma once

#include <cstdint>
#include <vector>

#include "base/plane.hpp"
#include "codec/wavelet/choice/bridge_choice.hpp"

namespace tetrakis::inline texture {

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

}  // namespace tetrakis::inline texture

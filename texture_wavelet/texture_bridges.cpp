// SPDX-License-Identifier: Apache-2.0
#include "texture_wavelet/texture_bridges.hpp"

#include <algorithm>

#include "wavelet/bridges.hpp"
#include "wavelet/choice/bridge_fill.hpp"
#include "wavelet/choice/typical_parts.hpp"

namespace tetrakis::inline texture {

TextureBridges chooseTextureBridges(const ChannelPlanes& channels, int bits, BridgeTarget target) {
  constexpr uint8_t kMost = 16;
  target.most = kMost;
  if (channels.coded.all()) return {};
  const std::vector<std::vector<int32_t>>& planes = *channels.planes;
  const std::vector<int32_t>& leading = planes[planes.size() >= 3 ? 1 : 0];
  const BridgedPlane chosen =
      chooseBridges({leading, channels.extent, channels.coded}, bits, target);
  return textureBridges(channels, chosen.reach);
}

TextureBridges textureBridges(const ChannelPlanes& channels, uint8_t reach) {
  if (reach == 0 || channels.coded.all()) return {};
  const auto [extent, coded, planes] = channels;
  TextureBridges bridges{
      reach, liftedSamples({coded.bytes().begin(), coded.bytes().end()}, extent, reach)};
  bridges.share = static_cast<double>(markedIn(extent, coded)) /
                  static_cast<double>(std::max<size_t>(markedIn(extent, bridges.lifted), 1));
  for (std::vector<int32_t>& plane : *planes)
    plane = bridged({plane, extent, coded}, bridges.lifted);
  return bridges;
}

}  // namespace tetrakis::inline texture

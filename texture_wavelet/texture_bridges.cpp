// SPDX-License-Identifier: Apache-2.0
#include "texture_wavelet/texture_bridges.hpp"

#include <algorithm>

#include "codec/wavelet/bridges.hpp"
#include "codec/wavelet/choice/bridge_fill.hpp"
#include "codec/wavelet/choice/typical_parts.hpp"

namespace tetrakis::inline texture {

namespace {

/// The longest reach of bridges in textures. A longer one takes the time of more trials; to bridge
/// a frame whole has lost 0.1 dB.
constexpr uint8_t kLongestReach = 16;

}  // namespace

TextureBridges chooseTextureBridges(const ChannelPlanes& channels, int bits, BridgeTarget target) {
  target.most = kLongestReach;
  if (channels.coded.all()) return {};
  const std::vector<int32_t>& leading = channels.planes[channels.planes.size() >= 3 ? 1 : 0];
  const BridgedPlane chosen =
      chooseBridges({leading, channels.extent, channels.coded}, bits, target);
  return textureBridges(channels.extent, channels.coded, chosen.reach);
}

TextureBridges textureBridges(Extent extent, Mask coded, uint8_t reach) {
  if (reach == 0 || coded.all()) return {};
  TextureBridges bridges{
      reach, liftedSamples({coded.bytes().begin(), coded.bytes().end()}, extent, reach)};
  bridges.share = static_cast<double>(markedIn(extent, coded)) /
                  static_cast<double>(std::max<size_t>(markedIn(extent, bridges.lifted), 1));
  return bridges;
}

ChannelPlanes withBridges(ChannelPlanes channels, const TextureBridges& bridges) {
  if (bridges.reach == 0) return channels;
  for (std::vector<int32_t>& plane : channels.planes)
    plane = bridged({plane, channels.extent, channels.coded}, bridges.lifted);
  return channels;
}

}  // namespace tetrakis::inline texture

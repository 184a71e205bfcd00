// SPDX-License-Identifier: Apache-2.0
#include "texture_wavelet/colour_planes.hpp"

#include <algorithm>
#include <bit>
#include <utility>

#include "codec/wavelet/choice/bridge_choice.hpp"
#include "codec/wavelet/choice/typical_plane.hpp"
#include "codec/wavelet/morphology.hpp"
#include "texture_wavelet/colour/colour_fit.hpp"
#include "texture_wavelet/mask/mask.hpp"
#include "texture_wavelet/texture_decoder.hpp"

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

namespace {

/// The part of the bytes that colours beside luma take, about, when bridges are chosen for luma. A
/// larger number chooses them for a finer step.
constexpr uint64_t kColourPart = 3;

using Planes = std::vector<std::vector<int32_t>>;

/// The channels that become colour planes; of those with tables, the places.
Planes channelsOf(const WaveletCoding& coding) {
  const Texels& texels = coding.source.texels;
  const size_t count = texels.extent().samples();
  Planes channels(coding.source.colours(), std::vector<int32_t>(count));
  for (size_t i = 0; i < count; ++i) {
    for (size_t c = 0; c < channels.size(); ++c)
      channels[c][i] = texels.samples[i * texels.channels + c];
  }
  for (size_t c = 0; c < channels.size(); ++c)
    if (!coding.few.tables[c].empty()) samplesToPlaces(coding.few.tables[c], channels[c]);
  return channels;
}

/// Nobody sees colours where alpha is 0, so what takes few bytes is put there. The last channel is
/// alpha.
Planes withFreeColours(const TextureSource& source, Planes channels) {
  const Extent extent = source.texels.extent();
  for (size_t c = 0; c + 1 < channels.size(); ++c)
    channels[c] = bridged({channels[c], extent, source.softly_seen}, {});
  return channels;
}

/// How many bits the values of the channels have.
int bitsOf(const WaveletCoding& coding) {
  const int sample_bits = coding.source.texels.bits;
  int bits = 1;
  for (uint32_t c = 0; c < coding.source.colours(); ++c) {
    const size_t values = coding.few.tables[c].size();
    bits = std::max(bits, values == 0 ? sample_bits : static_cast<int>(std::bit_width(values - 1)));
  }
  return bits;
}

/// What bridges are chosen for. Colours take a part of the bytes that are left.
BridgeTarget bridgeTarget(const WaveletCoding& coding, uint64_t opening_bytes) {
  BridgeTarget target{coding.purpose};
  if (coding.purpose == Purpose::kLossless) return target;
  const uint64_t room = coding.options.room;
  target.mean_square = coding.options.mean_square;
  if (room == UINT64_MAX) return target;
  const uint64_t left = room - std::min(room, opening_bytes);
  target.bytes = coding.source.colours() >= 3 ? left / kColourPart * (kColourPart - 1) : left;
  return target;
}

/// Applies the colour transform to channels, whose values get fraction bits.
Planes sheared(const ColourTransform& colour, int fraction_bits, Planes planes) {
  const size_t count = planes.front().size();
  std::vector<int32_t*> chunk(planes.size());
  for (size_t first = 0; first < count; first += kColourChunk) {
    for (size_t c = 0; c < planes.size(); ++c) chunk[c] = planes[c].data() + first;
    forwardColour(colour, chunk, std::min(kColourChunk, count - first), fraction_bits);
  }
  return planes;
}

ColourTransform fitColours(const Planes& channels, const Texels& texels, Purpose purpose) {
  std::vector<const int32_t*> pointers;
  for (const std::vector<int32_t>& channel : channels) pointers.push_back(channel.data());
  const auto fit = purpose == Purpose::kLossy ? fitColour : chooseLosslessColour;
  ColourTransform colour = fit(pointers, texels.extent());
  if (channels.size() % 2 == 0 && texels.opaque)
    colour.further_shears = fitFurtherColour(colour, pointers, texels.extent(), purpose);
  return colour;
}

/// Colour planes with the filters that suit them: for the last bit all of them say which, else
/// green, or grey, because it must be known how many fraction bits go in.
struct FittedPlanes {
  Planes planes;
  WaveletHeader wavelet;
};

/// mask: the texels that have coefficients.
FittedPlanes fitFilters(const WaveletCoding& coding, const ColourTransform& colour, Mask mask,
                        Planes channels) {
  const SharedForest& forest = coding.source.forest;
  const auto view_of = [&](const std::vector<int32_t>& plane) {
    PlaneView<const int32_t> view(plane, coding.source.texels.extent(), mask);
    if (forest != nullptr) view.patch_rows = forest->side();
    return view;
  };
  const int bits = bitsOf(coding);
  if (coding.purpose == Purpose::kLossless) {
    Planes planes = sheared(colour, 0, std::move(channels));
    std::vector<PlaneView<const int32_t>> views;
    for (const std::vector<int32_t>& plane : planes) views.push_back(view_of(plane));
    return {std::move(planes), chooseLosslessWavelet(views, bits)};
  }
  const WaveletHeader wavelet =
      chooseWavelet(view_of(channels[channels.size() >= 3 ? 1 : 0]), bits, coding.purpose);
  return {sheared(colour, wavelet.fraction_bits, std::move(channels)), wavelet};
}

WaveletHeader forWindows(const WaveletHeader& wavelet, const TextureOptions& options) {
  return options.windows ? withShortReach(wavelet) : wavelet;
}

}  // namespace

ColourPlanes colourPlanesOf(const WaveletCoding& coding, Mask coded, uint64_t opening_bytes) {
  const Extent extent = coding.source.texels.extent();
  const TextureHeader* like = coding.like;
  Planes all = channelsOf(coding);
  if (coding.purpose == Purpose::kLossy && !coding.source.softly_seen.empty())
    all = withFreeColours(coding.source, std::move(all));
  ChannelPlanes channels{extent, coded, withMeanColour(coded, std::move(all))};
  TextureBridges bridges =
      like != nullptr
          ? textureBridges(extent, coded, like->bridge)
          : chooseTextureBridges(channels, bitsOf(coding), bridgeTarget(coding, opening_bytes));
  Planes filled = withBridges(std::move(channels), bridges).planes;
  if (like != nullptr) {
    const ColourTransform colour = colourOf(*like);
    return {sheared(colour, like->wavelet.fraction_bits, std::move(filled)), colour,
            forWindows(like->wavelet, coding.options), std::move(bridges)};
  }
  const ColourTransform colour = fitColours(filled, coding.source.texels, coding.purpose);
  auto [planes, wavelet] = fitFilters(coding, colour, bridges.lifting(coded), std::move(filled));
  return {std::move(planes), colour, forWindows(wavelet, coding.options), std::move(bridges)};
}

}  // namespace tetrakis::inline texture

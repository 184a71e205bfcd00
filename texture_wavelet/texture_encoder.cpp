// SPDX-License-Identifier: Apache-2.0
#include "texture_wavelet/texture_encoder.hpp"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <numeric>
#include <utility>

#include "base/parallel.hpp"
#include "lattice/validity_encoder.hpp"
#include "texture_wavelet/colour/colour_fit.hpp"
#include "texture_wavelet/colour/colour_levels.hpp"
#include "texture_wavelet/colour/lossless_colour.hpp"
#include "texture_wavelet/drawn/drawn_encoder.hpp"
#include "texture_wavelet/mask/cutout.hpp"
#include "texture_wavelet/tables/channel_tables_encoder.hpp"
#include "texture_wavelet/texture_bridges.hpp"
#include "texture_wavelet/texture_plan.hpp"
#include "texture_wavelet/visual_weights.hpp"
#include "wavelet/choice/rounding_choice.hpp"
#include "wavelet/priority_map_encoder.hpp"
#include "wavelet/wavelet_header.hpp"

namespace tetrakis::inline texture {

namespace {

using Planes = std::vector<std::vector<int32_t>>;

/// The first channels of the texels.
Planes separate(const Texels& texels, uint32_t channels) {
  const size_t count = size_t{texels.width} * texels.height;
  Planes planes(channels, std::vector<int32_t>(count));
  for (size_t i = 0; i < count; ++i) {
    for (uint32_t c = 0; c < channels; ++c) planes[c][i] = texels.samples[i * texels.channels + c];
  }
  return planes;
}

/// What the squared error of each channel counts.
using ChannelWeights = std::array<double, 4>;

/// Squared error of all channels per squared error of each component's coefficients of a level;
/// alpha counts like a colour.
std::vector<double> energiesOf(size_t components, const ColourTransform& colour, int level,
                               const ChannelWeights& weights) {
  std::vector<double> energies(weights.begin(), weights.begin() + static_cast<int>(components));
  if (components >= 3) {
    const std::array<double, 3> rgb =
        componentEnergies(colour, level, {weights[0], weights[1], weights[2]});
    std::copy(rgb.begin(), rgb.end(), energies.begin());
  }
  return energies;
}

TextureHeader makeHeader(const Texels& texels, const ColourTransform& colour,
                         const WaveletHeader& wavelet, size_t components, const FewValues& few) {
  TextureHeader header;
  header.width = texels.width;
  header.height = texels.height;
  header.channels = static_cast<uint8_t>(texels.channels);
  header.opaque = texels.opaque;
  header.sample = texels.bits == 8 ? TKS_U8 : TKS_U16;
  header.wavelet = wavelet;
  header.centre = colour.centre;
  header.colour_order = colour.order;
  std::copy(colour.shears.begin(), colour.shears.end(), header.colour_shears.front().begin());
  for (const Shears& shears : colour.level_shears)
    std::copy(shears.begin(), shears.end(), header.colour_shears.emplace_back().begin());
  if (!few.none()) header.tables = headerOf(few.tables, texels.bits);
  const std::vector<double> energies = energiesOf(components, colour, 1, few.squares);
  const double usual =
      *std::min_element(few.squares.begin(), few.squares.begin() + static_cast<int>(components));
  for (size_t c = 0; c < components; ++c) {
    const double priority = std::round(8 * std::log2(energies[c] / usual));
    header.priority[c] = static_cast<int64_t>(std::clamp(priority, -128.0, 128.0));
  }
  return header;
}

void transformColours(const ColourTransform& colour, int fraction_bits, Planes& planes) {
  const size_t count = planes.front().size();
  std::vector<int32_t*> chunk(planes.size());
  for (size_t first = 0; first < count; first += kColourChunk) {
    for (size_t c = 0; c < planes.size(); ++c) chunk[c] = planes[c].data() + first;
    forwardColour(colour, chunk, std::min(kColourChunk, count - first), fraction_bits);
  }
}

ColourTransform fitColours(const Planes& planes, const Texels& texels, Purpose purpose) {
  std::vector<const int32_t*> pointers;
  for (const std::vector<int32_t>& plane : planes) pointers.push_back(plane.data());
  const auto fit = purpose == Purpose::kLossy ? fitColour : chooseLosslessColour;
  return fit(pointers, texels.extent());
}

/// The colour transform of an image and the filters of its components.
struct Fit {
  ColourTransform colour;
  WaveletHeader wavelet;
};

/// Applies the colour transform and chooses the wavelet: for the last bit by all that comes out of
/// it, else by green, or grey, because it must be known how many fraction bits go in.
WaveletHeader transformColours(const ColourTransform& colour, Purpose purpose, const Texels& texels,
                               int bits, Mask lifted, Planes& planes) {
  const auto view_of = [&](const std::vector<int32_t>& plane) {
    return PlaneView<const int32_t>(plane, texels.extent(), lifted);
  };
  if (purpose == Purpose::kLossless) {
    transformColours(colour, 0, planes);
    std::vector<PlaneView<const int32_t>> all;
    for (const std::vector<int32_t>& plane : planes) all.push_back(view_of(plane));
    return chooseLosslessWavelet(all, bits);
  }
  const WaveletHeader wavelet =
      chooseWavelet(view_of(planes[texels.channels >= 3 ? 1 : 0]), bits, purpose);
  transformColours(colour, wavelet.fraction_bits, planes);
  return wavelet;
}

/// Chooses colours and filters, or takes those of `like`, and transforms the colours of the planes,
/// whose samples have so many bits.
Fit fitAndTransform(const Texels& texels, Purpose purpose, int bits, Mask lifted,
                    const TextureHeader* like, Planes& planes) {
  if (like != nullptr) {
    const Fit fit{colourOf(*like), like->wavelet};
    transformColours(fit.colour, fit.wavelet.fraction_bits, planes);
    return fit;
  }
  const ColourTransform colour = fitColours(planes, texels, purpose);
  return {colour, transformColours(colour, purpose, texels, bits, lifted, planes)};
}

void prepend(std::span<const uint8_t> opening, double worth, EncodedTrack& track) {
  if (opening.empty()) return;
  track.codeword.insert(track.codeword.begin(), opening.begin(), opening.end());
  for (RatePoint& point : track.points) point.bytes += opening.size();
  track.points.insert(track.points.begin(), {0, track.points.front().distortion + worth, false,
                                             track.points.front().beyond});
}

/// The mask of a cut-out goes first, then the overlay: without them alphas are all wrong, and
/// colours off by half the range.
void prependOpening(const Texels& texels, std::span<const uint8_t> overlay,
                    std::span<const uint8_t> mask, EncodedTrack& track) {
  const double most = texels.most();
  const auto samples = static_cast<double>(texels.samples.size());
  prepend(overlay, most * most / 4 * samples, track);
  prepend(mask, most * most * samples / texels.channels, track);
}

/// Texels that are in both masks.
std::vector<uint8_t> intersection(Mask a, Mask b) {
  std::vector<uint8_t> common(a.bytes().size());
  for (size_t i = 0; i < common.size(); ++i) common[i] = a[i] && b[i];
  return common;
}

/// The texels that have coefficients, and how much the errors of these count.
struct LiftedTexels {
  Mask texels;
  double share;
};

std::vector<EncodedTrack> encodePlanes(const TextureHeader& header, const ColourTransform& colour,
                                       const ChannelWeights& weights, const LiftedTexels& lifted,
                                       const TrackOptions& options, Planes& planes) {
  const Mask coded = lifted.texels;
  const TexturePlan plan(header, coded);
  const PlaneLayout& layout = plan.layout();
  const double unit = lifted.share * std::exp2(-2 * header.wavelet.fraction_bits);
  const std::array<double, kPriorities> worth =
      worthOf(priorityMapOf(header.priorities, header.extent()));
  assert(planes.size() == header.components());
  std::vector<int32_t*> pointers;
  for (std::vector<int32_t>& plane : planes) {
    clearUnmarked(std::span(plane), coded);
    forwardWavelet(specOf(header.wavelet), {plane, header.extent(), coded}, options.threads);
    pointers.push_back(plane.data());
  }
  forwardColourLevels(colour, layout.pyramid(), pointers);
  const auto add = [&](size_t c, size_t region, TrackSource& source) {
    for (const BandPart& part : plan.parts(region)) {
      const int level = layout.subbands()[part.subband].level;
      const double energy = energiesOf(planes.size(), colour, level, weights)[c];
      source.bands.push_back(
          {layout.gather(planes[c], part), layout.energy(part.subband) * energy * unit, worth});
    }
  };
  const size_t regions = plan.regions().size();
  if (regions > 1 && options.toTheEnd()) {
    const auto source_of = [&](size_t region) {
      TrackSource source{plan.bands(plan.parts(region)), {}};
      for (size_t c = 0; c < planes.size(); ++c) add(c, region, source);
      return source;
    };
    return encodeWholeTracks(regions, source_of, options.threads);
  }
  std::vector<TrackSource> sources(regions);
  for (size_t i = 0; i < regions; ++i) sources[i].plan = plan.bands(plan.parts(i));
  for (size_t c = 0; c < planes.size(); ++c) {
    parallelFor(options.threads, regions, [&](size_t i) { add(c, i, sources[i]); });
    planes[c] = std::vector<int32_t>();  // {} would keep its memory
  }
  return encodeTracks(sources, options);
}

/// Coding ends at half of the error that is to be reached: the account is not as exact as that, and
/// samples are rounded, which matters where few steps are left.
TrackOptions untilReached(const TextureOptions& options, uint64_t samples) {
  TrackOptions tracks{options.limit, options.threads};
  if (options.mean_square > 1)
    tracks.enough = options.mean_square / 2 * static_cast<double>(samples);
  return tracks;
}

/// How many bits the samples of the channels have, of which those with tables are places.
int bitsOf(const Texels& texels, uint32_t channels, const FewValues& few) {
  int bits = 1;
  for (uint32_t c = 0; c < channels; ++c) {
    const size_t values = few.tables[c].size();
    bits = std::max(bits, values == 0 ? texels.bits : static_cast<int>(std::bit_width(values - 1)));
  }
  return bits;
}

/// What bridges are chosen for, behind an opening of so many bytes. Colours take about a third of
/// those that are left.
BridgeTarget bridgeTarget(Purpose purpose, const TextureOptions& options, uint32_t channels,
                          uint64_t opening_bytes) {
  BridgeTarget target{purpose};
  if (purpose == Purpose::kLossless) return target;
  target.mean_square = options.mean_square;
  if (options.room == UINT64_MAX) return target;
  const uint64_t left = options.room - std::min(options.room, opening_bytes);
  target.bytes = channels >= 3 ? left / 3 * 2 : left;
  return target;
}

/// The bridges of `like`, or those that pay, with the planes filled there.
TextureBridges bridgesFor(const ChannelPlanes& channels, int bits, const BridgeTarget& target,
                          const TextureHeader* like) {
  return like != nullptr ? textureBridges(channels, like->bridge)
                         : chooseTextureBridges(channels, bits, target);
}

/// few: none, or tables of the samples that are coded.
EncodedTexture encode(const TextureSource& source, Purpose purpose, const TextureOptions& options,
                      Mask photograph, const TextureHeader* like, const FewValues& few) {
  const Texels& texels = source.texels;
  const std::vector<uint8_t>& seen = source.cutout;
  const bool hidden = !seen.empty() && purpose == Purpose::kLossy;
  Planes planes = separate(texels, source.colours());
  for (size_t c = 0; c < planes.size(); ++c)
    if (!few.tables[c].empty()) samplesToPlaces(few.tables[c], planes[c]);
  std::vector<uint8_t> common;
  if (hidden && !photograph.all()) common = intersection(seen, photograph);
  const Mask coded = !common.empty() ? Mask(common) : hidden ? Mask(seen) : photograph;
  std::vector<uint8_t> mask, overlay;
  if (!seen.empty()) mask = encodeValidity({seen, texels.extent()});
  if (!photograph.all()) overlay = encodeOverlay(texels, photograph);
  hideColours(coded, planes);
  const int bits = bitsOf(texels, source.colours(), few);
  const BridgeTarget target =
      bridgeTarget(purpose, options, source.colours(), mask.size() + overlay.size());
  const TextureBridges bridges = bridgesFor({texels.extent(), coded, &planes}, bits, target, like);
  const LiftedTexels lifted{bridges.lifting(coded), bridges.share};
  auto [colour, wavelet] = fitAndTransform(texels, purpose, bits, lifted.texels, like, planes);
  if (options.windows) wavelet = withShortReach(wavelet);
  EncodedTexture encoded{makeHeader(texels, colour, wavelet, planes.size(), few), {}};
  TextureHeader& header = encoded.header;
  header.hidden = hidden;
  if (options.priorities != nullptr) header.priorities = headerOf(*options.priorities);
  if (options.visual) header.weights = visualWeights(header.components());
  header.regions.side_log2 = static_cast<uint8_t>(options.region_log2);
  header.alpha_bytes = mask.size();
  header.overlay_bytes = overlay.size();
  header.bridge = bridges.reach;
  const uint64_t counted = countedSamples(texels, source.counted(hidden));
  double squares = 0;  // by the first component, which holds most of the bits
  if (wavelet.fraction_bits == 0)
    squares = lifted.share *
              std::accumulate(few.squares.begin(),
                              few.squares.begin() + static_cast<int>(planes.size()), 0.) *
              roundedSquares({planes.front(), texels.extent(), lifted.texels}, {}, wavelet);
  encoded.tracks =
      encodePlanes(header, colour, few.squares, lifted, untilReached(options, counted), planes);
  header.planes = static_cast<uint8_t>(encoded.tracks.front().planes);
  if (wavelet.fraction_bits == 0)
    header.wavelet.rounded_bytes = roundedBytes(encoded.tracks, squares);
  prependOpening(texels, overlay, mask, encoded.tracks.front());
  return encoded;
}

}  // namespace

EncodedTexture encodeByWavelet(const TextureSource& source, Purpose purpose,
                               const TextureOptions& options, Mask photograph,
                               const TextureHeader* like) {
  const bool in_tables = like != nullptr && like->tables.present;
  assert(!in_tables || purpose == Purpose::kLossless);
  return encode(source, purpose, options, photograph, like,
                in_tables ? fewValuesOf(source, photograph) : FewValues());
}

EncodedTexture encodeInTables(const TextureSource& source, const FewValues& few,
                              const TextureOptions& options, Mask photograph) {
  return encode(source, Purpose::kLossless, options, photograph, nullptr, few);
}

FewValues fewValuesOf(const TextureSource& source, Mask photograph) {
  return fewValuesOf(source.texels, source.colours(), photograph);
}

}  // namespace tetrakis::inline texture

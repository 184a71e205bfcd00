// SPDX-License-Identifier: Apache-2.0
#include "texture_wavelet/texture_encoder.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <iterator>
#include <numeric>
#include <span>
#include <utility>

#include "base/parallel.hpp"
#include "base/portable_math.hpp"
#include "codec/lattice/validity.hpp"
#include "codec/wavelet/choice/filter_choice.hpp"
#include "codec/wavelet/priority_map.hpp"
#include "codec/wavelet/wavelet.hpp"
#include "texture_wavelet/colour/colour.hpp"
#include "texture_wavelet/colour_planes.hpp"
#include "texture_wavelet/drawn/drawn_encoder.hpp"
#include "texture_wavelet/mask/mask.hpp"
#include "texture_wavelet/tables/channel_tables_encoder.hpp"
#include "texture_wavelet/texture_decoder.hpp"

namespace tetrakis::inline texture {

namespace {

/// Coding for a PSNR ends at the target's squared error over this number. A larger number takes
/// time; with a smaller one more textures miss the target and are coded once more.
constexpr double kPartOfTarget = 2;
/// Coding ends early only for targets above this squared error, in texel units: below it rounding
/// counts as much. A smaller number has more textures coded twice.
constexpr double kLeastSquares = 1;
/// The squared error that an overlay takes off texels, as a part of the squared range: without it
/// colours are off by half the range. A smaller number puts overlays further ahead of other bytes.
constexpr double kOverlayPart = 4;

}  // namespace

std::vector<double> energiesOf(size_t planes, const ColourTransform& colour, int level,
                               const ChannelWeights& weights) {
  std::vector<double> energies(weights.begin(), weights.begin() + static_cast<int>(planes));
  if (planes >= 3) {
    const std::array<double, 3> rgb =
        planeEnergies(colour, level, {weights[0], weights[1], weights[2]});
    std::copy(rgb.begin(), rgb.end(), energies.begin());
  }
  if (planes % 2 == 0) {
    const std::array<double, 3> further = furtherEnergies(colour, planes, level);
    for (size_t c = 0; c + 1 < planes; ++c) energies[c] += weights[planes - 1] * further[c];
  }
  return energies;
}

// 16 log2 of amplitudes is 8 log2 of energies.
std::array<int64_t, 4> prioritiesOf(size_t planes, const ColourTransform& colour,
                                    const ChannelWeights& weights) {
  const std::vector<double> energies = energiesOf(planes, colour, 1, weights);
  const double usual =
      *std::min_element(weights.begin(), weights.begin() + static_cast<int>(planes));
  std::array<int64_t, 4> priorities{};
  for (size_t c = 0; c < planes; ++c) {
    const double priority = std::round(8 * portable::log2(energies[c] / usual));
    priorities[c] = static_cast<int64_t>(std::clamp(priority, -128.0, 128.0));
  }
  return priorities;
}

void describeColour(const ColourTransform& colour, TextureHeader& header) {
  header.centre = colour.centre;
  header.colour_order = colour.order;
  std::copy(colour.shears.begin(), colour.shears.end(), header.colour_shears.front().begin());
  for (const Shears& shears : colour.level_shears)
    std::copy(shears.begin(), shears.end(), header.colour_shears.emplace_back().begin());
  std::copy(colour.further_shears.begin(), colour.further_shears.end(),
            header.further_shears.begin());
}

namespace {

/// The codewords ahead of the coefficients: the mask of a cut-out, then the overlay. Empty: there
/// is none.
struct Opening {
  std::vector<uint8_t> alpha, overlay;

  size_t bytes() const { return alpha.size() + overlay.size(); }
};

Opening encodeOpening(const WaveletCoding& coding) {
  const TextureSource& source = coding.source;
  Opening opening;
  if (!source.cutout.empty())
    opening.alpha = encodeValidity({source.cutout, source.texels.extent()});
  if (!coding.photograph.all()) opening.overlay = encodeOverlay(source.texels, coding.photograph);
  return opening;
}

/// The header, but for what coding the coefficients tells.
TextureHeader textureHeaderOf(const WaveletCoding& coding, const ColourPlanes& colours,
                              const Opening& opening) {
  const auto& [source, purpose, options, photograph, like, few] = coding;
  TextureHeader header;
  header.width = source.texels.width;
  header.height = source.texels.height;
  header.channels = static_cast<uint8_t>(source.texels.channels);
  header.opaque = source.texels.opaque;
  header.white_level = source.texels.white_level;
  header.sample = source.texels.bits == 8 ? TKS_U8 : TKS_U16;
  header.wavelet = colours.wavelet;
  header.wavelet.ring = source.ring;
  header.wavelet.forest = source.forest;
  describeColour(colours.colour, header);
  header.priority = prioritiesOf(colours.planes.size(), colours.colour, few.squares);
  if (!few.none()) header.tables = headerOf(few.tables, source.texels.bits);
  if (options.priorities != nullptr) header.priorities = headerOf(*options.priorities);
  header.regions.side_log2 = static_cast<uint8_t>(options.region_log2);
  header.hidden = coding.hides();
  header.alpha_bytes = opening.alpha.size();
  header.overlay_bytes = opening.overlay.size();
  header.bridge = colours.bridges.reach;
  if (options.visual) header.weights = visualWeights(header.colourPlanes());
  return header;
}

/// Texels that are neither hidden nor drawn over; empty: all.
std::vector<uint8_t> codedTexels(const WaveletCoding& coding) {
  const std::span<const uint8_t> photograph = coding.photograph.bytes();
  if (!coding.hides()) return {photograph.begin(), photograph.end()};
  std::vector<uint8_t> coded = coding.source.cutout;
  for (size_t i = 0; i < photograph.size(); ++i) coded[i] &= photograph[i];
  return coded;
}

/// Colour planes as the wavelet leaves them, and what tracks are made of them with.
struct TransformedPlanes {
  const TexturePlan& plan;
  ColourTransform colour;
  ChannelWeights weights;
  std::vector<std::vector<int32_t>> planes;
  double unit;  ///< squared samples in a squared unit of coefficients
  std::array<double, kPriorities> worth;

  /// What a region holds of a colour plane.
  std::vector<BandSource> bandsOf(size_t plane, size_t region) const {
    const PlaneLayout& layout = plan.layout();
    std::vector<BandSource> bands;
    for (const BandPart& part : plan.parts(region)) {
      const int level = layout.subbands()[part.subband].level;
      const double energy = energiesOf(planes.size(), colour, level, weights)[plane];
      bands.push_back(
          {layout.gather(planes[plane], part), layout.energy(part.subband) * energy * unit, worth});
    }
    return bands;
  }
};

void append(std::vector<BandSource> bands, std::vector<BandSource>& to) {
  std::move(bands.begin(), bands.end(), std::back_inserter(to));
}

/// Colour planes to coefficients. lifted: the texels that have some.
std::vector<std::vector<int32_t>> forwardPlanes(const TextureHeader& header, const Pyramid& pyramid,
                                                Mask lifted, uint32_t threads,
                                                std::vector<std::vector<int32_t>> planes) {
  assert(planes.size() == header.colourPlanes());
  std::vector<int32_t*> pointers;
  for (std::vector<int32_t>& plane : planes) {
    clearUnmarked(std::span(plane), lifted);
    forwardWavelet(specOf(header.wavelet), pyramid, plane, threads);
    pointers.push_back(plane.data());
  }
  forwardColourLevels(colourOf(header), pyramid, pointers);
  return planes;
}

/// Each plane is given up once all of its coefficients are gathered.
std::vector<EncodedTrack> encodePlanes(TransformedPlanes transformed, const TrackOptions& options) {
  const TexturePlan& plan = transformed.plan;
  const size_t regions = plan.regions().size(), planes = transformed.planes.size();
  const auto plan_of = [&](size_t region) { return plan.bands(plan.parts(region)); };
  if (regions > 1 && options.toTheEnd()) {
    const auto source_of = [&](size_t region) {
      TrackSource source{plan_of(region), {}};
      for (size_t c = 0; c < planes; ++c) append(transformed.bandsOf(c, region), source.bands);
      return source;
    };
    return encodeWholeTracks(regions, source_of, options.threads);
  }
  std::vector<TrackSource> sources(regions);
  for (size_t i = 0; i < regions; ++i) sources[i].plan = plan_of(i);
  for (size_t c = 0; c < planes; ++c) {
    parallelFor(options.threads, regions,
                [&](size_t i) { append(transformed.bandsOf(c, i), sources[i].bands); });
    transformed.planes[c] = std::vector<int32_t>();  // {} would keep its memory
  }
  return encodeTracks(sources, options);
}

}  // namespace

// Coding ends at a part of the error that is to be reached: the account is not as exact as that,
// and samples are rounded, which matters where few steps are left.
TrackOptions untilReached(const TextureOptions& options, uint64_t samples) {
  TrackOptions tracks{options.limit, options.threads};
  if (options.mean_square > kLeastSquares)
    tracks.enough = options.mean_square / kPartOfTarget * static_cast<double>(samples);
  return tracks;
}

namespace {

/// roundedSquares() of all planes, by the first, which holds most of the bits.
double roundedSquaresOf(const WaveletCoding& coding, const ColourPlanes& colours, Mask lifted) {
  const auto& squares = coding.few.squares;
  const double channels = std::accumulate(
      squares.begin(), squares.begin() + static_cast<int>(colours.planes.size()), 0.);
  return colours.bridges.share * channels *
         roundedSquares({colours.planes.front(), coding.source.texels.extent(), lifted}, {},
                        colours.wavelet);
}

void prepend(std::span<const uint8_t> opening, double worth, EncodedTrack& track) {
  if (opening.empty()) return;
  track.codeword.insert(track.codeword.begin(), opening.begin(), opening.end());
  for (RatePoint& point : track.points) point.bytes += opening.size();
  track.points.insert(track.points.begin(), {0, track.points.front().distortion + worth, false,
                                             track.points.front().beyond});
}

/// The track with the mask of a cut-out first, then the overlay: without them alphas are all wrong,
/// and colours off by half the range.
EncodedTrack withOpening(const Opening& opening, const Texels& texels, EncodedTrack track) {
  const double most = texels.white();
  const auto samples = static_cast<double>(texels.samples.size());
  prepend(opening.overlay, most * most / kOverlayPart * samples, track);
  prepend(opening.alpha, most * most * samples / texels.channels, track);
  return track;
}

EncodedTexture encode(const WaveletCoding& coding) {
  const auto& [source, purpose, options, photograph, like, few] = coding;
  const std::vector<uint8_t> coded = codedTexels(coding);
  const Opening opening = encodeOpening(coding);
  ColourPlanes colours = colourPlanesOf(coding, coded, opening.bytes());
  const Mask lifted = colours.bridges.lifting(coded);
  EncodedTexture encoded{textureHeaderOf(coding, colours, opening), {}};
  TextureHeader& header = encoded.header;
  const bool whole = header.wavelet.fraction_bits == 0;
  const double rounded_squares = whole ? roundedSquaresOf(coding, colours, lifted) : 0;
  const TexturePlan plan(header, sharedBits(lifted, header.extent()));
  TransformedPlanes planes{
      plan,
      colours.colour,
      few.squares,
      forwardPlanes(header, plan.layout().pyramid(), lifted, options.threads,
                    std::move(colours.planes)),
      colours.bridges.share * portable::exp2(-2 * header.wavelet.fraction_bits),
      worthOf(priorityMapOf(header.priorities, header.extent()))};
  const uint64_t counted = countedSamples(source.texels, source.counted(purpose));
  encoded.tracks = encodePlanes(std::move(planes), untilReached(options, counted));
  header.planes = static_cast<uint8_t>(encoded.tracks.front().planes);
  if (whole) header.wavelet.rounded_bytes = roundedBytes(encoded.tracks, rounded_squares);
  EncodedTrack& first = encoded.tracks.front();
  first = withOpening(opening, source.texels, std::move(first));
  return encoded;
}

}  // namespace

EncodedTexture encodeByWavelet(const TextureSource& source, Purpose purpose,
                               const TextureOptions& options, Mask photograph,
                               const TextureHeader* like) {
  const bool in_tables = like != nullptr && like->tables.present;
  assert(!in_tables || purpose == Purpose::kLossless);
  return encode({source, purpose, options, photograph, like,
                 in_tables ? fewValuesOf(source, photograph) : FewValues()});
}

EncodedTexture encodeInTables(const TextureSource& source, const FewValues& few,
                              const TextureOptions& options, Mask photograph) {
  return encode({source, Purpose::kLossless, options, photograph, nullptr, few});
}

FewValues fewValuesOf(const TextureSource& source, Mask photograph) {
  return fewValuesOf(source.texels, source.colours(), photograph);
}

}  // namespace tetrakis::inline texture

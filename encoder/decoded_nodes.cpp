// SPDX-License-Identifier: Apache-2.0
#include "encoder/decoded_nodes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>

#include "codec/geometry/steps/height_samples.hpp"
#include "encoder/view_inputs.hpp"

namespace tetrakis::inline encoder {

namespace {

/// At 6 texels or 12 heights a byte, detail that the prefix holds would be missing where the next
/// level is just not reached: errors of every other node were up to two thirds too large.
/// Priorities put the bytes where cameras are near.
constexpr uint64_t kTexelsPerByte = 24, kSamplesPerByte = 24, kNearCameras = 4, kLeast = 4096;
/// Details that are left out would take off less than this part of the error that is left. Errors
/// are then up to 6 % too large, most of it because texels are filtered between others further
/// apart.
constexpr double kTimesLeft = 32;

/// The heights that a view of a coarser level shows, with the last ones once more where they do not
/// reach the border.
std::vector<float> toBorder(std::vector<float> shown, Extent extent, Extent reaching) {
  if (extent == reaching) return shown;
  std::vector<float> heights;
  heights.reserve(reaching.samples());
  for (uint32_t y = 0; y < reaching.height; ++y) {
    const float* row = &shown[size_t{std::min(y, extent.height - 1)} * extent.width];
    heights.insert(heights.end(), row, row + extent.width);
    if (extent.width < reaching.width) heights.push_back(row[extent.width - 1]);
  }
  return heights;
}

/// What few bytes can show is shown by the coarser levels as well, in less time: one that every
/// wavelet has, of at least so many samples.
View enoughOf(Extent whole, uint64_t samples) {
  View view;
  const uint64_t enough = std::max(samples, kLeast);
  while (view.extentIn(whole).samples() / 4 >= enough &&
         std::min(whole.width, whole.height) >> (view.level + 1) >= 32)
    ++view.level;
  return view;
}

/// What a decoder is given of a component, and told of it.
template <class Coded>
Codewords prefixOf(const Rated<Coded>& rated, uint64_t bytes, TrackMemory& memory) {
  const CodedTracks tracks = rated.coded.rated();
  if (!endsWithPasses(rated)) return prefixAfter(tracks, rated.curve.packets, bytes);
  memory.passes_within = bytes - std::min(bytes, tracks.opening);
  return codewordsOf(tracks.tracks);
}

}  // namespace

DecodedNodes::DecodedNodes(const EncodeInputs& inputs, const Rated<CodedHeights>& heights,
                           const Rated<CodedTexture>& texture)
    : inputs_(inputs), heights_(heights), texture_(texture) {
  heights_memory_.tracks.all_levels = texture_memory_.tracks.all_levels = true;
  if (looksAtMeshes(inputs, *heights.coded.of))
    mesh_.emplace(inputs, *heights.coded.of, texture.coded.of->texels);
}

DecodedNodes::Samples DecodedNodes::heightsAt(uint64_t bytes, const View& view) {
  const CodedHeights& coded = heights_.coded;
  DecodedHeights shown = decodedAt(bytes, view);
  std::vector<std::byte> samples(tks_sample_bytes(inputs_.heights->sample) *
                                 shown.geometry.heights.size());
  fromSteps(shown, coded.header, coded.layers, samples.data());
  return {std::move(samples), std::move(shown.geometry.valid)};
}

Relief DecodedNodes::shownAt(uint64_t bytes) {
  if (mesh_) {
    std::optional<Relief> mesh = mesh_->ofDecoded(decodedAt(bytes, mesh_->view()).geometry);
    if (mesh) return std::move(*mesh);
  }
  return reliefAt(bytes);
}

/// Voids have every sample of their border.
Relief DecodedNodes::reliefAt(uint64_t bytes) {
  const tks_heights& whole = *inputs_.heights;
  const Extent extent{whole.width, whole.height};
  View view;
  if (heights_.coded.of->steps.valid.empty()) view = enoughOf(extent, kSamplesPerByte * bytes);
  const Samples samples = heightsAt(bytes, view);
  tks_heights shown = whole;
  shown.width = view.extentIn(extent).width;
  shown.height = view.extentIn(extent).height;
  Relief relief = reliefOf(shown, samples.data.data(), samples.valid);
  relief.frame = frameOf(whole);
  relief.step = view.step();
  relief.heights = toBorder(std::move(relief.heights), view.extentIn(extent), relief.extent());
  return relief;
}

Relief DecodedNodes::original() const {
  return reliefOf(*inputs_.heights, inputs_.heights->data, heights_.coded.of->steps.valid);
}

/// About what the details of a level that a state holds take off the squared error of a sample.
double DecodedNodes::heldOf(int level, const TrackState& state) const {
  // Most details have become significant in the last planes.
  constexpr double kTypical = 2;  // magnitude, in units of the last plane
  const TextureHeader& header = texture_.coded.header;
  const std::vector<Subband>& subbands = plan_->layout().subbands();
  std::vector<double> energies(header.components(), 1);  // of components
  if (energies.size() >= 3)
    std::ranges::copy(componentEnergies(colourOf(header), level), energies.begin());
  double squares = 0;
  for (size_t i = 0; i < state.bands.size(); ++i) {
    const size_t subband = i % subbands.size();
    if (subbands[subband].level != level) continue;
    const Tier& tier = state.bands[i].tier.front();
    const double typical = kTypical * std::ldexp(1, tier.plane - header.wavelet.fraction_bits);
    squares += energies[i / subbands.size()] * plan_->layout().energy(subband) *
               tier.significant_count * typical * typical;
  }
  return squares / texture_.coded.counted();
}

/// The level that the bytes may show, or the next coarser one where the prefix holds nearly nothing
/// of the details between them.
View DecodedNodes::textureView(const RatePoint& node) {
  const CodedTexture& coded = texture_.coded;
  const Extent whole = coded.header.extent();
  TrackMemory& tracks = texture_memory_.tracks;
  const bool near_cameras = !coded.header.priorities.none();
  const View view =
      enoughOf(whole, (near_cameras ? kNearCameras : 1) * kTexelsPerByte * node.bytes);
  const View coarser = enoughOf(whole, view.extentIn(whole).samples() / 4);
  const bool known = !tracks.tracks.empty() && tracks.tracks.front();
  if (near_cameras || !endsWithPasses(texture_) || !known || coarser.level == view.level)
    return view;
  if (!plan_) plan_.emplace(coded.header, Mask(), tracks.norms);
  const std::span<const uint8_t> codeword = prefixOf(texture_, node.bytes, tracks).front();
  const TrackState& state = tracks.decode(0, codeword.subspan(coded.rated().opening));
  return heldOf(coarser.level, state) * kTimesLeft < node.distortion ? coarser : view;
}

ScreenTexture DecodedNodes::textureAt(const RatePoint& node) {
  View view;
  if (!texture_.coded.header.direct()) view = textureView(node);
  return {texelsAt(node.bytes, view), texture_.coded.header.extent(), view.level};
}

Texels DecodedNodes::texelsAt(uint64_t bytes, const View& view) {
  const CodedTexture& coded = texture_.coded;
  const Codewords prefix = prefixOf(texture_, bytes, texture_memory_.tracks);
  return decodeTexture(coded.header, prefix, view, {inputs_.options.threads, &texture_memory_});
}

DecodedHeights DecodedNodes::decodedAt(uint64_t bytes, const View& view) {
  const CodedHeights& coded = heights_.coded;
  const Codewords prefix = prefixOf(heights_, bytes, heights_memory_.tracks);
  return decodeHeights(coded.header, coded.layers, prefix, view,
                       {inputs_.options.threads, &heights_memory_});
}

}  // namespace tetrakis::inline encoder

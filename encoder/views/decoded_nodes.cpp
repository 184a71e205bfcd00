// SPDX-License-Identifier: Apache-2.0
#include "encoder/views/decoded_nodes.hpp"

#include <algorithm>
#include <utility>

#include "codec/geometry/steps/decoded_heights.hpp"
#include "encoder/views/view_inputs.hpp"

namespace tetrakis::inline views {

namespace {

/// Texels and samples for each byte of a prefix, of the level that is decoded. With 6 texels or 12
/// heights a byte, detail that the prefix holds would be missing where the next level is just not
/// reached: errors of every other node were up to two thirds too large. Priorities put the bytes
/// where cameras are near. Larger numbers take the time of finer levels.
constexpr uint64_t kTexelsPerByte = 24, kSamplesPerByte = 24, kNearCameras = 4;
/// Texels or samples of the coarsest level that is decoded, and its least side, at least. Larger
/// numbers show the first nodes more exactly, and take time.
constexpr uint64_t kLeast = 4096, kLeastSide = 32;

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

/// The coarsest level that shows all that few bytes can show, in less time than the whole plane: a
/// level that every wavelet has, with `samples` samples or more. A forest is shown whole: pictures
/// look samples up in its raster, and the rasters of its levels hold patches at other places.
View enoughOf(const WaveletHeader& wavelet, Extent whole, uint64_t samples) {
  View view;
  if (wavelet.forest != nullptr) return view;
  const uint64_t enough = std::max(samples, kLeast);
  while (view.extentIn(whole).samples() / 4 >= enough &&
         std::min(whole.width, whole.height) >> (view.level + 1) >= kLeastSide)
    ++view.level;
  return view;
}

/// The codewords that a decoder gets with the first bytes of a component. memory: learns where
/// whole passes end.
template <class Coded>
Codewords prefixOf(const Rated<Coded>& rated, uint64_t bytes, TrackMemory& memory) {
  const CodedTracks tracks = rated.coded.accounted();
  if (!endsWithPasses(rated)) return prefixAfter(tracks, rated.curve.packets, bytes);
  memory.passes_within = bytes - std::min(bytes, tracks.opening);
  return codewordsOf(tracks.tracks);
}

}  // namespace

DecodedNodes::DecodedNodes(const EncodeInputs& inputs, const Rated<CodedHeights>& heights,
                           const Rated<CodedTexture>& texture)
    : inputs_(inputs), heights_(heights), texture_(texture) {
  heights_memory_.tracks.all_levels = texture_memory_.tracks.all_levels = true;
  if (looksAtMeshes(inputs, *heights.coded.quantised))
    mesh_.emplace(inputs, *heights.coded.quantised, texture.coded.source->texels);
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
  if (heights_.coded.quantised->steps.valid.empty())
    view = enoughOf(heights_.coded.header.wavelet, extent, kSamplesPerByte * bytes);
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
  return reliefOf(*inputs_.heights, inputs_.heights->data, heights_.coded.quantised->steps.valid);
}

ScreenTexture DecodedNodes::textureAt(uint64_t bytes) {
  const CodedTexture& coded = texture_.coded;
  const Extent whole = coded.header.extent();
  View view;
  const uint64_t near = coded.header.priorities.none() ? 1 : kNearCameras;
  if (!coded.header.direct())
    view = enoughOf(coded.header.wavelet, whole, near * kTexelsPerByte * bytes);
  return {texelsAt(bytes, view), whole, view.level};
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

}  // namespace tetrakis::inline views

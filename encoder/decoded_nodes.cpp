// SPDX-License-Identifier: Apache-2.0
#include "encoder/decoded_nodes.hpp"

#include <algorithm>
#include <utility>

#include "encoder/view_inputs.hpp"

namespace tetrakis::inline encoder {

namespace {

constexpr uint64_t kTexelsPerByte = 8, kSamplesPerByte = 16, kLeast = 4096;

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

}  // namespace

DecodedNodes::DecodedNodes(const EncodeInputs& inputs, const Rated<CodedHeights>& heights,
                           const Rated<CodedTexture>& texture)
    : inputs_(inputs), heights_(heights), texture_(texture) {
  heights_memory_.tracks.all_levels = texture_memory_.tracks.all_levels = true;
  if (looksAtMeshes(inputs, *heights.coded.of))
    mesh_.emplace(inputs, *heights.coded.of, texture.coded.of->texels);
}

DecodedNodes::Samples DecodedNodes::heightsAt(size_t point, const View& view) {
  const CodedHeights& coded = heights_.coded;
  DecodedHeights shown = decodedAt(point, view);
  std::vector<std::byte> samples(tks_sample_bytes(inputs_.heights->sample) *
                                 shown.geometry.heights.size());
  fromSteps(shown, coded.header, coded.layers, samples.data());
  return {std::move(samples), std::move(shown.geometry.valid)};
}

Relief DecodedNodes::shownAt(size_t point) {
  if (mesh_) {
    std::optional<Relief> mesh = mesh_->ofDecoded(decodedAt(point, mesh_->view()).geometry);
    if (mesh) return std::move(*mesh);
  }
  return reliefAt(point);
}

/// Voids have every sample of their border.
Relief DecodedNodes::reliefAt(size_t point) {
  const tks_heights& whole = *inputs_.heights;
  const Extent extent{whole.width, whole.height};
  View view;
  if (heights_.coded.of->steps.valid.empty())
    view = enoughOf(extent, kSamplesPerByte * heights_.curve.points[point].bytes);
  const Samples samples = heightsAt(point, view);
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

ScreenTexture DecodedNodes::textureAt(size_t point) {
  const CodedTexture& coded = texture_.coded;
  const Extent whole = coded.header.extent();
  View view;
  if (!coded.header.direct())
    view = enoughOf(whole, kTexelsPerByte * texture_.curve.points[point].bytes);
  return {texelsAt(point, view), whole, view.level};
}

Texels DecodedNodes::texelsAt(size_t point, const View& view) {
  const CodedTexture& coded = texture_.coded;
  const uint64_t bytes = texture_.curve.points[point].bytes;
  const Codewords prefix = prefixAfter(coded.rated(), texture_.curve.packets, bytes);
  return decodeTexture(coded.header, prefix, view, {inputs_.options.threads, &texture_memory_});
}

DecodedHeights DecodedNodes::decodedAt(size_t point, const View& view) {
  const CodedHeights& coded = heights_.coded;
  const uint64_t bytes = heights_.curve.points[point].bytes;
  const Codewords prefix = prefixAfter(coded.rated(), heights_.curve.packets, bytes);
  return decodeHeights(coded.header, coded.layers, prefix, view,
                       {inputs_.options.threads, &heights_memory_});
}

}  // namespace tetrakis::inline encoder

// SPDX-License-Identifier: Apache-2.0
// TexturePlan lists the bands of a texture, and takeOpening() decodes the layers before its
// coefficients.
#include "texture_wavelet/texture_decoder.hpp"

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <utility>

#include "codec/lattice/validity.hpp"
#include "codec/wavelet/morphology.hpp"
#include "codec/wavelet/wavelet.hpp"

namespace tetrakis::inline texture {

namespace {

/// The first so many bytes, which are taken off.
std::span<const uint8_t> take(uint64_t bytes, std::span<const uint8_t>& codeword) {
  const auto taken =
      codeword.first(static_cast<size_t>(std::min<uint64_t>(bytes, codeword.size())));
  codeword = codeword.subspan(taken.size());
  return taken;
}

/// seen: null: all texels.
BitPlane notDrawnOver(const DrawnOverlay& overlay, Extent plane, const BitPlane* seen) {
  BitPlane coded = seen != nullptr ? *seen : BitPlane(plane);
  if (seen == nullptr) coded.invert();
  for (uint32_t y = 0; y < plane.height; y += overlay.step) {
    uint64_t* const row = coded.row(y);
    const size_t first = size_t{y} * plane.width;
    for (uint32_t x = 0; x < plane.width; x += overlay.step)
      row[x / kWordBits] &= ~(uint64_t{overlay.covers(first + x)} << x % kWordBits);
  }
  return coded;
}

TextureOpening decodeOpening(const TextureHeader& header, std::span<const uint8_t> alpha,
                             std::span<const uint8_t> drawn, const OpeningMemory* memory) {
  TextureOpening opening;
  if (header.alpha_bytes > 0) opening.seen = shared(decodeValidity(alpha, header.extent()));
  if (header.hidden) opening.coded = opening.seen;
  if (header.overlay_bytes > 0) {
    opening.overlay = memory != nullptr && memory->overlay ? memory->overlay(drawn.size())
                                                           : decodeOverlay(header, drawn);
    opening.coded = shared(notDrawnOver(opening.overlay, header.extent(), opening.coded.get()));
  }
  opening.lifted = liftedSamples(opening.coded, header.bridge);
  return opening;
}

}  // namespace

void TextureOpening::paint(Extent whole, const View& view, Texels& texels) const {
  if (overlay.indices.size() == 0) return;
  assert(texels.extent() == view.extentIn(whole));
  uint16_t* out = texels.samples.data();
  for (uint32_t y = 0; y < texels.height; ++y) {
    const size_t row = view.firstColumn() + size_t{view.rowOf(y)} * whole.width;
    for (uint32_t x = 0; x < texels.width; ++x, out += texels.channels) {
      const size_t texel = row + size_t{x} * view.step();
      if (!overlay.covers(texel)) continue;
      std::copy_n(overlay.colours[overlay.indices[texel]].begin(), texels.channels, out);
    }
  }
}

std::shared_ptr<const TextureOpening> takeOpening(const TextureHeader& header,
                                                  OpeningMemory* memory,
                                                  std::span<const uint8_t>& codeword) {
  const auto alpha = take(header.alpha_bytes, codeword);
  const auto drawn = take(header.overlay_bytes, codeword);
  const bool whole = alpha.size() == header.alpha_bytes && drawn.size() == header.overlay_bytes;
  if (memory != nullptr && whole && memory->whole != nullptr) return memory->whole;
  auto opening =
      std::make_shared<const TextureOpening>(decodeOpening(header, alpha, drawn, memory));
  if (memory != nullptr && whole) memory->whole = opening;
  return opening;
}

namespace {

/// Contexts: of the first colour plane, of the other colours, of alpha.
uint32_t modelsOf(const TextureHeader& header, uint32_t plane) {
  return kPlaneModels * (header.isAlpha(plane) ? 2 : plane == 0 ? 0 : 1);
}

}  // namespace

TexturePlan::TexturePlan(const TextureHeader& header, const SharedBits& coded,
                         const std::optional<SynthesisNorms>& norms)
    : layout_(specOf(header.wavelet), pyramidOf(specOf(header.wavelet), coded, header.extent()),
              priorityMapOf(header.priorities, header.extent()), norms),
      regions_(regionsOf(header.width, header.height, header.regions.side_log2,
                         header.wavelet.patches())),
      weights_(header.weights) {
  for (uint32_t c = 0; c < header.colourPlanes(); ++c)
    planes_.push_back({static_cast<int>(header.priority[c]), modelsOf(header, c)});
}

std::vector<BandPlan> TexturePlan::bands(std::span<const BandPart> parts) const {
  std::vector<BandPlan> bands;
  for (uint32_t c = 0; c < planes_.size(); ++c) {
    const PlaneBands& own = planes_[c];
    const auto first = static_cast<int>(bands.size());
    std::vector<BandPlan> plan = layout_.plan(parts, first, own.priority, own.models);
    if (c == 0) plan = layout_.marked(parts, std::move(plan));
    for (size_t i = 0; i < plan.size(); ++i) {
      BandPlan& band = plan[i];
      const Subband& subband = layout_.subbands()[parts[i].subband];
      band.log_norm += static_cast<int>(weights_.at(c, subband.level, subband.orientation));
      if (first > 0) {
        band.companion = static_cast<int>(bands.size() - parts.size());
        band.absent = bands[i].absent;
        band.tiers = bands[i].tiers;
      }
      bands.push_back(std::move(band));
    }
  }
  return bands;
}

ColourTransform colourOf(const TextureHeader& header) {
  ColourTransform transform;
  transform.centre = header.centre;
  transform.order = header.colour_order;
  const auto shears_at = [&](size_t i) {
    Shears shears;
    std::transform(header.colour_shears[i].begin(), header.colour_shears[i].end(), shears.begin(),
                   [](int64_t shear) { return static_cast<int16_t>(shear); });
    return shears;
  };
  transform.shears = shears_at(0);
  for (size_t i = 1; i < header.colour_shears.size(); ++i)
    transform.level_shears.push_back(shears_at(i));
  std::transform(header.further_shears.begin(), header.further_shears.end(),
                 transform.further_shears.begin(),
                 [](int64_t shear) { return static_cast<int16_t>(shear); });
  return transform;
}

}  // namespace tetrakis::inline texture

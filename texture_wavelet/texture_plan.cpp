// SPDX-License-Identifier: Apache-2.0
#include "texture_wavelet/texture_plan.hpp"

#include <algorithm>
#include <utility>

#include "codec/wavelet/wavelet_header.hpp"

namespace tetrakis::inline texture {

namespace {

/// Contexts: of the first colour plane, of the other colours, of alpha.
uint32_t modelsOf(const TextureHeader& header, uint32_t plane) {
  return kPlaneModels * (header.isAlpha(plane) ? 2 : plane == 0 ? 0 : 1);
}

}  // namespace

TexturePlan::TexturePlan(const TextureHeader& header, const SharedBits& coded,
                         const std::optional<SynthesisNorms>& norms)
    : layout_(specOf(header.wavelet), Pyramid(coded, header.extent()),
              priorityMapOf(header.priorities, header.extent()), norms),
      regions_(regionsOf(header.width, header.height, header.regions.side_log2)),
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

// SPDX-License-Identifier: Apache-2.0
#include "texture_wavelet/texture_plan.hpp"

#include <algorithm>

#include "texture_wavelet/norms.hpp"

namespace tetrakis {

namespace {

/// Half the parent's magnitude (same orientation, one level coarser), and that of the same place in
/// the component before; either may be missing.
class SubbandHints : public HintSource {
 public:
  SubbandHints(const Band* parent, const Band* component)
      : parent_(parent), component_(component) {}
  void fill(uint32_t row, uint32_t column, uint32_t count, uint32_t* hints) const override {
    std::fill_n(hints, count, 0u);
    if (parent_ != nullptr) addParent(row, column, count, hints);
    if (component_ != nullptr) {
      const uint32_t* same = component_->magnitude.data() + component_->shape.cell(row, column);
      for (uint32_t i = 0; i < count; ++i) hints[i] += 2 * same[i];
    }
  }

 private:
  void addParent(uint32_t row, uint32_t column, uint32_t count, uint32_t* hints) const {
    if (parent_->shape.empty()) return;
    const uint32_t last = parent_->shape.columns[0] - 1;
    const uint32_t parent_row = std::min(row / 2, parent_->shape.rows - 1);
    const uint32_t* above = parent_->magnitude.data() + parent_->shape.cell(parent_row, 0);
    for (uint32_t i = 0; i < count; ++i) hints[i] += 2 * above[std::min((column + i) / 2, last)];
  }

  const Band* parent_;
  const Band* component_;
};

/// Contexts: by component (first, other colours, alpha), orientation, and fine or coarse level.
uint32_t modelsOf(const Subband& subband, uint32_t component, uint32_t channels) {
  const bool alpha = channels % 2 == 0 && component + 1 == channels;
  const uint32_t kind = alpha ? 2 : component == 0 ? 0 : 1;
  const auto scale = static_cast<uint32_t>(std::clamp(subband.level, 1, 3) - 1);
  return (kind * 3 + scale) * 4 + static_cast<uint32_t>(subband.orientation);
}

}  // namespace

TexturePlan::TexturePlan(const TextureHeader& header)
    : subbands_(subbandsOf(header.width, header.height)) {
  for (uint32_t c = 0; c < header.channels; ++c) {
    for (const Subband& subband : subbands_) {
      const BandShape shape{subband.height, {subband.width, subband.width}, false};
      const int log_norm = normLog2(subband) + static_cast<int>(header.priority[c]);
      bands_.push_back({shape, log_norm, modelsOf(subband, c, header.channels)});
    }
  }
}

std::unique_ptr<HintSource> TexturePlan::hints(const TrackState& state, uint32_t band) const {
  const size_t index = band % subbands_.size();
  const Band* parent = index >= 4 ? &state.bands[band - 3] : nullptr;
  const Band* component =
      band >= subbands_.size() ? &state.bands[band - subbands_.size()] : nullptr;
  return std::make_unique<SubbandHints>(parent, component);
}

ColourTransform colourOf(const TextureHeader& header) {
  ColourTransform transform;
  transform.centre = header.centre;
  transform.order = header.colour_order;
  for (size_t i = 0; i < transform.shears.size(); ++i) {
    transform.shears[i] = static_cast<int16_t>(header.colour_shears[i]);
  }
  return transform;
}

}  // namespace tetrakis

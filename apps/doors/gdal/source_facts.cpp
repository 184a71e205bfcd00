// SPDX-License-Identifier: Apache-2.0
// What the header says of the component that was chosen.
#include <algorithm>

#include "apps/doors/gdal/source.hpp"

namespace tetrakis::gdal {
namespace {

uint32_t sideOfLevel(uint32_t side, uint32_t level) {
  return static_cast<uint32_t>((side + (uint64_t{1} << level) - 1) >> level);
}

}  // namespace

uint32_t Source::width(uint32_t level) const {
  if (cubeDepth() > 0) return level == 0 ? info_.grid_width : sideOfLevel(round_, level);
  return sideOfLevel(part_ == TKS_PART_HEIGHTS ? info_.width : info_.texture_width, level);
}

uint32_t Source::height(uint32_t level) const {
  if (cubeDepth() > 0) return std::max(sideOfLevel(info_.grid_height, level), 2U);
  return sideOfLevel(part_ == TKS_PART_HEIGHTS ? info_.height : info_.texture_height, level);
}

uint32_t Source::channels() const {
  return part_ == TKS_PART_HEIGHTS ? frames() : info_.texture_channels;
}

uint32_t Source::frames() const {
  return frame_ || part_ != TKS_PART_HEIGHTS ? 1 : info_.frames;
}

bool Source::hasAlpha() const {
  return part_ == TKS_PART_TEXTURE && info_.texture_opaque == 0;
}

bool Source::isDrawn() const {
  return (part_ == TKS_PART_HEIGHTS ? info_.heights_drawn : info_.texture_drawn) == 1;
}

tks_sample Source::sample() const {
  if (cubeDepth() > 0) return TKS_F32;
  return part_ == TKS_PART_HEIGHTS ? info_.sample : info_.texture_sample;
}

uint32_t Source::coarsestLevel() const {
  return part_ == TKS_PART_HEIGHTS ? info_.coarsest_level : info_.texture_coarsest_level;
}

uint32_t Source::regionSide() const {
  if (cubeDepth() > 0) return 0;
  return part_ == TKS_PART_TEXTURE ? info_.texture_regions : info_.regions;
}

}  // namespace tetrakis::gdal

// SPDX-License-Identifier: Apache-2.0
#include "apps/tools/report/patch_atlas.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace tetrakis::tools {

PatchAtlas::PatchAtlas(uint32_t patches, uint32_t depth)
    : patches_(patches),
      side_((1u << depth) + 1),
      columns_(static_cast<uint32_t>(std::ceil(std::sqrt(patches)))),
      rows_((patches + columns_ - 1) / columns_) {}

ImageFile PatchAtlas::pictureOf(const ImageFile& raster) const {
  ImageFile picture = raster;
  picture.width = width();
  picture.height = height();
  const size_t texel = raster.channels * tks_sample_bytes(raster.sample);
  picture.data.resize(texel * picture.width * picture.height);
  auto out = picture.data.begin();
  const auto inPatch = [this](uint32_t at) {
    return std::clamp(at % cell(), 1u, side_) - 1;  // the gutter repeats the border
  };
  for (uint32_t y = 0; y < picture.height; ++y) {
    for (uint32_t x = 0; x < picture.width; ++x) {
      // Places behind the last patch show it again.
      const uint32_t patch = std::min(y / cell() * columns_ + x / cell(), patches_ - 1);
      const size_t row = size_t{patch} * side_ + inPatch(y);
      const auto from =
          raster.data.begin() + static_cast<std::ptrdiff_t>(texel * (row * side_ + inPatch(x)));
      out = std::copy_n(from, texel, out);
    }
  }
  return picture;
}

std::array<double, 2> PatchAtlas::at(uint32_t patch, double x, double y) const {
  const auto across = [this](uint32_t place, double part, uint32_t whole) {
    constexpr double kToMiddle = 1.5;  // over the gutter to the middle of the first texel
    return (static_cast<double>(place) * cell() + kToMiddle + part * (side_ - 1)) / whole;
  };
  return {across(patch % columns_, x, width()), across(patch / columns_, y, height())};
}

}  // namespace tetrakis::tools

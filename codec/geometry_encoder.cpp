// SPDX-License-Identifier: Apache-2.0
#include "codec/geometry_encoder.hpp"

#include <cmath>

#include "codec/geometry_plan.hpp"
#include "codec/lifting.hpp"

namespace tetrakis {

namespace {

BandSource gather(std::span<const int32_t> coefficients, uint32_t width, const Level& level) {
  BandSource source;
  source.values.assign(level.shape.cells(), 0);
  source.weight = std::exp2(logNormOf(level) / 8.0);
  for (uint32_t row = 0; row < level.shape.rows; ++row) {
    const int32_t* from = coefficients.data() + size_t{level.y(row)} * width + level.firstX(row);
    int32_t* to = source.values.data() + level.shape.cell(row, 0);
    for (uint32_t column = 0; column < level.shape.columns[row % 2]; ++column) {
      to[column] = from[size_t{column} * level.pitch()];
    }
  }
  return source;
}

}  // namespace

EncodedTrack encodeGeometry(std::span<const int32_t> heights, uint32_t width, uint32_t height,
                            uint64_t limit, std::span<const uint8_t> valid) {
  std::vector<int32_t> coefficients(heights.begin(), heights.end());
  for (size_t i = 0; i < valid.size(); ++i) coefficients[i] *= valid[i];
  forwardLifting({coefficients, width, height, valid});
  const GeometryPlan plan(width, height);
  std::vector<BandSource> sources;
  for (const Level& level : plan.levels()) sources.push_back(gather(coefficients, width, level));
  return encodeTrack(plan.bands(), sources, plan, limit);
}

}  // namespace tetrakis

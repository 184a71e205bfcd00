// SPDX-License-Identifier: Apache-2.0
#include "encoder/order_packets.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>
#include <string>

#include "base/length_unit.hpp"
#include "codec/mesh/decimation.hpp"
#include "encoder/height_errors.hpp"
#include "ratecontrol/screen_model.hpp"

namespace tetrakis::inline encoder {

namespace {

AuditScope auditScope(const EncodeInputs& inputs, size_t samples) {
  return {samples, inputs.budgeted() ? inputs.options.bytes : UINT64_MAX};
}

/// With a triangle budget, the mean squared error of the heights (in steps) below which more bytes
/// no longer help: a mesh of that many triangles is itself off by sixteen times as much, so that
/// its RMSE would fall by 3 % at most. 0 without a budget.
double meshFloor(const QuantisedHeights& heights, uint32_t triangles) {
  if (triangles == 0) return 0;
  const Result<MeshSequence> sequence =
      decimate({heights.samples->width, heights.samples->height, heights.steps.steps});
  if (!sequence.ok()) return 0;
  const double squares = sequence->squaredError(sequence->bestPrefix(triangles));
  assert(squares >= 0);
  return squares / heights.counted() / 16;
}

/// Texels that the texture moves per metre of height error.
double texelsPerMetre(const EncodeInputs& inputs, const tks_heights& heights,
                      const Texels& texture) {
  const double spacing = heights.spacing_x > 0 ? heights.spacing_x : kUnknownSpacing;
  const double texel = spacing * (heights.width - 1) / texture.width;
  const double parallax = inputs.options.parallax;
  return (parallax > 0 ? parallax : kDefaultParallax) / texel;
}

}  // namespace

ComponentCurve curveOfHeights(const EncodeInputs& inputs, const CodedHeights& heights,
                              const Texels* texture) {
  const QuantisedHeights& source = *heights.of;
  const double samples = heights.counted();
  const double metres = source.samples->unit ? metresPerUnit(source.samples->unit).value_or(1) : 1;
  const double step = source.steps.step * std::abs(source.samples->scale) * metres;
  const double floor = meshFloor(source, inputs.options.triangles);
  const auto useful = [=](double squares) { return std::max(squares / samples, floor); };
  Pricing pricing{samples, useful};
  std::optional<ScreenModel> model;
  if (texture != nullptr) {
    model.emplace(*texture, texelsPerMetre(inputs, *source.samples, *texture));
    pricing.cost = [&](double squares) { return model->cost(useful(squares) * step * step); };
  }
  HeightsMemory memory;
  const auto measure = [&](uint64_t bytes) {
    return squaresOf(heights, prefixAfter(heights.rated(), {}, bytes), inputs.options.threads,
                     &memory);
  };
  return curveOf(heights.rated(), auditScope(inputs, source.steps.steps.size()), measure, pricing);
}

ComponentCurve curveOfTexture(const EncodeInputs& inputs, const CodedTexture& texture) {
  const double samples = texture.counted();
  TextureMemory memory;
  const auto measure = [&](uint64_t bytes) {
    return squaresOf(texture, prefixAfter(texture.rated(), {}, bytes), inputs.options.threads,
                     &memory);
  };
  return curveOf(texture.rated(), auditScope(inputs, texture.of->texels.samples.size()), measure,
                 {samples, [=](double squares) { return squares / samples; }});
}

}  // namespace tetrakis::inline encoder

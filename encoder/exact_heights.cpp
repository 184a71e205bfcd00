// SPDX-License-Identifier: Apache-2.0
#include "encoder/exact_heights.hpp"

#include <cassert>

#include "codec/geometry/drawing_estimate.hpp"
#include "encoder/bounded_heights.hpp"
#include "encoder/quantised_heights.hpp"

namespace tetrakis::inline encoder {

std::shared_ptr<const CodedHeights> exactHeightsFor(const EncodeInputs& inputs, double error,
                                                    uint64_t lossy_bytes) {
  constexpr double kMostSteps = 2;  // of error, if heights are multiples of a step
  assert(inputs.heights != nullptr && inputs.options.lossless == 0);
  tks_encode_options options = inputs.options;
  options.bytes = 0;
  options.psnr = options.max_error = 0;
  options.lossless = 1;
  const EncodeInputs lossless = inputs.with(options, inputs.priorities);
  const Result<std::shared_ptr<const QuantisedHeights>> heights = quantiseHeights(lossless);
  if (!heights.ok()) return nullptr;
  const HeightSteps& steps = (*heights)->steps;
  const PlaneView<const int32_t> plane(steps.steps, extentOf(*inputs.heights), steps.valid);
  if (steps.table.empty() && error > kMostSteps * steps.step && !drawingMayFit(plane, lossy_bytes))
    return nullptr;
  return codeLosslessHeights(lossless, *heights);
}

}  // namespace tetrakis::inline encoder

// SPDX-License-Identifier: Apache-2.0
#include "encoder/mosaic/block.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <string>
#include <type_traits>

#include "base/samples.hpp"
#include "codec/geometry/quantiser/height_steps.hpp"
#include "codec/geometry/steps/restore.hpp"
#include "codec/geometry/steps/sample_order.hpp"
#include "codec/wavelet/wavelet.hpp"

namespace tetrakis::inline mosaic {

namespace {

std::string placeOf(const Window& window, size_t sample) {
  return "The height in column " + std::to_string(window.x + sample % window.width) + ", row " +
         std::to_string(window.y + sample / window.width);
}

}  // namespace

tks_heights heightsOf(const MosaicPlan& plan, const Window& window, const void* samples) {
  tks_heights heights{};
  heights.size = sizeof(heights);
  heights.width = window.width;
  heights.height = window.height;
  heights.sample = static_cast<tks_sample>(plan.geometry().sample);
  heights.data = samples;
  heights.has_nodata = plan.header.layers.has_nodata;
  heights.nodata = plan.header.layers.nodata;
  return heights;
}

Result<std::vector<int32_t>> stepsOf(const MosaicPlan& plan, const tks_heights& heights, Mask valid,
                                     const Window& window) {
  const GeometryHeader& header = plan.geometry();
  const double most = std::ldexp(1.0, header.wavelet.bits - header.wavelet.fraction_bits);
  const Promise promise(plan);
  std::vector<int32_t> steps(window.extent().samples());
  return withSampleType(heights.sample, [&](auto type) -> Result<std::vector<int32_t>> {
    using T = decltype(type);
    const auto* samples = static_cast<const T*>(heights.data);
    for (size_t i = 0; i < steps.size(); ++i) {
      if (!valid[i]) continue;
      const double place = (static_cast<double>(samples[i]) - header.base) / header.step;
      if (!(std::abs(place) < most)) {
        return Status(TKS_USAGE, placeOf(window, i) +
                                     " lies outside of the range that the plan was made for: make "
                                     "a new plan.");
      }
      const auto step = static_cast<int32_t>(std::lround(place));
      const bool is_kept = plan.header.layers.restoresSamples() ||
                           promise.isKept(samples[i], restore<T>(header.base, header.step, step));
      if (!is_kept) {
        return Status(TKS_USAGE, placeOf(window, i) +
                                     " is no multiple of the step that the plan was made for, or "
                                     "a negative zero: a mosaic cannot keep it to the last bit; "
                                     "give a largest error.");
      }
      steps[i] = step << header.wavelet.fraction_bits;
    }
    return std::move(steps);
  });
}

namespace {

Result<Block> readSamples(const TaskInputs& inputs, const Window& window) {
  const MosaicPlan& plan = inputs.plan;
  const Result<std::vector<std::byte>> samples = readWindow(inputs, window);
  if (!samples.ok()) return samples.status();
  const tks_heights heights = heightsOf(plan, window, samples->data());
  Result<std::vector<uint8_t>> valid = findVoids(heights);
  if (!valid.ok()) return valid.status();
  if (!valid->empty() && !plan.hasVoids()) {
    return Status(TKS_USAGE,
                  "There are voids where the plan says that there are none: make a new plan.");
  }
  Result<std::vector<int32_t>> steps = stepsOf(plan, heights, *valid, window);
  if (!steps.ok()) return steps.status();
  return Block{window, *std::move(steps), *std::move(valid)};
}

/// Puts the low band of a tile of the group before where it belongs in a block.
Status addLow(const TaskInputs& inputs, const Tile& finer, Block& block) {
  const Result<LowPart> low = readLowOf(inputs, finer);
  if (!low.ok()) return low.status();
  const Window from = inputs.grid.low(finer);
  copyShared<int32_t>(from, low->values, block.window, block.values);
  if (low->marks.empty()) return Status();
  if (block.valid.empty()) block.valid.assign(block.values.size(), 1);
  copyShared<uint8_t>(from, low->marks, block.window, block.valid);
  return Status();
}

}  // namespace

Result<std::vector<std::byte>> readWindow(const TaskInputs& inputs, const Window& window) {
  const auto sample = static_cast<tks_sample>(inputs.plan.geometry().sample);
  std::vector<std::byte> samples(window.extent().samples() * tks_sample_bytes(sample));
  if (Status status = inputs.read(window, samples.data()); !status.ok()) return status;
  return samples;
}

Result<LowPart> readLowOf(const TaskInputs& inputs, const Tile& other) {
  Result<LowPart> low = readLow(inputs.files, hashOf(inputs.plan), other);
  if (low.ok() && low->extent != inputs.grid.low(other).extent())
    return Status(TKS_IO, "The part " + lowName(other) + " of the mosaic has another size.");
  return low;
}

Result<Block> readBlock(const TaskInputs& inputs, const Window& window) {
  const int group = inputs.grid.planeGroup(inputs.tile);
  if (group == 0) return readSamples(inputs, window);
  Block block{window, std::vector<int32_t>(window.extent().samples()), {}};
  for (const Tile& finer : inputs.grid.leavers(group, window))
    if (Status status = addLow(inputs, finer, block); !status.ok()) return status;
  return block;
}

}  // namespace tetrakis::inline mosaic

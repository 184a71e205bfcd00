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

/// What the target of a plan promises of every sample.
class Promise {
 public:
  explicit Promise(const MosaicPlan& plan)
      : most_(plan.target.bounded ? plan.geometry().max_error / std::abs(plan.header.metadata.scale)
                                  : 0),
        exact_(plan.header.lossless != 0),
        bounded_(plan.target.bounded) {}

  template <class T>
  bool isKept(T sample, T restored) const {
    if (exact_) return orderOf(sample) == orderOf(restored);
    return !bounded_ ||
           std::abs(static_cast<double>(sample) - static_cast<double>(restored)) <= most_;
  }

 private:
  double most_;
  bool exact_, bounded_;
};

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
      if (!promise.isKept(samples[i], restore<T>(header.base, header.step, step))) {
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

Result<Block> readSamples(const MosaicPlan& plan, const Window& window, const ReadSamples& read) {
  const auto sample = static_cast<tks_sample>(plan.geometry().sample);
  std::vector<std::byte> samples(window.extent().samples() * tks_sample_bytes(sample));
  if (Status status = read(window, samples.data()); !status.ok()) return status;
  const tks_heights heights = heightsOf(plan, window, samples.data());
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

/// Copies what two rectangles of a plane share.
template <class T>
void copyShared(const Window& from, std::span<const T> source, const Window& to,
                std::span<T> target) {
  const uint32_t x = std::max(from.x, to.x), y = std::max(from.y, to.y);
  const uint32_t x1 = std::min(from.x + from.width, to.x + to.width);
  const uint32_t y1 = std::min(from.y + from.height, to.y + to.height);
  for (uint32_t row = y; row < y1; ++row) {
    const T* const line = source.data() + size_t{row - from.y} * from.width + (x - from.x);
    std::copy_n(line, x1 - x, target.data() + size_t{row - to.y} * to.width + (x - to.x));
  }
}

/// Puts the low band of a tile of the group before where it belongs in a block.
Status addLow(const MosaicPlan& plan, const MosaicGrid& grid, const Tile& finer,
              const MosaicFiles& files, Block& block) {
  const Result<LowPart> low = readLow(files, hashOf(plan), finer);
  if (!low.ok()) return low.status();
  const Window from = grid.low(finer);
  if (low->extent != from.extent())
    return {TKS_IO, "The part " + lowName(finer) + " of the mosaic has another size."};
  copyShared<int32_t>(from, low->values, block.window, block.values);
  if (low->valid.empty()) return Status();
  if (block.valid.empty()) block.valid.assign(block.values.size(), 1);
  copyShared<uint8_t>(from, low->valid, block.window, block.valid);
  return Status();
}

}  // namespace

Result<Block> readBlock(const MosaicPlan& plan, const MosaicGrid& grid, const Tile& tile,
                        const ReadSamples& read, const MosaicFiles& files) {
  const Window window = grid.block(tile);
  if (tile.group == 0) return readSamples(plan, window, read);
  Block block{window, std::vector<int32_t>(window.extent().samples()), {}};
  for (const Tile& finer : grid.needs(tile))
    if (Status status = addLow(plan, grid, finer, files, block); !status.ok()) return status;
  return block;
}

}  // namespace tetrakis::inline mosaic

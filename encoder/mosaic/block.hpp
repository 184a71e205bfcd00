// SPDX-License-Identifier: Apache-2.0
// readBlock() fetches a window of the plane of a group: samples of the source in steps, or the low
// bands that the tiles of the group before have left. A Block is a plane of its own for the
// transform.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "codec/geometry/steps/sample_order.hpp"
#include "encoder/mosaic/mosaic_plan.hpp"
#include "encoder/mosaic/part.hpp"
#include "tetrakis/result.hpp"
#include "tetrakis/tetrakis.h"

namespace tetrakis::inline mosaic {

/// Plan, grid, tile, source and files of a task. All of them outlive this.
struct TaskInputs {
  const MosaicPlan& plan;
  const MosaicGrid& grid;
  const Tile& tile;
  const ReadSamples& read;   ///< of the source
  const MosaicFiles& files;  ///< what other tasks have left
  uint32_t threads;          ///< nothing depends on them
};

struct Block {
  Window window;                ///< of the plane of the group
  std::vector<int32_t> values;  ///< as the transform takes them; 0 where there is none
  PartMask valid;
};

/// Checks whether samples keep what the target of a plan promises of each.
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

/// The heights of a window of the source, as the plan describes them. samples: outlives this.
tks_heights heightsOf(const MosaicPlan& plan, const Window& window, const void* samples);

/// Steps of heights, with the fraction bits of the transform. valid: the samples that are not void.
/// window: where they lie, for messages. TKS_USAGE: a sample does not come back as the target of
/// the plan promises.
Result<std::vector<int32_t>> stepsOf(const MosaicPlan& plan, const tks_heights& heights, Mask valid,
                                     const Window& window);

/// The samples of a window of the source, as bytes. TKS_IO: they cannot be read.
Result<std::vector<std::byte>> readWindow(const TaskInputs& inputs, const Window& window);

/// A window of the plane that the tile codes or restores. TKS_IO: samples or parts cannot be read.
/// TKS_USAGE: samples that the plan does not allow: voids where it says that there are none,
/// infinities, or as stepsOf() says.
Result<Block> readBlock(const TaskInputs& inputs, const Window& window);

/// Copies what two windows of a plane share.
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

/// Reads a low band that another tile has left. TKS_IO: there is none of the plan and of its size.
Result<LowPart> readLowOf(const TaskInputs& inputs, const Tile& other);

}  // namespace tetrakis::inline mosaic

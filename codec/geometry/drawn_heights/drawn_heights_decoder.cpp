// SPDX-License-Identifier: Apache-2.0
#include "codec/geometry/drawn_heights/drawn_heights_decoder.hpp"

#include <cstddef>

#include "base/view.hpp"
#include "base/zeroed_array.hpp"
#include "codec/drawing/drawing_pass.hpp"
#include "codec/lattice/levels.hpp"

namespace tetrakis::inline drawn_heights {

namespace {

/// The sum over n, rounded to the nearest, halves up. n: from 1 to 4.
int32_t meanOf(int64_t sum, int n) {
  const int64_t doubled = sum + n / 2;
  const int64_t quotient = doubled / n;
  return static_cast<int32_t>(quotient - (doubled % n < 0));
}

/// Reads the heights of coarser vertices around those of one level.
class Around {
 public:
  Around(const Level& level, const DrawnSurface& surface, const int32_t* heights)
      : extent_(surface.extent), valid_(surface.valid), heights_(heights) {
    if (level.kind == LevelKind::kRoots) return;
    roots_ = false;
    stencil_ = stencilOf(level.kind, level.step, extent_.width);
    step_ = level.step;
  }

  int32_t mean(uint32_t x, uint32_t y) const {
    if (roots_) return 0;
    const size_t vertex = size_t{y} * extent_.width + x;
    const int32_t* const at = heights_ + vertex;
    const ptrdiff_t* const to = stencil_.linear.data();
    const bool inside =
        x >= step_ && y >= step_ && x + step_ < extent_.width && y + step_ < extent_.height;
    if (inside && valid_ == nullptr)
      return meanOf(int64_t{at[to[0]]} + at[to[1]] + at[to[2]] + at[to[3]], kTaps);
    int64_t sum = 0, sum_of_valid = 0;
    int n = 0, n_valid = 0;
    for (int tap = 0; tap < kTaps; ++tap) {
      const int64_t nx = int64_t{x} + stencil_.dx[tap], ny = int64_t{y} + stencil_.dy[tap];
      if (nx < 0 || ny < 0 || nx >= extent_.width || ny >= extent_.height) continue;
      const int32_t height = at[to[tap]];
      sum += height;
      ++n;
      if (valid_ != nullptr && !valid_->at(static_cast<uint32_t>(nx), static_cast<uint32_t>(ny)))
        continue;
      sum_of_valid += height;
      ++n_valid;
    }
    return n_valid > 0 ? meanOf(sum_of_valid, n_valid) : meanOf(sum, n);
  }

 private:
  static constexpr int kTaps = Stencil::kRingSize[0];

  Extent extent_;
  const BitPlane* valid_;
  const int32_t* heights_;
  bool roots_ = true;
  Stencil stencil_{};
  uint32_t step_ = 0;
};

}  // namespace

void DrawnSurface::fill(int32_t* heights) const {
  for (const Level& level : levels) {
    const Around around(level, *this, heights);
    forEachVertex(level, neededOf(level, shown, extent), [&](uint32_t x, uint32_t y) {
      const size_t vertex = size_t{y} * extent.width + x;
      const DrawnIndex index = indices[vertex];
      heights[vertex] = index != kNoIndex ? steps[index] << kFractionBits : around.mean(x, y);
    });
  }
}

std::vector<uint8_t> DrawnSurface::significant(const int32_t* heights) const {
  std::vector<uint8_t> marks(shown.extent().samples());
  for (const Level& level : levels) {
    const Around around(level, *this, heights);
    forEachVertex(level, shown, [&](uint32_t x, uint32_t y) {
      const size_t vertex = size_t{y} * extent.width + x;
      marks[size_t{y - shown.y} * shown.width + x - shown.x] =
          indices[vertex] != kNoIndex && heights[vertex] != around.mean(x, y);
    });
  }
  return marks;
}

DecodedGeometry decodeDrawnHeights(const GeometryHeader& header, std::span<const uint8_t> codeword,
                                   const SharedBits& valid, const View& view) {
  const View grid{view.level, {}};
  const Extent extent = grid.extentIn(header.extent());
  const SharedBits shown = view.level > 0 ? sharedBits(shownMarks(valid, grid), extent) : valid;
  ZeroedArray<KeptIndex> indices(extent.samples());
  const PlaneView<KeptIndex> plane({indices.data(), indices.size()}, extent);
  const std::vector<Level> levels = levelsOf(header.width, header.height, view.level);
  DrawnSteps steps;
  DrawingDecoding<int32_t> io(codeword);
  if (!codeword.empty()) DrawingPass(plane, shown.get(), steps, io).run(levels);
  const Window window = view.window.value_or(Window{0, 0, extent.width, extent.height});
  return decodedHeights({plane.values(), extent, shown.get(), steps, levels, window});
}

DecodedGeometry decodedHeights(const DrawnSurface& surface) {
  DecodedGeometry out;
  out.width = surface.shown.width;
  out.height = surface.shown.height;
  out.fraction_bits = DrawnSurface::kFractionBits;
  if (surface.isWhole()) {
    out.heights.resize(surface.extent.samples());
    surface.fill(out.heights.data());
    out.significant = surface.significant(out.heights.data());
  } else {
    ZeroedArray<int32_t> heights(surface.extent.samples());  // few of which are touched
    surface.fill(heights.data());
    out.significant = surface.significant(heights.data());
    out.heights = slice(std::span<const int32_t>(heights.data(), heights.size()), surface.extent,
                        {0, surface.shown});
  }
  if (surface.valid != nullptr) out.valid = surface.valid->bytes({0, surface.shown});
  clearUnmarked(std::span(out.heights), out.valid);
  return out;
}

}  // namespace tetrakis::inline drawn_heights

// SPDX-License-Identifier: Apache-2.0
// decodeDrawnHeights() turns a codeword of heights that are coded as a drawing into their steps.
// DrawnSteps, the list of their values, and DrawnSurface, which fills the vertices that have not
// arrived, are shared with the encoder.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/bit_plane.hpp"
#include "base/plane.hpp"
#include "bitstream/stream/geometry_header.hpp"
#include "codec/drawing/drawing_models.hpp"
#include "codec/drawing/drawing_neighbours.hpp"
#include "codec/geometry/steps/decoded_heights.hpp"
#include "codec/lattice/levels.hpp"

namespace tetrakis::inline drawn_heights {

// DrawnSteps is the list of the values of drawn heights, in steps. Both sides build it, and code a
// value that it lacks as a difference from the neighbours' values.

class DrawnSteps {
 public:
  size_t size() const { return steps_.size(); }
  /// The class of the difference between two steps: 17 if they are equal, less if a is the lower
  /// one. Differences of up to 5 steps have a class each.
  uint32_t difference(DrawnIndex a, DrawnIndex b) const {
    const int64_t higher = int64_t{steps_[a]} - steps_[b];
    const uint64_t steps = static_cast<uint64_t>(higher < 0 ? -higher : higher);
    const uint32_t kind = steps < 6
                              ? static_cast<uint32_t>(steps)
                              : std::min(3 + static_cast<uint32_t>(std::bit_width(steps)), 16u);
    return higher < 0 ? 17 - kind : 17 + kind;
  }

  int32_t operator[](DrawnIndex i) const { return steps_[i]; }

  /// Codes a step that the list lacks as its difference from the mean of the first two candidates,
  /// modulo 2^32.
  template <class Io>
  void code(const Candidates& around, size_t vertex, Io& io) {
    uint32_t expected = 0;
    if (around.count() > 0) {
      const int64_t a = steps_[around[0].index];
      const int64_t b = steps_[around[std::min(around.count() - 1, 1)].index];
      expected = static_cast<uint32_t>((a + b) >> 1);
    }
    const uint32_t ours = static_cast<uint32_t>(io.value(vertex)) - expected;
    const auto residual =
        static_cast<uint32_t>(codeResidual(residuals_, static_cast<int32_t>(ours), io));
    if (!io.stopped()) steps_.push_back(static_cast<int32_t>(expected + residual));
  }

 private:
  std::vector<int32_t> steps_;
  ResidualModels<32> residuals_;
};

// DrawnSurface gives every vertex of drawn heights a height: its step where that is known, else the
// mean of the coarser vertices beside it. Vertices that differ from that mean count as significant,
// so that coded meshes have vertices only at edges.

/// The surface of heights of which some vertices have the index of a step.
struct DrawnSurface {
  std::span<const KeptIndex> indices;  ///< of each sample of the grid
  Extent extent;                       ///< of the grid
  const BitPlane* valid;               ///< null: all samples are
  const DrawnSteps& steps;
  std::span<const Level> levels;  ///< those of the grid, coarse to fine
  Window shown;                   ///< the part that is wanted

  /// Heights are in units of 2^-kFractionBits steps.
  static constexpr int kFractionBits = 4;

  bool isWhole() const { return shown.extent() == extent; }

  /// Writes the heights of the part, and the heights that they depend on, at their places in a grid
  /// of heights. A vertex without an index becomes the mean of the coarser vertices next to it: of
  /// the valid ones, or of all if none is valid. A root is 0. Voids get heights in the same way.
  void fill(int32_t* heights) const;

  /// Marks of the part: 1 where a step differs from the height that its vertex would have without
  /// it.
  std::vector<uint8_t> significant(const int32_t* heights) const;
};

// decodeDrawnHeights() decodes drawn heights: steps coded as they are, vertex by vertex of the
// lattice (codec/drawing/drawing_pass.hpp), in the place of coefficients. It uses integers only.

/// Decodes the heights of a view. For a level only its vertices are decoded; for a window all
/// vertices are, but only those that the window needs get heights. codeword: any prefix of the
/// codeword of a geometry with header.drawn. valid: of the whole plane. Safe on any bytes.
DecodedGeometry decodeDrawnHeights(const GeometryHeader& header, std::span<const uint8_t> codeword,
                                   const SharedBits& valid, const View& view);

/// The heights of the shown part of a surface.
DecodedGeometry decodedHeights(const DrawnSurface& surface);

}  // namespace tetrakis::inline drawn_heights

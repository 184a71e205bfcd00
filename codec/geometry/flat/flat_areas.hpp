// SPDX-License-Identifier: Apache-2.0
// Flat areas hold exactly one height each: the sea, lakes, rivers between their weirs. A mask says
// which samples are flat. Flat samples that touch each other along a row or a column, on a forest
// across the sides of patches too, are one area, and areas are numbered in the order of their first
// samples, row by row; so neither side sends which sample is of which area.
#pragma once

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "base/bit_plane.hpp"
#include "base/forest.hpp"
#include "base/plane.hpp"
#include "codec/wavelet/pyramid.hpp"

namespace tetrakis::inline flat {

/// The flat areas of a whole plane.
struct FlatAreas {
  std::vector<uint16_t> numbers;  ///< of each sample: 0, or 1 + its area; empty: there are none
  std::vector<int32_t> heights;   ///< of each area, in steps

  bool empty() const { return numbers.empty(); }
  HeldSamples held() const { return {numbers, heights}; }
};

/// Disjoint sets of labels: labels that are joined stand for one area (R. E. Tarjan).
class JoinedLabels {
 public:
  explicit JoinedLabels(size_t count) : earlier_(count) {
    std::iota(earlier_.begin(), earlier_.end(), 0u);
  }
  uint32_t first(uint32_t label) {
    while (earlier_[label] != label) {
      earlier_[label] = earlier_[earlier_[label]];
      label = earlier_[label];
    }
    return label;
  }
  void join(uint32_t a, uint32_t b) {
    if (earlier_[a] == earlier_[b]) return;
    a = first(a);
    b = first(b);
    (a < b ? earlier_[b] : earlier_[a]) = a < b ? a : b;
  }
  /// For each label an earlier one that it is joined with; the label itself where it is the first.
  std::vector<uint32_t> earlier() && { return std::move(earlier_); }

 private:
  std::vector<uint32_t> earlier_;
};

/// The numbers of the areas of a mask of flat samples, 0 or 1, and how many areas there are. There
/// are no numbers if the areas are too many.
struct NumberedAreas {
  std::vector<uint16_t> numbers;
  uint32_t count = 0;
};
/// forest: that the mask is the raster of, alike where patches share a sample; null: of none.
NumberedAreas numberAreas(const PlaneView<const uint8_t>& flat, const Forest* forest = nullptr);

// decodeFlatAreas() decodes the layer of flat areas (flat_pass.hpp).

/// codeword: any prefix of the codeword of a plane with this number of areas and these valid
/// samples. The result has no areas unless every decision counts and the number of areas is right.
/// forest: that the plane is the raster of; null: of none. Safe on any bytes.
FlatAreas decodeFlatAreas(std::span<const uint8_t> codeword, Extent plane, const SharedBits& valid,
                          uint32_t areas, const Forest* forest = nullptr);

}  // namespace tetrakis::inline flat

// SPDX-License-Identifier: Apache-2.0
// Reference decoder: patches whose sides are glued (docs/FORMAT.md, sections 2 and 7, "Forests").
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace tetrakis::reference {

/// Column x and row y of a patch.
struct Place {
  int64_t patch, x, y;
};

/// FORMAT 2, "A forest". A grid is one patch whose sides are borders.
class Forest {
 public:
  Forest() = default;  ///< a grid
  /// glued: of each side the other one, of a border itself.
  Forest(int depth, std::vector<int> glued);

  bool isGrid() const { return depth_ == 0; }
  int depth() const { return depth_; }
  int patches() const { return static_cast<int>(glued_.size() / 4); }
  const std::vector<int>& glued() const { return glued_; }
  int glued(int side) const { return glued_[static_cast<size_t>(side)]; }
  /// Of those that are the same as a corner.
  int lowestCorner(int corner) const { return corners_[static_cast<size_t>(corner)]; }
  /// FORMAT 7, "locate", among patches with such a last column and row.
  Place locate(Place place, int64_t lastX, int64_t lastY) const;
  /// Both are numbers of samples of the raster, row by row.
  size_t ownerOf(size_t sample) const;

  /// FORMAT 7.1: whether a mip level has the sample in column x and row y of the raster.
  bool shows(int level, int x, int y) const {
    const int step = 1 << level, row = isGrid() ? y : y % static_cast<int>(side());
    return x % step == 0 && row % step == 0;
  }
  int coarsestLevel() const { return depth_ - 1; }
  /// The same surface with patches of a level.
  Forest atLevel(int level) const {
    Forest forest = *this;
    if (!isGrid()) forest.depth_ -= level;
    return forest;
  }

  /// Samples that are not owned become what the owned ones are. of: as many for each sample.
  template <class T>
  void share(std::vector<T>& of) const {
    const size_t samples = isGrid() ? 0 : patches() * side() * side();
    for (size_t i = 0; i < samples; ++i) {
      const size_t each = of.size() / samples;
      std::copy_n(of.begin() + ownerOf(i) * each, each, of.begin() + i * each);
    }
  }

 private:
  size_t side() const { return (size_t{1} << depth_) + 1; }
  /// Where sample `along` of a side is on the other one.
  int64_t across(int side, int64_t along, int64_t last) const;

  int depth_ = 0;
  std::vector<int> glued_ = {0, 1, 2, 3};
  std::vector<int> corners_;   ///< of each corner the lowest one that is the same
  std::vector<bool> regular_;  ///< of each lowest corner: four meet there, and no border
};

}  // namespace tetrakis::reference

// SPDX-License-Identifier: Apache-2.0
// Losses by shape and place, and their sums over octagons.
#include "codec/mesh/decimation/deferred_losses.hpp"

#include <algorithm>
#include <cassert>

#include "codec/mesh/topology/lattice_mesh.hpp"

namespace tetrakis::inline decimation {
namespace {

/// 3 rows of 8 cells as 9 bits.
uint32_t nineCells(uint64_t cells) {
  assert((cells & ~uint64_t{0x070707}) == 0);
  return static_cast<uint32_t>((cells & 7) | (cells >> 5 & 0x38) | (cells >> 10 & 0x1c0));
}

/// Columns of squares in one row.
struct Span {
  int64_t first = 0, last = -1;

  /// Which of the three squares from `left` on are in it.
  uint32_t cellsFrom(int64_t left) const {
    uint32_t cells = 0;
    for (int64_t i = 0; i < 3; ++i)
      cells |= static_cast<uint32_t>(left + i >= first && left + i <= last) << i;
    return cells;
  }
};

/// The squares of one level in M_v.
class Squares {
 public:
  Squares(const Lattice& lattice, Site v, uint32_t level)
      : octagon_(Octagon::ofCentres(v.level, (level - v.level + 1) / 2)),
        x_(lattice.position(v).x >> lattice.plan(level).shift),
        y_(lattice.position(v).y >> lattice.plan(level).shift) {}

  // Centres lie at odd coordinates, v at even ones, and X, Y - |dy| are odd.
  int64_t top() const { return (y_ - octagon_.x - 1) / 2; }
  int64_t bottom() const { return (y_ + octagon_.x - 1) / 2; }
  Span row(int64_t row) const {
    if (row < top() || row > bottom()) return {};
    const int64_t reach = octagon_.reach(2 * row + 1 - y_);
    return {(x_ - reach - 1) / 2, (x_ + reach - 1) / 2};
  }

 private:
  Octagon octagon_;
  int64_t x_, y_;
};

}  // namespace

DeferredLosses::DeferredLosses(const Lattice& lattice, uint32_t level)
    : lattice_(&lattice), level_(level) {
  for (Kind& kind : kinds_) kind.index.fill(kNoShape);
  if (lattice.levelCount() == 0) return;  // nobody loses anything
  columns_ = lattice.plan(level).columns / 2 + 1;
  rows_ = lattice.plan(level).rows / 2 + 1;
}

Worth& DeferredLosses::slot(const AncestorWindow& squares) {
  const auto x = static_cast<size_t>(squares.left + 1), y = static_cast<size_t>(squares.top + 1);
  Kind& kind = kinds_[x % 2 + y % 2 * 2];
  const uint32_t cells = nineCells(squares.cells);
  const uint8_t index = kind.index[cells] == kNoShape ? addShape(kind, cells) : kind.index[cells];
  return kind.shapes[index].losses[y / 2 * columns_ + x / 2];
}

uint8_t DeferredLosses::addShape(Kind& kind, uint32_t cells) const {
  assert(kind.shapes.size() < kNoShape);
  kind.index[cells] = static_cast<uint8_t>(kind.shapes.size());
  kind.shapes.push_back({cells, std::vector<Worth>(columns_ * rows_)});
  return kind.index[cells];
}

Worth DeferredLosses::of(Site v) const {
  const Squares squares(*lattice_, v, level_);
  const int64_t rows = lattice_->plan(level_).rows, columns = lattice_->plan(level_).columns;
  Worth sum;
  std::vector<uint32_t> wanted;
  for (int64_t top = std::max<int64_t>(squares.top() - 2, -1);
       top <= std::min(squares.bottom(), rows - 1); ++top) {
    const std::array<Span, 3> spans = {squares.row(top), squares.row(top + 1),
                                       squares.row(top + 2)};
    const Span widest = *std::max_element(spans.begin(), spans.end(), [](Span a, Span b) {
      return a.last - a.first < b.last - b.first;
    });
    const int64_t left = std::max<int64_t>(widest.first - 2, -1);
    const int64_t right = std::min(widest.last, columns - 1);
    wanted.clear();
    for (int64_t i = left; i <= right; ++i)
      wanted.push_back(spans[0].cellsFrom(i) | spans[1].cellsFrom(i) << 3 |
                       spans[2].cellsFrom(i) << 6);
    sum += sumOfRow(static_cast<size_t>(left + 1), static_cast<size_t>(top + 1), wanted);
  }
  return sum;
}

/// Losses at the places (x, y), (x + 1, y) ... whose cells are among those wanted there.
Worth DeferredLosses::sumOfRow(size_t x, size_t y, const std::vector<uint32_t>& wanted) const {
  Worth sum;
  for (size_t odd = 0; odd < std::min<size_t>(2, wanted.size()); ++odd) {
    const size_t first = y / 2 * columns_ + (x + odd) / 2;
    for (const Shape& shape : kinds_[(x + odd) % 2 + y % 2 * 2].shapes) {
      const Worth* losses = &shape.losses[first];
      for (size_t i = odd; i < wanted.size(); i += 2, ++losses) {
        const bool meets = (shape.cells & wanted[i]) != 0;
        sum.distortion += meets ? losses->distortion : 0;
        sum.cost += meets ? losses->cost : 0;
      }
    }
  }
  return sum;
}

}  // namespace tetrakis::inline decimation

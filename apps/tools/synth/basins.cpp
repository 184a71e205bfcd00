// SPDX-License-Identifier: Apache-2.0
// Cells that run down to one pit are a basin, and a basin fills to the lowest pass on its way out.
// Those ways are the minimum spanning tree of basins joined by their passes (Cordonnier, Bovy,
// Braun, "A versatile, linear complexity algorithm for flow routing in topographies with
// depressions", Earth Surface Dynamics 7, 2019), here by Kruskal: everything but the passes is
// visited row by row.
#include "apps/tools/synth/basins.hpp"

#include <array>
#include <numeric>

#include "apps/tools/synth/drainage.hpp"

namespace tetrakis::tools::synth {
namespace {

/// The root of a cell in a forest; the path there is halved.
template <class Forest>
uint32_t rootOf(Forest& parent, uint32_t cell) {
  while (parent[cell] != cell) cell = parent[cell] = parent[parent[cell]];
  return cell;
}

/// The lowest of the lower neighbours; outlets and pits lead to themselves.
Raster<uint32_t> downhill(const Grid& height, const Raster<uint8_t>& outlet) {
  return rasterOf<uint32_t>(height.side(), [&](uint32_t x, uint32_t y) {
    const uint32_t cell = y * height.side() + x;
    uint32_t lowest = cell;
    if (outlet[cell]) return lowest;
    forNeighbours(height, cell, [&](uint32_t next, const Step&) {
      if (height[next] < height[lowest]) lowest = next;
    });
    return lowest;
  });
}

/// For every cell its basin: the pit, or outlet, that it runs down to. Level ground has one way
/// down.
Raster<uint32_t> basinsOf(const Grid& height, const Raster<uint8_t>& outlet) {
  Raster<uint32_t> basin = downhill(height, outlet);
  std::vector<uint32_t> pits;
  for (uint32_t cell = 0; cell < basin.size(); ++cell)
    if (basin[cell] == cell && !outlet[cell]) pits.push_back(cell);
  for (const uint32_t pit : pits) {
    forNeighbours(height, pit, [&](uint32_t next, const Step&) {
      if (height[next] != height[pit]) return;
      const uint32_t here = rootOf(basin, pit);
      // Beyond the first way down the level ground is a pass.
      if (height[here] == height[pit] && !outlet[here]) basin[here] = rootOf(basin, next);
    });
  }
  for (uint32_t cell = 0; cell < basin.size(); ++cell) basin[cell] = rootOf(basin, cell);
  return basin;
}

/// Between two basins, by their numbers.
struct Pass {
  double height;
  uint32_t a, b;
};

/// Collects passes; of those between the same two basins that come soon after one another, as they
/// do along a border, only the lowest.
class Passes {
 public:
  void add(Pass pass) {
    if (pass.a > pass.b) std::swap(pass.a, pass.b);
    Pass& recent = recent_[latticeHash(0, pass.a, pass.b) >> 52];
    if (recent.a == pass.a && recent.b == pass.b) {
      recent.height = std::min(recent.height, pass.height);
      return;
    }
    if (recent.a != recent.b) all_.push_back(recent);
    recent = pass;
  }

  std::vector<Pass> fromTheLowest() {
    for (const Pass& pass : recent_)
      if (pass.a != pass.b) all_.push_back(pass);
    std::sort(all_.begin(), all_.end(),
              [](const Pass& p, const Pass& q) { return p.height < q.height; });
    return std::move(all_);
  }

 private:
  std::vector<Pass> recent_ = std::vector<Pass>(1 << 12);  // a == b: none
  std::vector<Pass> all_;
};

/// The pits, in order; number 0 stands for all outlets, i + 1 for the pit at [i].
class Pits {
 public:
  Pits(const Raster<uint32_t>& basin, const Raster<uint8_t>& outlet) : outlet_(outlet) {
    for (uint32_t cell = 0; cell < basin.size(); ++cell)
      if (basin[cell] == cell && !outlet[cell]) cells_.push_back(cell);
  }
  uint32_t number(uint32_t pit) const {
    if (outlet_[pit]) return 0;
    const auto at = std::lower_bound(cells_.begin(), cells_.end(), pit);
    return static_cast<uint32_t>(at - cells_.begin()) + 1;
  }
  const std::vector<uint32_t>& cells() const { return cells_; }

 private:
  const Raster<uint8_t>& outlet_;
  std::vector<uint32_t> cells_;
};

std::vector<Pass> passesOf(const Grid& height, const Raster<uint32_t>& basin, const Pits& pits) {
  constexpr std::array<std::array<int64_t, 2>, 4> kAhead = {{{1, 0}, {-1, 1}, {0, 1}, {1, 1}}};
  const int64_t side = height.side();
  Passes passes;
  for (int64_t y = 0; y < side; ++y) {
    for (int64_t x = 0; x < side; ++x) {
      const uint32_t cell = static_cast<uint32_t>(y * side + x);
      for (const auto& [dx, dy] : kAhead) {
        if (x + dx < 0 || x + dx >= side || y + dy >= side) continue;
        const uint32_t next = static_cast<uint32_t>((y + dy) * side + x + dx);
        if (basin[cell] == basin[next]) continue;
        const uint32_t a = pits.number(basin[cell]), b = pits.number(basin[next]);
        if (a != b) passes.add({std::max(height[cell], height[next]), a, b});
      }
    }
  }
  return passes.fromTheLowest();
}

/// Basins joined over their passes, from the lowest on; each fills when it is joined to the
/// outlets.
class Filling {
 public:
  explicit Filling(size_t basins) : level_(basins), parent_(basins), next_(basins), last_(basins) {
    std::iota(parent_.begin(), parent_.end(), 0u);
    std::iota(next_.begin(), next_.end(), 0u);
    std::iota(last_.begin(), last_.end(), 0u);
  }

  void join(const Pass& pass) {
    uint32_t a = rootOf(parent_, pass.a), b = rootOf(parent_, pass.b);
    if (a == b) return;
    if (b == 0) std::swap(a, b);
    parent_[b] = a;
    if (a == 0) {
      fill(b, pass.height);
    } else {
      next_[last_[a]] = b;
      last_[a] = last_[b];
    }
  }
  double level(size_t basin) const { return level_[basin]; }

 private:
  void fill(uint32_t basin, double level) {
    level_[basin] = level;
    while (next_[basin] != basin) level_[basin = next_[basin]] = level;
  }

  std::vector<double> level_;
  std::vector<uint32_t> parent_;
  std::vector<uint32_t> next_, last_;  // list of the basins under a root; the last is its own next
};

}  // namespace

Grid waterLevel(const Grid& height, const Raster<uint8_t>& outlet) {
  const Raster<uint32_t> basin = basinsOf(height, outlet);
  const Pits pits(basin, outlet);
  Filling filling(pits.cells().size() + 1);
  for (const Pass& pass : passesOf(height, basin, pits)) filling.join(pass);
  Grid level = height;
  for (size_t i = 0; i < pits.cells().size(); ++i) level[pits.cells()[i]] = filling.level(i + 1);
  forRows(level.side(), level.side(), [&](uint32_t first, uint32_t end) {
    const size_t last = size_t{end} * level.side();
    for (size_t cell = size_t{first} * level.side(); cell < last; ++cell)
      if (basin[cell] != cell) level[cell] = std::max(height[cell], level[basin[cell]]);
  });
  return level;
}

}  // namespace tetrakis::tools::synth

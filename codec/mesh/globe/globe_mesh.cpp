// SPDX-License-Identifier: Apache-2.0
#include "codec/mesh/globe/globe_mesh.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

namespace tetrakis::inline globe {
namespace {

constexpr uint32_t kUnused = std::numeric_limits<uint32_t>::max();

/// One end of the grid, whose row goes round a pole.
struct PoleEnd {
  double row;   ///< of the samples
  double pole;  ///< the row that the pole lies in
  bool first;   ///< before the grid, not behind it
};

class Closing {
 public:
  Closing(const LatticeMesh& mesh, std::span<const float> heights, const RoundGrid& grid)
      : grid_(grid) {
    assert(heights.size() == mesh.vertices.size());
    for (size_t v = 0; v < heights.size(); ++v) {
      const uint32_t sample = mesh.vertices[v];
      add({double(sample % grid.width), double(sample / grid.width)}, heights[v]);
    }
    mesh_.triangles = mesh.triangles;
  }

  GlobeMesh run() {
    joinColumns();
    if (grid_.first_pole) closeEnd({0, *grid_.first_pole, true});
    if (grid_.last_pole) closeEnd({grid_.height - 1.0, *grid_.last_pole, false});
    leaveOutVoids();
    leaveOutUnused();
    return std::move(mesh_);
  }

 private:
  uint32_t add(GridPlace place, float height) {
    mesh_.places.push_back(place);
    mesh_.heights.push_back(height);
    return static_cast<uint32_t>(mesh_.places.size() - 1);
  }
  void addTriangle(uint32_t a, uint32_t b, uint32_t c) {
    mesh_.triangles.insert(mesh_.triangles.end(), {a, b, c});
  }
  double columnOf(uint32_t v) const { return mesh_.places[v].column; }
  double rowOf(uint32_t v) const { return mesh_.places[v].row; }

  /// The vertices of a column from the first row on, or those of a row from the first column on.
  std::vector<uint32_t> line(double GridPlace::*across, double GridPlace::*along,
                             double place) const {
    std::vector<uint32_t> vertices;
    for (uint32_t v = 0; v < mesh_.places.size(); ++v)
      if (mesh_.places[v].*across == place) vertices.push_back(v);
    std::sort(vertices.begin(), vertices.end(), [&](uint32_t a, uint32_t b) {
      return mesh_.places[a].*along < mesh_.places[b].*along;
    });
    return vertices;
  }
  std::vector<uint32_t> columnAt(double column) const {
    return line(&GridPlace::column, &GridPlace::row, column);
  }
  std::vector<uint32_t> rowAt(double row) const {
    return line(&GridPlace::row, &GridPlace::column, row);
  }

  /// Down both columns at a time: the next triangle stands on the edge whose middle comes first.
  void joinColumns() {
    const std::vector<uint32_t> left = columnAt(grid_.width - 1.0);
    std::vector<uint32_t> right = columnAt(0);
    for (uint32_t& v : right) v = add({double(grid_.width), rowOf(v)}, mesh_.heights[v]);
    const auto middle = [this](const std::vector<uint32_t>& column, size_t i) {
      return i + 1 < column.size() ? rowOf(column[i]) + rowOf(column[i + 1])
                                   : std::numeric_limits<double>::infinity();
    };
    for (size_t i = 0, j = 0; i + 1 < left.size() || j + 1 < right.size();) {
      if (middle(left, i) <= middle(right, j)) {
        addTriangle(left[i], left[i + 1], right[j]);
        ++i;
      } else {
        addTriangle(left[i], right[j + 1], right[j]);
        ++j;
      }
    }
  }

  void closeEnd(const PoleEnd& end) {
    const std::vector<uint32_t> row = rowAt(end.row);
    const float height = meanHeight(row);
    if (end.pole == end.row)
      shrink(end, height);
    else
      addFan(end, row, height);
  }

  /// Of the line through the vertices of a row, without those that are void; NaN if all are.
  float meanHeight(const std::vector<uint32_t>& row) const {
    double sum = 0, length = 0;
    for (size_t i = 0; i < row.size(); ++i) {
      if (std::isnan(mesh_.heights[row[i]])) continue;
      const uint32_t before = row[i > 0 ? i - 1 : i], behind = row[i + 1 < row.size() ? i + 1 : i];
      const double part = columnOf(behind) - columnOf(before);
      sum += part * mesh_.heights[row[i]];
      length += part;
    }
    return static_cast<float>(sum / length);
  }

  void addFan(const PoleEnd& end, const std::vector<uint32_t>& row, float height) {
    for (size_t i = 0; i + 1 < row.size(); ++i) {
      const double column = (columnOf(row[i]) + columnOf(row[i + 1])) / 2;
      const uint32_t pole = add({column, end.pole}, height);
      if (end.first)
        addTriangle(row[i], row[i + 1], pole);
      else
        addTriangle(row[i + 1], row[i], pole);
    }
  }

  /// Takes all samples of a row for one point. Triangles with an edge on the row are gone.
  void shrink(const PoleEnd& end, float height) {
    size_t kept = 0;
    for (size_t t = 0; t < mesh_.triangles.size(); t += 3) {
      std::array<uint32_t, 3> corners;
      std::copy_n(&mesh_.triangles[t], 3, corners.begin());
      const auto at_pole = [&](uint32_t v) { return rowOf(v) == end.row; };
      const auto count = std::count_if(corners.begin(), corners.end(), at_pole);
      if (count > 1) continue;
      if (count == 1) {
        // The corner at the pole comes first.
        std::rotate(corners.begin(), std::find_if(corners.begin(), corners.end(), at_pole),
                    corners.end());
        corners[0] = add({(columnOf(corners[1]) + columnOf(corners[2])) / 2, end.row}, height);
      }
      std::copy_n(corners.begin(), 3, &mesh_.triangles[kept]);
      kept += 3;
    }
    mesh_.triangles.resize(kept);
  }

  void leaveOutVoids() {
    size_t kept = 0;
    const auto is_void = [this](uint32_t v) { return std::isnan(mesh_.heights[v]); };
    for (size_t t = 0; t < mesh_.triangles.size(); t += 3) {
      const std::span<const uint32_t> corners = std::span(mesh_.triangles).subspan(t, 3);
      if (std::any_of(corners.begin(), corners.end(), is_void)) continue;
      std::copy(corners.begin(), corners.end(),
                mesh_.triangles.begin() + static_cast<ptrdiff_t>(kept));
      kept += 3;
    }
    mesh_.triangles.resize(kept);
  }

  void leaveOutUnused() {
    std::vector<uint32_t> renumbered(mesh_.places.size(), kUnused);
    for (const uint32_t v : mesh_.triangles) renumbered[v] = 0;
    uint32_t kept = 0;
    for (uint32_t v = 0; v < renumbered.size(); ++v) {
      if (renumbered[v] == kUnused) continue;
      mesh_.places[kept] = mesh_.places[v];
      mesh_.heights[kept] = mesh_.heights[v];
      renumbered[v] = kept++;
    }
    mesh_.places.resize(kept);
    mesh_.heights.resize(kept);
    for (uint32_t& v : mesh_.triangles) v = renumbered[v];
  }

  const RoundGrid& grid_;
  GlobeMesh mesh_;
};

}  // namespace

GlobeMesh closedRound(const LatticeMesh& mesh, std::span<const float> heights,
                      const RoundGrid& grid) {
  return Closing(mesh, heights, grid).run();
}

}  // namespace tetrakis::inline globe

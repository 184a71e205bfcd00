// SPDX-License-Identifier: Apache-2.0
#include "codec/remesh/cleaned_mesh.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "codec/remesh/disjoint_sets.hpp"
#include "codec/remesh/half_edges.hpp"

namespace tetrakis::inline remesh {
namespace {

/// The triangles of the input that are kept.
struct KeptFaces {
  std::vector<Triangle> corners;  ///< of points in one place the first
  std::vector<uint32_t> sources;  ///< their numbers in the input
};

/// For each point the first one that lies in its place.
std::vector<uint32_t> firstInPlace(const std::vector<Point>& points) {
  std::vector<uint32_t> order(points.size()), first(points.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) {
    return points[a] != points[b] ? points[a] < points[b] : a < b;
  });
  for (size_t k = 0; k < order.size(); ++k) {
    const bool again = k > 0 && points[order[k]] == points[order[k - 1]];
    first[order[k]] = again ? first[order[k - 1]] : order[k];
  }
  return first;
}

KeptFaces withoutDegenerate(const TriangleMesh& input, CleaningReport& report) {
  const std::vector<uint32_t> first = firstInPlace(input.points);
  KeptFaces kept;
  for (uint32_t t = 0; t < input.triangles.size(); ++t) {
    const Triangle& given = input.triangles[t];
    const Triangle corners{first[given[0]], first[given[1]], first[given[2]]};
    if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0]) {
      ++report.degenerate;
    } else {
      kept.corners.push_back(corners);
      kept.sources.push_back(t);
    }
  }
  return kept;
}

/// Of triangles with the same corners the first one is kept, whichever sides they face.
KeptFaces withoutDoubles(const KeptFaces& faces, CleaningReport& report) {
  std::vector<std::pair<Triangle, uint32_t>> by_corners;
  for (uint32_t t = 0; t < faces.corners.size(); ++t) {
    Triangle corners = faces.corners[t];
    std::sort(corners.begin(), corners.end());
    by_corners.emplace_back(corners, t);
  }
  std::sort(by_corners.begin(), by_corners.end());
  std::vector<bool> doubled(faces.corners.size());
  for (size_t k = 1; k < by_corners.size(); ++k)
    doubled[by_corners[k].second] = by_corners[k].first == by_corners[k - 1].first;
  KeptFaces kept;
  for (uint32_t t = 0; t < doubled.size(); ++t) {
    report.doubled += doubled[t];
    if (doubled[t]) continue;
    kept.corners.push_back(faces.corners[t]);
    kept.sources.push_back(faces.sources[t]);
  }
  return kept;
}

/// Finds which triangles must be turned round, so that neighbours face one side. It walks over
/// edges from triangle to triangle, and cuts an edge where two triangles that it has been to
/// disagree.
class Orientation {
 public:
  Orientation(const std::vector<Triangle>& triangles, GluedSides& glued)
      : triangles_(triangles), glued_(glued), seen_(triangles.size()), turned_(triangles.size()) {
    for (uint32_t t = 0; t < triangles.size(); ++t) {
      if (!seen_[t]) walkFrom(t);
    }
  }

  const std::vector<bool>& turned() const { return turned_; }
  uint32_t cuts() const { return cuts_; }

 private:
  void walkFrom(uint32_t seed) {
    component_.assign(1, seed);
    seen_[seed] = true;
    for (size_t k = 0; k < component_.size(); ++k) {
      for (uint32_t corner = 0; corner < 3; ++corner) step(3 * component_[k] + corner);
    }
    const auto turned =
        std::count_if(component_.begin(), component_.end(), [&](uint32_t t) { return turned_[t]; });
    if (2 * static_cast<size_t>(turned) <= component_.size()) return;
    for (const uint32_t t : component_) turned_[t] = !turned_[t];
  }

  void step(uint32_t side) {
    const uint32_t other = glued_.opposite[side];
    if (other == kNone) return;
    const bool same_way = startOf(triangles_, side) == startOf(triangles_, other);
    const bool turned = turned_[side / 3] != same_way;
    if (!seen_[other / 3]) {
      seen_[other / 3] = true;
      turned_[other / 3] = turned;
      component_.push_back(other / 3);
    } else if (turned_[other / 3] != turned) {
      glued_.opposite[side] = glued_.opposite[other] = kNone;
      ++cuts_;
    }
  }

  const std::vector<Triangle>& triangles_;
  GluedSides& glued_;
  std::vector<bool> seen_, turned_;
  std::vector<uint32_t> component_;
  uint32_t cuts_ = 0;
};

/// Joins the corners that are one point: those of the triangles of a fan.
DisjointSets fansOf(const std::vector<Triangle>& triangles, const GluedSides& glued) {
  DisjointSets fans(glued.opposite.size());
  for (uint32_t side = 0; side < glued.opposite.size(); ++side) {
    const uint32_t other = glued.opposite[side];
    if (other == kNone) continue;
    const bool same_way = startOf(triangles, side) == startOf(triangles, other);
    fans.join(side, same_way ? other : nextSide(other));
    fans.join(nextSide(side), same_way ? nextSide(other) : other);
  }
  return fans;
}

/// Each fan gets a point of its own. It may be that two triangles were cut from each other but
/// still share both points. Then they are neighbours again: they are the first and the last one of
/// a fan, and so they face one side.
void numberPoints(const TriangleMesh& input, const KeptFaces& faces, DisjointSets& fans,
                  CleanedMesh& result) {
  std::vector<uint32_t> point_of(3 * faces.corners.size(), kNone);
  for (uint32_t corner = 0; corner < point_of.size(); ++corner) {
    const uint32_t fan = fans.find(corner);
    if (point_of[fan] == kNone) {
      const uint32_t point = startOf(faces.corners, corner);
      point_of[fan] = static_cast<uint32_t>(result.mesh.points.size());
      result.mesh.points.push_back(input.points[point]);
    }
    result.mesh.triangles[corner / 3][corner % 3] = point_of[fan];
  }
}

}  // namespace

CleanedMesh cleaned(const TriangleMesh& input) {
  CleanedMesh result;
  const KeptFaces faces = withoutDoubles(withoutDegenerate(input, result.report), result.report);
  GluedSides glued = gluedSides(faces.corners);
  const Orientation orientation(faces.corners, glued);
  DisjointSets fans = fansOf(faces.corners, glued);
  result.report.cut_edges = glued.crowded + orientation.cuts();
  result.mesh.triangles.resize(faces.corners.size());
  numberPoints(input, faces, fans, result);
  for (uint32_t t = 0; t < faces.corners.size(); ++t) {
    TriangleSource source{faces.sources[t]};
    if (orientation.turned()[t]) {
      std::swap(source.corners[1], source.corners[2]);
      std::swap(result.mesh.triangles[t][1], result.mesh.triangles[t][2]);
    }
    result.sources.push_back(source);
  }
  return result;
}

}  // namespace tetrakis::inline remesh

// SPDX-License-Identifier: Apache-2.0
#include "codec/remesh/mapped_decimation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "codec/remesh/collapse_cost.hpp"
#include "codec/remesh/ring_flattening.hpp"
#include "codec/remesh/shrinking_mesh.hpp"

namespace tetrakis::inline remesh {
namespace {

/// The mesh, moved and scaled into a cube of side 1, so that limits do not depend on its unit.
TriangleMesh ofUnitSize(const TriangleMesh& mesh) {
  TriangleMesh scaled = mesh;
  if (mesh.points.empty()) return scaled;
  const auto [low, high] = boxAround(mesh.points);
  double half = 0;  // of the longest side, which might be too long for a double
  for (size_t axis = 0; axis < 3; ++axis) half = std::max(half, high[axis] / 2 - low[axis] / 2);
  if (!(half > 0)) half = 1;
  for (Point& point : scaled.points) {
    for (size_t axis = 0; axis < 3; ++axis) point[axis] = (point[axis] / 2 - low[axis] / 2) / half;
  }
  return scaled;
}

}  // namespace

/// Collapses points, the cheapest one first.
class MappedDecimation::Decimator {
 public:
  Decimator(const TriangleMesh& mesh, DecimationAim aim, CollapseMap& map)
      : mesh_(ofUnitSize(mesh)),
        shrinking_(mesh_),
        cost_(mesh_, aim),
        mapped_(aim == DecimationAim::kEven),
        map_(map),
        stamps_(mesh.points.size()) {}

  /// Returns the number of triangles that are left.
  uint32_t run(uint32_t fewest) {
    while (shrinking_.triangleCount() > fewest) {
      if (heap_.empty() && !beginsRound()) break;
      if (!heap_.empty()) takeCheapest();
    }
    return shrinking_.triangleCount();
  }

 private:
  /// A round is the last one if it removes no more than one triangle in so many.
  static constexpr uint32_t kRoundsEnd = 256;

  struct Offer {
    double cost;
    uint32_t point, stamp;

    bool operator<(const Offer& other) const {  // so that the cheapest one is on top of a heap
      return cost != other.cost ? cost > other.cost : point > other.point;
    }
  };
  struct Choice {
    double cost = std::numeric_limits<double>::infinity();
    uint32_t target = kNone;
  };

  /// A point that could not go may be able to after collapses elsewhere: so all points are offered
  /// again, in rounds, as long as these remove triangles.
  bool beginsRound() {
    if (before_ - shrinking_.triangleCount() <= before_ / kRoundsEnd) return false;
    before_ = shrinking_.triangleCount();
    for (uint32_t point = 0; point < stamps_.size(); ++point) offer(point);
    return true;
  }

  /// The cheapest neighbour that the centre of ring_ may collapse into. `flat`: the collapse must
  /// also be possible in the flattened ring, which goes to flat_.
  Choice choose(bool flat) {
    cost_.find(shrinking_, ring_, costs_);
    if (flat) flatten(mesh_.points, ring_, flat_);
    while (true) {
      Choice best;
      for (uint32_t i = 0; i < costs_.size(); ++i) {
        const bool first = best.target != kNone && costs_[i] == best.cost &&
                           ring_.points[i] < ring_.points[best.target];
        if (costs_[i] < best.cost || first) best = {costs_[i], i};
      }
      if (best.target == kNone || (shrinking_.keepsTopology(ring_, best.target) &&
                                   (!flat || fansOut(ring_, flat_, best.target))))
        return best;
      costs_[best.target] = std::numeric_limits<double>::infinity();
    }
  }

  /// Puts the point on the heap with what it costs now. Earlier offers of it are void.
  void offer(uint32_t point) {
    ++stamps_[point];
    if (!shrinking_.findRing(point, ring_)) return;
    const Choice choice = choose(false);
    if (choice.target != kNone) push(point, choice.cost);
  }

  void push(uint32_t point, double cost) {
    heap_.push_back({cost, point, stamps_[point]});
    std::push_heap(heap_.begin(), heap_.end());
  }

  /// Collapses the cheapest point, unless its offer is void, or it costs more by now.
  void takeCheapest() {
    std::pop_heap(heap_.begin(), heap_.end());
    const Offer offered = heap_.back();
    heap_.pop_back();
    if (offered.stamp != stamps_[offered.point]) return;
    if (!shrinking_.findRing(offered.point, ring_)) return;
    const Choice choice = choose(mapped_);
    if (choice.target == kNone) return;
    if (choice.cost > offered.cost) return push(offered.point, choice.cost);
    map_.add(ring_, choice.target, flat_);
    cost_.collapsed(ring_, choice.target);
    shrinking_.collapse(ring_, choice.target);
    ++stamps_[offered.point];
    changed_ = ring_.points;
    for (const uint32_t point : changed_) offer(point);
  }

  const TriangleMesh mesh_;
  ShrinkingMesh shrinking_;
  CollapseCost cost_;
  bool mapped_;  // else nothing is flattened
  CollapseMap& map_;
  uint32_t before_ = kNone;       // number of triangles when the round began
  std::vector<uint32_t> stamps_;  // for each point the stamp of its offer that is valid
  std::vector<Offer> heap_;
  // Of the point in work:
  Ring ring_;
  std::vector<double> costs_;
  std::vector<FlatPoint> flat_;
  std::vector<uint32_t> changed_;
};

MappedDecimation::MappedDecimation(const TriangleMesh& mesh, uint32_t fewest, DecimationAim aim)
    : mesh_(mesh),
      map_(mesh.triangles.size()),
      decimator_(std::make_unique<Decimator>(mesh, aim, map_)),
      fewest_(decimator_->run(fewest)) {}

MappedDecimation::~MappedDecimation() = default;

void MappedDecimation::goOn(uint32_t fewest) {
  fewest_ = decimator_->run(fewest);
}

DecimatedMesh MappedDecimation::base(uint32_t most_triangles) const {
  std::vector<Triangle> triangles = mesh_.triangles;
  std::vector<uint32_t> last(triangles.size(), kNone);
  size_t left = triangles.size();
  for (uint32_t k = 0; k < map_.collapses() && left > most_triangles; ++k)
    left -= map_.replay(k, triangles, last);
  DecimatedMesh base;
  std::vector<uint32_t> number(mesh_.points.size(), kNone);
  for (uint32_t t = 0; t < triangles.size(); ++t) {
    if (triangles[t][0] == kNone) continue;
    for (uint32_t& point : triangles[t]) {
      if (number[point] == kNone) {
        number[point] = static_cast<uint32_t>(base.mesh.points.size());
        base.mesh.points.push_back(mesh_.points[point]);
      }
      point = number[point];
    }
    base.mesh.triangles.push_back(triangles[t]);
    base.triangles.push_back(t);
    base.collapses.push_back(last[t]);
  }
  return base;
}

SurfacePoint MappedDecimation::toInput(const DecimatedMesh& base, const SurfacePoint& place) const {
  SurfacePoint at{base.triangles[place.triangle], place.weights};
  uint32_t collapse = base.collapses[place.triangle];
  while (collapse != kNone) collapse = map_.undo(collapse, at);
  return at;
}

}  // namespace tetrakis::inline remesh

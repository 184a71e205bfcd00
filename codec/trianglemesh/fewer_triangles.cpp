// SPDX-License-Identifier: Apache-2.0
#include "codec/trianglemesh/fewer_triangles.hpp"

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "codec/trianglemesh/collapsing_triangles.hpp"
#include "codec/trianglemesh/corner_fans.hpp"
#include "codec/trianglemesh/mesh_pieces.hpp"
#include "codec/trianglemesh/step_heap.hpp"
#include "codec/trianglemesh/swept_error.hpp"

namespace tetrakis::inline trianglemesh {
namespace {

/// Vertices that had no step are looked at again if the piece has lost a quarter of its triangles
/// since: of a piece of n triangles that takes n log n.
bool mayHaveSteps(uint32_t triangles, uint32_t before) {
  return triangles < before - before / 4;
}

class Thinning {
 public:
  explicit Thinning(CodedTriangles mesh)
      : triangles_(std::move(mesh)),
        left_(triangles_.mesh().vertices.size() / 3),
        pieces_(triangles_.mesh()),
        pieces_left_(pieces_.count()),
        states_(pieces_.count()),
        heap_(triangles_.mesh().places.size() + pieces_.count()),
        error_(triangles_.mesh().places) {
    for (uint32_t piece = 0; piece < pieces_.count(); ++piece) {
      states_[piece].triangles = pieces_.triangles(piece);
      lookAtAll(piece);
      goOn(piece);
    }
  }

  /// Until at most so many triangles are left.
  const CollapsingTriangles& run(uint64_t most) {
    const size_t vertices = triangles_.mesh().places.size();
    while (left_ > most) {
      const uint32_t cheapest = heap_.cheapest();
      if (cheapest < vertices)
        takeStep(cheapest);
      else if (pieces_left_ > 1)
        takeAway(static_cast<uint32_t>(cheapest - vertices));
      else
        keepLargest(most);
    }
    return triangles_;
  }

 private:
  enum class Stage : uint8_t { kKeepsShape, kKeepsSurface, kVanishes };
  struct State {
    Stage stage = Stage::kKeepsShape;
    uint32_t triangles = 0;  ///< that are left
    uint32_t looked_at = 0;  ///< that were left when all vertices were looked at
    uint32_t waiting = 0;    ///< its vertices in the heap
  };
  struct Step {
    uint64_t cost = 0;
    size_t target = 0;
  };

  /// Of a vertex that may collapse, with its star in star_. Of steps that cost the same it is the
  /// one to the lowest vertex.
  std::optional<Step> cheapestStep(uint32_t vertex) {
    if (!triangles_.findStar(vertex, star_)) return {};
    const bool strictly = states_[pieces_.of(vertex)].stage == Stage::kKeepsShape;
    error_.look(triangles_.mesh(), star_);
    const auto isBefore = [&](const Step& a, const Step& b) {
      return std::pair(a.cost, star_.points[a.target]) < std::pair(b.cost, star_.points[b.target]);
    };
    steps_.clear();
    const size_t count = star_.points.size();
    for (size_t target = 0; target < count; target += star_.closed ? 1 : count - 1)
      steps_.push_back({strictly ? error_.least(target) : error_.roughCost(target), target});
    std::sort(steps_.begin(), steps_.end(), isBefore);
    std::optional<Step> best;
    for (Step step : steps_) {
      if (best && best->cost < step.cost) break;
      if (strictly) {
        const WedgeHeirs heirs = triangles_.heirsOf(star_, step.target);
        const auto cost = error_.cost(step.target, heirs, step.cost);
        if (!cost) continue;
        step.cost = *cost;
      }
      if (best && isBefore(*best, step)) continue;
      if (triangles_.keepsSurface(star_, step.target, strictly)) best = step;
    }
    return best;
  }

  void lookAt(uint32_t vertex) {
    State& state = states_[pieces_.of(vertex)];
    if (heap_.holds(vertex)) --state.waiting;
    const std::optional<Step> step = cheapestStep(vertex);
    if (!step) return heap_.erase(vertex);
    ++state.waiting;
    heap_.set(vertex, step->cost);
  }

  void lookAtAll(uint32_t piece) {
    states_[piece].looked_at = states_[piece].triangles;
    for (const uint32_t vertex : pieces_.vertices(piece)) lookAt(vertex);
  }

  /// Finds further steps of a piece of which none waits.
  void goOn(uint32_t piece) {
    State& state = states_[piece];
    while (state.waiting == 0 && state.stage != Stage::kVanishes) {
      if (!mayHaveSteps(state.triangles, state.looked_at))
        state.stage = state.stage == Stage::kKeepsShape ? Stage::kKeepsSurface : Stage::kVanishes;
      if (state.stage != Stage::kVanishes) lookAtAll(piece);
    }
    if (state.waiting > 0) return;
    heap_.set(static_cast<uint32_t>(triangles_.mesh().places.size() + piece), costOf(piece));
  }

  /// As if all that is left of the piece went as far as the piece is long.
  uint64_t costOf(uint32_t piece) const {
    const CodedTriangles& mesh = triangles_.mesh();
    uint64_t area = 0;
    Place low, high;
    low.fill(INT32_MAX);
    high.fill(0);
    for (const uint32_t vertex : pieces_.vertices(piece)) {
      const uint32_t corner = triangles_.cornerOf()[vertex];
      if (corner == CollapsingTriangles::kNone) continue;
      const Place& place = mesh.places[vertex];
      for (size_t axis = 0; axis < 3; ++axis) {
        low[axis] = std::min(low[axis], place[axis]);
        high[axis] = std::max(high[axis], place[axis]);
      }
      visitFan(mesh.sides, corner, [&](uint32_t at) {
        const auto wayTo = [&](uint32_t end) {
          return wayBetween(place, mesh.places[mesh.vertices[end]]);
        };
        area = costSum(area, roughLength(crossProduct(wayTo(after(at)), wayTo(before(at)))));
      });
    }
    return error_.areaCost(area / 3, SweptError::distanceOf(wayBetween(low, high)));
  }

  void takeStep(uint32_t vertex) {
    const uint32_t piece = pieces_.of(vertex);
    const std::optional<Step> step = cheapestStep(vertex);
    // Collapses two edges away may have taken the step away that it waited for.
    if (!step || step->cost != heap_.costOf(vertex)) {
      lookAt(vertex);
      return goOn(piece);
    }
    triangles_.collapse(star_, step->target);
    const uint32_t vanished = star_.closed ? 2 : 1;
    left_ -= vanished;
    states_[piece].triangles -= vanished;
    --states_[piece].waiting;
    heap_.erase(vertex);
    changed_ = star_.points;
    for (const uint32_t point : changed_) lookAt(point);
    goOn(piece);
  }

  void takeAway(uint32_t piece) {
    for (const uint32_t vertex : pieces_.vertices(piece)) {
      const uint32_t corner = triangles_.cornerOf()[vertex];
      if (corner == CollapsingTriangles::kNone) continue;
      visitFan(triangles_.mesh().sides, corner, [&](uint32_t at) { triangles_.remove(at / 3); });
    }
    left_ -= states_[piece].triangles;
    --pieces_left_;
    heap_.erase(static_cast<uint32_t>(triangles_.mesh().places.size() + piece));
  }

  /// Of the last piece.
  void keepLargest(uint64_t most) {
    const CodedTriangles& mesh = triangles_.mesh();
    std::vector<std::pair<uint64_t, uint32_t>> by_area;
    for (uint32_t t = 0; t < mesh.vertices.size() / 3; ++t) {
      if (triangles_.isGone(t)) continue;
      const auto at = [&](uint32_t i) { return mesh.places[mesh.vertices[3 * t + i]]; };
      const uint64_t area =
          roughLength(crossProduct(wayBetween(at(0), at(1)), wayBetween(at(0), at(2))));
      by_area.push_back({UINT64_MAX - area, t});
    }
    std::sort(by_area.begin(), by_area.end());
    for (size_t i = most; i < by_area.size(); ++i) triangles_.remove(by_area[i].second);
    left_ = most;
  }

  CollapsingTriangles triangles_;
  uint64_t left_;  ///< triangles
  MeshPieces pieces_;
  uint32_t pieces_left_;
  std::vector<State> states_;  ///< of each piece
  StepHeap heap_;              ///< vertices, and behind them the pieces that vanish next
  SweptError error_;
  Star star_;                ///< of the latest vertex that was looked at
  std::vector<Step> steps_;  ///< of it
  std::vector<uint32_t> changed_;
};

}  // namespace

CodedTriangles fewerTriangles(CodedTriangles mesh, uint64_t most) {
  if (mesh.vertices.size() / 3 <= most) return mesh;
  return Thinning(std::move(mesh)).run(most).rest();
}

LeftTriangles leftTriangles(CodedTriangles mesh, uint64_t most) {
  return Thinning(std::move(mesh)).run(most).left();
}

}  // namespace tetrakis::inline trianglemesh

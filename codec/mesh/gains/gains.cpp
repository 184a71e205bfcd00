// SPDX-License-Identifier: Apache-2.0
#include "codec/mesh/gains/gains.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "codec/mesh/topology/lattice_mesh.hpp"

namespace tetrakis::inline gains {

namespace {

double shareOnEdge(const SurfaceView& surface, GridPoint from, GridPoint to) {
  const auto both = [](uint32_t p, uint32_t q, uint32_t line) { return p == line && q == line; };
  const bool border = both(from.x, to.x, 0) || both(from.x, to.x, surface.width - 1) ||
                      both(from.y, to.y, 0) || both(from.y, to.y, surface.height - 1);
  return border ? 1.0 : 0.5;
}

class ClampedTriangle {
 public:
  ClampedTriangle(const SurfaceView& surface, const std::array<GridPoint, 3>& corners)
      : surface_(surface), samples_(corners), base_(heightAt(corners[0].x, corners[0].y)) {
    for (size_t k = 0; k < 3; ++k) {
      shares_[k] = shareOnEdge(surface, corners[(k + 1) % 3], corners[(k + 2) % 3]);
      rise_[k] = heightAt(corners[k].x, corners[k].y) - base_;
    }
  }

  const TriangleSamples& samples() const { return samples_; }
  /// The share that the triangle has of a sample that lies in it.
  double share(const TriangleSamples::Edges& e) const {
    double share = 1;
    for (size_t k = 0; k < 3; ++k)
      if (e[k] == 0) share = shares_[k];
    return share;
  }
  /// Squared residual times weight.
  double error(uint32_t x, uint32_t y, const TriangleSamples::Edges& e) const {
    const auto area = static_cast<double>(samples_.doubledArea());
    double plane = 0;
    for (size_t k = 0; k < 3; ++k) plane += static_cast<double>(e[k]) * rise_[k];
    const double residual = ((heightAt(x, y) - base_) * area - plane) / area;
    return residual * residual * surface_.weightOf(indexOf(x, y));
  }

 private:
  size_t indexOf(uint32_t x, uint32_t y) const { return size_t{y} * surface_.width + x; }
  double heightAt(uint32_t x, uint32_t y) const { return surface_.heights[indexOf(x, y)]; }

  const SurfaceView& surface_;
  TriangleSamples samples_;
  std::array<double, 3> shares_;  ///< of the samples on each edge
  std::array<double, 3> rise_;    ///< above corner 0: keeps the products small and exact on terrain
  double base_;
};

/// Sum of weighted squared residuals against the plane through the corners, shared as in
/// gains.hpp. The corners are samples; the triangle has an area.
double clampedEnergy(const SurfaceView& surface, const std::array<GridPoint, 3>& corners) {
  for ([[maybe_unused]] const GridPoint& p : corners)
    assert(p.x < surface.width && p.y < surface.height);
  const ClampedTriangle triangle(surface, corners);
  double energy = 0;
  triangle.samples().forEach([&](uint32_t x, uint32_t y, const TriangleSamples::Edges& e) {
    energy += triangle.share(e) * triangle.error(x, y, e);
  });
  return energy;
}

}  // namespace

double clampedError(const SurfaceView& surface, const std::array<GridPoint, 3>& corners,
                    GridPoint sample) {
  const ClampedTriangle triangle(surface, corners);
  const TriangleSamples::Edges e = triangle.samples().at(sample.x, sample.y);
  return (e[0] | e[1] | e[2]) < 0 ? 0 : triangle.error(sample.x, sample.y, e);
}

// One descent over the forest: moments bottom-up inside the grid, rasterised planes where it
// overhangs.

namespace {

struct HeightCorner {
  GridPoint point;
  double height = 0;
};
using HeightTriangle = LatticeTriangle<HeightCorner>;

class GainBuilder {
 public:
  GainBuilder(const Lattice& lattice, const SurfaceView& surface)
      : lattice_(lattice), surface_(surface), gains_(lattice.vertexCount()) {
    // Far from the border and without weights all triangles of a level have the same.
    grams_.resize(lattice.levelCount());
    TriangleMoments t = mergeFinest(kInnerWeights, 0);
    for (size_t level = grams_.size(); level-- > 0; t = merge(t, t, 0)) grams_[level] = t.gram;
  }

  std::vector<double> build() {
    forEachRootTriangle(
        lattice_, [&](GridPoint p) { return cornerAt(p); },
        [&](const HeightTriangle& t) { energyOf(t); });
    round();
    return std::move(gains_);
  }

 private:
  static constexpr CornerWeights kInnerWeights = {0.125, 0.125, 0.125, 0.25};

  HeightCorner cornerAt(GridPoint p) const {
    return {p, static_cast<double>(surface_.heights[lattice_.gridIndex(p)])};
  }

  /// Share of a sample's weight for each full-resolution triangle at it: 8 meet in samples of even
  /// coordinate sum, 4 in the others.
  double cornerWeight(GridPoint p) const {
    const double inside = (p.x + p.y) % 2 == 0 ? 0.125 : 0.25;
    const double side = p.x == 0 || p.x + 1 == lattice_.width() ? 2 : 1;
    return inside * side * (p.y == 0 || p.y + 1 == lattice_.height() ? 2 : 1) *
           surface_.weightOf(lattice_.gridIndex(p));
  }

  CornerWeights finestWeights(const HeightTriangle& t, GridPoint split) const {
    const bool inner = split.x > 1 && split.y > 1 && split.x + 2 < lattice_.width() &&
                       split.y + 2 < lattice_.height();
    if (inner && surface_.weights.empty()) return kInnerWeights;
    return {cornerWeight(t.a.point), cornerWeight(t.b.point), cornerWeight(t.apex.point),
            cornerWeight(split)};
  }

  bool isInner(GridPoint p) const {
    return p.x > 0 && p.y > 0 && p.x + 1 < lattice_.width() && p.y + 1 < lattice_.height();
  }

  /// What moments() does, for an inner triangle and without weights: nearly all there are.
  Residuals residuals(uint32_t level, const HeightCorner& a, const HeightCorner& b,
                      const HeightCorner& apex) {
    const GridPoint split = {(a.point.x + b.point.x) / 2, (a.point.y + b.point.y) / 2};
    const HeightCorner w = {
        split, static_cast<double>(surface_.heights[split.y * lattice_.width() + split.x])};
    const double delta = w.height - 0.5 * (a.height + b.height);
    double& gain = gains_[lattice_.id(lattice_.siteAt(level, split))];
    if (level + 1 == lattice_.levelCount()) {
      const double half = kInnerWeights.split * delta, energy = 2 * half * delta;
      gain += energy;
      return {energy, {half, half, 0}};
    }
    const Residuals t1 = residuals(level + 1, apex, a, w), t2 = residuals(level + 1, b, apex, w);
    const TriangleMoments::Gram& g = grams_[level + 1];
    const double more = 2 * delta * (t1.first.p + t2.first.p) + delta * delta * (g.pp + g.pp);
    gain += more;
    const double half = 0.5 * ((t1.first.p + delta * g.pp) + (t2.first.p + delta * g.pp));
    return {t1.energy + t2.energy + more,
            {(t1.first.b + delta * g.bp) + half, (t2.first.a + delta * g.ap) + half,
             (t1.first.a + delta * g.ap) + (t2.first.b + delta * g.bp)}};
  }

  /// Adds the gains in and below a triangle that lies inside the grid.
  TriangleMoments moments(const HeightTriangle& t) {
    if (surface_.weights.empty() && isInner(t.a.point) && isInner(t.b.point) &&
        isInner(t.apex.point)) {
      const Residuals r = residuals(t.level, t.a, t.b, t.apex);
      return {r.energy, r.first, grams_[t.level]};
    }
    const HeightCorner w = cornerAt(t.splitPoint());
    const double delta = w.height - 0.5 * (t.a.height + t.b.height);
    double& gain = gains_[lattice_.id(lattice_.siteAt(t.level, w.point))];
    if (t.level + 1 == lattice_.levelCount()) {
      const TriangleMoments finest = mergeFinest(finestWeights(t, w.point), delta);
      gain += finest.energy;
      return finest;
    }
    const TriangleMoments first = moments(t.first(w)), second = moments(t.second(w));
    gain += splitGain(first, second, delta);
    return merge(first, second, delta);
  }

  /// Adds the gains in and below any triangle. Depth at most levelCount().
  double energyOf(const HeightTriangle& t) {
    if (t.collapses(lattice_) || t.level == lattice_.levelCount()) return 0;
    return t.overhangs(lattice_) ? overhangingEnergy(t) : moments(t).energy;
  }

  /// The halves of a clamped triangle need not fill it, but those of a whole diamond do: the sum
  /// over its triangles is right.
  double overhangingEnergy(const HeightTriangle& t) {
    const HeightCorner w = cornerAt(t.splitPoint());
    const double halves = energyOf(t.first(w)) + energyOf(t.second(w));
    const GridPoint a = lattice_.clamp(t.a.point), b = lattice_.clamp(t.b.point);
    const GridPoint split = lattice_.clamp(w.point);
    if (split == a || split == b) return halves;  // one half is all of t, the other has no area
    const double whole = clampedEnergy(surface_, {a, b, lattice_.clamp(t.apex.point)});
    gains_[lattice_.id(lattice_.siteAt(t.level, w.point))] += whole - halves;
    return whole;
  }

  /// Doubles hold every multiple of a unit up to 2^53 units: no sum of gains comes near that.
  void round() {
    double total = 0;
    for (const double g : gains_) total += std::abs(g);
    if (total == 0) return;
    const float heaviest = surface_.weights.empty() ? 1
                                                    : *std::max_element(surface_.weights.begin(),
                                                                        surface_.weights.end());
    const int exponent = std::max(std::ilogb(heaviest) - 30, std::ilogb(total) - 51);
    const double unit = std::ldexp(1.0, exponent), inverse = std::ldexp(1.0, -exponent);
    for (double& g : gains_) g = std::round(g * inverse) * unit;
  }

  const Lattice& lattice_;
  const SurfaceView& surface_;
  std::vector<double> gains_;
  std::vector<TriangleMoments::Gram> grams_;  ///< of inner triangles of each level
};

}  // namespace

Status checkWeights(const SurfaceView& surface) {
  if (!surface.weights.empty() && surface.weights.size() != surface.heights.size())
    return {TKS_USAGE, "A surface needs one weight for each sample, or none at all."};
  for (const float w : surface.weights)
    if (!(w >= 0 && std::isfinite(w)))
      return {TKS_USAGE, "Weights of samples must be finite and not negative."};
  return {};
}

std::vector<double> vertexGains(const Lattice& lattice, const SurfaceView& surface) {
  assert(surface.width == lattice.width() && surface.height == lattice.height());
  assert(surface.heights.size() == lattice.sampleCount());
  return GainBuilder(lattice, surface).build();
}

}  // namespace tetrakis::inline gains

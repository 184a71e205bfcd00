// SPDX-License-Identifier: Apache-2.0
// FittedMoments, momentsOf() and squaredErrorOf() sum the samples in triangles against the planes
// through fitted heights.
#include "codec/mesh/fitting/fitting.hpp"

#include <algorithm>
#include <cassert>

#include "codec/mesh/topology/lattice_mesh.hpp"

namespace tetrakis::inline fitting {

namespace {

/// visit(WeighedSample) for every sample that counts in the triangle.
template <class Visit>
void forEachWeighed(const WeightedSurface& surface, const HeldTriangle& triangle, Visit&& visit) {
  const SurfaceView& grid = surface.view;
  std::array<double, 3> shares;  // of the samples on each edge
  for (size_t k = 0; k < 3; ++k) {
    const bool border =
        onBorder(grid, triangle.corners[(k + 1) % 3], triangle.corners[(k + 2) % 3]);
    shares[k] = border ? 1.0 : 0.5;
  }
  const TriangleSamples samples(triangle.corners);
  const auto area = static_cast<double>(samples.doubledArea());
  const std::array<double, 3>& h = triangle.heights;
  samples.forEach([&](uint32_t x, uint32_t y, const TriangleSamples::Edges& e) {
    if (std::count(e.begin(), e.end(), 0) == 2) return;  // a vertex stands apart
    const uint32_t sample = y * grid.width + x;
    double weight = surface.weightOf(sample);
    for (size_t k = 0; k < 3; ++k)
      if (e[k] == 0) weight *= shares[k];
    const double a = static_cast<double>(e[0]) / area, b = static_cast<double>(e[1]) / area,
                 p = static_cast<double>(e[2]) / area;
    const double z = grid.heights[sample];
    visit(WeighedSample{weight, a, b, p, a * (z - h[0]) + b * (z - h[1]) + p * (z - h[2])});
  });
}

}  // namespace

void add(TriangleMoments& t, const WeighedSample& s) {
  t.energy += s.weight * s.residual * s.residual;
  t.first.a += s.weight * s.residual * s.a;
  t.first.b += s.weight * s.residual * s.b;
  t.first.p += s.weight * s.residual * s.p;
  t.gram.aa += s.weight * s.a * s.a;
  t.gram.bb += s.weight * s.b * s.b;
  t.gram.pp += s.weight * s.p * s.p;
  t.gram.ab += s.weight * s.a * s.b;
  t.gram.ap += s.weight * s.a * s.p;
  t.gram.bp += s.weight * s.b * s.p;
}

bool onBorder(const SurfaceView& grid, GridPoint from, GridPoint to) {
  return (from.x == to.x && (from.x == 0 || from.x + 1 == grid.width)) ||
         (from.y == to.y && (from.y == 0 || from.y + 1 == grid.height));
}

TriangleMoments momentsOf(const WeightedSurface& surface, const HeldTriangle& triangle) {
  TriangleMoments moments;
  forEachWeighed(surface, triangle, [&](const WeighedSample& s) { add(moments, s); });
  return moments;
}

double squaredErrorOf(const WeightedSurface& surface, const HeldTriangle& triangle) {
  double energy = 0;
  forEachWeighed(surface, triangle,
                 [&](const WeighedSample& s) { energy += s.weight * s.residual * s.residual; });
  return energy;
}

// Descents over the forest that merge leaves in their order; triangles that overhang the grid are
// rasterised instead, because their halves need not fill them (gains.cpp).

namespace {

struct FittedCorner {
  GridPoint point;
  uint32_t sample = 0;
  double height = 0;
};
using FittedTriangle = LatticeTriangle<FittedCorner>;

/// The plane moves down by (a, b, p) at the corners: all residuals grow by a linear function.
void lower(TriangleMoments& t, const TriangleMoments::First& by) {
  const auto& g = t.gram;
  const TriangleMoments::First g_by = {g.aa * by.a + g.ab * by.b + g.ap * by.p,
                                       g.ab * by.a + g.bb * by.b + g.bp * by.p,
                                       g.ap * by.a + g.bp * by.b + g.pp * by.p};
  t.energy += by.a * (2 * t.first.a + g_by.a) + by.b * (2 * t.first.b + g_by.b) +
              by.p * (2 * t.first.p + g_by.p);
  t.first = {t.first.a + g_by.a, t.first.b + g_by.b, t.first.p + g_by.p};
}

std::array<double, 3> cornerSamples(const WeightedSurface& surface, const FittedTriangle& t) {
  const auto& z = surface.view.heights;
  return {static_cast<double>(z[t.a.sample]), static_cast<double>(z[t.b.sample]),
          static_cast<double>(z[t.apex.sample])};
}

/// The moments of the clamped triangle, against the plane through the samples at its corners.
TriangleMoments rasterise(const Lattice& lattice, const WeightedSurface& surface,
                          const FittedTriangle& t) {
  return tetrakis::momentsOf(
      surface, {{lattice.clamp(t.a.point), lattice.clamp(t.b.point), lattice.clamp(t.apex.point)},
                cornerSamples(surface, t)});
}

}  // namespace

/// Walks the mesh of a FittedMoments; its leaves come in the order in which they are stored.
class FittedDescent {
 public:
  explicit FittedDescent(const FittedMoments& mesh) : mesh_(mesh), lattice_(mesh.lattice_) {
    if (!mesh.full_ || mesh.surface_.isWeighted()) return;
    grams_.resize(lattice_.levelCount() + 1);
    TriangleMoments t;
    for (size_t level = lattice_.levelCount(); level-- > 0; grams_[level] = t.gram) {
      t = tetrakis::merge(t, t, 0);
      add(t, {0.5, 0.5, 0.5, 0, 0});
    }
  }

  /// visit(FittedTriangle) for every root triangle.
  template <class Visit>
  void forEachRoot(Visit&& visit) const {
    forEachRootTriangle(
        lattice_, [&](GridPoint p) { return cornerAt(p); }, visit);
  }

  /// The leaves of the mesh of `kept` within t.
  void merge(const FittedTriangle& t, const std::vector<bool>& kept, std::vector<FittedLeaf>& out) {
    if (t.collapses(lattice_)) return;
    if (splits(t, kept)) {
      const FittedCorner w = cornerAt(t.splitPoint());
      merge(t.first(w), kept, out);
      merge(t.second(w), kept, out);
      return;
    }
    const bool was_leaf = !splits(t, mesh_.present_);
    TriangleMoments moments = momentsOf(t, nullptr);
    if (!was_leaf && t.overhangs(lattice_)) moments = overhanging(t);
    out.push_back({{t.a.sample, t.b.sample, t.apex.sample}, moments});
  }

  /// The moments of a triangle inside the grid. If the triangle overhangs and is no leaf, only the
  /// energy is computed. gains: those in and below t are added to it; may be null.
  TriangleMoments momentsOf(const FittedTriangle& t, std::vector<double>* gains) {
    if (t.collapses(lattice_)) return {};
    if (!splits(t, mesh_.present_))
      return mesh_.full_ ? TriangleMoments() : mesh_.leaves_[next_++].moments;
    if (!grams_.empty() && isInner(t.a.point) && isInner(t.b.point) && isInner(t.apex.point)) {
      const Residuals r = residuals(t.level, t.a.sample, t.b.sample, t.apex.sample);
      return {r.energy, r.first, grams_[t.level]};
    }
    const FittedCorner w = cornerAt(t.splitPoint());
    const TriangleMoments first = momentsOf(t.first(w), gains);
    const TriangleMoments second = momentsOf(t.second(w), gains);
    const double halves = first.energy + second.energy;
    TriangleMoments whole;
    if (!t.overhangs(lattice_)) {
      whole = mergeHalves(t, w, first, second);
    } else {
      whole.energy = halves;
      if (gains == nullptr || w.sample == t.a.sample || w.sample == t.b.sample) return whole;
      whole.energy = overhanging(t).energy;
    }
    if (gains != nullptr)
      (*gains)[lattice_.id(lattice_.siteAt(t.level, w.point))] += whole.energy - halves;
    return whole;
  }

 private:
  FittedCorner cornerAt(GridPoint p) const {
    const uint32_t sample = lattice_.gridIndex(p);
    return {p, sample, mesh_.heights_[sample]};
  }

  bool splits(const FittedTriangle& t, const std::vector<bool>& vertices) const {
    return t.level < lattice_.levelCount() &&
           vertices[lattice_.id(lattice_.siteAt(t.level, t.splitPoint()))];
  }

  bool isInner(GridPoint p) const {
    return p.x > 0 && p.y > 0 && p.x + 1 < lattice_.width() && p.y + 1 < lattice_.height();
  }

  /// What momentsOf() does to an inner triangle of full resolution without weights, where all of a
  /// level have the same second moments: nearly all there are at first. Corners are samples.
  Residuals residuals(uint32_t level, uint32_t a, uint32_t b, uint32_t apex) const {
    const uint32_t w = (a + b) / 2;
    const std::vector<double>& z = mesh_.heights_;
    const double delta = z[w] - 0.5 * (z[a] + z[b]), own = 0.5 * delta;
    if (level + 1 == lattice_.levelCount()) return {own * delta, {0.5 * own, 0.5 * own, 0}};
    const Residuals t1 = residuals(level + 1, apex, a, w), t2 = residuals(level + 1, b, apex, w);
    const TriangleMoments::Gram& g = grams_[level + 1];
    const double p1 = t1.first.p + delta * g.pp, p2 = t2.first.p + delta * g.pp;
    const double both = 0.5 * (p1 + p2 + own);
    const double gain = 2 * delta * (t1.first.p + t2.first.p) + delta * delta * (g.pp + g.pp);
    return {t1.energy + t2.energy + gain + own * delta,
            {t1.first.b + delta * g.bp + both, t2.first.a + delta * g.ap + both,
             t1.first.a + delta * g.ap + (t2.first.b + delta * g.bp)}};
  }

  TriangleMoments overhanging(const FittedTriangle& t) const {
    const GridPoint w = t.splitPoint(), p = t.apex.point;
    const bool first = p.y < w.y || (p.y == w.y && p.x < w.x);
    const uint64_t split = lattice_.id(lattice_.siteAt(t.level, w));
    const auto [known, added] = mesh_.rasters_.try_emplace(2 * split + (first ? 0 : 1));
    if (added) known->second = rasterise(lattice_, mesh_.surface_, t);
    TriangleMoments moments = known->second;
    const std::array<double, 3> z = cornerSamples(mesh_.surface_, t);
    lower(moments, {z[0] - t.a.height, z[1] - t.b.height, z[2] - t.apex.height});
    return moments;
  }

  /// w becomes a sample like others.
  TriangleMoments mergeHalves(const FittedTriangle& t, const FittedCorner& w,
                              const TriangleMoments& first, const TriangleMoments& second) const {
    const double middle = 0.5 * (t.a.height + t.b.height);
    TriangleMoments moments = tetrakis::merge(first, second, w.height - middle);
    const double weight = onBorder(mesh_.surface_.view, t.a.point, t.b.point) ? 1.0 : 0.5;
    add(moments, {weight * mesh_.surface_.weightOf(w.sample), 0.5, 0.5, 0,
                  mesh_.surface_.view.heights[w.sample] - middle});
    return moments;
  }

  const FittedMoments& mesh_;
  const Lattice& lattice_;
  size_t next_ = 0;                           ///< leaf
  std::vector<TriangleMoments::Gram> grams_;  ///< for residuals(), of each level; empty: not so
};

FittedMoments::FittedMoments(const Lattice& lattice, const WeightedSurface& surface)
    : lattice_(lattice),
      surface_(surface),
      present_(lattice.vertexCount(), true),
      heights_(surface.view.heights.begin(), surface.view.heights.end()) {
  assert(surface.known.empty() || surface.known.size() == heights_.size());
}

void FittedMoments::coarsen(std::span<const VertexId> kept) {
  std::vector<bool> keep(present_.size());
  for (const VertexId v : kept) {
    assert(present_[v]);
    keep[v] = true;
  }
  std::vector<FittedLeaf> merged;
  FittedDescent descent(*this);
  descent.forEachRoot([&](const auto& t) { descent.merge(t, keep, merged); });
  leaves_ = std::move(merged);
  present_ = std::move(keep);
  full_ = false;
}

void FittedMoments::correct(std::span<const uint32_t> samples,
                            std::span<const double> corrections) {
  assert(!full_ && samples.size() == corrections.size());
  std::vector<double> before;
  before.reserve(3 * leaves_.size());
  for (const FittedLeaf& leaf : leaves_)
    for (const uint32_t sample : leaf.corners) before.push_back(heights_[sample]);
  for (size_t i = 0; i < samples.size(); ++i) heights_[samples[i]] += corrections[i];
  for (size_t i = 0; i < leaves_.size(); ++i) {
    FittedLeaf& leaf = leaves_[i];
    const double* old = &before[3 * i];
    lower(leaf.moments, {old[0] - heights_[leaf.corners[0]], old[1] - heights_[leaf.corners[1]],
                         old[2] - heights_[leaf.corners[2]]});
  }
}

std::vector<double> FittedMoments::gains(std::span<const VertexId> vertices) const {
  assert(!full_);
  std::vector<double> all(lattice_.vertexCount());
  FittedDescent descent(*this);
  descent.forEachRoot([&](const auto& t) { descent.momentsOf(t, &all); });
  std::vector<double> gains;
  gains.reserve(vertices.size());
  for (const VertexId v : vertices) {
    const Site site = lattice_.site(v);
    const uint32_t sample = lattice_.gridIndex(lattice_.position(site));
    const double own = surface_.view.heights[sample] - heights_[sample];
    const double weight = lattice_.hidden(site) ? 0 : surface_.weightOf(sample);
    gains.push_back(all[v] - weight * own * own);
  }
  return gains;
}

}  // namespace tetrakis::inline fitting

// SPDX-License-Identifier: Apache-2.0
// vertexGains() takes a surface and returns for each vertex of its lattice the squared error that
// inserting the vertex removes, on which all choices of vertices rest. It sums TriangleMoments
// bottom-up, and clampedEnergy() where the lattice reaches over the grid.
#pragma once

#include <array>
#include <vector>

#include "codec/mesh/surface/surface.hpp"
#include "codec/mesh/topology/lattice.hpp"
#include "tetrakis/result.hpp"

namespace tetrakis::inline gains {

// TriangleMoments holds the squared error of a triangle's plane and the sums from which that of a
// larger triangle follows, bottom-up without cancellation (thesis 5.A: the l2 distance).
//
// Let r = z - P_T be the residual of the samples of a triangle T against the plane through its
// corners, and lambda its barycentric coordinates. T is split at w into T1, T2; their planes differ
// from P_T by delta * h, where delta = z_w - (z_a + z_b) / 2 and h, the hat of w, is the
// barycentric coordinate of w in T1 and T2. Hence r = r_i + delta * h on T_i, and with
//
//   energy    E    = sum of r^2
//   first_k   F_k  = sum of r lambda_k
//   gram_jk   G_jk = sum of lambda_j lambda_k
//
//   E(T) = E(T1) + E(T2) + g,   g = sum over i of 2 delta F_w(Ti) + delta^2 G_ww(Ti),
//
// while F and G of T follow from those of T1, T2, because the barycentric coordinates of T are
// linear in those of T_i. Plain moments (sums of z, z^2, x z ...) would lose all digits on high
// plateaus.
//
// Samples on an edge count half for the triangle on either side, and fully where the edge lies on
// the border of the grid: over any mesh every sample has weight 1. Corners have no residual; their
// weight is 1 over the number of full-resolution triangles that meet there, for each such triangle.

/// The moments of samples against the plane of one triangle (a, b, apex).
struct TriangleMoments {
  struct Gram {
    double aa = 0, bb = 0, pp = 0, ab = 0, ap = 0, bp = 0;  ///< p: apex
  };
  struct First {
    double a = 0, b = 0, p = 0;
  };
  double energy = 0;
  First first;
  Gram gram;
};

/// The moments that depend on the heights: what is left to find where the Gram matrix is known.
struct Residuals {
  double energy = 0;
  TriangleMoments::First first;
};

/// The weights of the corner samples in one full-resolution triangle, and the weight of the split
/// vertex w in either half.
struct CornerWeights {
  double a = 0, b = 0, apex = 0, split = 0;
};

/// Returns g of one triangle: the error that the split by `delta` removes.
inline double splitGain(const TriangleMoments& t1, const TriangleMoments& t2, double delta) {
  return 2 * delta * (t1.first.p + t2.first.p) + delta * delta * (t1.gram.pp + t2.gram.pp);
}

/// Moments of T from T1 = (apex, a, w) and T2 = (b, apex, w).
inline TriangleMoments merge(const TriangleMoments& t1, const TriangleMoments& t2, double delta) {
  const auto lift = [delta](const TriangleMoments& t) {  // sums of (r_i + delta h) lambda
    return TriangleMoments::First{t.first.a + delta * t.gram.ap, t.first.b + delta * t.gram.bp,
                                  t.first.p + delta * t.gram.pp};
  };
  const TriangleMoments::First f1 = lift(t1), f2 = lift(t2);
  const TriangleMoments::Gram &g1 = t1.gram, &g2 = t2.gram;
  const double half = 0.5 * (f1.p + f2.p), quarter = 0.25 * (g1.pp + g2.pp);
  TriangleMoments t;
  t.energy = t1.energy + t2.energy + splitGain(t1, t2, delta);
  t.first = {f1.b + half, f2.a + half, f1.a + f2.b};
  // On T1: lambda_a = b1 + p1/2, lambda_b = p1/2, lambda_p = a1. On T2: p2/2, a2 + p2/2, b2.
  t.gram.aa = g1.bb + g1.bp + quarter;
  t.gram.bb = g2.aa + g2.ap + quarter;
  t.gram.pp = g1.aa + g2.bb;
  t.gram.ab = 0.5 * (g1.bp + g2.ap) + quarter;
  t.gram.ap = g1.ab + 0.5 * (g1.ap + g2.bp);
  t.gram.bp = g2.ab + 0.5 * (g2.bp + g1.ap);
  return t;
}

/// merge() of two full-resolution triangles, whose only samples are their corners.
inline TriangleMoments mergeFinest(const CornerWeights& weight, double delta) {
  TriangleMoments t;
  const double half = weight.split * delta, quarter = 0.5 * weight.split;
  t.energy = 2 * half * delta;
  t.first = {half, half, 0};
  t.gram = {weight.a + quarter, weight.b + quarter, 2 * weight.apex, quarter, 0, 0};
  return t;
}

// clampedEnergy() sums the squared error of a triangle with any corners on the grid. Clamping makes
// triangles of such shapes, to which the recursion of TriangleMoments does not apply.

/// The weighted squared residual of one sample, whole; 0 where it lies outside the triangle.
double clampedError(const SurfaceView& surface, const std::array<GridPoint, 3>& corners,
                    GridPoint sample);

// vertexGains() computes from a surface the worth of each lattice vertex, by the diamond form of
// the global error (thesis 5.3).
//
// Inserting v splits the one or two triangles of its diamond. g(v) = sum of E over them - sum of E
// over their halves is fixed and local, whatever else is in the mesh. So for every closed set S the
// squared error of its mesh is D = sum of g(v) over the vertices v that are not in S (full
// resolution has D = 0).

/// TKS_USAGE for weights that are not one for each sample, or negative or not finite.
Status checkWeights(const SurfaceView& surface);

/// Returns g of every vertex, in squared height steps. A gain may be negative. Gains are rounded to
/// multiples of one power of two (2^-30 of the largest weight where that is fine enough), chosen so
/// that every sum of gains is exact in any order; so no order of vertices that is built from them
/// depends on rounding. The surface must have the size of the lattice and pass checkWeights().
std::vector<double> vertexGains(const Lattice& lattice, const SurfaceView& surface);

}  // namespace tetrakis::inline gains

// SPDX-License-Identifier: Apache-2.0
// fitHeights() replaces the heights at the vertices of a mesh by those that fit the surface best.
//
// A mesh with heights h is the function sum over vertices k of h_k phi_k, phi_k the hat of vertex
// k. Its squared error over the samples z with weights w is least where
//
//   A h = b,   A_jk = sum of w phi_j phi_k,   b_k = sum of w z phi_k
//
// (thesis 5.A fits planes to triangles; here all triangles share their corners). A is a mass
// matrix: scaled by its diagonal its condition is at most 4 (Wathen 1987), so a few steps of
// conjugate gradients solve it.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "codec/mesh/fitting/fitted_moments.hpp"

namespace tetrakis::inline fitting {

/// Moves the heights of a coarsened mesh to the least squares. A vertex whose own sample has no
/// weight stays where it is as far as no other sample says more. The same bits with every compiler.
void fitHeights(FittedMoments& mesh);

/// What the least squares add to the height at each of these samples, the vertices of a mesh.
struct HeightCorrections {
  std::vector<uint32_t> samples;
  std::vector<double> corrections;
};

/// The corrections of the heights of a mesh of any triangles. leaves: their moments against the
/// planes through `heights`, which has one for each sample; those of vertices count.
HeightCorrections fittedCorrections(const WeightedSurface& surface,
                                    std::span<const FittedLeaf> leaves,
                                    std::span<const double> heights);

}  // namespace tetrakis::inline fitting

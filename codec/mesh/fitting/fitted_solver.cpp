// SPDX-License-Identifier: Apache-2.0
// fitHeights() and fittedCorrections() solve the least squares of all heights of a mesh, and
// withinRange() keeps the heights within the range of the surface.
#include "codec/mesh/fitting/fitting.hpp"

#include <algorithm>
#include <cassert>
#include <limits>

namespace tetrakis::inline fitting {

std::vector<double> withinRange(const WeightedSurface& surface, std::vector<double> heights) {
  int32_t low = std::numeric_limits<int32_t>::max(), high = std::numeric_limits<int32_t>::min();
  for (size_t i = 0; i < surface.view.heights.size(); ++i) {
    if (!surface.isKnown(i)) continue;
    low = std::min(low, surface.view.heights[i]);
    high = std::max(high, surface.view.heights[i]);
  }
  if (low > high) return heights;
  for (double& height : heights) height = std::clamp<double>(height, low, high);
  return heights;
}

// Normal equations triangle by triangle, solved by conjugate gradients with the diagonal as
// preconditioner (Hestenes and Stiefel 1952). The unknowns are corrections of the present heights;
// every sum runs in the mesh's order.

namespace {

/// The squared error of the solution over that of zero heights. A smaller number takes steps of the
/// solver, which nobody sees.
constexpr double kPrecision = 0x1p-40;
constexpr int kMaxSteps = 100;  // at condition 4 a step gains a factor of 3

class NormalEquations {
 public:
  NormalEquations(const WeightedSurface& surface, std::span<const FittedLeaf> leaves,
                  std::span<const double> heights)
      : surface_(surface), heights_(heights), index_(heights.size(), kNone) {
    couplings_.reserve(leaves.size());
    for (const FittedLeaf& leaf : leaves) add(leaf);
  }

  /// The samples whose heights are the unknowns.
  const std::vector<uint32_t>& samples() const { return samples_; }
  /// What the present heights leave of b.
  const std::vector<double>& right() const { return right_; }
  double diagonal(size_t k) const { return diagonal_[k]; }

  void multiply(const std::vector<double>& x, std::vector<double>& out) const {
    for (size_t k = 0; k < x.size(); ++k) out[k] = diagonal_[k] * x[k];
    for (const Coupling& t : couplings_) {
      const auto [a, b, p] = t.corners;
      out[a] += t.ab * x[b] + t.ap * x[p];
      out[b] += t.ab * x[a] + t.bp * x[p];
      out[p] += t.ap * x[a] + t.bp * x[b];
    }
  }

 private:
  /// The part of A off the diagonal that one triangle adds.
  struct Coupling {
    std::array<uint32_t, 3> corners;
    double ab, ap, bp;
  };
  static constexpr uint32_t kNone = std::numeric_limits<uint32_t>::max();
  /// Holds a vertex whose own sample has no weight: far below the usual weight, 1.
  static constexpr double kHold = 0x1p-10;

  void add(const FittedLeaf& leaf) {
    std::array<uint32_t, 3> k;
    for (size_t i = 0; i < 3; ++i) k[i] = unknown(leaf.corners[i]);
    const TriangleMoments& t = leaf.moments;
    couplings_.push_back({k, t.gram.ab, t.gram.ap, t.gram.bp});
    diagonal_[k[0]] += t.gram.aa;
    diagonal_[k[1]] += t.gram.bb;
    diagonal_[k[2]] += t.gram.pp;
    right_[k[0]] += t.first.a;
    right_[k[1]] += t.first.b;
    right_[k[2]] += t.first.p;
  }

  /// The vertex's own sample (phi = 1) comes with its first triangle.
  uint32_t unknown(uint32_t sample) {
    if (index_[sample] == kNone) {
      index_[sample] = static_cast<uint32_t>(samples_.size());
      samples_.push_back(sample);
      const double weight = surface_.weightOf(sample);
      diagonal_.push_back(weight > 0 ? weight : kHold);
      right_.push_back(weight * (surface_.view.heights[sample] - heights_[sample]));
    }
    return index_[sample];
  }

  const WeightedSurface& surface_;
  std::span<const double> heights_;
  std::vector<uint32_t> index_;  ///< of each sample among the unknowns
  std::vector<uint32_t> samples_;
  std::vector<double> diagonal_, right_;
  std::vector<Coupling> couplings_;
};

double dot(const std::vector<double>& x, const std::vector<double>& y) {
  double sum = 0;
  for (size_t k = 0; k < x.size(); ++k) sum += x[k] * y[k];
  return sum;
}

/// x with A x = b, to the root of kPrecision of b in the norm of the inverse diagonal.
std::vector<double> solve(const NormalEquations& a) {
  std::vector<double> x(a.right().size()), residual = a.right();
  std::vector<double> scaled(x.size()), image(x.size());
  const auto rescale = [&] {
    for (size_t k = 0; k < x.size(); ++k) scaled[k] = residual[k] / a.diagonal(k);
    return dot(residual, scaled);
  };
  double norm = rescale();
  const double goal = norm * kPrecision;
  std::vector<double> direction = scaled;
  for (int step = 0; step < kMaxSteps && norm > goal; ++step) {
    a.multiply(direction, image);
    const double length = norm / dot(direction, image);
    for (size_t k = 0; k < x.size(); ++k) {
      x[k] += length * direction[k];
      residual[k] -= length * image[k];
    }
    const double next = rescale();
    for (size_t k = 0; k < x.size(); ++k) direction[k] = scaled[k] + next / norm * direction[k];
    norm = next;
  }
  return x;
}

}  // namespace

HeightCorrections fittedCorrections(const WeightedSurface& surface,
                                    std::span<const FittedLeaf> leaves,
                                    std::span<const double> heights) {
  assert(!leaves.empty() && heights.size() == surface.view.heights.size());
  const NormalEquations equations(surface, leaves, heights);
  return {equations.samples(), solve(equations)};
}

void fitHeights(FittedMoments& mesh) {
  const HeightCorrections fitted = fittedCorrections(mesh.surface(), mesh.leaves(), mesh.heights());
  mesh.correct(fitted.samples, fitted.corrections);
}

}  // namespace tetrakis::inline fitting

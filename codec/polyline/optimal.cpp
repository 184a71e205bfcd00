// SPDX-License-Identifier: Apache-2.0
// uoptimal: dynamic programming over the trellis of thesis 2.3 (fig. 2.6, appendix 2.B). A best
// polyline of c segments to knot j is a best one of c - 1 segments to some knot l, and the chord
// from l to j: B[c][j] = min over l of B[c - 1][l] + E(l, j).
#include <algorithm>
#include <cstddef>
#include <limits>
#include <utility>

#include "codec/polyline/polylines.hpp"

namespace tetrakis::inline polyline {
namespace {

/// A column of the trellis, causally: what all polylines that end at knot j are made of.
class Trellis {
 public:
  Trellis(const Curve& curve, uint32_t most)
      : curve_(curve),
        best_(most + 1, std::vector<double>(curve.size(), 0.0)),
        before_(most + 1, std::vector<uint32_t>(curve.size(), 0)),
        chords_(curve.size()) {}

  void reach(uint32_t j) {
    for (uint32_t l = 0; l < j; ++l) chords_[l] = curve_.error(l, j);
    operations_.errors += j;
    best_[1][j] = chords_[0];
    const auto most = static_cast<uint32_t>(best_.size() - 1);
    for (uint32_t c = 2; c <= std::min(j, most); ++c) upgrade(c, j);
  }

  Polylines finish() && {
    Polylines polylines;
    polylines.errors.assign(curve_.size(), std::numeric_limits<double>::quiet_NaN());
    for (size_t c = 1; c < best_.size(); ++c) polylines.errors[c] = best_[c].back();
    polylines.before = std::move(before_);
    polylines.operations = operations_;
    return polylines;
  }

 private:
  /// The polylines of c segments to j, by their last knot but one.
  void upgrade(uint32_t c, uint32_t j) {
    const std::vector<double>& shorter = best_[c - 1];
    uint32_t chosen = c - 1;
    double least = shorter[chosen] + chords_[chosen];
    for (uint32_t l = c; l < j; ++l) {
      const double error = shorter[l] + chords_[l];
      if (error < least) {
        least = error;
        chosen = l;
      }
    }
    operations_.updates += j - c + 1;
    operations_.comparisons += j - c + 1;
    best_[c][j] = least;
    before_[c][j] = chosen;
  }

  const Curve& curve_;
  std::vector<std::vector<double>> best_;  ///< [segments][knot]
  std::vector<std::vector<uint32_t>> before_;
  std::vector<double> chords_;
  Operations operations_;
};

}  // namespace

Polylines uoptimalUpTo(const Curve& curve, uint32_t most) {
  Trellis trellis(curve, std::min(most, curve.size() - 1));
  for (uint32_t j = 1; j < curve.size(); ++j) trellis.reach(j);
  return std::move(trellis).finish();
}

Polylines uoptimal(const Curve& curve) {
  return uoptimalUpTo(curve, curve.size() - 1);
}

}  // namespace tetrakis::inline polyline

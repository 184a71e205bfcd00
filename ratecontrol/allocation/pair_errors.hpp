// SPDX-License-Identifier: Apache-2.0
// PairErrors gives the error of the picture for heights and textures of any quality (thesis 6.3.1:
// D(M_i, T_j)), from a grid of pairs that an engine has looked at. The two errors do not add: a
// texture that is in the wrong place is worth little (figure 6.7), and the grid holds that.
//
// Between two columns of the grid the logarithm of the error is linear in that of the squared error
// of the heights. Behind the last column the error goes on to fall towards that of the original,
// with the power of the squared error by which it fell before: the last bytes take off errors of
// fine detail, of which viewers see less. Rows and textures behave likewise.
#pragma once

#include <cstddef>
#include <vector>

namespace tetrakis::inline allocation {

/// Squared errors of the nodes of a grid, in their own samples: falling, positive. The original, of
/// error 0, is the node behind the last.
struct PairNodes {
  std::vector<double> heights, textures;
};

class PairErrors {
 public:
  /// errors: of the pairs, one row of textures after the other for each of the heights.
  PairErrors(PairNodes nodes, std::vector<double> errors);

  /// Where a squared error lies among the nodes.
  struct Place {
    size_t node = 0;    ///< the one before
    double rest = 0;    ///< of the way to the next one
    bool last = false;  ///< the next one is the original
    double ratio = 1;   ///< above 1: by which the squared error fell to the last node

    /// The exponent with which errors of pictures follow the squared error behind the last node.
    double power(double before, double from, double to) const;
  };
  Place heightsAt(double square) const { return placeOf(nodes_.heights, square); }
  Place textureAt(double square) const { return placeOf(nodes_.textures, square); }

  /// Error of the picture.
  double at(const Place& heights, const Place& texture) const;

 private:
  static Place placeOf(const std::vector<double>& nodes, double square);

  PairNodes nodes_;
  std::vector<double> errors_;
};

}  // namespace tetrakis::inline allocation

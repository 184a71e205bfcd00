// SPDX-License-Identifier: Apache-2.0
// ValueGaps estimates how the gaps between the values of a table harm prefixes: a prefix misses the
// place of a value by a few, and then errs by the gaps there. Encoder only.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace tetrakis::inline quantiser {

class ValueGaps {
 public:
  /// values: of a table, smallest first.
  explicit ValueGaps(std::vector<double> values);

  /// Values that no sample has, smallest first, to stand between values i - 1 and i where these are
  /// far apart. Without them a prefix would show the lowest ground at the value that marks holes in
  /// it.
  std::vector<double> bridge(size_t i) const;

  /// The bits by which samples of prefixes cost more than with even gaps that take as many bits.
  /// samples: how many have each value. A value that stands alone behind a bridge does not count.
  double unevenness(const std::vector<uint32_t>& samples) const;

 private:
  /// Between values i - 1 and i; 0 at the ends.
  double gap(size_t i) const;
  bool isWide(size_t i) const;
  /// The mean of the squared gaps around a value that are not wide; 0 if all of them are.
  double squaredGap(size_t i) const;

  std::vector<double> values_;
  double usual_ = 0;  ///< the median gap
};

}  // namespace tetrakis::inline quantiser

// SPDX-License-Identifier: Apache-2.0
// fewerBits() takes heights in steps and returns them as places in a table of their values, where
// that saves bits; chooseStandIn() chooses the polyline that stands for the table while bytes of it
// are missing. Encoder only.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "bitstream/stream/geometry_header.hpp"
#include "codec/geometry/quantiser/height_steps.hpp"
#include "tetrakis/tetrakis.h"

namespace tetrakis::inline quantiser {

// ValueGaps estimates how the gaps between the values of a table harm prefixes: a prefix misses the
// place of a value by a few, and then errs by the gaps there.

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

// fewerBits() decides whether a table of values takes fewer bits than multiples of a step.

/// multiples: the steps of toSteps() for the heights, with corrections behind them where they are
/// not exact. Returns these, or places in a table of values. A few rare values may be missing in
/// the table: then it is not exact, and corrections restore their samples.
HeightSteps fewerBits(const tks_heights& heights, HeightSteps multiples);

// chooseStandIn() chooses the knots of the polyline that stands for a table of values while bytes
// of the table are missing, and computes the error that the polyline leaves.

struct StandInChoice {
  std::vector<TableKnot> knots;
  double squares = 0;  ///< squared error of the samples with complete coefficients, in steps
};

/// steps: with a table. table_bytes: of its codeword. most: the squared error that one sample adds
/// at most.
StandInChoice chooseStandIn(const HeightSteps& steps, const GeometryHeader& header,
                            size_t table_bytes, double most);

}  // namespace tetrakis::inline quantiser

// SPDX-License-Identifier: Apache-2.0
// bench/results.csv: one measured quantity a line, in a stable order, so that a reviewer sees in a
// diff what a change costs or gains.
#pragma once

#include <string>
#include <vector>

#include "tetrakis/result.hpp"

namespace tetrakis::bench {

/// One line. No field may hold a comma, a quote or a line break: the first three are names of
/// files, codecs and quantities.
struct ResultRow {
  std::string item;  ///< the file, without extension, relative to the folder; or "mean"
  std::string codec;
  std::string quantity;  ///< with its unit, e.g. "bd_rate_percent"
  double value = 0;
};

/// Replaces all rows of `bench` in the CSV file by `rows`, keeps those of other benches, and
/// creates the file when there is none; an empty path: nothing is written. Columns:
/// bench,item,codec,quantity,value.
Status updateResults(const std::string& path, const std::string& bench,
                     const std::vector<ResultRow>& rows);

}  // namespace tetrakis::bench

// SPDX-License-Identifier: Apache-2.0
// Parts of the command line that benches share.
#pragma once

#include <CLI/CLI.hpp>

#include "bench/comparison.hpp"

namespace tetrakis::bench {

/// options.window holds the defaults.
inline void addComparisonOptions(CLI::App& app, ComparisonOptions& options) {
  app.add_option("DIR", options.folders, "Folders, searched recursively")->required();
  app.add_option("--low", options.window.low, "Lower end of the window of rates, bits a pixel")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--high", options.window.high, "Upper end of the window of rates, bits a pixel")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--files", options.filters, "Only files whose path holds one of these texts")
      ->delimiter(',');
  app.add_option("--csv", options.csv, "Replace this bench's rows of a results file");
}

/// What benches that measure time share. Options: holds `runs` and `csv`.
template <class Options>
void addRunOptions(CLI::App& app, Options& options) {
  app.add_option("--runs", options.runs, "Runs that each median of times is taken of")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--csv", options.csv, "Replace this bench's rows of a results file");
}

}  // namespace tetrakis::bench

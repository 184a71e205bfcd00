// SPDX-License-Identifier: Apache-2.0
// SurfaceFigures prints what is measured of models for a row of columns, and keeps the ratios for
// their means and for results.csv.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "bench/harness/results.hpp"

namespace tetrakis::bench {

using ColumnValues = std::vector<std::optional<double>>;  ///< nothing: "-"

class SurfaceFigures {
 public:
  /// quantity: what columns are, in names of results.csv, such as "at_error".
  SurfaceFigures(std::string quantity, std::vector<double> columns);

  const std::vector<double>& columns() const { return columns_; }

  /// A line with the columns themselves.
  void printColumns(const char* name, int digits) const;
  static void print(const char* name, const ColumnValues& values, int digits);

  /// A line of ours / theirs. name: what is compared.
  void ratios(const std::string& model, const std::string& name, const ColumnValues& ours,
              const ColumnValues& theirs);

  /// Geometric means over the models, of each name.
  void printMeans();

  const std::vector<ResultRow>& rows() const { return rows_; }

 private:
  void keep(const std::string& item, const std::string& name, const ColumnValues& values);

  std::string quantity_;
  std::vector<double> columns_;
  std::map<std::string, std::vector<std::vector<double>>> ratios_;  ///< of names, then of columns
  std::vector<ResultRow> rows_;
};

}  // namespace tetrakis::bench

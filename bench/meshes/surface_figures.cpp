// SPDX-License-Identifier: Apache-2.0
#include "bench/meshes/surface_figures.hpp"

#include <algorithm>
#include <cstdio>
#include <utility>

#include "bench/harness/averages.hpp"

namespace tetrakis::bench {

SurfaceFigures::SurfaceFigures(std::string quantity, std::vector<double> columns)
    : quantity_(std::move(quantity)), columns_(std::move(columns)) {}

void SurfaceFigures::printColumns(const char* name, int digits) const {
  print(name, {columns_.begin(), columns_.end()}, digits);
}

void SurfaceFigures::print(const char* name, const ColumnValues& values, int digits) {
  std::printf("  %-28s", name);
  for (const std::optional<double>& value : values) {
    if (value)
      std::printf(" %9.*f", digits, *value);
    else
      std::printf(" %9s", "-");
  }
  std::printf("\n");
  std::fflush(stdout);
}

void SurfaceFigures::ratios(const std::string& model, const std::string& name,
                            const ColumnValues& ours, const ColumnValues& theirs) {
  ColumnValues found(columns_.size());
  auto& all = ratios_[name];
  all.resize(columns_.size());
  for (size_t i = 0; i < found.size(); ++i) {
    if (!ours[i] || !theirs[i]) continue;
    found[i] = *ours[i] / *theirs[i];
    all[i].push_back(*found[i]);
  }
  print(name.c_str(), found, 3);
  keep(model, name, found);
}

void SurfaceFigures::printMeans() {
  if (ratios_.empty()) return;
  std::printf("geometric means\n");
  printColumns(quantity_.c_str(), 2);
  for (const auto& [name, all] : ratios_) {
    ColumnValues means;
    for (const std::vector<double>& of_column : all)
      means.push_back(of_column.empty() ? std::nullopt : std::optional(geometricMean(of_column)));
    print(name.c_str(), means, 3);
    keep("mean", name, means);
  }
}

void SurfaceFigures::keep(const std::string& item, const std::string& name,
                          const ColumnValues& values) {
  std::string quantity = name + '_' + quantity_ + '_';
  std::replace(quantity.begin(), quantity.end(), ' ', '_');
  for (size_t i = 0; i < values.size(); ++i) {
    if (!values[i]) continue;
    char column[32];
    std::snprintf(column, sizeof column, "%g", columns_[i]);
    rows_.push_back({item, "tetrakis", quantity + column, *values[i]});
  }
}

}  // namespace tetrakis::bench

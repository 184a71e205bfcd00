// SPDX-License-Identifier: Apache-2.0
// bench_polyline [HEIGHT...]: table 2.3 and figures 2.9, 2.10, 2.17 and 2.20 of the thesis on rows
// of height fields, beside the numbers that it prints.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "apps/tools/files/files.hpp"
#include "apps/tools/files/sample_types.hpp"
#include "apps/tools/synth/synth.hpp"
#include "bench/harness/arguments.hpp"
#include "bench/harness/results.hpp"
#include "codec/polyline/polylines.hpp"

namespace {

using namespace tetrakis;
using namespace tetrakis::bench;

constexpr uint32_t kSide = 257;          // curves and knots of fig. 2.2
constexpr double kWorst = 1e5;           // e_max of (2.3): every curve is scaled to it
constexpr double kRounding = 1e-9;       // of the largest error: less is no rise of the error
constexpr uint32_t kMostOptimal = 1025;  // knots that uoptimal is counted for: cubic time

using Heights = std::vector<double>;

struct Options {
  std::vector<std::string> heights;
  uint32_t rows = kSide;   ///< of each file
  bool all_rates = false;  ///< rows of results for every number of segments
  std::string csv;
};

/// Rows of the central square. Fails if a sample of it is void, or the file is smaller.
Result<std::vector<Heights>> centralRows(const tools::HeightFile& file, const std::string& name) {
  if (file.width < kSide || file.height < kSide)
    return Status(TKS_USAGE, name + " is smaller than 257 x 257 samples");
  const uint32_t left = (file.width - kSide) / 2, top = (file.height - kSide) / 2;
  std::vector<Heights> rows(kSide);
  bool whole = true;
  for (uint32_t y = 0; y < kSide; ++y)
    for (uint32_t x = 0; x < kSide; ++x) {
      const size_t i = size_t{top + y} * file.width + left + x;
      const double height =
          tools::visitSamples(file, [i](auto samples) { return static_cast<double>(samples[i]); });
      whole = whole && std::isfinite(height) && !(file.nodata && height == *file.nodata);
      rows[y].push_back(height * file.scale);
    }
  if (!whole) return Status(TKS_USAGE, name + " has voids in its central 257 x 257 samples");
  return rows;
}

Result<std::vector<Heights>> readRows(const Options& options) {
  if (options.heights.empty()) {
    tools::SynthOptions synth;
    synth.size = kSide;
    Result<std::vector<Heights>> all =
        centralRows(tools::synthesize(synth).heights, "the sample terrain");
    if (!all.ok() || options.rows == kSide) return all;
    std::vector<Heights> rows;
    for (uint32_t i = 0; i < options.rows; ++i)
      rows.push_back(std::move((*all)[size_t{i} * kSide / options.rows]));
    return rows;
  }
  std::vector<Heights> rows;
  for (const std::string& path : options.heights) {
    const Result<tools::HeightFile> file = tools::readHeights(path);
    Result<std::vector<Heights>> more =
        file.ok() ? centralRows(*file, path) : Result<std::vector<Heights>>(file.status());
    if (!more.ok()) {
      std::fprintf(stderr, "left out: %s\n", more.status().message().c_str());
      continue;
    }
    for (uint32_t i = 0; i < options.rows; ++i)
      rows.push_back(std::move((*more)[size_t{i} * kSide / options.rows]));
  }
  if (rows.empty()) return Status(TKS_USAGE, "None of the files has curves to measure.");
  return rows;
}

/// Of more knots than a row has: rows there and back, as a plough goes.
Heights ploughed(const std::vector<Heights>& rows, size_t first, uint32_t knots) {
  Heights heights;
  for (size_t r = first; heights.size() < knots; ++r) {
    Heights row = rows[r % rows.size()];
    if (r % 2 == 1) std::reverse(row.begin(), row.end());
    heights.insert(heights.end(), row.begin(), row.end());
  }
  heights.resize(knots);
  return heights;
}

/// Table 2.3 and fig. 2.9: operations over m log2 m, means of some curves.
void countOperations(const std::vector<Heights>& rows, std::vector<ResultRow>& results) {
  std::printf("Operations / (m log2 m); uoptimal: / n^3\n%6s", "n");
  for (const Algorithm& algorithm : kAlgorithms) std::printf(" %16s", algorithm.name);
  std::printf("\n%6s %16s", "thesis", "0.5");
  for (size_t i = 1; i < kAlgorithms.size(); ++i) std::printf(" %16g", kAlgorithms[i].factor);
  std::printf("\n");
  for (uint32_t n = 17; n <= 4097; n = 2 * n - 1) {
    std::printf("%6u", n);
    for (const Algorithm& algorithm : kAlgorithms) {
      const bool cubic = algorithm.factor == 0;
      if (cubic && n > kMostOptimal) {
        std::printf(" %16s", "-");
        continue;
      }
      const size_t curves = cubic ? 1 : 8;
      double operations = 0;
      for (size_t i = 0; i < curves; ++i) {
        const Curve curve(ploughed(rows, i * rows.size() / curves, n));
        operations += static_cast<double>(algorithm.run(curve).operations.total());
      }
      const double m = n - 2.0, unit = cubic ? double(n) * n * n : m * std::log2(m);
      const double share = operations / static_cast<double>(curves) / unit;
      std::printf(" %16.3f", share);
      results.push_back({"n_" + std::to_string(n), algorithm.name, "operations_share", share});
    }
    std::printf("\n");
  }
}

/// Means over the curves.
struct Quality {
  /// dB (2.3) by segments. Where an algorithm has no polyline of so many segments, the next smaller
  /// one that it has.
  std::vector<double> decibels = std::vector<double>(kSide, 0);
  double rises = 0;  ///< how often one segment more means more error (table 2.3: monotone)
};

Quality meanQuality(const std::vector<Heights>& rows, const Algorithm& algorithm) {
  Quality quality;
  size_t curves = 0;
  for (const Heights& row : rows) {
    const Curve curve(row);
    const double worst = curve.error(0, kSide - 1);
    if (worst == 0) continue;  // a straight line, as the sea is
    ++curves;
    const Polylines polylines = algorithm.run(curve);
    double before = worst;
    for (uint32_t c = 1; c < kSide; ++c) {
      const double error = polylines.errors[polylines.reached(c)];
      quality.decibels[c] += 10 * std::log10(kWorst / (std::max(error, 0.0) * kWorst / worst + 1));
      if (error > before + kRounding * worst) ++quality.rises;
      before = error;
    }
  }
  const auto count = static_cast<double>(std::max<size_t>(curves, 1));
  for (double& decibels : quality.decibels) decibels /= count;
  quality.rises /= count;
  return quality;
}

struct Gap {
  const char *figure, *better, *worse, *thesis;
};

constexpr Gap kGaps[] = {
    {"2.10", "uoptimal", "urefine", "3.86 at most"},
    {"2.10", "uoptimal", "udecimate", "3.86 at most"},
    {"2.10", "urefine", "udecimate", "refinement at low rates"},
    {"2.17", "urefine", "crefine", "15 at least"},
    {"2.17", "udecimate", "cdecimate", "15 at least"},
    {"2.17", "crefine", "cdecimate", "cross at mid-rate"},
    {"2.20", "urefine", "cglobal", "3.92 at most"},
    {"2.20", "udecimate", "cglobal", "3.92 at most"},
    {"2.6", "coptimal", "cglobal", "0.5 in the mean"},
    {"-", "udecimate-global", "udecimate", "-"},
};

using Curves = std::vector<std::vector<double>>;  // dB by segments, of each of kAlgorithms

/// Of few numbers of segments; results of all if `all_rates`.
void printQuality(const Curves& curves, bool all_rates, std::vector<ResultRow>& results) {
  constexpr std::array kPrinted = {2,  3,  4,  6,   8,   12,  16,  24, 32,
                                   48, 64, 96, 128, 160, 192, 224, 256};
  for (int c = 1; c < int{kSide}; ++c) {
    const bool print = std::find(kPrinted.begin(), kPrinted.end(), c) != kPrinted.end();
    if (print) std::printf("%6d", c);
    for (size_t i = 0; i < kAlgorithms.size(); ++i) {
      const double decibels = curves[i][static_cast<size_t>(c)];
      if (print) std::printf(" %16.2f", decibels);
      if (print || all_rates)
        results.push_back({"mean", kAlgorithms[i].name, "db_at_" + std::to_string(c), decibels});
    }
    if (print) std::printf("\n");
  }
}

/// The largest and the mean distances that the thesis states.
void printGaps(const Curves& curves) {
  const auto curveOf = [&](const std::string& name) -> const std::vector<double>& {
    size_t i = 0;
    while (name != kAlgorithms[i].name) ++i;
    return curves[i];
  };
  std::printf("\n%-6s %-36s %8s %5s %8s %5s %8s  %s\n", "figure", "dB of one above the other",
              "most", "at C", "least", "at C", "mean", "thesis");
  for (const Gap& gap : kGaps) {
    const std::vector<double>&better = curveOf(gap.better), &worse = curveOf(gap.worse);
    uint32_t most = 1, least = 1;
    double sum = 0;
    const auto at = [&](uint32_t c) { return better[c] - worse[c]; };
    for (uint32_t c = 1; c < kSide; ++c) {
      sum += at(c);
      if (at(c) > at(most)) most = c;
      if (at(c) < at(least)) least = c;
    }
    const std::string pair = std::string(gap.better) + " - " + gap.worse;
    std::printf("%-6s %-36s %8.2f %5u %8.2f %5u %8.2f  %s\n", gap.figure, pair.c_str(), at(most),
                most, at(least), least, sum / (kSide - 1), gap.thesis);
  }
}

/// Figs. 2.10, 2.17 and 2.20, and what of table 2.3 is about errors.
void compareQuality(const std::vector<Heights>& rows, bool all_rates,
                    std::vector<ResultRow>& results) {
  Curves curves;
  std::string rises;
  std::printf("\nMean dB (2.3) by segments\n%6s", "C");
  for (const Algorithm& algorithm : kAlgorithms) {
    std::printf(" %16s", algorithm.name);
    Quality quality = meanQuality(rows, algorithm);
    curves.push_back(std::move(quality.decibels));
    results.push_back({"mean", algorithm.name, "rises_per_curve", quality.rises});
    char text[32];
    std::snprintf(text, sizeof(text), " %16.2f", quality.rises);
    rises += text;
  }
  std::printf("\n");
  printQuality(curves, all_rates, results);
  std::printf("%6s%s\n", "rises", rises.c_str());
  printGaps(curves);
}

/// Fig. 5.9: a polyline of nine knots, and how many segments it has when each knot goes.
void decimateExample(const Heights& row, std::vector<ResultRow>& results) {
  Heights heights;
  for (uint32_t k = 0; k < kSide; k += (kSide - 1) / 8) heights.push_back(row[k]);
  const Polylines polylines = cglobal(Curve(heights));
  for (size_t k = 0; k < heights.size(); ++k) {
    const std::string knot = "knot_" + std::to_string(k);
    results.push_back({"fig_5.9", knot, "height", heights[k]});
    results.push_back({"fig_5.9", knot, "entry", static_cast<double>(polylines.entry[k])});
  }
}

Status run(const Options& options) {
  const Result<std::vector<Heights>> rows = readRows(options);
  if (!rows.ok()) return rows.status();
  std::vector<ResultRow> results;
  results.push_back({"all", "curves", "count", static_cast<double>(rows->size())});
  countOperations(*rows, results);
  compareQuality(*rows, options.all_rates, results);
  if (options.all_rates) decimateExample((*rows)[rows->size() / 2], results);
  return updateResults(options.csv, "polyline", results);
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  Arguments arguments("Polylines: the algorithms of the thesis's chapter 2, costs and errors");
  arguments.texts({"HEIGHT", "Height files; without any the sample terrain"}, options.heights);
  arguments.within({"--rows", "Rows of each file, spread over its centre"}, options.rows, 1, kSide);
  arguments.flag({"--all-rates", "Results of every number of segments, for plots"},
                 options.all_rates);
  arguments.csv(options.csv);
  if (const std::optional<int> code = arguments.parse(argc, argv)) return *code;
  return exitCode(run(options));
}

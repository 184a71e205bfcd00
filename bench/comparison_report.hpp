// SPDX-License-Identifier: Apache-2.0
// What a comparison prints, file by file, and the rows it leaves for results.csv.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "bench/bjontegaard.hpp"
#include "bench/raster.hpp"
#include "bench/results.hpp"

namespace tetrakis::bench {

/// One codec on one file. Rates in bits a pixel.
struct PeerResult {
  std::vector<RatePoint> points;
  double lossless_bits = 0;                  ///< 0: the codec has no lossless mode
  std::optional<RateDifference> difference;  ///< to the anchor; none for the anchor itself
};

class ComparisonReport {
 public:
  /// as_rmse: errors at fixed rates as RMSE in the raster's unit, not as PSNR in dB.
  explicit ComparisonReport(bool as_rmse) : as_rmse_(as_rmse) {}

  /// Begins a file's table. peak: of the PSNR, in sample steps.
  void addFile(const std::string& item, const Raster& raster, double peak);

  /// A line of the table.
  void addPeer(const std::string& codec, const PeerResult& result);

  /// The mean rate differences over all files.
  void addMeans(const std::string& anchor, RateWindow window);

  const std::vector<ResultRow>& rows() const { return rows_; }

 private:
  void add(const std::string& codec, const std::string& quantity, double value);
  void addErrors(const std::string& codec, const std::vector<RatePoint>& points);

  bool as_rmse_;
  std::string item_;
  double rmse_at_zero_db_ = 0;  // the peak in the raster's unit
  std::vector<ResultRow> rows_;
  std::map<std::string, std::vector<double>> differences_;  // by codec, percent
};

}  // namespace tetrakis::bench

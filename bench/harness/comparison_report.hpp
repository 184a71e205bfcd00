// SPDX-License-Identifier: Apache-2.0
// What a comparison prints, file by file, and the rows it leaves for results.csv.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "bench/harness/bjontegaard.hpp"
#include "bench/harness/results.hpp"
#include "bench/peers/raster.hpp"

namespace tetrakis::bench {

/// One codec on one file. Rates in bits a pixel.
struct PeerResult {
  std::vector<RatePoint> points;             ///< empty: compared in its lossless mode only
  uint64_t lossless_bytes = 0;               ///< 0: the codec has no lossless mode
  std::optional<RateDifference> difference;  ///< to the anchor; none for the anchor itself
  /// Of cuts of one stream, and of the lossless one, to streams made for each length.
  std::optional<RateDifference> cuts, lossless_cuts;
  std::vector<RatePoint> near_end;  ///< of the lossless stream without kNearEnd; empty: not known
};

class ComparisonReport {
 public:
  /// as_rmse: errors at fixed rates as RMSE in the raster's unit, not as PSNR in dB.
  explicit ComparisonReport(bool as_rmse) : as_rmse_(as_rmse) {}

  /// Begins a file's table. peak: of the PSNR, in sample steps.
  void addFile(const std::string& item, const Raster& raster, double peak);

  /// A line of the table. The anchor comes first.
  void addPeer(const std::string& codec, const PeerResult& result);

  /// Counts the file in the summary: all codecs have passed it.
  void finishFile();

  /// The mean rate differences and the sums of lossless sizes over all files that were finished.
  void addSummary(const std::string& anchor, RateWindow window);

  const std::vector<ResultRow>& rows() const { return rows_; }

 private:
  void add(const std::string& codec, const std::string& quantity, double value);
  void addErrors(const std::string& codec, const std::vector<RatePoint>& points);

  // A codec on all finished files.
  struct Total {
    std::string codec;
    std::vector<double> differences, cuts, lossless_cuts;  // percent
    double lossless_bytes = 0;
  };
  struct Line {
    std::string codec;
    PeerResult result;
  };

  Total& totalOf(const std::string& codec);
  void addCuts(const std::string& codec, const PeerResult& result);
  void addNearEnd(const std::string& codec, const PeerResult& result);
  void addMean(const std::string& codec, const char* quantity, const std::vector<double>& values);
  void addMeans(const std::string& anchor, RateWindow window);
  void addLosslessSums(const std::string& anchor);

  bool as_rmse_;
  std::string item_;
  double rmse_at_zero_db_ = 0;  // the peak in the raster's unit
  double pixels_ = 0;           // of the current file
  std::vector<Line> lines_;     // of the current file
  std::vector<ResultRow> rows_;
  std::vector<Total> totals_;
  size_t files_ = 0;
  double total_pixels_ = 0;
};

}  // namespace tetrakis::bench

// SPDX-License-Identifier: Apache-2.0
// Tables and rows of a comparison; see comparison_report.hpp.
#include "bench/comparison_report.hpp"

#include <cmath>
#include <cstdio>
#include <numeric>

namespace tetrakis::bench {
namespace {

constexpr double kReportedRates[] = {0.1, 0.25, 0.5, 1, 2};  // bits a pixel

}  // namespace

void ComparisonReport::addFile(const std::string& item, const Raster& raster, double peak) {
  item_ = item;
  rmse_at_zero_db_ = raster.unit * peak;
  std::printf("\n%s  %u x %u", item.c_str(), raster.width, raster.height);
  if (as_rmse_) std::printf(", step %.4g, range %.6g", raster.unit, rmse_at_zero_db_);
  std::printf("\n  %-12s %9s %15s %9s  %s at", "codec", "BD-rate", "over dB", "lossless",
              as_rmse_ ? "RMSE" : "PSNR");
  for (const double rate : kReportedRates) std::printf(" %8g", rate);
  std::printf(" bits\n");
}

void ComparisonReport::addPeer(const std::string& codec, const PeerResult& result) {
  std::printf("  %-12s ", codec.c_str());
  if (result.difference) {
    const double percent = 100 * result.difference->ratio;
    std::printf("%+8.2f%% %6.1f .. %5.1f", percent, result.difference->psnr_low,
                result.difference->psnr_high);
    add(codec, "bd_rate_percent", percent);
    differences_[codec].push_back(percent);
  } else {
    std::printf("%9s %15s", "anchor", "");
  }
  if (result.lossless_bits > 0) {
    std::printf(" %9.3f         ", result.lossless_bits);
    add(codec, "lossless_bits", result.lossless_bits);
  } else {
    std::printf(" %9s         ", "-");
  }
  addErrors(codec, result.points);
  std::printf("\n");
  std::fflush(stdout);
}

void ComparisonReport::addMeans(const std::string& anchor, RateWindow window) {
  std::printf("\nMean BD-rate against %s, %g to %g bits (negative: fewer bytes)\n", anchor.c_str(),
              window.low, window.high);
  item_ = "mean";
  for (const auto& [codec, values] : differences_) {
    const double sum = std::accumulate(values.begin(), values.end(), 0.0);
    const double mean = sum / static_cast<double>(values.size());
    std::printf("  %-12s %+8.2f%% over %zu files\n", codec.c_str(), mean, values.size());
    add(codec, "bd_rate_percent", mean);
  }
}

void ComparisonReport::add(const std::string& codec, const std::string& quantity, double value) {
  rows_.push_back({item_, codec, quantity, value});
}

void ComparisonReport::addErrors(const std::string& codec, const std::vector<RatePoint>& points) {
  const Result<MonotoneCubic> quality = qualityOverLogRate(points);
  for (const double rate : kReportedRates) {
    const double at = std::log10(rate);
    if (!quality.ok() || at < quality->low() || at > quality->high()) {
      std::printf(" %8s", "-");
      continue;
    }
    const double psnr = quality->at(at);
    const double value = as_rmse_ ? rmse_at_zero_db_ * std::pow(10, -psnr / 20) : psnr;
    char quantity[32];
    std::snprintf(quantity, sizeof(quantity), "%s_at_%g", as_rmse_ ? "rmse" : "psnr", rate);
    std::printf(" %8.4g", value);
    add(codec, quantity, value);
  }
}

}  // namespace tetrakis::bench

// SPDX-License-Identifier: Apache-2.0
// Tables and rows of a comparison; see comparison_report.hpp.
#include "bench/harness/comparison_report.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>

#include "bench/peers/peer.hpp"

namespace tetrakis::bench {
namespace {

constexpr double kReportedRates[] = {0.1, 0.25, 0.5, 1, 2};  // bits a pixel

double percentOf(const RateDifference& difference) {
  return 100 * difference.ratio;
}

}  // namespace

void ComparisonReport::addFile(const std::string& item, const Raster& raster, double peak) {
  item_ = item;
  lines_.clear();
  pixels_ = static_cast<double>(raster.pixels());
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
    const double percent = percentOf(*result.difference);
    std::printf("%+8.2f%% %6.1f .. %5.1f", percent, result.difference->psnr_low,
                result.difference->psnr_high);
    add(codec, "bd_rate_percent", percent);
  } else {
    std::printf("%9s %15s", lines_.empty() ? "anchor" : "-", "");
  }
  if (result.lossless_bytes > 0) {
    const double bits = static_cast<double>(result.lossless_bytes) * 8 / pixels_;
    std::printf(" %9.3f         ", bits);
    add(codec, "lossless_bits", bits);
  } else {
    std::printf(" %9s         ", "-");
  }
  addErrors(codec, result.points);
  std::printf("\n");
  addCuts(codec, result);
  addNearEnd(codec, result);
  std::fflush(stdout);
  lines_.push_back({codec, result});
}

void ComparisonReport::addCuts(const std::string& codec, const PeerResult& result) {
  if (!result.cuts || !result.lossless_cuts) return;
  const double cuts = percentOf(*result.cuts), lossless = percentOf(*result.lossless_cuts);
  std::printf(
      "    cuts: %+.2f%%, of the lossless stream %+.2f%%, against streams made for each length\n",
      cuts, lossless);
  add(codec, "cuts_bd_rate_percent", cuts);
  add(codec, "lossless_cuts_bd_rate_percent", lossless);
}

void ComparisonReport::addNearEnd(const std::string& codec, const PeerResult& result) {
  if (result.near_end.size() != kNearEnd.size()) return;
  std::printf("    the lossless stream without its last");
  for (size_t i = 0; i < kNearEnd.size(); ++i) {
    const double percent = 100 * kNearEnd[i], psnr = result.near_end[i].psnr;
    std::printf("%s %g %%: %.1f dB", i > 0 ? "," : "", percent, psnr);
    char quantity[64];
    std::snprintf(quantity, sizeof quantity, "psnr_without_last_%g_percent", percent);
    if (std::isfinite(psnr)) add(codec, quantity, psnr);
  }
  std::printf("\n");
}

void ComparisonReport::finishFile() {
  for (const Line& line : lines_) {
    Total& total = totalOf(line.codec);
    if (line.result.difference) total.differences.push_back(percentOf(*line.result.difference));
    if (line.result.cuts) total.cuts.push_back(percentOf(*line.result.cuts));
    if (line.result.lossless_cuts)
      total.lossless_cuts.push_back(percentOf(*line.result.lossless_cuts));
    total.lossless_bytes += static_cast<double>(line.result.lossless_bytes);
  }
  ++files_;
  total_pixels_ += pixels_;
}

ComparisonReport::Total& ComparisonReport::totalOf(const std::string& codec) {
  const auto found = std::find_if(totals_.begin(), totals_.end(),
                                  [&](const Total& total) { return total.codec == codec; });
  return found != totals_.end() ? *found : totals_.emplace_back(Total{codec, {}, {}, {}, 0});
}

void ComparisonReport::addSummary(const std::string& anchor, RateWindow window) {
  if (files_ == 0) return;
  addMeans(anchor, window);
  addLosslessSums(anchor);
}

void ComparisonReport::addMeans(const std::string& anchor, RateWindow window) {
  std::printf("\nMean BD-rate against %s, %g to %g bits (negative: fewer bytes)\n", anchor.c_str(),
              window.low, window.high);
  item_ = "mean";
  for (const Total& total : totals_) addMean(total.codec, "bd_rate_percent", total.differences);
  std::printf("Mean BD-rate of cuts against streams made for each length\n");
  for (const Total& total : totals_) {
    addMean(total.codec, "cuts_bd_rate_percent", total.cuts);
    addMean(total.codec, "lossless_cuts_bd_rate_percent", total.lossless_cuts);
  }
}

void ComparisonReport::addMean(const std::string& codec, const char* quantity,
                               const std::vector<double>& values) {
  if (values.empty()) return;
  const double sum = std::accumulate(values.begin(), values.end(), 0.0);
  const double mean = sum / static_cast<double>(values.size());
  std::printf("  %-12s %+8.2f%% over %zu files (%s)\n", codec.c_str(), mean, values.size(),
              quantity);
  add(codec, quantity, mean);
}

void ComparisonReport::addLosslessSums(const std::string& anchor) {
  std::printf("\nLossless, sum over %zu files, beside %s\n", files_, anchor.c_str());
  item_ = "all";
  const double reference = totalOf(anchor).lossless_bytes;
  for (const Total& total : totals_) {
    if (total.lossless_bytes == 0) continue;
    const double bits = total.lossless_bytes * 8 / total_pixels_;
    std::printf("  %-12s %+8.2f%% %12.0f bytes %9.3f bits\n", total.codec.c_str(),
                100 * (total.lossless_bytes / reference - 1), total.lossless_bytes, bits);
    add(total.codec, "lossless_bits", bits);
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

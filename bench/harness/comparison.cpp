// SPDX-License-Identifier: Apache-2.0
// Rate curves of every codec on every file; see comparison.hpp.
#include "bench/harness/comparison.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <limits>

#include "bench/harness/comparison_report.hpp"

namespace tetrakis::bench {
namespace {

namespace fs = std::filesystem;

constexpr double kRateStep = 1.4142135623730951;  // between points: half a bit-plane, roughly
constexpr double kRateMargin = 2;  // points beyond the window, so that no curve ends within it

struct InputFile {
  std::string path;
  std::string item;  // relative to its folder, without extension
};

std::string lowerCase(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

bool isWanted(const fs::path& path, const ComparisonSpec& spec, const ComparisonOptions& options) {
  const std::string extension = lowerCase(path.extension().string());
  const auto& known = spec.extensions;
  if (std::find(known.begin(), known.end(), extension) == known.end()) return false;
  if (!spec.wanted(lowerCase(path.stem().string()))) return false;
  const auto matches = [&](const std::string& filter) {
    return path.string().find(filter) != std::string::npos;
  };
  return options.filters.empty() ||
         std::any_of(options.filters.begin(), options.filters.end(), matches);
}

Result<std::vector<InputFile>> findFiles(const ComparisonSpec& spec,
                                         const ComparisonOptions& options) {
  std::vector<InputFile> files;
  for (const fs::path folder : options.folders) {
    std::error_code error;
    for (fs::recursive_directory_iterator it(folder, error), end; !error && it != end;
         it.increment(error)) {
      if (!it->is_regular_file() || !isWanted(it->path(), spec, options)) continue;
      fs::path item = fs::relative(it->path(), folder).replace_extension();
      files.push_back({it->path().string(), item.generic_string()});
    }
    if (error) return Status(TKS_IO, "Cannot list " + folder.string() + ": is it a folder?");
  }
  std::sort(files.begin(), files.end(),
            [](const InputFile& a, const InputFile& b) { return a.item < b.item; });
  if (files.empty()) return Status(TKS_IO, "No " + spec.bench + " file found to compare on.");
  return files;
}

std::vector<uint64_t> byteTargets(const Raster& raster, RateWindow window) {
  std::vector<uint64_t> targets;
  const double pixels = static_cast<double>(raster.pixels());
  const double end = window.high * kRateMargin * 1.001;
  for (double rate = window.low / kRateMargin; rate <= end; rate *= kRateStep) {
    const auto bytes = static_cast<uint64_t>(std::max(1.0, std::round(rate * pixels / 8)));
    if (targets.empty() || bytes > targets.back()) targets.push_back(bytes);
  }
  return targets;
}

// The range of the samples for heights, as PSNR of a height field is understood; 255 for images.
double peakOf(const Raster& raster, const ComparisonSpec& spec) {
  if (!spec.report_rmse) return 255;
  const auto [low, high] = std::minmax_element(raster.samples.begin(), raster.samples.end());
  return std::max(1.0, double{1} * *high - *low);
}

double psnrOf(double mse, double peak) {
  if (mse == 0) return std::numeric_limits<double>::infinity();
  return 10 * std::log10(peak * peak / mse);
}

Result<PeerResult> measure(const Peer& peer, const Raster& raster, RateWindow window, double peak) {
  const Result<PeerCurves> curves = peer.curves(raster, byteTargets(raster, window));
  if (!curves.ok()) return curves.status();
  const auto points_of = [&](const std::vector<CodedPoint>& coded) {
    const double bits_per_byte = 8 / static_cast<double>(raster.pixels());
    std::vector<RatePoint> points;
    for (const CodedPoint& p : coded)
      points.push_back({static_cast<double>(p.bytes) * bits_per_byte, psnrOf(p.mse, peak)});
    return points;
  };
  std::vector<std::vector<RatePoint>> measured;
  for (const std::vector<CodedPoint>& setting : curves->settings)
    measured.push_back(points_of(setting));
  PeerResult result;
  result.points = upperEnvelope(measured);
  const auto against_made = [&](const std::vector<RatePoint>& cuts) {
    const auto difference = rateDifference(points_of(curves->made), cuts, window);
    return difference.ok() ? std::optional(*difference) : std::nullopt;
  };
  result.cuts = against_made(result.points);
  result.lossless_cuts = against_made(points_of(curves->lossless_cuts));
  result.near_end = points_of(curves->near_end);
  result.lossless_bytes = curves->lossless_bytes;
  return result;
}

Status compareFile(const ComparisonSpec& spec, const ComparisonOptions& options,
                   const InputFile& file, ComparisonReport& report) {
  const Result<Raster> raster = spec.load(file.path);
  if (!raster.ok()) return raster.status();
  const double peak = peakOf(*raster, spec);
  report.addFile(file.item, *raster, peak);
  std::vector<RatePoint> anchor;
  for (const auto& peer : spec.peers) {
    Result<PeerResult> result = measure(*peer, *raster, options.window, peak);
    if (!result.ok()) return result.status();
    if (peer == spec.peers.front()) {
      anchor = result->points;
    } else if (!result->points.empty()) {
      const auto difference = rateDifference(anchor, result->points, options.window);
      if (difference.ok()) result->difference = *difference;
    }
    report.addPeer(peer->name(), *result);
  }
  report.finishFile();
  return {};
}

}  // namespace

int runComparison(const ComparisonSpec& spec, const ComparisonOptions& options) {
  const auto files = findFiles(spec, options);
  if (!files.ok()) {
    std::fprintf(stderr, "%s\n", files.status().message().c_str());
    return files.status().code();
  }
  ComparisonReport report(spec.report_rmse);
  int failure = 0;
  for (const InputFile& file : *files) {
    const Status status = compareFile(spec, options, file, report);
    if (status.ok()) continue;
    std::fprintf(stderr, "%s: %s\n", file.path.c_str(), status.message().c_str());
    failure = status.code();
  }
  report.addSummary(spec.peers.front()->name(), options.window);
  if (failure != 0) return failure;
  const Status written = updateResults(options.csv, spec.bench, report.rows());
  if (!written.ok()) std::fprintf(stderr, "%s\n", written.message().c_str());
  return written.code();
}

}  // namespace tetrakis::bench

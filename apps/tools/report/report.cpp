// SPDX-License-Identifier: Apache-2.0
// The measurements behind the report: one stream, cut at halves of halves, and its two tracks.
#include "apps/tools/report/report.hpp"

#include <utility>

namespace tetrakis::tools {
namespace {

constexpr uint32_t kLargestDivisor = 16;
constexpr double kCuts = 0.15;  ///< of the time, about: the cuts, before the pairs

/// Of streams of heights and texture in one track each; nothing of others.
Result<std::optional<PairPlane>> planeOf(Comparer& comparer, const ReportRequest& request) {
  const Result<SplitStream> tracks = SplitStream::take(request.stream);
  if (!tracks.ok() || tracks->most().heights == 0 || tracks->most().texture == 0)
    return std::optional<PairPlane>();
  const auto progress = [&](double done) { request.progress(kCuts + (1 - kCuts) * done); };
  Result<PairPlane> plane =
      lookAtPairs(comparer, *tracks, request.grid, request.triangles, progress);
  if (!plane.ok()) return plane.status();
  return std::optional<PairPlane>(std::move(*plane));
}

}  // namespace

Result<Report> makeReport(const Reference& reference, const ReportRequest& request) {
  Result<Decoder> decoder = Decoder::open(request.stream);
  if (!decoder) return decoder.status();
  const tks_info& info = decoder->info();
  Result<Comparer> comparer = Comparer::create(reference, info);
  if (!comparer.ok()) return comparer.status();
  if (Status status = comparer->look(request.cameras); !status.ok()) return status;
  Report report{request.title, comparer->cameras(), comparer->referencePictures(), {}, {}, {}, {}};
  for (uint32_t divisor = 1; divisor <= kLargestDivisor; divisor *= 2) {
    const size_t bytes = request.stream.size() / divisor;
    if (bytes < info.header_bytes) break;
    Result<Measurement> measurement =
        comparer->measure(request.stream.first(bytes), request.triangles);
    if (!measurement.ok()) return measurement.status();
    report.rows.push_back({divisor, std::move(*measurement)});
  }
  request.progress(kCuts);
  Result<std::optional<PairPlane>> plane = planeOf(*comparer, request);
  if (!plane.ok()) return plane.status();
  report.plane = std::move(*plane);
  return report;
}

}  // namespace tetrakis::tools

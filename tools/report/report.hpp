// SPDX-License-Identifier: Apache-2.0
// The page of `encode --report`: what a stream looks like at 1/1, 1/2, … 1/16 of its bytes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "base/status.hpp"
#include "tools/report/comparison.hpp"

namespace tetrakis::tools {

struct ReportRequest {
  std::string title;
  std::span<const uint8_t> stream;
  uint32_t triangles = 0;  ///< draw budget meshes of at most that many; 0: the full grid
  CameraChoice cameras;
};

/// One cut of the stream.
struct ReportRow {
  uint32_t divisor = 1;  ///< the cut is at stream bytes / divisor
  Measurement measurement;
};

/// Everything the page shows.
struct Report {
  std::string title;
  std::vector<Camera> cameras;
  std::vector<Picture> originals;  ///< one a camera
  std::vector<ReportRow> rows;     ///< longest cut first
};

/// Measures and draws the cuts. Cuts too short for the header are left out. Errors: of the decoder,
/// the renderer and the camera file.
Result<Report> makeReport(const Reference& reference, const ReportRequest& request);

/// The page: HTML with its pictures (JPEG) and plot (SVG) inside.
Result<std::string> renderPage(const Report& report);

/// Screen PSNR over bytes (logarithmic) as an SVG element; exact cuts have no finite PSNR and no
/// dot.
std::string plotScreenPsnr(const std::vector<ReportRow>& rows);

}  // namespace tetrakis::tools

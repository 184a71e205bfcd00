// SPDX-License-Identifier: Apache-2.0
// makeReport() makes the page of `encode --report`: how a stream looks at 1/1, 1/2, … 1/16 of its
// bytes, and how it shares them between heights and texture (thesis, figures 6.6 to 6.8).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "apps/tools/report/comparison.hpp"
#include "apps/tools/report/pair_plane.hpp"
#include "tetrakis/result.hpp"

namespace tetrakis::tools {

struct ReportRequest {
  std::string title;
  std::span<const uint8_t> stream;
  uint32_t triangles = 0;  ///< draw budget meshes of at most that many; 0: the full grid
  CameraChoice cameras;
  PlaneGrid grid{};
  /// Told how much is done, from 0 to 1.
  std::function<void(double done)> progress = [](double) {};
};

/// One cut of the stream.
struct ReportRow {
  uint32_t divisor = 1;  ///< the cut is at stream bytes / divisor
  Measurement measurement;
};

/// Pictures side by side.
struct Gallery {
  struct Plate {
    Picture picture;
    std::string caption;
  };
  std::string title, text;
  std::vector<Plate> plates;
};

/// A mesh seen from above.
struct MeshPlan {
  std::string caption;
  uint32_t width = 0, height = 0;                ///< of the grid
  std::vector<std::array<uint32_t, 4>> edges{};  ///< column and row of either end
  std::array<double, 2> eye{};                   ///< of the viewer, in columns and rows
};

/// Everything the page shows.
struct Report {
  std::string title;
  std::vector<Camera> cameras;
  std::vector<Picture> originals;  ///< one a camera
  std::vector<ReportRow> rows;     ///< longest cut first
  std::optional<PairPlane> plane;  ///< of streams of two tracks
  std::vector<Gallery> galleries;
  std::vector<MeshPlan> meshes;
};

/// Measures and draws the cuts and the plane. Cuts too short for the header are left out. Errors:
/// of the decoder, the renderer and the camera file.
Result<Report> makeReport(const Reference& reference, const ReportRequest& request);

/// The page: HTML with its pictures (JPEG), figures and the library that draws them (D3) inside.
Result<std::string> renderPage(const Report& report);

}  // namespace tetrakis::tools

// SPDX-License-Identifier: Apache-2.0
// The common run of bench_geometry and bench_texture: every file of some folders, every codec, rate
// curves against the first codec of the list.
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "bench/harness/bjontegaard.hpp"
#include "bench/peers/peer.hpp"

namespace tetrakis::bench {

/// What differs between heights and images.
struct ComparisonSpec {
  std::string bench;                    ///< "geometry" or "texture": name of the bench in the CSV
  std::vector<std::string> extensions;  ///< of the files to read, lower case, with the dot
  std::function<bool(const std::string& stem)> wanted;  ///< by a file's name without extension
  std::function<Result<Raster>(const std::string& path)> load;
  std::vector<std::unique_ptr<Peer>> peers;  ///< the first is the anchor
  bool report_rmse = false;  ///< error at fixed rates as RMSE in data units instead of PSNR in dB
};

struct ComparisonOptions {
  std::vector<std::string> folders;
  std::vector<std::string> filters;  ///< only files whose path holds one of these; empty: all
  RateWindow window;                 ///< bits a pixel (heights: a sample)
  std::vector<std::string> peers;    ///< codecs to add to the anchor and Tetrakis
  std::string csv;                   ///< file to update; empty: none

  bool wants(const std::string& peer) const {
    return std::find(peers.begin(), peers.end(), peer) != peers.end();
  }
};

/// Prints tables to stdout, problems to stderr. A file that fails is left out of the means; the CSV
/// is then left as it was. Returns the process exit code.
int runComparison(const ComparisonSpec& spec, const ComparisonOptions& options);

}  // namespace tetrakis::bench

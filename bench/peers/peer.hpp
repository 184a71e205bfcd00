// SPDX-License-Identifier: Apache-2.0
// What a codec must offer to be compared. To add one: a file that implements Peer, and a line in
// the list of peers of geometry.cpp or texture.cpp.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "bench/peers/raster.hpp"
#include "tetrakis/result.hpp"

namespace tetrakis::bench {

/// Shares of a lossless stream's bytes, from its end.
inline constexpr std::array kNearEnd = {0.1, 0.04, 0.01, 0.001};

/// A decoded operating point. mse: over the real samples of all channels, squared sample steps.
struct CodedPoint {
  uint64_t bytes = 0;
  double mse = 0;
};

/// What a codec does to one raster: a curve for each of its settings, of which the best counts at
/// each rate. Points may come in any order.
struct PeerCurves {
  std::vector<std::vector<CodedPoint>> settings;
  uint64_t lossless_bytes = 0;  ///< 0: the codec has no lossless mode
  /// Where the points are cuts of one stream: those of streams made for each length, and cuts of
  /// the lossless stream.
  std::vector<CodedPoint> made, lossless_cuts;
  /// Of the lossless stream without the last kNearEnd of its bytes.
  std::vector<CodedPoint> near_end;
};

class Peer {
 public:
  virtual ~Peer() = default;
  virtual std::string name() const = 0;

  /// Codes and decodes the raster at about each of `targets` (bytes, rising). Targets the codec
  /// cannot meet give no point; a codec that fails gives an error.
  virtual Result<PeerCurves> curves(const Raster& raster,
                                    const std::vector<uint64_t>& targets) const = 0;
};

}  // namespace tetrakis::bench

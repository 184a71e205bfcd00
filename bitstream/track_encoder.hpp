// SPDX-License-Identifier: Apache-2.0
// Encodes the coefficients of a track down to the last bit and measures what every byte buys.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bitstream/track.hpp"

namespace tetrakis {

/// A point of a track's operational rate-distortion curve: the state a decoder reaches when it has
/// the first `bytes` bytes of the codeword.
struct RatePoint {
  uint64_t bytes;
  double distortion;  ///< weighted squared error of the coefficients
  /// Between the point before and this one, some prefix is noticeably worse than the best so far.
  bool dips = false;
};

struct EncodedTrack {
  std::vector<uint8_t> codeword;
  /// Falling distortion at rising bytes, from {0, all of it} to {codeword.size(), what is left}.
  std::vector<RatePoint> points;
  int planes = 0;        ///< bit-planes of the largest coefficient: the decoder must know
  bool complete = true;  ///< down to the last bit
};

/// Coefficients of one band in the cell layout of BandShape (margins zero), |value| < 2^30.
struct BandSource {
  std::vector<int32_t> values;
  double weight = 1;  ///< squared error in the output per squared error of a coefficient
};

/// sources[i] belongs to plan[i]. Stops after the pass in which the codeword passes `limit` bytes.
EncodedTrack encodeTrack(const std::vector<BandPlan>& plan, const std::vector<BandSource>& sources,
                         uint64_t limit);

}  // namespace tetrakis

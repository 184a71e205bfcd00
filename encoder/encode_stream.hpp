// SPDX-License-Identifier: Apache-2.0
// encodeStream() turns checked heights, a texture or both into the bytes of a stream. Beside it
// stand the other services of the encoder that api/ hands to callers: ToldProgress, which tells how
// far an encoding is; findOutliers(), which finds undeclared voids; and fitPositions(), which makes
// the longitudes and latitudes of a raster short enough for a header.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

#include "base/watch.hpp"
#include "bitstream/stream/georeference.hpp"
#include "encoder/inputs/encode_inputs.hpp"
#include "tetrakis/result.hpp"
#include "tetrakis/tetrakis.h"

namespace tetrakis::inline encoder {

// ToldProgress tells the caller of an encoding how much of the work is done, and ends the work when
// the caller's answer asks for it.

/// Counts how much of the work is done: every piece brings the count closer to the end of its
/// stage, and none brings it beyond.
class ToldProgress : public Watch {
 public:
  /// A function that is told how much of the work is done, from 0 to 1, never less than before. It
  /// is called on any thread, by one thread at a time, at each stage and every 50 ms or so. False:
  /// the work is to end.
  using Tell = std::function<bool(double)>;

  explicit ToldProgress(Tell tell) : tell_(std::move(tell)) {}

  void stage(double until) override;
  void pass(size_t pieces) override;

 private:
  void tell();

  Tell tell_;
  std::mutex mutex_;
  double done_ = 0, until_ = 0;
  bool stopped_ = false;
  std::chrono::steady_clock::time_point told_;
};

// findOutliers() finds samples that lie so far from all others that they cannot be heights, though
// the file does not declare their value as nodata. Coded as heights they would cost most of the
// bytes.

/// See tks_find_outliers. The heights are checked.
tks_outliers findOutliers(const tks_heights& heights);

// fitPositions() fits polynomials to the longitudes and latitudes of a raster, in as few bytes as a
// tolerance allows, so that a receiver without a library of projections knows where the raster
// lies. Maps are nearly similar to a plane that touches the sphere where they do, so that a few
// terms suffice; the error of the fit is counted in columns and rows.

/// Longitude and latitude of a place of a raster, u and v from -1 to 1; nothing if it has none.
using Locator = std::function<std::optional<LongitudeLatitude>(double u, double v)>;

struct PositionFit {
  double columns = 1, rows = 1;  ///< of the raster
  double tolerance = 0.1;        ///< the largest error, in samples
  size_t most_bytes = 0;
};

/// The shortest positions that meet the wish; nothing if none do.
std::optional<GroundPositions> fitPositions(const Locator& locate, const PositionFit& wish);

// encodeStream() turns heights, a texture or both into a stream that meets the target of the
// options. It quantises, codes, orders the packets, keeps the packets that the target needs, and
// writes. Every stage takes a value and returns the next one, so that a stage can be tried again in
// another way.

/// The finished stream. inputs: have passed the checks of the C interface. TKS_USAGE: the options
/// ask for something impossible, or the caller stopped.
Result<std::vector<uint8_t>> encodeStream(const EncodeInputs& inputs);

}  // namespace tetrakis::inline encoder

// SPDX-License-Identifier: Apache-2.0
// CorrectedCut finds where to cut the coefficients of a track so that they and the corrections
// behind them take the fewest bytes. The cut leaves errors, and the corrections bring these below a
// largest error.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "bitstream/stream/geometry_header.hpp"
#include "bitstream/track/track_encoder.hpp"
#include "codec/geometry/coefficients_decoder.hpp"
#include "codec/geometry/corrections/correction_parts.hpp"
#include "codec/geometry/flat/flat_areas.hpp"
#include "codec/geometry/quantiser/height_steps.hpp"

namespace tetrakis::inline coding_choice {

/// The multiple of 2 * largest + 1 nearest to q.
int32_t nearestMultiple(int64_t q, int64_t largest);

/// The corrections of the heights that a cut leaves.
struct Corrected {
  PartCodewords codewords;       ///< of each part
  bool any = false;              ///< some sample is off by more than allowed
  double before = 0, after = 0;  ///< squared errors in steps

  /// Appends the corrections of the parts that follow.
  void append(Corrected more);
};

/// The heights that a decoder has of a window of the plane.
struct DecodedWindow {
  const DecodedGeometry& heights;
  Window window;
  std::span<const Window> parts;  ///< that it consists of
};

/// Corrections of decoded heights that leave a largest error, in steps. steps: of the whole plane,
/// which has `width` columns. threads: nothing depends on them.
Corrected correct(const HeightSteps& steps, uint32_t width, const DecodedWindow& decoded,
                  int32_t largest, uint32_t threads);

/// The same for a plane that is one part.
Corrected correct(const HeightSteps& steps, const DecodedGeometry& decoded, int32_t largest);

/// Tries cuts of one track of coefficients, complete or not. All arguments outlive it. It remembers
/// the decoded heights of cuts near the best one, so that decoding goes on from there.
class CorrectedCut {
 public:
  /// header: with the planes of the track; flat: the areas beside which the coefficients were
  /// coded; largest: error allowed, in steps.
  CorrectedCut(const HeightSteps& steps, const FlatAreas& flat, const GeometryHeader& header,
               const EncodedTrack& coefficients, int32_t largest)
      : steps_(steps),
        flat_(flat),
        header_(header),
        coefficients_(coefficients),
        largest_(largest) {}

  Corrected correct(uint64_t bytes);

  /// Bytes of the coefficients that leave a mean squared error, in steps.
  uint64_t bytesFor(double mean_square) const;
  /// Bytes of the coefficients up to the cut, and of the corrections behind it.
  uint64_t total(uint64_t bytes);

  /// The cut with the fewest bytes in all; only roughly, where these are clearly more than the
  /// rival's bytes.
  uint64_t best(uint64_t rival);

 private:
  DecodedGeometry decoded(uint64_t bytes);
  void forgetFarthest();

  const HeightSteps& steps_;
  const FlatAreas& flat_;
  const GeometryHeader& header_;
  const EncodedTrack& coefficients_;
  int32_t largest_;
  std::map<uint64_t, TrackMemory> known_;  ///< by bytes
  std::map<uint64_t, uint64_t> totals_;
  uint64_t shortest_ = 0;  ///< of the cuts that were tried, if there are any
};

/// The RMSE, in steps, that cuts usually leave where the total bytes are fewest: ahead of exact
/// corrections, and for each step of a largest error. Samples are rounded: a cut at an RMSE below
/// 0.3 steps would have to code the noise of rounding; coarser cuts make corrections dear.
inline constexpr double kExactRmse = 0.3, kBoundedRmse = 0.45;

/// The mean squared error of such a cut.
inline double usualCut(int32_t largest) {
  const double rmse = largest == 0 ? kExactRmse : kBoundedRmse * largest;
  return rmse * rmse;
}

}  // namespace tetrakis::inline coding_choice

// SPDX-License-Identifier: Apache-2.0
// A *cut* ends the coefficients of heights after some bytes; corrections behind it code the rest.
// CorrectedCut, chooseExactCut(), chooseFacetCut() and boundWays() take heights in steps and return
// where to cut, if at all, so that coefficients and corrections take the fewest bytes together: for
// a largest error, for exact steps and for facets. Encoder only.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "base/plane.hpp"
#include "bitstream/stream/geometry_header.hpp"
#include "bitstream/track/track_encoder.hpp"
#include "codec/geometry/corrections/corrections_encoder.hpp"
#include "codec/geometry/facets/facets_encoder.hpp"
#include "codec/geometry/flat/flat_areas.hpp"
#include "codec/geometry/heights_decoder.hpp"
#include "codec/geometry/quantiser/height_steps.hpp"

namespace tetrakis::inline coding_choice {

// CorrectedCut finds where to cut the coefficients of a track so that they and the corrections
// behind them take the fewest bytes. The cut leaves errors, and correct() computes the corrections
// that bring these below a largest error.

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
  /// Bytes of the coefficients up to the cut, and of the corrections behind it. Exact corrections
  /// and few ones are coded for it, others are estimated.
  uint64_t total(uint64_t bytes);

  /// The cut with the fewest bytes in all; only roughly, where these are clearly more than the
  /// rival's bytes.
  uint64_t best(uint64_t rival);

 private:
  DecodedGeometry decoded(uint64_t bytes);
  uint64_t codedBytes(uint64_t bytes);
  uint64_t boundedBytes(uint64_t bytes);
  void forgetFarthest();

  const HeightSteps& steps_;
  const FlatAreas& flat_;
  const GeometryHeader& header_;
  const EncodedTrack& coefficients_;
  int32_t largest_;
  std::map<uint64_t, TrackMemory> known_;  ///< by bytes
  std::map<uint64_t, uint64_t> totals_;
  std::optional<double> taken_of_entropy_ = {};  ///< by the corrections of the usual cut
  uint64_t shortest_ = 0;                        ///< of the cuts that were tried, if there are any
};

/// The RMSE, in steps, that cuts usually leave where the total bytes are fewest: ahead of exact
/// corrections, and for each step of a largest error. Samples are rounded: a cut at an RMSE below
/// 0.3 steps would have to code the noise of rounding; coarser cuts make corrections dear.
inline constexpr double kExactRmse = 0.3, kBoundedRmse = 0.45;

/// The mean squared error, in squared steps, of a cut at this RMSE.
inline double usualCut(int32_t largest) {
  const double rmse = largest == 0 ? kExactRmse : kBoundedRmse * largest;
  return rmse * rmse;
}

// chooseExactCut() decides, by typical parts, whether heights to the last bit take fewer bytes as a
// cut of lossy coefficients with exact corrections behind it than as coefficients without fraction
// bits, and where to cut.
//
// The integer transform rounds each coefficient, which costs about a bit a sample where the heights
// themselves hold less, and it gains nothing from copies, planes that meet at edges, and heights
// rounded to tens. Corrections look at the exact neighbours of each sample.

struct ExactCut {
  double mean_square;  ///< squared error of a sample, in steps, that the cut leaves
  double bytes;        ///< of it and of the corrections, as far as is known
  double worth;        ///< exactWorth() of these
  bool pays = false;   ///< it comes near the whole coefficients
};

/// The worth of bytes whose first `cut` bytes are a cut. Behind a cut the error falls row by row,
/// so that prefixes lose by early cuts: 5 % more for each halving of the cut against all bytes.
double exactWorth(double bytes, double cut);

/// Whether a way of this worth is as good as coefficients to the last bit that take `whole_bytes`
/// bytes, whose own prefixes lose about as much as by one halving.
bool isWorth(double worth, double whole_bytes);

/// The best cut that was looked at, by typical parts of the heights, whether or not it comes near
/// the whole coefficients to the last bit, which take `whole_bytes` bytes; nothing if these are too
/// few for any cut. heights: in steps. range_bits: of them.
std::optional<ExactCut> estimateExactCut(const PlaneView<const int32_t>& heights, int range_bits,
                                         uint64_t whole_bytes);

/// The same if the cut pays; else nothing.
std::optional<ExactCut> chooseExactCut(const PlaneView<const int32_t>& heights, int range_bits,
                                       uint64_t whole_bytes);

// chooseFacetCut() decides where to cut the coefficients of a surface of facets, whose samples are
// restored behind the cut. Only samples beyond edges need the decoded heights: each takes a bit
// less for each halving of their error, and a halving takes coefficients all over the plane.

/// The mean squared error, in steps, that the cut leaves, by typical parts of the heights. For the
/// sake of prefixes it is the finest cut that takes a tenth more bytes in all than the best cut, or
/// a quarter more where there is room for that. room: bytes.
double chooseFacetCut(const HeightSteps& steps, Extent extent, const FacetShare& facets,
                      double room);

// boundWays() decides which of two ways to keep heights within a largest error is worth trying
// (rounding to coarser steps, or a cut with corrections), and where to cut, by typical parts.

struct BoundWays {
  bool round = true;    ///< to multiples of 2 * largest + 1 steps, coded to the last bit
  bool correct = true;  ///< coefficients that are cut, and corrections behind them
  /// Mean squared error, in steps, that the cut leaves; nothing: to be searched for.
  std::optional<double> mean_square = {};
  /// Bytes of the plane by either way, as typical parts foretell them; nothing: nobody looked.
  std::optional<double> rounded_bytes = {}, corrected_bytes = {};
};

/// Says which ways to try. largest: the error allowed, in steps. wavelet: that of coefficients that
/// will be cut. Both ways are worth trying for planes of at most 1025 * 1025 samples, which takes
/// some twenty times as long as coding them. Of larger planes typical parts are coded in both ways,
/// and the way that takes fewer bytes for the parts is the one to try for the whole plane.
BoundWays boundWays(const HeightSteps& steps, Extent plane, const WaveletHeader& wavelet,
                    int32_t largest);

/// The same by typical parts, whatever the size of the plane. largest: 1 or more.
BoundWays boundWaysByParts(const HeightSteps& steps, Extent plane, const WaveletHeader& wavelet,
                           int32_t largest);

}  // namespace tetrakis::inline coding_choice

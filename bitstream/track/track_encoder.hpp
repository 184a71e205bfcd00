// SPDX-License-Identifier: Apache-2.0
// encodeTracks() encodes the coefficients of tracks, down to the last bit or to the bit from which
// on bytes buy too little, and measures the error after every byte.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <vector>

#include "bitstream/track/track.hpp"

namespace tetrakis::inline track {

/// A point of a track's operational rate-distortion curve: the state a decoder reaches when it has
/// the first `bytes` bytes of the codeword.
struct RatePoint {
  uint64_t bytes;
  double distortion;  ///< weighted squared error of the coefficients, by what viewers see of it
  /// Between the point before and this one, some prefix is noticeably worse than the best so far.
  bool dips = false;
  /// By how much the unweighted squared error exceeds distortion; 0 unless there are priorities.
  double beyond = 0;

  /// The unweighted squared error of the coefficients.
  double squares() const { return distortion + beyond; }
};

struct EncodedTrack {
  std::vector<uint8_t> codeword;
  /// Falling distortion at rising bytes, from {0, all of it} to {codeword.size(), what is left}.
  std::vector<RatePoint> points;
  int planes = 0;        ///< bit-planes of the largest coefficient: the decoder must know
  bool complete = true;  ///< down to the last bit
};

/// How many bytes all codewords take together.
uint64_t bytesOf(std::span<const EncodedTrack> tracks);

/// The bytes with which coefficients are restored exactly; where their tracks are not complete,
/// more than they have.
uint64_t exactBytes(std::span<const EncodedTrack> tracks);

/// Coefficients of one band in the cell layout of BandShape (margins zero), |value| < 2^30.
struct BandSource {
  std::vector<int32_t> values;
  double weight = 1;  ///< squared error in the output per squared error of a coefficient
  /// What viewers see of it in each tier, against the mean of all samples.
  std::array<double, kPriorities> seen = {1, 1, 1, 1, 1, 1, 1, 1};
};

/// What one track is made of: bands[i] belongs to plan[i].
struct TrackSource {
  std::vector<BandPlan> plan;
  std::vector<BandSource> bands;
};

/// Where the coding of a component's tracks ends.
struct TrackOptions {
  /// An error of which the account, a sum of floats, never falls short: all passes are coded.
  static constexpr double kNever = -std::numeric_limits<double>::infinity();

  uint64_t limit = UINT64_MAX;  ///< bytes worth coding, of all tracks together
  uint32_t threads = 1;         ///< nothing depends on them
  double enough = kNever;       ///< distortion of all tracks together below which coding ends

  /// Nothing ends it but the last bit.
  bool toTheEnd() const { return limit == UINT64_MAX && enough == kNever; }
};

/// The tracks of one component, all with the bit-planes of its largest coefficient. Several tracks
/// stop together, at the same key of the order of passes, after a bit-plane in which all codewords
/// together pass the limit, or their error is small enough.
std::vector<EncodedTrack> encodeTracks(const std::vector<TrackSource>& sources,
                                       const TrackOptions& options);

/// Bit-planes of the largest coefficient of a track.
int planesOf(const TrackSource& track);

/// One of the tracks of a component. planes: those of the component's largest coefficient, or more.
/// least_slope: coding ends behind the first bit-plane of which a byte takes off less distortion;
/// 0: with the last bit.
EncodedTrack encodeTrack(const TrackSource& source, int planes, double least_slope = 0);

/// The same of all of them, where each track is coded by itself: only those that are being coded
/// take memory. source_of: is asked for every track twice, by several threads at a time.
std::vector<EncodedTrack> encodeWholeTracks(size_t count,
                                            const std::function<TrackSource(size_t)>& source_of,
                                            uint32_t threads);

}  // namespace tetrakis::inline track

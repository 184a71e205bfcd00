// SPDX-License-Identifier: Apache-2.0
// audit() corrects the account that an encoder keeps of a track (bytes and error after each pass)
// by decoding prefixes, as many as the size of the track allows. The account counts errors of
// coefficients; a viewer sees samples.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "bitstream/track/track_encoder.hpp"

namespace tetrakis::inline curves {

/// Squared error of the samples decoded from the first `bytes` bytes, in the units of the points.
/// Asked for rising bytes.
using Measure = std::function<double(uint64_t bytes)>;

/// The extent of an audit.
struct AuditScope {
  uint64_t samples = 0;
  uint64_t budget = UINT64_MAX;  ///< bytes of the track that can be sent at most
  /// All of the track is needed, as a largest error needs it, whatever its last bytes improve in
  /// the mean.
  bool whole = false;
};

/// Returns the track's points so that their distortion falls strictly.
///   small tracks    every point is measured, and so many prefixes in between that the quality
///                   between two of them changes by little, or as many as 2^23 decoded samples
///                   allow: all of the first bytes (8192 of 512 samples, 256 of 16 384). Dips are
///                   those that were seen. A quarter behind the budget is as far as anything in
///                   it can depend on
///   large tracks    a few points are measured and the others scaled in between; not with a
///                   budget, because the order must not depend on it. Of exact tracks more
///                   points are measured late, where samples lose most by being rounded
std::vector<RatePoint> audit(const EncodedTrack& track, const AuditScope& scope,
                             const Measure& measure);

/// The account of several tracks in their order, corrected at two points as audit() does if it ends
/// exact or there is no budget; any other account as it is.
std::vector<RatePoint> auditTogether(std::span<const RatePoint> points, const AuditScope& scope,
                                     const Measure& measure);

/// Twice the samples of the largest track of which every prefix is measured. Larger tracks measure
/// one prefix in as many bytes as they have times more samples. A larger number finds more dips,
/// and takes time.
inline constexpr uint64_t kTinySamples = uint64_t{1} << 12;
/// Samples of the largest track of which many prefixes are measured. A larger number finds dips of
/// more tracks, and takes their time.
inline constexpr uint64_t kSmallSamples = uint64_t{1} << 14;

}  // namespace tetrakis::inline curves

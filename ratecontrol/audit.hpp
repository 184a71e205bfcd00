// SPDX-License-Identifier: Apache-2.0
// The encoder's account of a track is kept in the transform domain; a viewer sees samples. The
// audit decodes prefixes and corrects the account, as often as the size of the track allows.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "bitstream/track_encoder.hpp"

namespace tetrakis {

/// Squared error of the decoded samples for a prefix of that many bytes, in the units of the
/// points.
using Measure = std::function<double(uint64_t bytes)>;

/// Returns the track's points so that their distortion falls strictly.
///   tiny tracks     one point for every byte that improves on all before it; dips are exact
///   small tracks    every point is measured
///   large tracks    a few points are measured and the others scaled in between; not where
///   `budgeted`:
///                   then the account stands as it is, because the order must not depend on a
///                   budget
std::vector<RatePoint> audit(const EncodedTrack& track, uint64_t samples, bool budgeted,
                             const Measure& measure);

inline constexpr uint64_t kTinySamples = uint64_t{1} << 11;
inline constexpr uint64_t kSmallSamples = uint64_t{1} << 14;
inline constexpr size_t kLargeMeasurements = 6;

}  // namespace tetrakis

// SPDX-License-Identifier: Apache-2.0
// squaresOf() and sampleErrorsOf() decode prefixes of coded heights, as a decoder would, and
// measure how far the decoded samples are from the input. The account of a track only estimates
// that error.
#pragma once

#include <cstdint>

#include "bitstream/stream/packet.hpp"
#include "codec/geometry/heights_decoder.hpp"
#include "encoder/heights/coded_heights.hpp"

namespace tetrakis::inline heights {

/// Sum of squared errors of the samples, in steps, including voids whose place is not known yet.
/// prefix: of the codeword of each track. memory: that of calls for fewer bytes of a component with
/// one track.
double squaresOf(const CodedHeights& heights, const Codewords& prefix, uint32_t threads,
                 HeightsMemory* memory = nullptr);

/// The memory for the first call of squaresOf().
HeightsMemory memoryFor(const CodedHeights& heights);

/// Decoded samples against the input's, over the valid ones; in sample units.
struct SampleErrors {
  double mean_square = 0, largest = 0;
};
SampleErrors sampleErrorsOf(const CodedHeights& heights, const Codewords& prefix, uint32_t threads);

}  // namespace tetrakis::inline heights

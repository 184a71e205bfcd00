// SPDX-License-Identifier: Apache-2.0
// encodeCorrections() and encodeExactSteps() turn the corrections of steps (correction_coder.hpp)
// and exact steps (exact_corrections.hpp) into a codeword, which corrections_decoder.hpp decodes;
// encodeParts() does so for each region of a plane.
#pragma once

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

#include "base/parallel.hpp"
#include "base/plane.hpp"
#include "base/view.hpp"
#include "bitstream/stream/geometry_header.hpp"
#include "codec/geometry/corrections/correction_coder.hpp"

namespace tetrakis::inline corrections {

// encodeParts() codes the corrections of each region of a plane as a codeword of its own
// (bitstream/stream/geometry_header.hpp), on several threads. A plane in one track is one part.

/// The codewords of the parts, in their order. The codeword of a part whose samples are all void
/// may be empty.
using PartCodewords = std::vector<std::vector<uint8_t>>;

inline uint64_t bytesOf(const PartCodewords& codewords) {
  return std::accumulate(codewords.begin(), codewords.end(), uint64_t{0},
                         [](uint64_t sum, const auto& codeword) { return sum + codeword.size(); });
}

/// Codes the parts at the same time. code(window): the codeword of a part. Nothing depends on the
/// threads.
template <class Code>
PartCodewords encodeParts(const GeometryHeader& header, uint32_t threads, const Code& code) {
  const std::vector<Window> parts = correctionParts(header);
  PartCodewords codewords(parts.size());
  parallelFor(threads, parts.size(), [&](size_t i) { codewords[i] = code(parts[i]); });
  return codewords;
}

// encodeCorrections() codes one small integer for each sample as a codeword of corrections
// (correction_coder.hpp).

/// Returns the codeword of one correction for each sample. Those of void samples are not coded.
std::vector<uint8_t> encodeCorrections(std::span<const int32_t> corrections,
                                       const CorrectionHints& hints);

// encodeExactSteps() codes exact corrections (exact_corrections.hpp), which turn decoded heights
// into whole steps again.

/// The codeword that leads from decoded heights, in units of 2^-fraction_bits steps, to the steps.
/// Those of void samples are not coded.
std::vector<uint8_t> encodeExactSteps(std::span<const int32_t> steps,
                                      const PlaneView<const int32_t>& heights, int fraction_bits);

}  // namespace tetrakis::inline corrections

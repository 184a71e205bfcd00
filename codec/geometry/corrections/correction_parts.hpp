// SPDX-License-Identifier: Apache-2.0
// encodeParts() codes the corrections of each region of a plane as a codeword of its own
// (bitstream/stream/correction_tracks.hpp), on several threads. A plane in one track is one part.
#pragma once

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

#include "base/parallel.hpp"
#include "base/view.hpp"
#include "bitstream/stream/correction_tracks.hpp"

namespace tetrakis::inline corrections {

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
  const std::vector<Window> parts = correctionParts(header.extent(), header.regions.side_log2);
  PartCodewords codewords(parts.size());
  parallelFor(threads, parts.size(), [&](size_t i) { codewords[i] = code(parts[i]); });
  return codewords;
}

}  // namespace tetrakis::inline corrections

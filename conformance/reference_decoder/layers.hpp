// SPDX-License-Identifier: Apache-2.0
// Reference decoder: validity, table of values, flat areas and
// corrections (docs/FORMAT.md, section 8.1).
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "conformance/reference_decoder/regions.hpp"
#include "conformance/reference_decoder/wavelet.hpp"

namespace tetrakis::reference {

/// 1 valid, 0 void, row by row.
std::vector<uint8_t> decodeValidity(std::span<const uint8_t> codeword, int width, int height);

/// FORMAT 8.1.2, "Masks of regions". base: of the first track; masks: of the others; regions: of
/// all of them, in their order.
std::vector<uint8_t> decodeRegionMasks(std::span<const uint8_t> base,
                                       const std::vector<std::span<const uint8_t>>& masks,
                                       const std::vector<Region>& regions);

/// FORMAT 9.4, "Masks": of each frame.
std::vector<std::vector<uint8_t>> decodeFrameMasks(std::span<const uint8_t> codeword, int width,
                                                   int height, int frames);

/// FORMAT 8.1, "Late mask". lifted: with the lifted samples as its valid ones.
std::vector<uint8_t> decodeLateValidity(std::span<const uint8_t> codeword, const Plane& lifted);

/// FORMAT 8.1, "Bridges": what section 7 takes for valid; empty: all samples. reach: 1 to 255.
std::vector<uint8_t> bridged(const std::vector<uint8_t>& valid, int width, int height, int reach);

class RangeDecoder;

/// FORMAT 8.1, "Flat areas": 1 flat, 0 not; nothing if a decision does not count.
std::optional<std::vector<uint8_t>> decodeFlatMask(RangeDecoder& decoder, const Plane& plane);

/// plane: which samples are valid. None unless there are so many areas and all decisions count.
Flat decodeFlat(std::span<const uint8_t> codeword, const Plane& plane, uint32_t areas,
                const Forest& forest);

/// One a sample, modulo 2^32. plane: which samples are valid. hints: one a sample, 0 to 31.
std::vector<uint32_t> decodeCorrections(std::span<const uint8_t> codeword, const Plane& plane,
                                        const std::vector<int>& hints);

/// FORMAT 8.1, "Exact": plane: heights in units of 2^-f steps.
void makeExact(std::span<const uint8_t> codeword, Plane& plane, int f);

/// Tables of so many words each, one behind the other; none from the first on of which a decision
/// does not count. bits: of the first word.
std::vector<std::vector<uint32_t>> decodeTables(std::span<const uint8_t> codeword,
                                                const std::vector<uint32_t>& values, int bits);

/// Takes up to `count` bytes off the front.
inline std::span<const uint8_t> take(std::span<const uint8_t>& codeword, uint64_t count) {
  const auto taken = codeword.first(std::min<uint64_t>(count, codeword.size()));
  codeword = codeword.subspan(taken.size());
  return taken;
}

}  // namespace tetrakis::reference

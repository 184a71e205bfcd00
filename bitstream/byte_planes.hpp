// SPDX-License-Identifier: Apache-2.0
// Samples that no model helps, stored: the highest byte of all of them, then the next one of all,
// so that a prefix still holds every sample roughly.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace tetrakis {

/// words: the lower `bytes` bytes of each count. Takes words.size() * bytes.
std::vector<uint8_t> toBytePlanes(std::span<const uint32_t> words, int bytes);

/// What a prefix of the planes of `count` words says. Bytes that are missing count as 80 00 00; of
/// words of which nothing is there, there is none.
std::vector<uint32_t> fromBytePlanes(std::span<const uint8_t> planes, size_t count, int bytes);

}  // namespace tetrakis

// SPDX-License-Identifier: Apache-2.0
// Streams that nobody encoded, made to take long: any tools on planes of any size, before codewords
// that decide much in few bytes. Those at an end of the range do: each decision is what its model
// expects, so that a byte holds 90 000 of them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace tetrakis::test {

struct SlowCase {
  std::string description;  ///< tools, size and codeword
  std::vector<uint8_t> stream;
};

/// The case of a seed. most_samples: of a plane.
SlowCase slowCase(uint64_t seed, uint64_t most_samples);

}  // namespace tetrakis::test

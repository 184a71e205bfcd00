// SPDX-License-Identifier: Apache-2.0
#include "conformance/digest.hpp"

#include <algorithm>
#include <bit>
#include <vector>

#include "conformance/sha256.hpp"

namespace tetrakis::conformance {

std::string sampleDigest(std::span<const std::byte> samples, tks_sample sample) {
  std::vector<std::byte> bytes(samples.begin(), samples.end());
  if constexpr (std::endian::native == std::endian::big) {
    const auto width = static_cast<std::ptrdiff_t>(tks_sample_bytes(sample));
    for (auto at = bytes.begin(); at != bytes.end(); at += width) std::reverse(at, at + width);
  }
  return sha256({reinterpret_cast<const uint8_t*>(bytes.data()), bytes.size()});
}

}  // namespace tetrakis::conformance

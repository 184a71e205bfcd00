// SPDX-License-Identifier: Apache-2.0
// SHA-256 (FIPS 180-4) by libmd.
#include "conformance/digest.hpp"

#include <sha2.h>

#include <algorithm>
#include <array>
#include <bit>
#include <vector>

namespace tetrakis::conformance {

std::string sampleDigest(std::span<const std::byte> samples, tks_sample sample) {
  std::vector<std::byte> bytes(samples.begin(), samples.end());
  if constexpr (std::endian::native == std::endian::big) {
    const auto width = static_cast<std::ptrdiff_t>(tks_sample_bytes(sample));
    for (auto at = bytes.begin(); at != bytes.end(); at += width) std::reverse(at, at + width);
  }
  std::array<char, SHA256_DIGEST_STRING_LENGTH> text{};
  SHA256Data(reinterpret_cast<const uint8_t*>(bytes.data()), bytes.size(), text.data());
  return text.data();
}

}  // namespace tetrakis::conformance

// SPDX-License-Identifier: Apache-2.0
// sha256() computes the digest of bytes (FIPS 180-4), so that every machine with a C++ compiler can
// check conformance without another library.
#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace tetrakis::conformance {

/// The digest of `bytes` as 64 lower-case hexadecimal digits.
std::string sha256(std::span<const uint8_t> bytes);

}  // namespace tetrakis::conformance

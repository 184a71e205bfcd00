// SPDX-License-Identifier: Apache-2.0
// sampleDigest() computes the SHA-256 of decoded samples, which is the same on every machine.
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "tetrakis/tetrakis.h"

namespace tetrakis::conformance {

/// SHA-256 of `samples` (host byte order, whole samples of type `sample`) written little endian, as
/// 64 lower-case hexadecimal digits.
std::string sampleDigest(std::span<const std::byte> samples, tks_sample sample);

}  // namespace tetrakis::conformance

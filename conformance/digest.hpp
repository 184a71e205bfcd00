// SPDX-License-Identifier: Apache-2.0
// Digests are the SHA-256 of what is decoded, which is the same on every machine.
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "tetrakis/tetrakis.hpp"

namespace tetrakis::conformance {

/// SHA-256 of `samples` (host byte order, whole samples of type `sample`) written little endian, as
/// 64 lower-case hexadecimal digits.
std::string sampleDigest(std::span<const std::byte> samples, tks_sample sample);

/// Likewise of doubles.
std::string doublesDigest(std::span<const double> values);

/// Of x, y, z of all corners, triangle by triangle, and of their texcoords u, v behind
/// these, if there are any.
std::string cornerDigest(const ObjectMesh& mesh);

}  // namespace tetrakis::conformance

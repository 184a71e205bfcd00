// SPDX-License-Identifier: Apache-2.0
// Conformance vectors that no encoder makes: headers at the ends of their ranges before codewords
// of noise, what decoders have to ignore, and what they have to refuse.
#pragma once

#include <vector>

#include "conformance/vector_cases.hpp"

namespace tetrakis::conformance {

/// Cases whose stream is written out (VectorCase::stream).
std::vector<VectorCase> craftedCases();

/// The same for headers and packets that decoders have to take as they are, or to refuse.
std::vector<VectorCase> unusualAndRefusedCases();

}  // namespace tetrakis::conformance

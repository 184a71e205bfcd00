// SPDX-License-Identifier: Apache-2.0
// What an encoding promises, checked from outside on the stream that it made.
#pragma once

#include <string>

#include "tests/awkward/awkward_case.hpp"

namespace tetrakis::test {

/// Encodes and looks: lossless streams give every bit back, bounds and budgets hold, every stream
/// is whole, takes no more than its samples and decodes wherever it is cut. Empty, or the first
/// promise that is broken. A refusal (TKS_USAGE with a sentence) breaks none but that of a lossless
/// stream.
std::string brokenPromise(const AwkwardCase& c);

}  // namespace tetrakis::test

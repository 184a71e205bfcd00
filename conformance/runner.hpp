// SPDX-License-Identifier: Apache-2.0
// runVectors() decodes every cut of every conformance vector and compares the answers with the
// manifest.
#pragma once

#include <ostream>
#include <string>

#include "conformance/manifest.hpp"
#include "tetrakis/result.hpp"

namespace tetrakis::conformance {

struct VectorSummary {
  int passed = 0, failed = 0;  ///< vectors; one passes when all its cuts do
};

/// Decodes the vectors of a directory that holds a manifest. Writes a line for each vector, and one
/// for each difference, to `log`. Fails with TKS_IO or TKS_CORRUPT for the manifest alone: a stream
/// that is missing or decodes differently counts as failed.
Result<VectorSummary> runVectors(const std::string& directory, std::ostream& log);

}  // namespace tetrakis::conformance

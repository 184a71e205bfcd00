// SPDX-License-Identifier: Apache-2.0
// Conformance runner. Exact equality is the only tolerance: the decoder is integer only.
#include "conformance/runner.hpp"

#include <span>

#include "conformance/decode_cut.hpp"

namespace tetrakis::conformance {
namespace {

std::string describe(const Cut& cut) {
  return "status " + std::to_string(cut.status) + ", heights " +
         (cut.heights.empty() ? "none" : cut.heights) + ", texture " +
         (cut.texture.empty() ? "none" : cut.texture) + ", triangles " +
         (cut.triangles.empty() ? "none" : cut.triangles);
}

bool same(const Cut& a, const Cut& b) {
  return a.status == b.status && a.heights == b.heights && a.texture == b.texture &&
         a.triangles == b.triangles;
}

/// Every cut, even after a difference: the log then shows where the difference begins.
bool runVector(const Vector& vector, std::span<const uint8_t> stream, std::ostream& log) {
  bool passed = !vector.cuts.empty();
  if (!passed) log << "  " << vector.name << " has no cuts\n";
  for (const Cut& wanted : vector.cuts) {
    if (wanted.bytes > stream.size()) {
      log << "  " << vector.name << " has " << stream.size() << " bytes, fewer than the cut at "
          << wanted.bytes << "\n";
      passed = false;
      continue;
    }
    const Cut got =
        decodeCut(stream.first(static_cast<size_t>(wanted.bytes)), wanted.level, wanted.component);
    if (same(wanted, got)) continue;
    log << "  " << vector.name << " at " << wanted.bytes << " bytes, level " << wanted.level
        << "\n    wanted " << describe(wanted) << "\n    got    " << describe(got) << "\n";
    passed = false;
  }
  return passed;
}

}  // namespace

Result<VectorSummary> runVectors(const std::string& directory, std::ostream& log) {
  const auto vectors = readManifest(directory);
  if (!vectors.ok()) return vectors.status();
  VectorSummary summary;
  for (const Vector& vector : *vectors) {
    const auto stream = readFile(directory + "/" + vector.file);
    if (!stream.ok()) log << "  " << stream.status().message() << "\n";
    const bool passed = stream.ok() && runVector(vector, *stream, log);
    log << (passed ? "pass " : "FAIL ") << vector.name << ": " << vector.purpose << "\n";
    ++(passed ? summary.passed : summary.failed);
  }
  return summary;
}

}  // namespace tetrakis::conformance

// SPDX-License-Identifier: Apache-2.0
// Conformance runner. Exact equality is the only tolerance: the decoder is integer only.
#include "conformance/runner.hpp"

#include "conformance/digest.hpp"
#include "tetrakis/tetrakis.hpp"

namespace tetrakis::conformance {
namespace {

std::string describe(const Cut& cut) {
  return "status " + std::to_string(cut.status) + ", heights " +
         (cut.heights.empty() ? "none" : cut.heights) + ", texture " +
         (cut.texture.empty() ? "none" : cut.texture);
}

bool same(const Cut& a, const Cut& b) {
  return a.status == b.status && a.heights == b.heights && a.texture == b.texture;
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
    const Cut got = decodeCut(stream.first(static_cast<size_t>(wanted.bytes)), wanted.level);
    if (same(wanted, got)) continue;
    log << "  " << vector.name << " at " << wanted.bytes << " bytes, level " << wanted.level
        << "\n    wanted " << describe(wanted) << "\n    got    " << describe(got) << "\n";
    passed = false;
  }
  return passed;
}

}  // namespace

Cut decodeCut(std::span<const uint8_t> prefix, int level) {
  Cut cut;
  cut.bytes = prefix.size();
  cut.level = level;
  auto decoder = Decoder::open(prefix);
  if (!decoder) {
    cut.status = decoder.status().code();
    return cut;
  }
  if (level > 0) {
    const auto up_to = [&](uint32_t coarsest) {
      return std::min(static_cast<uint32_t>(level), coarsest);
    };
    const tks_info info = decoder->info();
    const auto set =
        decoder->setLevels(up_to(info.coarsest_level), up_to(info.texture_coarsest_level));
    if (!set.ok()) cut.status = set.code();
  }
  if (decoder->info().has_heights) {
    const auto heights = decoder->heights();
    if (heights) cut.heights = sampleDigest(*heights, decoder->info().sample);
    if (!heights) cut.status = heights.status().code();
  }
  if (decoder->info().has_texture) {
    const auto texture = decoder->texture();
    if (texture) cut.texture = sampleDigest(*texture, decoder->info().texture_sample);
    if (!texture) cut.status = texture.status().code();
  }
  return cut;
}

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

// SPDX-License-Identifier: Apache-2.0
// A Candidate is the result of one attempt to code a component, with its curve once that is known.
// Attempts do not know of each other and change nothing that they are given, so that none of them
// has anything to take back: fewestBytes() chooses among the candidates.
#pragma once

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "ratecontrol/curves/component_curve.hpp"
#include "ratecontrol/needs/needed_bytes.hpp"

namespace tetrakis::inline needs {

/// Coded: CodedHeights or CodedTexture.
template <class Coded>
struct Candidate {
  std::shared_ptr<const Coded> coded;
  std::optional<ComponentCurve> curve = {};  ///< once somebody needed it
  uint64_t need = kAllBytes;                 ///< bytes of its packets that the target needs

  uint64_t bytes() const { return std::min(need, bytesOf(coded->tracks)) + coded->inHeader(); }
};

/// A candidate whose target needs all of its bytes, without a curve.
template <class Coded>
Candidate<Coded> candidateOf(Coded coded) {
  return {std::make_shared<const Coded>(std::move(coded))};
}

/// The candidate of the fewest bytes; of equal ones the first. There is at least one. lost: called
/// with each of the others.
template <class Coded, class Lost>
Candidate<Coded> fewestBytes(std::vector<Candidate<Coded>> candidates, const Lost& lost) {
  assert(!candidates.empty());
  const auto best = std::min_element(
      candidates.begin(), candidates.end(),
      [](const Candidate<Coded>& a, const Candidate<Coded>& b) { return a.bytes() < b.bytes(); });
  for (auto one = candidates.begin(); one != candidates.end(); ++one)
    if (one != best) lost(*one);
  return std::move(*best);
}

}  // namespace tetrakis::inline needs

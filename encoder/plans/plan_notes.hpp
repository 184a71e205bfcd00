// SPDX-License-Identifier: Apache-2.0
// PlanNotes collects the plans that an encoding weighs: each with the bytes that were expected of
// it, with what came out where it was coded, and with the reason for which it was not taken. Who
// drops a candidate notes it; the candidate that the stream holds is noted last. Notes never have a
// part in a choice.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "encoder/plans/plan.hpp"

namespace tetrakis::inline plans {

/// Whether a plan was taken, or else why not.
enum class Verdict : uint8_t {
  kTaken,
  kExpectedLonger,  ///< an estimate says that it takes more bytes, or hardly fewer: not coded
  kLonger,          ///< it takes more bytes than another one, or as many
  kMissesTarget,    ///< all of its bytes do not reach the error that is asked for
  kNoRoom,          ///< the budget does not hold it
  kWorsePrefixes,   ///< prefixes of it lose more than its bytes save
  kWorseInBudget    ///< what the budget holds of it shows more errors, or has no use for its end
};

/// What a coded plan came to.
struct CodedOutcome {
  uint64_t bytes = 0;      ///< of all tracks, whether or not the target needs all of them
  uint64_t needed = 0;     ///< of these, what the target needs; of a taken plan, what is sent
  uint64_t in_header = 0;  ///< bytes of the header that only some plans need
  double rmse = 0;         ///< that all bytes leave, by the encoder's account, in samples

  bool operator==(const CodedOutcome&) const = default;
};

struct WeighedPlan {
  Plan plan;
  Verdict verdict = Verdict::kLonger;
  std::optional<double> expected = {};     ///< bytes by an estimate; nothing: none was made
  std::optional<CodedOutcome> coded = {};  ///< nothing: it was not coded
};

/// The plans of one component. At most one thread notes at a time.
class ComponentNotes {
 public:
  /// A plan is kept once, however often it is noted: later verdicts and outcomes take the place of
  /// earlier ones, but a verdict kTaken stays, as does what only an earlier note knew.
  void add(WeighedPlan weighed);
  /// In the order in which the plans were first noted.
  const std::vector<WeighedPlan>& plans() const { return plans_; }

 private:
  std::vector<WeighedPlan> plans_;
};

/// Each component has notes of its own, because both are coded at the same time.
struct PlanNotes {
  ComponentNotes heights, texture;
};

/// What fewestBytes() is to do with the candidates that lose. inputs: outlive the result.
template <class Inputs>
auto notingLonger(const Inputs& inputs) {
  return [&inputs](const auto& lost) { note(inputs, *lost.coded, Verdict::kLonger, lost.need); };
}

}  // namespace tetrakis::inline plans

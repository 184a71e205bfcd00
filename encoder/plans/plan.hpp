// SPDX-License-Identifier: Apache-2.0
// Plan states as a value how a component is coded. PlanNotes collects the plans that an encoding
// has weighed, and filterWords(), layerWords() and predictorWords() say them in words, so that the
// encoder can explain its choice to the caller.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "bitstream/stream/coding_headers.hpp"

namespace tetrakis::inline plans {

// Plan states how a component is coded, as a value: what its samples are counted in, what makes
// their base, where the base is cut, what residual follows, and which layers lie around both. Plans
// can be compared and told to people; two codings of one component with equal plans differ in
// nothing that a plan states.

/// The predictor of the samples that a residual restores.
enum class Predictor : uint8_t {
  kNone,
  kDecoded,     ///< the decoded base alone
  kNeighbours,  ///< the base, and the errors of the exact steps beside a sample
  kRelative,    ///< multiples of a step beside the samples before
  kFacets       ///< planes and lines through the samples before
};

/// The corrections that follow the base.
struct Residual {
  enum class Kind : uint8_t { kNone, kWithin, kExact };

  Kind kind = Kind::kNone;
  double within = 0;  ///< kWithin only: the error that is left, in steps
  Predictor predictor = Predictor::kNone;

  bool operator==(const Residual&) const = default;
};

/// The layers around the base.
enum class Layer : uint8_t {
  kMask,       ///< of voids, ahead of the base
  kLateMask,   ///< of voids, within the base
  kBridges,    ///< the transform goes on over what is not coded
  kFlatAreas,  ///< shapes with a height
  kCutOut,     ///< alpha that is 0 or the largest value
  kOverlay,    ///< drawn over a photograph
  kPriorities,
  kRegions
};

struct Plan {
  Coding base = Coding::kWavelet;  ///< kStored: there is none, the samples are stored
  double step = 0;                 ///< in sample units; 0: a table's places, or texels
  uint32_t table_values = 0;       ///< of all tables together; 0: there is none
  /// Of level 1, of level 2, of all coarser ones. Nothing: there are no filters, or an estimate did
  /// without the choice of them.
  std::optional<std::array<uint8_t, 3>> filters = {};
  bool fractions = false;          ///< the transform keeps fractions: it does not end exact
  std::optional<double> cut = {};  ///< the RMSE, in steps, at which coefficients end; nothing: none
  Residual residual = {};
  std::vector<Layer> layers = {};  ///< in the order of the enumeration

  bool operator==(const Plan&) const = default;
};

// PlanNotes collects the plans that an encoding weighs: each with the bytes that were expected of
// it, with what came out where it was coded, and with the reason for which it was not taken. Who
// drops a candidate notes it; the candidate that the stream holds is noted last. Notes never have a
// part in a choice.

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

/// The bytes and the error that a coded plan came to.
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

/// Notes the candidates that lose, for fewestBytes(). inputs: outlive the result.
template <class Inputs>
auto notingLonger(const Inputs& inputs) {
  return [&inputs](const auto& lost) { note(inputs, *lost.coded, Verdict::kLonger, lost.need); };
}

// filterWords(), layerWords() and predictorWords() say parts of a plan in the words that the C
// interface hands out.

/// The filters of level 1, of level 2 and of all coarser ones: "six-tap, six-tap, quiet". Empty if
/// the plan names none.
std::string filterWords(const Plan& plan);

/// The layers: "mask, flat areas". Empty if there are none.
std::string layerWords(const Plan& plan);

/// Empty if there is no residual.
const char* predictorWords(const Plan& plan);

}  // namespace tetrakis::inline plans

// SPDX-License-Identifier: Apache-2.0
#include "encoder/plans/plan_notes.hpp"

#include <algorithm>
#include <utility>

namespace tetrakis::inline plans {

void ComponentNotes::add(WeighedPlan weighed) {
  const auto known = std::find_if(plans_.begin(), plans_.end(), [&](const WeighedPlan& noted) {
    return noted.plan == weighed.plan;
  });
  if (known == plans_.end()) {
    plans_.push_back(std::move(weighed));
    return;
  }
  if (weighed.expected) known->expected = weighed.expected;
  if (known->verdict == Verdict::kTaken) return;
  if (weighed.coded) known->coded = weighed.coded;
  if (weighed.coded || !known->coded) known->verdict = weighed.verdict;
}

}  // namespace tetrakis::inline plans

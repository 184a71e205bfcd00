// SPDX-License-Identifier: Apache-2.0
// Reference decoder: how much is known to go on around a coefficient (docs/FORMAT.md, section 6).
#pragma once

#include <algorithm>
#include <cstdint>

#include "conformance/reference_decoder/track.hpp"

namespace tetrakis::reference {

/// FORMAT 6: L(S(p)), which is 0 where S(p) is.
inline int activity(const Neighbours& n, int p) {
  uint32_t sum = 0;
  const auto add = [&](const Coefficient& c, uint32_t weight) {
    sum += weight * std::min(c.magnitude >> p, 30u);
  };
  for (const Coefficient& c : n.along) add(c, 2);
  for (const Coefficient& c : n.across) add(c, 2);
  for (const Coefficient& c : n.far) add(c, 1);
  if (sum < 5) return static_cast<int>(sum);
  int level = 5;
  for (const uint32_t last : {6u, 9u, 13u, 19u, 29u}) level += sum > last;
  return level;
}

}  // namespace tetrakis::reference

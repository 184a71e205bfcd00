// SPDX-License-Identifier: Apache-2.0
// What the reference decoder answers, as the library says it.
#pragma once

#include "conformance/reference_decoder.hpp"
#include "tetrakis/tetrakis.h"

namespace tetrakis::test {

inline tks_status statusOf(reference::Outcome outcome) {
  switch (outcome) {
    case reference::Outcome::kDone:
      return TKS_OK;
    case reference::Outcome::kTruncated:
      return TKS_TRUNCATED;
    case reference::Outcome::kCorrupt:
      return TKS_CORRUPT;
    case reference::Outcome::kUnsupported:
      return TKS_UNSUPPORTED;
    case reference::Outcome::kTooLarge:
      return TKS_LIMIT;
  }
  return TKS_USAGE;
}

}  // namespace tetrakis::test

// SPDX-License-Identifier: Apache-2.0
// Numbers as text for people.
#pragma once

#include <cstdio>
#include <string>

namespace tetrakis::tools {

/// With so many digits behind the point; the C locale's point always.
inline std::string fixed(double value, int digits) {
  char text[400];  // the longest double has 309 digits before the point
  return {text, static_cast<size_t>(std::snprintf(text, sizeof text, "%.*f", digits, value))};
}

}  // namespace tetrakis::tools

// SPDX-License-Identifier: Apache-2.0
// GlLimits holds the sizes that the driver supports, and checkGl() reports the errors of the
// driver.
#pragma once

#include <cstdint>

#include "tetrakis/result.hpp"

namespace tetrakis::tools {

/// Largest sizes of the driver.
struct GlLimits {
  uint32_t texture = 0, target = 0;

  static GlLimits query();
};

/// The error since the last call, if there is one. what: was drawn or handed over.
Status checkGl(const char* what);

}  // namespace tetrakis::tools

// SPDX-License-Identifier: Apache-2.0
// positive() checks that the text of an option is a number above 0.
#pragma once

#include <CLI/CLI.hpp>
#include <cmath>
#include <string>

namespace tetrakis::tools {

/// CLI11's own says "in range [2.2e-308 - 1.8e+308]", with all digits.
inline CLI::Validator positive() {
  return CLI::Validator(
      [](const std::string& text) {
        double value = 0;
        return CLI::detail::lexical_cast(text, value) && value > 0 && std::isfinite(value)
                   ? std::string()
                   : "'" + text + "' is not a finite number above 0";
      },
      "");
}

}  // namespace tetrakis::tools

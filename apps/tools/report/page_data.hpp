// SPDX-License-Identifier: Apache-2.0
// pageData() writes the data that the script of a report's page draws.
#pragma once

#include <string>

#include "apps/tools/report/report.hpp"

namespace tetrakis::tools {

/// As JSON, safe to stand in a script of a page.
std::string pageData(const Report& report);

}  // namespace tetrakis::tools

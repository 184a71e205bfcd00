// SPDX-License-Identifier: Apache-2.0
// giveCrs() and giveVerticalDatum() replace the reference system that a file states by the one that
// the user gives.
#pragma once

#include <string>

#include "apps/tools/files/files.hpp"

namespace tetrakis::tools {

/// Drops what the file says of its CRS. Spacing follows from the new one where PROJ knows its unit;
/// one with a vertical part replaces the vertical datum too.
void giveCrs(HeightFile& heights, const std::string& crs);

/// Drops what the file says of its vertical CRS alone.
void giveVerticalDatum(HeightFile& heights, const std::string& datum);

}  // namespace tetrakis::tools

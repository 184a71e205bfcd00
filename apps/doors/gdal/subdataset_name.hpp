// SPDX-License-Identifier: Apache-2.0
// What datasets are called: a file, or one of the two parts of it.
#pragma once

#include <optional>
#include <string>

#include "tetrakis/tetrakis.h"

namespace tetrakis::gdal {

/// TKS:"file":heights or TKS:"file":texture, also without the quotes.
struct SubdatasetName {
  std::string file;
  tks_part part;
};

/// Whether a name is meant for one, well formed or not.
bool isSubdatasetName(const char* text);

/// Nothing after a reported error.
std::optional<SubdatasetName> subdatasetName(const char* text);

std::string nameOf(const SubdatasetName& subdataset);

/// The word for a part.
const char* partName(tks_part part);

}  // namespace tetrakis::gdal

// SPDX-License-Identifier: Apache-2.0
// columnsRound() of a file: whether its columns go round the Earth, by its transform and the unit
// of its geographic CRS. Files without a place, and maps, do not go round.
#pragma once

#include <cstdint>

#include "apps/tools/files/files.hpp"
#include "base/columns_round.hpp"

namespace tetrakis::tools {

ColumnsRound columnsRound(const Georeference& place, uint32_t width);

}  // namespace tetrakis::tools

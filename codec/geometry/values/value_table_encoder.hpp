// SPDX-License-Identifier: Apache-2.0
// encodeValueTable() codes a table of values as a codeword.
#pragma once

#include <cstdint>
#include <vector>

#include "codec/geometry/values/value_table.hpp"

namespace tetrakis::inline values {

std::vector<uint8_t> encodeValueTable(const ValueTable& table);

}  // namespace tetrakis::inline values

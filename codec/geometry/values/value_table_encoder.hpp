// SPDX-License-Identifier: Apache-2.0
// The encoder of a table of values: from the sorted values to its codeword.
#pragma once

#include <cstdint>
#include <vector>

#include "codec/geometry/values/value_table.hpp"

namespace tetrakis::inline values {

std::vector<uint8_t> encodeValueTable(const ValueTable& table);

}  // namespace tetrakis::inline values

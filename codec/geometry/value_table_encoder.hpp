// SPDX-License-Identifier: Apache-2.0
// Table of values to codeword.
#pragma once

#include <cstdint>
#include <vector>

#include "codec/geometry/value_table.hpp"

namespace tetrakis::inline geometry {

std::vector<uint8_t> encodeValueTable(const ValueTable& table);

}  // namespace tetrakis::inline geometry

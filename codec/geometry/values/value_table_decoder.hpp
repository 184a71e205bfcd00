// SPDX-License-Identifier: Apache-2.0
// decodeValueTable() decodes a table of values from its codeword.
#pragma once

#include <cstdint>
#include <span>

#include "codec/geometry/values/value_table.hpp"

namespace tetrakis::inline values {

/// codeword: any prefix of the codeword of a table. Empty unless all values are known. values: how
/// many there are. Safe on any bytes; takes memory for that many words and no more.
ValueTable decodeValueTable(std::span<const uint8_t> codeword, uint32_t values);

}  // namespace tetrakis::inline values

// SPDX-License-Identifier: Apache-2.0
// giveBytes() copies bytes into a buffer that the caller releases.
#pragma once

#include <cstdint>
#include <span>

#include "tetrakis/tetrakis.h"

namespace tetrakis::inline api {

/// Copies bytes to where tks_free_buffer() finds them. out: has none. Throws std::bad_alloc.
void giveBytes(std::span<const uint8_t> bytes, tks_buffer& out);

}  // namespace tetrakis::inline api

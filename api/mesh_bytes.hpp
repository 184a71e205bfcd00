// SPDX-License-Identifier: Apache-2.0
// meshBytes() tells how many bytes a mesh takes to decode. Its figures are measured
// (tests/api/decode_memory_test.cpp).
#pragma once

#include <cstdint>

#include "api/memory.hpp"

namespace tetrakis::inline api {

/// Bytes of a request for a coded mesh or a budget mesh.
uint64_t meshBytes(const tks_decoder& decoder, const MemoryRequest& request);

}  // namespace tetrakis::inline api

// SPDX-License-Identifier: Apache-2.0
// crc32() computes the checksum of headers, and of the payloads of streams that promise exact
// samples or a largest error.
#pragma once

#include <cstdint>
#include <span>

namespace tetrakis::inline stream {

/// CRC-32 as in PNG and zip: polynomial EDB88320 reflected, initial and final xor FFFFFFFF.
uint32_t crc32(std::span<const uint8_t> bytes);

}  // namespace tetrakis::inline stream

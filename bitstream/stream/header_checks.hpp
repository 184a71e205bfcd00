// SPDX-License-Identifier: Apache-2.0
// Each field of a header is held to its range while it is read. The checks here are of what fields
// say together, and of numbers that no range describes (docs/FORMAT.md, section 2).
#pragma once

#include "base/status.hpp"
#include "bitstream/stream/header.hpp"

namespace tetrakis::inline stream {

/// TKS_CORRUPT where a header says what no stream can hold.
Status checkMeaning(const StreamHeader& header);

}  // namespace tetrakis::inline stream

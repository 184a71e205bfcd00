// SPDX-License-Identifier: Apache-2.0
// checkMeaning() refuses a header whose fields contradict each other, once all fields are read; the
// range of each is checked while it is read. A stream with a part that this decoder does not know
// but must know is refused before that, as unsupported (docs/FORMAT.md, section 2, Statuses).
#pragma once

#include "base/status.hpp"
#include "bitstream/stream/header.hpp"

namespace tetrakis::inline stream {

/// TKS_CORRUPT where a header says what no stream can hold.
Status checkMeaning(const StreamHeader& header);

}  // namespace tetrakis::inline stream

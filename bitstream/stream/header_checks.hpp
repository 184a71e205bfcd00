// SPDX-License-Identifier: Apache-2.0
// Each field of a header is held to its range while it is read. The checks here are of what fields
// of several parts say together, once all are read: a stream with a part that this decoder does not
// know and has to is unsupported before that (docs/FORMAT.md, section 2, Statuses).
#pragma once

#include "base/status.hpp"
#include "bitstream/stream/header.hpp"

namespace tetrakis::inline stream {

/// TKS_CORRUPT where a header says what no stream can hold.
Status checkMeaning(const StreamHeader& header);

}  // namespace tetrakis::inline stream

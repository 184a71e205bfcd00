// SPDX-License-Identifier: Apache-2.0
// encodeSequence() encodes the files that patterns name as the frames of a sequence, in the order
// of their names: `tetrakis encode 'frames/*.tif' --fps 2`.
#pragma once

#include "apps/tools/commands/encode_arguments.hpp"
#include "tetrakis/result.hpp"

namespace tetrakis::tools {

/// Whether heights or texture are given by a pattern.
bool isSequence(const EncodeArguments& arguments);

/// Writes the sequence group by group, in the memory of one group.
Status encodeSequence(const EncodeArguments& arguments, bool quiet);

}  // namespace tetrakis::tools

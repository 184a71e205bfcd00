// SPDX-License-Identifier: Apache-2.0
// encodeSequence() encodes the files that patterns name as the frames of a sequence, in the order
// of their names: `tetrakis encode 'frames/*.tif' --fps 2`.
#pragma once

#include <string>
#include <vector>

#include "apps/tools/commands/encode_arguments.hpp"
#include "tetrakis/result.hpp"

namespace tetrakis::tools {

/// Whether heights or texture are given by a pattern.
bool isSequence(const EncodeArguments& arguments);

/// The files that a pattern with *, ? or [ names, sorted; of another path, that path. TKS_IO: there
/// is none.
Result<std::vector<std::string>> filesOf(const std::string& pattern);

/// Writes the sequence group by group, in the memory of one group.
Status encodeSequence(const EncodeArguments& arguments, bool quiet);

}  // namespace tetrakis::tools

// SPDX-License-Identifier: Apache-2.0
// checkEncodeMemory() refuses to encode inputs that would take more memory than the limit, before
// encoding begins.
#pragma once

#include "apps/tools/commands/encode_arguments.hpp"
#include "apps/tools/report/comparison.hpp"

namespace tetrakis::tools {

/// TKS_LIMIT with a sentence if encoding takes more than there may be; an estimate that is no lower
/// than what was measured.
Status checkEncodeMemory(const EncodeArguments& arguments, const Reference& inputs);

}  // namespace tetrakis::tools

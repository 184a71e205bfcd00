// SPDX-License-Identifier: Apache-2.0
// The functions here read the inputs of `tetrakis encode` and turn its arguments into what the
// library takes; frames of a sequence go through them one by one.
#pragma once

#include "apps/tools/commands/encode_arguments.hpp"
#include "apps/tools/report/report.hpp"
#include "tetrakis/result.hpp"
#include "tetrakis/tetrakis.h"

namespace tetrakis::tools {

/// Reads heights and texture, with what the arguments say of them, and tells what is guessed.
Result<Reference> readInputs(const EncodeArguments& arguments, bool quiet);

/// Without cameras, pictures and callbacks.
Result<tks_encode_options> encodeOptions(const EncodeArguments& arguments, const Reference& inputs);

/// The heights of a file, which outlives them, with the arguments' step and the latitudes of their
/// rows.
tks_heights encodedHeights(const EncodeArguments& arguments, const HeightFile& file);

}  // namespace tetrakis::tools

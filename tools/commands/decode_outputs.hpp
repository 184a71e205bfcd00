// SPDX-License-Identifier: Apache-2.0
// The files that `tetrakis decode` writes. They are planned before there is any work, and appear
// when all have been written.
#pragma once

#include <optional>

#include "tools/commands/decode_arguments.hpp"
#include "tools/files/engine_heights.hpp"
#include "tools/output/output.hpp"

namespace tetrakis::tools {

struct DecodeOutputs {
  std::optional<Output> height, texture, mesh, normals;
  std::optional<EngineSize> engine;  ///< of --size
};

/// TKS_USAGE if the names of the files, the options and the stream do not go together.
Result<DecodeOutputs> planOutputs(const DecodeArguments& arguments, const tks_info& info);

/// Puts the files that have been staged in their places.
Status commit(DecodeOutputs& outputs);

}  // namespace tetrakis::tools

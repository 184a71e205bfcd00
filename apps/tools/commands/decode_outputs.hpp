// SPDX-License-Identifier: Apache-2.0
// planOutputs() names the files that `tetrakis decode` writes, before any work begins, and commit()
// makes all of them appear once they are written.
#pragma once

#include <optional>

#include "apps/tools/commands/decode_arguments.hpp"
#include "apps/tools/files/engine_heights.hpp"
#include "apps/tools/output/output.hpp"

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

// SPDX-License-Identifier: Apache-2.0
// inSeparateProcess() does work in a copy of this process, for libraries that damaged files can
// crash, or keep busy for ever: it is the copy that ends.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "tetrakis/result.hpp"

namespace tetrakis::tools {

/// The bytes that `work` returns. The copy prints nothing, leaves Temporaries alone, and may take
/// as much memory as this process (memory_limit.hpp) and so many seconds of processor time.
/// TKS_LIMIT: it took more. TKS_USAGE: it crashed. `work` meets no other thread of this process.
Result<std::vector<std::byte>> inSeparateProcess(
    const std::function<std::vector<std::byte>()>& work, uint32_t seconds);

}  // namespace tetrakis::tools

// SPDX-License-Identifier: Apache-2.0
// parallelFor() runs independent pieces of work on several threads. The results never depend on the
// number of threads.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>

namespace tetrakis::inline base {

/// Calls work(i) once for every i < count, on at most `threads` threads (0 counts as 1), the
/// caller's among them. Calls must not write what another one touches. Throws what a call throws
/// (one of them), after all threads have ended; where the system refuses threads, fewer do the
/// work. The watch of the caller's thread counts the calls, and may end them (base/watch.hpp).
void parallelFor(uint32_t threads, size_t count, const std::function<void(size_t)>& work);

}  // namespace tetrakis::inline base

// SPDX-License-Identifier: Apache-2.0
// parallelFor() where there is one thread: a WebAssembly module without shared memory.
#include "base/parallel.hpp"
#include "base/watch.hpp"

namespace tetrakis::inline base {

namespace {

Watch* watch_of_thread = nullptr;

}  // namespace

Watch*& watchOfThread() {
  return watch_of_thread;
}

void parallelFor(uint32_t, size_t count, const std::function<void(size_t)>& work) {
  for (size_t i = 0; i < count; ++i) {
    work(i);
    passPiece(count);
  }
}

}  // namespace tetrakis::inline base

// SPDX-License-Identifier: Apache-2.0
// Peak memory by fork and wait4; see child_memory.hpp.
#include "bench/peers/child_memory.hpp"

#include <malloc.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace tetrakis::bench {
namespace {

// Peak resident bytes of a child that does the work; its exit code is the status code.
Result<uint64_t> childPeak(const std::function<Status()>& work) {
  const pid_t child = fork();
  if (child < 0) return Status(TKS_NO_MEMORY, "Cannot fork a process to measure memory.");
  if (child == 0) _exit(work().code());
  int state = 0;
  rusage usage{};
  if (wait4(child, &state, 0, &usage) != child || !WIFEXITED(state)) {
    return Status(TKS_MISMATCH, "The process whose memory is measured crashed.");
  }
  if (WEXITSTATUS(state) != TKS_OK) {
    return Status(static_cast<tks_status>(WEXITSTATUS(state)), "The measured work failed.");
  }
  return static_cast<uint64_t>(usage.ru_maxrss) * 1024;  // Linux counts KiB
}

}  // namespace

Result<uint64_t> peakMemory(const std::function<Status()>& work,
                            const std::function<Status()>& baseline) {
  malloc_trim(0);  // else a child would reuse freed blocks that its baseline already counts
  const Result<uint64_t> idle = childPeak(baseline);
  if (!idle.ok()) return idle;
  const Result<uint64_t> busy = childPeak(work);
  if (!busy.ok()) return busy;
  return *busy > *idle ? *busy - *idle : 0;
}

}  // namespace tetrakis::bench

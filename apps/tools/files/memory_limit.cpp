// SPDX-License-Identifier: Apache-2.0
#include "apps/tools/files/memory_limit.hpp"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <limits>
#include <optional>

#include "base/shown_text.hpp"

namespace tetrakis::tools {
namespace {

constexpr uint64_t kUnlimited = std::numeric_limits<uint64_t>::max();

/// The number that a file begins with; nothing for "max", or if there is no such file.
std::optional<uint64_t> numberIn(const std::filesystem::path& path) {
  std::ifstream file(path);
  uint64_t number = 0;
  if (!(file >> number)) return std::nullopt;
  return number;
}

/// What can be had without swapping (MemAvailable: free memory, and caches that give way), because
/// memory that others hold is of no use; physical memory where that is not said.
uint64_t machineMemory() {
  std::ifstream file("/proc/meminfo");
  std::string word;
  while (file >> word) {
    uint64_t kibibytes = 0;
    if (word == "MemAvailable:" && file >> kibibytes) return 1024 * kibibytes;
  }
  const long pages = sysconf(_SC_PHYS_PAGES), page = sysconf(_SC_PAGESIZE);
  if (pages <= 0 || page <= 0) return kUnlimited;
  return static_cast<uint64_t>(pages) * static_cast<uint64_t>(page);
}

/// The least that the control groups of this process allow, of either version.
uint64_t groupMemory() {
  const std::filesystem::path root = "/sys/fs/cgroup";
  uint64_t least = numberIn(root / "memory/memory.limit_in_bytes").value_or(kUnlimited);
  std::ifstream file("/proc/self/cgroup");
  std::filesystem::path group;
  for (std::string line; std::getline(file, line);)
    if (line.starts_with("0::/")) group = line.substr(4);
  for (; !group.empty() && group != group.parent_path(); group = group.parent_path())
    least = std::min(least, numberIn(root / group / "memory.max").value_or(kUnlimited));
  return std::min(least, numberIn(root / "memory.max").value_or(kUnlimited));
}

/// What RLIMIT_AS leaves of the address space.
uint64_t addressSpace() {
  rlimit limit = {};
  if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return kUnlimited;
  const auto page = static_cast<uint64_t>(std::max(sysconf(_SC_PAGESIZE), 1L));
  const uint64_t used = numberIn("/proc/self/statm").value_or(0) * page;
  return limit.rlim_cur - std::min<uint64_t>(limit.rlim_cur, used);
}

uint64_t limit_of_process = 0;

}  // namespace

uint64_t defaultMemoryLimit() {
  return std::max<uint64_t>(1, std::min({machineMemory(), groupMemory(), addressSpace()}) / 4 * 3);
}

void setMemoryLimit(uint64_t bytes) {
  limit_of_process = bytes > 0 ? bytes : defaultMemoryLimit();
}

uint64_t memoryLimit() {
  if (limit_of_process == 0) setMemoryLimit(0);
  return limit_of_process;
}

Status checkMemoryFor(const std::string& what, uint64_t bytes) {
  if (bytes <= memoryLimit()) return Status();
  return Status(TKS_LIMIT, what + " takes " + describeBytes(bytes) +
                               " of memory; the limit (--max-memory) is " +
                               describeBytes(memoryLimit()));
}

}  // namespace tetrakis::tools

// SPDX-License-Identifier: Apache-2.0
#include "apps/tools/files/separate_process.hpp"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <fstream>
#include <new>
#include <string>

#include "apps/tools/files/memory_limit.hpp"

namespace tetrakis::tools {
namespace {

constexpr int kDone = 0, kNoMemory = 3, kThrown = 4;

/// Bytes of the address space that are taken: under sanitizers far more than memory.
uint64_t takenSpace() {
  std::ifstream file("/proc/self/statm");
  uint64_t pages = 0;
  file >> pages;
  return pages * static_cast<uint64_t>(std::max(sysconf(_SC_PAGESIZE), 1L));
}

void limitTo(int resource, uint64_t most) {
  rlimit limit{};
  getrlimit(static_cast<__rlimit_resource_t>(resource), &limit);
  limit.rlim_cur = std::min<rlim_t>(limit.rlim_max, most);
  setrlimit(static_cast<__rlimit_resource_t>(resource), &limit);
}

/// Signals do what they usually do, and not what this process does about Temporaries.
void detach(uint32_t seconds) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  for (const int signal : {SIGHUP, SIGINT, SIGTERM, SIGPIPE}) std::signal(signal, SIG_DFL);
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  const int nowhere = open("/dev/null", O_RDWR);
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) dup2(nowhere, stream);
  const uint64_t memory = memoryLimit(), taken = takenSpace();
  limitTo(RLIMIT_AS, memory > UINT64_MAX - taken ? UINT64_MAX : memory + taken);
  limitTo(RLIMIT_CPU, seconds);
  limitTo(RLIMIT_CORE, 0);
}

bool sendAll(int pipe, const std::vector<std::byte>& bytes) {
  for (size_t sent = 0; sent < bytes.size();) {
    const ssize_t now = write(pipe, bytes.data() + sent, bytes.size() - sent);
    if (now < 0 && errno == EINTR) continue;
    if (now <= 0) return false;
    sent += static_cast<size_t>(now);
  }
  return true;
}

[[noreturn]] void workAndEnd(const std::function<std::vector<std::byte>()>& work, int pipe) {
  try {
    _exit(sendAll(pipe, work()) ? kDone : kThrown);
  } catch (const std::bad_alloc&) {
    _exit(kNoMemory);
  } catch (...) {
    _exit(kThrown);
  }
}

std::vector<std::byte> receiveAll(int pipe) {
  constexpr size_t kAtOnce = size_t{1} << 20;
  std::vector<std::byte> bytes;
  for (size_t received = 0;;) {
    bytes.resize(received + kAtOnce);
    const ssize_t now = read(pipe, bytes.data() + received, kAtOnce);
    if (now < 0 && errno == EINTR) continue;
    if (now > 0) received += static_cast<size_t>(now);
    bytes.resize(received);
    if (now <= 0) return bytes;
  }
}

Status endOf(pid_t child, uint32_t seconds) {
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) continue;
  if (WIFEXITED(status) && WEXITSTATUS(status) == kDone) return {};
  if (WIFEXITED(status) && WEXITSTATUS(status) == kNoMemory)
    return {TKS_LIMIT, "it takes more memory than the limit (--max-memory)"};
  if (WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU)
    return {TKS_LIMIT, "it takes more than " + std::to_string(seconds) + " s"};
  return {TKS_USAGE, "it is damaged"};
}

}  // namespace

Result<std::vector<std::byte>> inSeparateProcess(
    const std::function<std::vector<std::byte>()>& work, uint32_t seconds) {
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) return Status(TKS_IO, "there is no pipe left");
  memoryLimit();  // taken once, of the whole process
  const pid_t child = fork();
  if (child == 0) {
    close(ends[0]);
    detach(seconds);
    workAndEnd(work, ends[1]);
  }
  close(ends[1]);
  std::vector<std::byte> bytes;
  if (child > 0) bytes = receiveAll(ends[0]);
  close(ends[0]);
  if (child < 0) return Status(TKS_IO, "there is no process left");
  if (const Status status = endOf(child, seconds); !status.ok()) return status;
  return bytes;
}

}  // namespace tetrakis::tools

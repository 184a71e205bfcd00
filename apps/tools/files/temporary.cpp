// SPDX-License-Identifier: Apache-2.0
// What must go when the process goes. Signals are blocked in all threads and taken by one that
// waits for them: unlike a signal handler it may lock, and walk through folders.
#include "apps/tools/files/temporary.hpp"

#include <pthread.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <mutex>
#include <string>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include "apps/tools/files/file_bytes.hpp"

namespace tetrakis::tools {
namespace fs = std::filesystem;
namespace {

struct Entry {
  fs::path path;
  bool unless_filled;
};

struct Registry {
  std::mutex mutex;
  std::vector<Entry> entries;  ///< in the order of their making
};

/// Never destroyed, as signals may come while the process ends.
Registry& registry() {
  static Registry* const all = new Registry;
  return *all;
}

void removeEntry(const Entry& entry) {
  std::error_code ignored;
  if (entry.unless_filled) {
    fs::remove(entry.path, ignored);
    return;
  }
  // Another thread may be about to create one more file in it.
  constexpr int kAttempts = 100;
  for (int i = 0; i < kAttempts && fs::exists(fs::symlink_status(entry.path, ignored)); ++i)
    fs::remove_all(entry.path, ignored);
}

/// The lock is never given back: nothing may be made any more.
[[noreturn]] void dieOf(int signal, const sigset_t& signals) {
  registry().mutex.lock();
  auto& entries = registry().entries;
  std::for_each(entries.rbegin(), entries.rend(), removeEntry);
  pthread_sigmask(SIG_UNBLOCK, &signals, nullptr);
  raise(signal);
  std::_Exit(128 + signal);  // as shells report it; no default action lets it come to this
}

void waitFor(sigset_t signals) {
  int signal = 0;
  if (sigwait(&signals, &signal) == 0) dieOf(signal, signals);
}

Status cannotCreate(const std::string& what, int error) {
  return {TKS_IO, "cannot create " + what + ": " + std::strerror(error)};
}

}  // namespace

Result<Temporary> Temporary::makeFolder(const fs::path& parent) {
  std::string name = (parent / ".tetrakis-XXXXXX").string();
  const std::lock_guard lock(registry().mutex);
  if (!mkdtemp(name.data()))
    return cannotCreate("a temporary folder in " + quoted(parent.string()), errno);
  registry().entries.push_back({name, false});
  return Temporary(name);
}

Result<Temporary> Temporary::makeFile() {
  std::error_code no_folder;
  std::string name = (fs::temp_directory_path(no_folder) / "tetrakis-XXXXXX").string();
  const std::lock_guard lock(registry().mutex);
  const int descriptor = mkstemp(name.data());
  if (descriptor < 0) return cannotCreate("a temporary file " + tools::quoted(name), errno);
  close(descriptor);
  registry().entries.push_back({name, false});
  return Temporary(name);
}

Result<Temporary> Temporary::makeUnlessEmpty(const fs::path& path) {
  std::error_code error;
  const std::lock_guard lock(registry().mutex);
  if (!fs::create_directory(path, error))
    return cannotCreate(quoted(path.string()), error ? error.value() : EEXIST);
  registry().entries.push_back({path, true});
  return Temporary(path);
}

Temporary::Temporary(Temporary&& other) noexcept : path_(std::exchange(other.path_, {})) {}

Temporary& Temporary::operator=(Temporary&& other) noexcept {
  std::swap(path_, other.path_);
  return *this;
}

Temporary::~Temporary() {
  if (path_.empty()) return;
  const std::lock_guard lock(registry().mutex);
  auto& entries = registry().entries;
  const auto entry = std::find_if(entries.begin(), entries.end(),
                                  [this](const Entry& known) { return known.path == path_; });
  removeEntry(*entry);
  entries.erase(entry);
}

Status replaceFolder(const fs::path& made, const fs::path& target, const fs::path& aside) {
  const std::lock_guard no_signal(registry().mutex);  // which would remove `aside`
  std::error_code error;
  fs::rename(target, aside, error);
  if (error) return {TKS_IO, error.message()};
  fs::rename(made, target, error);
  if (!error) return {};
  std::error_code ignored;
  fs::rename(aside, target, ignored);
  return {TKS_IO, error.message()};
}

void cleanUpOnSignals() {
  sigset_t signals;
  sigemptyset(&signals);
  for (const int signal : {SIGHUP, SIGINT, SIGTERM}) {
    struct sigaction now {};
    if (sigaction(signal, nullptr, &now) == 0 && now.sa_handler != SIG_IGN)
      sigaddset(&signals, signal);
  }
  std::signal(SIGPIPE, SIG_IGN);
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  try {
    std::thread(waitFor, signals).detach();
  } catch (const std::system_error&) {
    pthread_sigmask(SIG_UNBLOCK, &signals, nullptr);  // signals end it without clearing up
  }
}

}  // namespace tetrakis::tools

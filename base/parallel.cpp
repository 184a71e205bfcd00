// SPDX-License-Identifier: Apache-2.0
#include "base/parallel.hpp"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <new>
#include <system_error>
#include <thread>
#include <vector>

#include "base/watch.hpp"

namespace tetrakis::inline base {

namespace {

thread_local Watch* watch_of_thread = nullptr;

/// Hands out indices until there are none left, or until a call has thrown.
class Queue {
 public:
  Queue(size_t count, const std::function<void(size_t)>& work) : count_(count), work_(work) {}

  void run() noexcept {
    try {
      for (size_t i; (i = next_.fetch_add(1, std::memory_order_relaxed)) < count_;) {
        work_(i);
        passPiece(count_);
      }
    } catch (...) {
      next_ = count_;
      const std::lock_guard lock(mutex_);
      if (!error_) error_ = std::current_exception();
    }
  }
  /// The same under the watch of the thread that waits for all.
  void runFor(Watch* watch) noexcept {
    const Watched watched(watch);
    run();
  }
  void rethrow() const {
    if (error_) std::rethrow_exception(error_);
  }

 private:
  size_t count_;
  const std::function<void(size_t)>& work_;
  std::atomic<size_t> next_ = 0;
  std::mutex mutex_;
  std::exception_ptr error_;
};

}  // namespace

Watch*& watchOfThread() {
  return watch_of_thread;
}

void parallelFor(uint32_t threads, size_t count, const std::function<void(size_t)>& work) {
  const size_t helpers = std::min<size_t>(threads, count) - (std::min<size_t>(threads, count) > 0);
  if (helpers == 0) {
    for (size_t i = 0; i < count; ++i) {
      work(i);
      passPiece(count);
    }
    return;
  }
  Queue queue(count, work);
  std::vector<std::thread> started;
  started.reserve(helpers);
  try {
    while (started.size() < helpers)
      started.emplace_back([&, watch = watchOfThread()] { queue.runFor(watch); });
  } catch (const std::system_error&) {
    // Those that have started, and this one, do the work.
  } catch (const std::bad_alloc&) {
    // Likewise: a thread takes memory of its own.
  }
  queue.run();
  for (std::thread& thread : started) thread.join();
  queue.rethrow();
}

}  // namespace tetrakis::inline base

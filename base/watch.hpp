// SPDX-License-Identifier: Apache-2.0
// Long work that says how far it is, and ends early when nobody waits for it any more.
#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <mutex>
#include <utility>

namespace tetrakis::inline base {

/// Thrown out of work that its watch has ended.
struct Stopped {};

/// Counts the stages of long work, and the pieces of each. How many pieces a stage has is not
/// known: each brings the account closer to the end of the stage, and none beyond it.
class Watch {
 public:
  /// Is told how much of the work is done, from 0 to 1, never less than before: on whatever thread,
  /// by one at a time. False: the work is to end.
  using Tell = std::function<bool(double)>;

  explicit Watch(Tell tell) : tell_(std::move(tell)) {}

  /// The stage before has ended; this one ends where `until` of all work is done. Throws Stopped.
  void stage(double until);
  /// One of so many pieces of some work has ended. Throws Stopped.
  void pass(size_t pieces);

 private:
  void tell();

  Tell tell_;
  std::mutex mutex_;
  double done_ = 0, until_ = 0;
  bool stopped_ = false;
  std::chrono::steady_clock::time_point told_;
};

/// The watch of what this thread does; null: none.
Watch* currentWatch();

/// Sets the watch of this thread for as long as it lives.
class Watched {
 public:
  explicit Watched(Watch* watch);
  ~Watched();
  Watched(const Watched&) = delete;
  Watched& operator=(const Watched&) = delete;

 private:
  Watch* before_;
};

/// The same as Watch::stage() and Watch::pass() of this thread's watch, if it has one.
void beginStage(double until);
void passPiece(size_t pieces);

}  // namespace tetrakis::inline base

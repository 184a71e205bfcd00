// SPDX-License-Identifier: Apache-2.0
// A Watch is told how far long work is, and ends the work early when nobody waits for it any more.
#pragma once

#include <cstddef>

namespace tetrakis::inline base {

/// Thrown out of work that its watch has ended.
struct Stopped {};

/// Is told of the stages of long work, and of the pieces of each, on whatever thread works. Nobody
/// knows in advance how many pieces a stage will have.
class Watch {
 public:
  Watch() = default;
  Watch(const Watch&) = delete;
  Watch& operator=(const Watch&) = delete;
  virtual ~Watch() = default;

  /// The stage before has ended; this one ends where `until` of all work is done, from 0 to 1. May
  /// throw Stopped.
  virtual void stage(double until) = 0;
  /// One of so many pieces of some work has ended. May throw Stopped.
  virtual void pass(size_t pieces) = 0;
};

/// What watches the work of this thread; null: nothing. parallelFor() hands it on to its threads;
/// the file that defines parallelFor() defines this too.
Watch*& watchOfThread();

/// Sets the watch of this thread for as long as it lives.
class Watched {
 public:
  explicit Watched(Watch* watch) : before_(watchOfThread()) { watchOfThread() = watch; }
  ~Watched() { watchOfThread() = before_; }
  Watched(const Watched&) = delete;
  Watched& operator=(const Watched&) = delete;

 private:
  Watch* before_;
};

/// The same as Watch::stage() and Watch::pass() of this thread's watch, if it has one.
inline void beginStage(double until) {
  if (Watch* const watch = watchOfThread()) watch->stage(until);
}
inline void passPiece(size_t pieces) {
  if (Watch* const watch = watchOfThread()) watch->pass(pieces);
}

}  // namespace tetrakis::inline base

// SPDX-License-Identifier: Apache-2.0
#include "base/watch.hpp"

#include <algorithm>
#include <cassert>

namespace tetrakis::inline base {

namespace {

thread_local Watch* current = nullptr;

}  // namespace

void Watch::stage(double until) {
  assert(until >= 0 && until <= 1);
  const std::lock_guard lock(mutex_);
  done_ = until_;
  until_ = std::max(until_, until);
  tell();
}

void Watch::pass(size_t pieces) {
  // All pieces of one work bring a stage so far; most stages have several works.
  constexpr double kOfTheRest = 0.25;
  constexpr std::chrono::milliseconds kBetweenTellings(50);
  assert(pieces > 0);
  const std::lock_guard lock(mutex_);
  if (stopped_) throw Stopped();
  done_ += (until_ - done_) * kOfTheRest / static_cast<double>(pieces);
  if (std::chrono::steady_clock::now() - told_ >= kBetweenTellings) tell();
}

void Watch::tell() {
  const Watched not_by_itself(nullptr);  // what is told may call the library
  stopped_ = stopped_ || !tell_(done_);
  if (stopped_) throw Stopped();
  told_ = std::chrono::steady_clock::now();
}

Watch* currentWatch() {
  return current;
}

Watched::Watched(Watch* watch) : before_(current) {
  current = watch;
}

Watched::~Watched() {
  current = before_;
}

void beginStage(double until) {
  if (current != nullptr) current->stage(until);
}

void passPiece(size_t pieces) {
  if (current != nullptr) current->pass(pieces);
}

}  // namespace tetrakis::inline base

// SPDX-License-Identifier: Apache-2.0
#include "encoder/told_progress.hpp"

#include <algorithm>
#include <cassert>

namespace tetrakis::inline encoder {

namespace {

// The part of the rest of a stage that all pieces of one work complete; most stages have several
// works.
constexpr double kOfTheRest = 0.25;
// Callers are told of progress no more often than this.
constexpr std::chrono::milliseconds kBetweenTellings(50);

}  // namespace

void ToldProgress::stage(double until) {
  assert(until >= 0 && until <= 1);
  const std::lock_guard lock(mutex_);
  done_ = until_;
  until_ = std::max(until_, until);
  tell();
}

void ToldProgress::pass(size_t pieces) {
  assert(pieces > 0);
  const std::lock_guard lock(mutex_);
  if (stopped_) throw Stopped();
  done_ += (until_ - done_) * kOfTheRest / static_cast<double>(pieces);
  if (std::chrono::steady_clock::now() - told_ >= kBetweenTellings) tell();
}

void ToldProgress::tell() {
  const Watched by_nothing(nullptr);  // who is told may call the library
  stopped_ = stopped_ || !tell_(done_);
  if (stopped_) throw Stopped();
  told_ = std::chrono::steady_clock::now();
}

}  // namespace tetrakis::inline encoder

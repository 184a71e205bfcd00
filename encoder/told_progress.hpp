// SPDX-License-Identifier: Apache-2.0
// ToldProgress tells the caller of an encoding how much of the work is done, and ends the work when
// the caller's answer asks for it.
#pragma once

#include <chrono>
#include <functional>
#include <mutex>
#include <utility>

#include "base/watch.hpp"

namespace tetrakis::inline encoder {

/// Counts how much of the work is done: every piece brings the count closer to the end of its
/// stage, and none brings it beyond.
class ToldProgress : public Watch {
 public:
  /// A function that is told how much of the work is done, from 0 to 1, never less than before. It
  /// is called on any thread, by one thread at a time, at each stage and every 50 ms or so. False:
  /// the work is to end.
  using Tell = std::function<bool(double)>;

  explicit ToldProgress(Tell tell) : tell_(std::move(tell)) {}

  void stage(double until) override;
  void pass(size_t pieces) override;

 private:
  void tell();

  Tell tell_;
  std::mutex mutex_;
  double done_ = 0, until_ = 0;
  bool stopped_ = false;
  std::chrono::steady_clock::time_point told_;
};

}  // namespace tetrakis::inline encoder

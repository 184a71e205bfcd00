// SPDX-License-Identifier: Apache-2.0
// TrialProgress makes one progress of those of several trials, of which nobody knows beforehand how
// many there will be: each takes a part of what is left.
#pragma once

#include "tetrakis/tetrakis.h"

namespace tetrakis::inline api {

class TrialProgress {
 public:
  TrialProgress(tks_progress tell, void* user) : tell_(tell), user_(user) {}

  /// Makes the next trial tell this. part: of what is left, that the trial takes.
  void follow(tks_encode_options& trial, double part) {
    first_ = last_;
    last_ += part * (1 - last_);
    if (tell_ == nullptr) return;
    trial.progress = &TrialProgress::report;
    trial.user = this;
  }

  /// Whether the caller has asked to stop.
  bool stopped() const { return stopped_; }

 private:
  static int report(void* self, double done) {
    TrialProgress& progress = *static_cast<TrialProgress*>(self);
    const double all = progress.first_ + done * (progress.last_ - progress.first_);
    progress.stopped_ = progress.stopped_ || progress.tell_(progress.user_, all) != 0;
    return progress.stopped_ ? 1 : 0;
  }

  tks_progress tell_;
  void* user_;
  double first_ = 0, last_ = 0;
  bool stopped_ = false;
};

}  // namespace tetrakis::inline api

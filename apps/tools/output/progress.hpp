// SPDX-License-Identifier: Apache-2.0
// Progress draws a progress bar on standard error, if a person can see it.
#pragma once

#include <string>

namespace tetrakis::tools {

/// Draws "label [####    ]  50 %" while alive and erases it at the end. Silent when `quiet` or when
/// standard error is no terminal.
class Progress {
 public:
  Progress(std::string label, bool quiet);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// A tks_progress callback; `self` is the Progress.
  static int report(void* self, double done);

 private:
  void draw(int percent);

  std::string label_;
  bool visible_;
  int percent_ = -1;  ///< last one drawn; -1: none
};

}  // namespace tetrakis::tools

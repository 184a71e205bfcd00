// SPDX-License-Identifier: Apache-2.0
// A progress bar on standard error, shown only where a person can see it.
#include "apps/tools/output/progress.hpp"

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <utility>

namespace tetrakis::tools {
namespace {

constexpr int kBarWidth = 40;

}  // namespace

Progress::Progress(std::string label, bool quiet)
    : label_(std::move(label)), visible_(!quiet && isatty(STDERR_FILENO) == 1) {}

Progress::~Progress() {
  if (percent_ >= 0) std::fputs("\r\x1b[K", stderr);
}

int Progress::report(void* self, double done) {
  static_cast<Progress*>(self)->draw(static_cast<int>(std::clamp(done, 0.0, 1.0) * 100));
  return 0;
}

void Progress::draw(int percent) {
  if (!visible_ || percent == percent_) return;
  percent_ = percent;
  const auto filled = static_cast<size_t>(kBarWidth * percent / 100);
  const std::string bar = std::string(filled, '#') + std::string(kBarWidth - filled, ' ');
  std::fprintf(stderr, "\r%s [%s] %3d %%", label_.c_str(), bar.c_str(), percent);
  std::fflush(stderr);
}

}  // namespace tetrakis::tools

// SPDX-License-Identifier: Apache-2.0
// Distortion where the viewer sees it: between rendered pictures (thesis, section 6.1).
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "apps/tools/render/render.hpp"

namespace tetrakis::tools {
namespace {

/// Mean squared error over RGB of the pixels that either picture covers; none: no value.
std::optional<double> pictureMse(const Picture& a, const Picture& b) {
  uint64_t sum = 0, covered = 0;
  for (size_t i = 0; i < a.rgba.size(); i += 4) {
    if (a.rgba[i + 3] == 0 && b.rgba[i + 3] == 0) continue;
    ++covered;
    for (size_t c = 0; c < 3; ++c) {
      const int error = int{a.rgba[i + c]} - int{b.rgba[i + c]};
      sum += static_cast<uint64_t>(error * error);
    }
  }
  if (covered == 0) return std::nullopt;
  return static_cast<double>(sum) / (3.0 * static_cast<double>(covered));
}

}  // namespace

double screenPsnr(const std::vector<Picture>& reference, const std::vector<Picture>& test,
                  const std::vector<double>& weights) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  if (reference.size() != test.size()) return kNone;
  if (!weights.empty() && weights.size() != reference.size()) return kNone;
  const double heaviest = weights.empty() ? 1 : *std::max_element(weights.begin(), weights.end());
  double sum = 0, pictures = 0;
  for (size_t i = 0; i < reference.size(); ++i) {
    const Picture &a = reference[i], &b = test[i];
    if (a.width != b.width || a.height != b.height) return kNone;
    const double weight = weights.empty() ? 1 : weights[i] / heaviest;  // sums stay finite
    if (!(weight > 0)) continue;
    if (const std::optional<double> mse = pictureMse(a, b)) {
      sum += weight * *mse;
      pictures += weight;
    }
  }
  if (sum == 0) return std::numeric_limits<double>::infinity();
  return 10 * std::log10(255.0 * 255.0 * pictures / sum);
}

}  // namespace tetrakis::tools

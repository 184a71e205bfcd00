// SPDX-License-Identifier: Apache-2.0
// Synthesis norms. The transform is separable, so a band's norm is the product of two norms of the
// one-dimensional synthesis, over the factor of two for each doubling of the low band
// (wavelet.hpp).
#include "texture_wavelet/norms.hpp"

#include <cmath>

namespace tetrakis {
namespace {

constexpr int kFineSteps = 256;
using Table = std::array<int, kMaxWaveletLevels + 1>;

// 256 log2 of the norm of one coefficient of the low and high band after [i] splits, measured with
// impulses through the linear synthesis. Each further split of a smooth function adds a factor
// sqrt 2.
constexpr Table kLowNorms = {0,   96,   217,  342,  469,  597,  725, 853,
                             981, 1109, 1237, 1365, 1493, 1621, 1749};
constexpr Table kHighNorms = {0,   -88, -11, 105,  228,  354,  482, 610,
                              738, 866, 994, 1122, 1250, 1378, 1506};

/// 256 log2 of the band's norm.
int fineNorm(const Subband& band) {
  const bool high_x = band.orientation == Orientation::kHL || band.orientation == Orientation::kHH;
  const bool high_y = band.orientation == Orientation::kLH || band.orientation == Orientation::kHH;
  // A detail band is made from the low band of the level before, LL is itself a low band.
  const int doubled_up_to = band.orientation == Orientation::kLL ? band.level : band.level - 1;
  int norm = (high_x ? kHighNorms : kLowNorms)[static_cast<size_t>(band.splits_x)] +
             (high_y ? kHighNorms : kLowNorms)[static_cast<size_t>(band.splits_y)];
  for (int level : kDoubledLevels) norm -= level <= doubled_up_to ? kFineSteps : 0;
  return norm;
}

}  // namespace

int normLog2(const Subband& band) {
  static_assert(kFineSteps / kNormSteps == 16);
  return (fineNorm(band) + 8) >> 4;
}

double normOf(const Subband& band) {
  return std::exp2(static_cast<double>(fineNorm(band)) / kFineSteps);
}

}  // namespace tetrakis

// SPDX-License-Identifier: Apache-2.0
// Reference decoder: the bands of a plane and their norms (docs/FORMAT.md, section 7).
#include <algorithm>
#include <bit>

#include "conformance/reference_decoder/wavelet.hpp"

namespace tetrakis::reference {
namespace {

/// FORMAT 7: "a side n > 4 splits into n - floor(n/2) low and floor(n/2) high samples".
int lowSide(int n) {
  return n > 4 ? n - n / 2 : n;
}

/// A signal that has no ends, around the places that are not 0.
using Signal = std::vector<int64_t>;

/// One level of the inverse: `part` is the low or the high half, the other one is 0.
Signal stretch(const Filter& filter, const Signal& part, bool high) {
  constexpr size_t kMargin = 10;  // no filter reaches further than 18 samples
  Signal x(2 * (part.size() + 2 * kMargin));
  for (size_t i = 0; i < part.size(); ++i) x[2 * (i + kMargin) + high] = part[i];
  const auto at = [&](int64_t t) {
    return t < 0 || t >= static_cast<int64_t>(x.size()) ? 0 : x[static_cast<size_t>(t)];
  };
  for (size_t s = filter.steps.size(); s-- > 0;) {
    for (size_t t = s % 2 == 0 ? 1 : 0; t < x.size(); t += 2) {
      int64_t sum = int64_t{1} << (filter.shift - 1), distance = 1;
      for (const int weight : filter.steps[s]) {
        const auto place = static_cast<int64_t>(t);
        sum += weight * (at(place - distance) + at(place + distance));
        distance += 2;
      }
      x[t] -= sum >> filter.shift;
    }
  }
  return x;
}

/// FORMAT 7: log(E).
int logOf(uint64_t e) {
  const int w = static_cast<int>(std::bit_width(e)) - 1;
  uint64_t m = w > 31 ? e >> (w - 31) : e << (31 - w);
  int log = w;
  for (int i = 0; i < 8; ++i) {
    m = (m * m) >> 31;
    log = 2 * log + static_cast<int>(m >> 32);
    m >>= m >> 32;
  }
  return log;
}

/// FORMAT 7: N of one direction.
int normOf(const WaveletHeader& header, bool high, int splits) {
  if (splits == 0) return 0;
  if (splits > 10) {
    const int ten = normOf(header, high, 10);
    return ten + (splits - 10) * (ten - normOf(header, high, 9));
  }
  Signal x = {int64_t{1} << 20};
  for (int level = splits; level >= 1; --level)
    x = stretch(filterOf(header, level), x, high && level == splits);
  uint64_t e = 0;
  for (const int64_t value : x) e += static_cast<uint64_t>(value * value);
  return (logOf(e) - 10240) >> 1;
}

}  // namespace

std::vector<Subband> subbandsOf(int width, int height) {
  std::vector<Subband> subbands;  // finest first
  int splitsX = 0, splitsY = 0, level = 0;
  while (width > 4 || height > 4) {
    const int lowWidth = lowSide(width), lowHeight = lowSide(height);
    splitsX += width > 4;
    splitsY += height > 4;
    ++level;
    const int highWidth = width - lowWidth, highHeight = height - lowHeight;
    subbands.push_back({level, kHH, highHeight, highWidth, splitsX, splitsY});
    subbands.push_back({level, kLH, highHeight, lowWidth, splitsX, splitsY});
    subbands.push_back({level, kHL, lowHeight, highWidth, splitsX, splitsY});
    width = lowWidth;
    height = lowHeight;
  }
  subbands.push_back({level, kLL, height, width, splitsX, splitsY});
  std::reverse(subbands.begin(), subbands.end());
  return subbands;
}

int logNormOf(const WaveletHeader& header, const Subband& subband) {
  int norm = normOf(header, subband.highInX(), subband.splitsX) +
             normOf(header, subband.highInY(), subband.splitsY);
  const int last = subband.orientation == kLL ? subband.level : subband.level - 1;
  for (int level = 1; level <= last; ++level) norm -= doublesLow(header, level) ? 256 : 0;
  return (norm + 8) >> 4;
}

}  // namespace tetrakis::reference

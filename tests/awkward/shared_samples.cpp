// SPDX-License-Identifier: Apache-2.0
#include "tests/awkward/shared_samples.hpp"

#include <algorithm>
#include <cstring>
#include <numeric>
#include <utility>

#include "tetrakis/tetrakis.h"

namespace tetrakis::test {

SharedSamples::SharedSamples(uint32_t depth, std::span<const uint32_t> sides)
    : n_(uint32_t{1} << depth),
      firsts_(sides.size() / 4 * (n_ + 1) * (n_ + 1)),
      on_border_(firsts_.size()) {
  std::iota(firsts_.begin(), firsts_.end(), 0u);
  const auto runs_clockwise = [](uint32_t side) { return side % 4 < 2; };
  for (uint32_t side = 0; side < sides.size(); ++side) {
    const uint32_t other = sides[side];
    if (other == TKS_BORDER) continue;
    const bool turned = runs_clockwise(side) == runs_clockwise(other);
    for (uint32_t k = 0; k <= n_; ++k) join(at(side, k), at(other, turned ? n_ - k : k));
  }
  for (uint32_t& first : firsts_) first = rootOf(first);
  for (uint32_t side = 0; side < sides.size(); ++side) {
    for (uint32_t k = 0; k <= n_ && sides[side] == TKS_BORDER; ++k)
      on_border_[firsts_[at(side, k)]] = true;
  }
}

void SharedSamples::share(std::span<std::byte> raster, size_t bytes) const {
  for (size_t i = 0; i < firsts_.size(); ++i)
    std::memmove(&raster[i * bytes], &raster[firsts_[i] * bytes], bytes);
}

std::optional<size_t> SharedSamples::torn(std::span<const std::byte> raster, size_t bytes) const {
  for (size_t i = 0; i < firsts_.size(); ++i)
    if (std::memcmp(&raster[i * bytes], &raster[firsts_[i] * bytes], bytes) != 0) return i;
  return std::nullopt;
}

uint32_t SharedSamples::at(uint32_t side, uint32_t k) const {
  const bool along_row = side % 2 == 0, far = side % 4 == 1 || side % 4 == 2;
  const uint32_t across = far ? n_ : 0;
  const uint32_t x = along_row ? k : across, y = along_row ? across : k;
  return (side / 4 * (n_ + 1) + y) * (n_ + 1) + x;
}

uint32_t SharedSamples::rootOf(uint32_t sample) const {
  while (firsts_[sample] != sample) sample = firsts_[sample];
  return sample;
}

/// The lower one is the root, so that it is the first of all.
void SharedSamples::join(uint32_t a, uint32_t b) {
  const auto [low, high] = std::minmax({rootOf(a), rootOf(b)});
  firsts_[high] = low;
}

}  // namespace tetrakis::test

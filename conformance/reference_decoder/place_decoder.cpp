// SPDX-License-Identifier: Apache-2.0
#include "conformance/reference_decoder/place_decoder.hpp"

#include <algorithm>

namespace tetrakis::reference {
namespace {

/// FORMAT 11, q.
int q(int64_t x, int64_t c, int most) {
  return c == 0 ? most : static_cast<int>(std::min<int64_t>(most, (2 * x + c) / (2 * c)));
}

}  // namespace

int64_t meanOf(int64_t sum, int64_t count) {
  const int64_t a = 2 * sum + count, b = 2 * count;
  return a / b - (a % b < 0 ? 1 : 0);
}

PlaceDecoder::PlaceDecoder(RangeDecoder& decoder, int axes, int bits)
    : decoder_(decoder),
      axes_(axes),
      bits_(bits),
      more_(4, std::vector<ModelTable>(256, ModelTable(24))),
      weights_(24) {
  for (auto& weights : weights_) weights.fill(kFirstWeight);
}

std::array<int64_t, 3> PlaceDecoder::mean(const std::vector<std::array<int64_t, 3>>& all) const {
  std::array<int64_t, 3> mean = {};
  for (int i = 0; i < axes_; ++i) {
    int64_t sum = 0;
    for (const auto& one : all) sum += one[i];
    mean[i] = std::clamp<int64_t>(meanOf(sum, static_cast<int64_t>(all.size())), 0, most());
  }
  return mean;
}

TellPlace PlaceDecoder::tell(const std::array<int64_t, 3>& expected,
                             const std::vector<TellPlace>& nearby, int f) {
  const auto n = static_cast<int64_t>(nearby.size());
  std::array<int64_t, 3> s = {};
  int64_t all = 0, h = 0;
  for (const TellPlace& one : nearby) {
    for (int i = 0; i < axes_; ++i) s[i] += one.k[i];
  }
  for (const int64_t one : s) all += one;
  TellPlace told;
  for (int i = 0; i < axes_; ++i) {
    const int last = i > 0 ? std::min(told.k[i - 1], 15) : 0;
    const std::array<int, 4> states = {
        q(2 * s[i], n, 63) + 64 * std::min(f, 3), q(h, i, 15) + 16 * q(s[i], n, 15),
        q(2 * all, axes_ * n, 63) + 64 * i, last + 16 * q(all, axes_ * n, 15)};
    const int64_t size = most() + 1;
    told.at[i] = ((expected[i] + difference(states, told.k[i])) % size + size) % size;
    h += told.k[i];
  }
  return told;
}

int64_t PlaceDecoder::difference(const std::array<int, 4>& states, int& k) {
  k = ones(bits_, [&](int j) {
    std::array<Model*, 4> models;
    for (size_t m = 0; m < 4; ++m) models[m] = &more_[m][states[m]][j];
    return ask([&] { return decodeMixed(decoder_, models, weights_[j]); });
  });
  if (k == 0) return 0;
  const int64_t d = digits(k, [&](int, uint32_t b) {
    return ask([&] { return b < 4 ? high_[k][b].decode(decoder_) : decoder_.even(); });
  });
  return ask([&] { return decoder_.even(); }) ? -d : d;
}

template <class Decide>
int PlaceDecoder::ask(const Decide& decide) {
  if (ended_) return 0;
  try {
    return decide();
  } catch (const Undecided&) {
    ended_ = true;
    return 0;
  }
}

}  // namespace tetrakis::reference

// SPDX-License-Identifier: Apache-2.0
// Dice are random numbers that are the same on every machine.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace tetrakis::test {

/// SplitMix64 (G. L. Steele, D. Lea, C. H. Flood 2014).
class Dice {
 public:
  explicit Dice(uint64_t seed) : state_(seed * 0x9e3779b97f4a7c15u) {}
  uint64_t next() {
    uint64_t z = state_ += 0x9e3779b97f4a7c15u;
    z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
    z = (z ^ z >> 27) * 0x94d049bb133111ebu;
    return z ^ z >> 31;
  }
  uint32_t below(uint32_t n) { return static_cast<uint32_t>(next() % n); }
  bool once(uint32_t in) { return below(in) == 0; }
  template <class T, size_t N>
  T of(const std::array<T, N>& choices) {
    return choices[below(N)];
  }

 private:
  uint64_t state_;
};

}  // namespace tetrakis::test

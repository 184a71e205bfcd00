// SPDX-License-Identifier: Apache-2.0
// orderOf() turns samples into 32-bit words, and fromOrder() turns these back. The order of the
// words is the order of the samples, and neighbouring words are neighbouring samples. Corrections
// that restore samples bit for bit are differences of such words, modulo 2^32.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <type_traits>

namespace tetrakis::inline steps {

/// The word of a sample. Integers stay as they are; the sign and magnitude of a float become two's
/// complement, -0 below 0.
template <class T>
uint32_t orderOf(T sample) {
  if constexpr (std::is_floating_point_v<T>) {
    const auto bits = std::bit_cast<uint32_t>(sample);
    return bits >> 31 ? bits ^ 0x7fffffffu : bits;
  } else {
    return static_cast<uint32_t>(sample);
  }
}

template <class T>
T fromOrder(uint32_t order) {
  if constexpr (std::is_floating_point_v<T>) {
    return std::bit_cast<T>(order >> 31 ? order ^ 0x7fffffffu : order);
  } else {
    return static_cast<T>(order);
  }
}

/// log2 of the distance between a sample and the next one of its binade; 0 for integers.
template <class T>
int spacingExponent(T sample) {
  if constexpr (std::is_floating_point_v<T>) {
    const auto field = static_cast<int>((std::bit_cast<uint32_t>(sample) >> 23) & 0xff);
    return std::max(field, 1) - 150;
  } else {
    return 0;
  }
}

/// How many low bits of a sample's word a step of 2^exponent or more leaves open, 0 to 15: the hint
/// of its correction.
template <class T>
uint8_t openBits(T sample, int exponent) {
  return static_cast<uint8_t>(std::clamp(exponent - spacingExponent(sample), 0, 15));
}

}  // namespace tetrakis::inline steps

// SPDX-License-Identifier: Apache-2.0
// std::bit_cast for the libc++ of emscripten 3.1.6 (Debian 12), which lacks it. Included by force
// in front of every file of the module.
#pragma once

#include <bit>
#include <version>

#ifndef __cpp_lib_bit_cast
namespace std {
template <class To, class From>
requires(sizeof(To) == sizeof(From)) constexpr To bit_cast(const From& from) noexcept {
  return __builtin_bit_cast(To, from);
}
}  // namespace std
#endif

// SPDX-License-Identifier: Apache-2.0
// takeSized() copies a struct of the C interface that begins with its size: callers compiled
// against an older or a newer tetrakis.h hand over fewer or more fields than this library knows.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <string>

#include "base/status.hpp"

namespace tetrakis::inline api {

/// No struct is ever as large: a greater size was never set.
inline constexpr size_t kMostStructBytes = 4096;

/// Whether a struct of `size` bytes has at least `least` ones, and sets no field behind the first
/// `known`.
Status checkSized(const std::string& name, const void* given, size_t size, size_t least,
                  size_t known);

/// Copies what the caller has of a struct; fields that it lacks are 0. `least` bytes are needed.
/// Fields unknown to this library may be there as long as they are 0, which is every field's
/// default. A field does not straddle a multiple of alignof(T), so no half of one is taken.
template <class T>
Status takeSized(const std::string& name, const T& given, size_t least, T& out) {
  Status status = checkSized(name, &given, given.size, least, sizeof(T));
  if (!status.ok()) return status;
  const size_t bytes = std::min<size_t>(given.size, sizeof(T)) / alignof(T) * alignof(T);
  out = T{};
  std::memcpy(&out, &given, bytes);
  out.size = sizeof(T);
  return {};
}

/// Fills the caller's struct as far as it goes; what is unknown to this library becomes 0. Its size
/// stays.
template <class T>
void giveSized(const T& full, T& out) {
  const size_t size = out.size;
  auto* bytes = reinterpret_cast<std::byte*>(&out);
  std::memcpy(bytes, &full, std::min(size, sizeof(T)));
  if (size > sizeof(T)) std::memset(bytes + sizeof(T), 0, size - sizeof(T));
  out.size = size;
}

}  // namespace tetrakis::inline api

// SPDX-License-Identifier: Apache-2.0
// guarded() runs the work of a call of the C interface: no exception leaves the call, and its
// sentence goes where the caller looks for it. Whatever may allocate happens within.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <new>
#include <stdexcept>
#include <string>
#include <string_view>

#include "tetrakis/result.hpp"

namespace tetrakis::inline api {

/// Runs work(), which returns a tks_status. The exceptions that may occur inside, of exhausted
/// memory, become TKS_NO_MEMORY, whose sentence exhausted(const char*) takes without allocating. Of
/// 32 bits a vector may be asked for more than it can ever hold.
template <class Work, class Exhausted>
tks_status guarded(Work&& work, Exhausted&& exhausted) {
  try {
    return work();
  } catch (const std::bad_alloc&) {
  } catch (const std::length_error&) {
  }
  exhausted("Not enough memory.");
  return TKS_NO_MEMORY;
}

/// Runs f, which returns a Status, of a function that hands over no sentence.
template <class F>
tks_status answering(F&& f) {
  return guarded([&] { return f().code(); }, [](const char*) {});
}

/// The same of a function that writes its sentence, cut to fit.
template <class F>
tks_status reporting(char* message, size_t message_size, F&& f) {
  const auto write = [&](std::string_view sentence) {
    if (message == nullptr || message_size == 0) return;
    const size_t length = std::min(sentence.size(), message_size - 1);
    std::memcpy(message, sentence.data(), length);
    message[length] = '\0';
  };
  const auto work = [&] {
    const Status status = f();
    write(status.message());
    return status.code();
  };
  return guarded(work, write);
}

/// The same of a function of a handle that keeps its sentence.
template <class Handle, class F>
tks_status keepingSentence(Handle* handle, F&& f) {
  if (handle == nullptr) return TKS_USAGE;
  const auto work = [&] {
    handle->last = f();
    handle->sentence = handle->last.message().c_str();
    return handle->last.code();
  };
  return guarded(work, [&](const char* sentence) { handle->sentence = sentence; });
}

inline Status outputMissing() {
  return {TKS_USAGE, "The output is missing."};
}

// takeSized() copies a struct of the C interface that begins with its size: callers compiled
// against an older or a newer tetrakis.h hand over fewer or more fields than this library knows.

/// No struct is ever as large: a greater size was never set.
inline constexpr size_t kMostStructBytes = 4096;

/// Whether a struct of `size` bytes has at least `least` ones, and sets no field behind the first
/// `known`.
inline Status checkSized(const std::string& name, const void* given, size_t size, size_t least,
                         size_t known) {
  if (size < least || size > kMostStructBytes) {
    return {TKS_USAGE, "The struct of " + name + " takes a size of at least " +
                           std::to_string(least) + " bytes, not " + std::to_string(size) + "."};
  }
  const auto* bytes = static_cast<const std::byte*>(given);
  if (size > known &&
      std::any_of(bytes + known, bytes + size, [](std::byte b) { return b != std::byte{0}; })) {
    return {TKS_UNSUPPORTED,
            "The struct of " + name + " sets a field that this library does not know."};
  }
  return {};
}

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

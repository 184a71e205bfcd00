// SPDX-License-Identifier: Apache-2.0
// guarded() runs the work of a call of the C interface: no exception leaves the call, and its
// sentence goes where the caller looks for it. Whatever may allocate happens within.
#pragma once

#include <algorithm>
#include <cstring>
#include <new>
#include <stdexcept>
#include <string_view>

#include "base/status.hpp"

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

inline Status outputMissing() {
  return {TKS_USAGE, "The output is missing."};
}

}  // namespace tetrakis::inline api

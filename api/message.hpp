// SPDX-License-Identifier: Apache-2.0
// Sentences across the C boundary.
#pragma once

#include <algorithm>
#include <cstring>
#include <new>
#include <stdexcept>

#include "base/status.hpp"

namespace tetrakis::inline api {

/// Copies the sentence, cut to fit, and hands the code on.
inline tks_status report(const Status& status, char* message, size_t message_size) {
  if (message != nullptr && message_size > 0) {
    const size_t length = std::min(status.message().size(), message_size - 1);
    std::memcpy(message, status.message().data(), length);
    message[length] = '\0';
  }
  return status.code();
}

inline Status outputMissing() {
  return {TKS_USAGE, "The output is missing."};
}

/// Runs f; the exceptions that may occur inside, of exhausted memory, become a Status. Of 32 bits a
/// vector may be asked for more than it can ever hold.
template <class F>
Status guarded(F&& f) {
  try {
    return f();
  } catch (const std::bad_alloc&) {
    return {TKS_NO_MEMORY, "Not enough memory."};
  } catch (const std::length_error&) {
    return {TKS_NO_MEMORY, "Not enough memory."};
  }
}

}  // namespace tetrakis::inline api

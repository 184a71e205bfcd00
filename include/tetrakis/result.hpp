// SPDX-License-Identifier: Apache-2.0
// The one result type of the C++ interface, of the library and of its tools: success, or a stable
// code with one sentence that says what went wrong.
#pragma once

#include <cassert>
#include <string>
#include <utility>
#include <variant>

#include "tetrakis/tetrakis.h"

namespace tetrakis {
// The namespace is inline as in tetrakis.hpp.
inline namespace v0 {

/// Success, or a code with one sentence that says what, where (in bytes) and what to do.
class [[nodiscard]] Status {
 public:
  Status() = default;
  /// A failure: the code is not TKS_OK.
  Status(tks_status code, std::string message) : code_(code), message_(std::move(message)) {
    assert(code != TKS_OK);
  }
  bool ok() const { return code_ == TKS_OK; }
  tks_status code() const { return code_; }
  /// Empty if there is no failure.
  const std::string& message() const { return message_; }

 private:
  tks_status code_ = TKS_OK;
  std::string message_;
};

/// A value, or the Status that explains why there is none.
template <class T>
class [[nodiscard]] Result {
 public:
  Result(T value) : state_(std::move(value)) {}
  Result(Status status) : state_(std::move(status)) { assert(!std::get<Status>(state_).ok()); }

  /// True if there is a value.
  bool ok() const { return std::holds_alternative<T>(state_); }
  explicit operator bool() const { return ok(); }
  Status status() const { return ok() ? Status() : std::get<Status>(state_); }
  /// The value, which there must be. That of a result that is moved may be moved on.
  T& operator*() & { return std::get<T>(state_); }
  const T& operator*() const& { return std::get<T>(state_); }
  T&& operator*() && { return std::get<T>(std::move(state_)); }
  T* operator->() { return &std::get<T>(state_); }
  const T* operator->() const { return &std::get<T>(state_); }

 private:
  std::variant<Status, T> state_;
};

}  // namespace v0
}  // namespace tetrakis

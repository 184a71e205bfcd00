// SPDX-License-Identifier: Apache-2.0
// The one result type of the library: a stable code, one human sentence, or a value.
#pragma once

#include <cassert>
#include <string>
#include <utility>
#include <variant>

#include "tetrakis/tetrakis.h"

namespace tetrakis {

/// Success, or a code with one sentence that says what, where (in bytes) and what to do.
class [[nodiscard]] Status {
 public:
  Status() = default;
  Status(tks_status code, std::string message) : code_(code), message_(std::move(message)) {
    assert(code != TKS_OK);
  }
  bool ok() const { return code_ == TKS_OK; }
  tks_status code() const { return code_; }
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
  bool ok() const { return std::holds_alternative<T>(state_); }
  Status status() const { return ok() ? Status() : std::get<Status>(state_); }
  T& operator*() { return std::get<T>(state_); }
  const T& operator*() const { return std::get<T>(state_); }
  T* operator->() { return &std::get<T>(state_); }
  const T* operator->() const { return &std::get<T>(state_); }

 private:
  std::variant<Status, T> state_;
};

}  // namespace tetrakis

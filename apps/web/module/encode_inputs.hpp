// SPDX-License-Identifier: Apache-2.0
// What the modules that encode share: numbers and texts come as lists, in the order that a module
// states by name, so that their loader (apps/web/src/encoder_call.js) knows neither the layout of
// structs nor numbers of 64 bits; progress goes to the page.
#pragma once

/// The page's: told how much is done, from 0 to 1.
extern "C" void web_progress(double done);

namespace tetrakis::web {

/// Takes numbers in their order.
class Numbers {
 public:
  explicit Numbers(const double* numbers) : next_(numbers) {}
  template <class T>
  void take(T& value) {
    value = static_cast<T>(*next_++);
  }
  void take(double (&values)[6]) {
    for (double& value : values) value = *next_++;
  }

 private:
  const double* next_;
};

inline int tellProgress(void*, double done) {
  web_progress(done);
  return 0;
}

}  // namespace tetrakis::web

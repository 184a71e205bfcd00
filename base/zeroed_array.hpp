// SPDX-License-Identifier: Apache-2.0
// A ZeroedArray has a fixed size and is full of zeros that the operating system need not touch
// before they are used: bands in which nothing happens cost address space alone.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <memory>
#include <new>
#include <type_traits>

namespace tetrakis::inline base {

template <class T>
class ZeroedArray {
  static_assert(std::is_trivial_v<T>);

 public:
  ZeroedArray() = default;
  /// Throws std::bad_alloc.
  explicit ZeroedArray(size_t size)
      : size_(size), data_(static_cast<T*>(std::calloc(size > 0 ? size : 1, sizeof(T)))) {
    if (data_ == nullptr) throw std::bad_alloc();
  }

  ZeroedArray(ZeroedArray&&) noexcept = default;
  ZeroedArray& operator=(ZeroedArray&&) noexcept = default;
  ZeroedArray(const ZeroedArray& other) : ZeroedArray(other.size_) {
    std::copy_n(other.data(), size_, data());
  }
  ZeroedArray& operator=(const ZeroedArray& other) {
    if (size_ != other.size_) return *this = ZeroedArray(other);
    std::copy_n(other.data(), size_, data());
    return *this;
  }

  size_t size() const { return size_; }
  T* data() { return data_.get(); }
  const T* data() const { return data_.get(); }
  T& operator[](size_t i) { return data_.get()[i]; }
  const T& operator[](size_t i) const { return data_.get()[i]; }
  T* begin() { return data(); }
  T* end() { return data() + size_; }

 private:
  struct Free {
    void operator()(T* p) const { std::free(p); }
  };
  size_t size_ = 0;
  std::unique_ptr<T[], Free> data_;
};

}  // namespace tetrakis::inline base

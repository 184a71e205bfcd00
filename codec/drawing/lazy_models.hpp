// SPDX-License-Identifier: Apache-2.0
// LazyModels is a large table of models for a drawing, which may be small and ask few of them. A
// block of models is made when the first of them is asked: making all of them takes a millisecond a
// table, mostly for memory that the operating system hands over page by page.
#pragma once

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <type_traits>
#include <vector>

#include "bitstream/coder/adaptive_bit.hpp"

namespace tetrakis::inline drawing {

class LazyModels {
 public:
  /// count: a multiple of kTogether.
  explicit LazyModels(size_t count)
      : room_(new std::byte[count * sizeof(AdaptiveBit)]), made_(count / kTogether) {
    assert(count % kTogether == 0);
  }

  AdaptiveBit& operator[](size_t index) {
    const size_t block = index / kTogether;
    if (made_[block] == 0) [[unlikely]] {
      std::uninitialized_value_construct_n(models() + block * kTogether, kTogether);
      made_[block] = 1;
    }
    return models()[index];
  }

 private:
  static constexpr size_t kTogether = 64;
  static_assert(std::is_trivially_destructible_v<AdaptiveBit>);

  AdaptiveBit* models() { return reinterpret_cast<AdaptiveBit*>(room_.get()); }

  std::unique_ptr<std::byte[]> room_;
  std::vector<uint8_t> made_;  ///< of each block: 1 once its models are
};

}  // namespace tetrakis::inline drawing

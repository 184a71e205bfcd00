// SPDX-License-Identifier: Apache-2.0
// The ranges of a plan, and streams that get them.
#pragma once

#include <cstdint>
#include <span>

#include "tests/support/stream_fixture.hpp"

namespace tetrakis::test {

class Ranges {
 public:
  Ranges(Stream& stream, const tks_screen_camera* view, uint64_t bytes, uint32_t triangles = 0,
         uint64_t request_bytes = 0) {
    const tks_fetch fetch = {sizeof fetch, bytes, triangles, request_bytes};
    EXPECT_EQ(tks_plan(stream.get(), view, &fetch, &ranges_), TKS_OK) << tks_message(stream.get());
  }
  Ranges(const Ranges&) = delete;
  Ranges& operator=(const Ranges&) = delete;
  ~Ranges() { tks_free_ranges(&ranges_); }

  std::span<const tks_range> all() const { return {ranges_.ranges, ranges_.count}; }
  uint64_t bytes() const {
    uint64_t sum = 0;
    for (const tks_range& range : all()) sum += range.size;
    return sum;
  }

 private:
  tks_ranges ranges_ = {};
};

inline void put(Stream& stream, const Bytes& bytes, const tks_range& range) {
  ASSERT_LE(range.offset + range.size, bytes.size());
  ASSERT_EQ(tks_put(stream.get(), range.offset, bytes.data() + range.offset, range.size), TKS_OK)
      << tks_message(stream.get());
}

}  // namespace tetrakis::test

// SPDX-License-Identifier: Apache-2.0
#include "codec/geometry/stored_heights_encoder.hpp"

#include "base/samples.hpp"
#include "bitstream/coder/byte_planes.hpp"
#include "codec/geometry/steps/sample_order.hpp"

namespace tetrakis::inline geometry {

uint64_t storedBytes(const tks_heights& heights, size_t valid_samples) {
  return uint64_t{valid_samples} * tks_sample_bytes(heights.sample);
}

std::vector<uint8_t> encodeStoredHeights(const tks_heights& heights, Mask valid) {
  std::vector<uint32_t> words;
  withSampleType(heights.sample, [&](auto type) {
    const auto* samples = static_cast<const decltype(type)*>(heights.data);
    for (size_t i = 0; i < size_t{heights.width} * heights.height; ++i) {
      if (valid[i]) words.push_back(orderOf(samples[i]));
    }
  });
  return toBytePlanes(words, static_cast<int>(tks_sample_bytes(heights.sample)));
}

}  // namespace tetrakis::inline geometry

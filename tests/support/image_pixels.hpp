// SPDX-License-Identifier: Apache-2.0
// Images that tests write, and what they expect of those they read.
#pragma once

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

#include "apps/tools/files/files.hpp"

namespace tetrakis::test {

inline tools::ImageFile randomImage(uint32_t width, uint32_t height, uint32_t channels,
                                    tks_sample sample) {
  tools::ImageFile image{width, height, channels, sample, {}};
  image.data.resize(size_t{width} * height * channels * tks_sample_bytes(sample));
  std::mt19937 random(width + 7 * channels);
  for (std::byte& byte : image.data) byte = static_cast<std::byte>(random());
  return image;
}

inline void expectPixels(const Result<tools::ImageFile>& read, const std::vector<uint8_t>& pixels) {
  ASSERT_TRUE(read.ok()) << read.status().message();
  ASSERT_EQ(read->data.size(), pixels.size());
  for (size_t i = 0; i < pixels.size(); ++i) EXPECT_EQ(uint8_t(read->data[i]), pixels[i]) << i;
}

}  // namespace tetrakis::test

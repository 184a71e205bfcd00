// SPDX-License-Identifier: Apache-2.0
// Textures of prefixes and levels, held against the reference decoder.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "conformance/reference_decoder.hpp"
#include "tests/support/reference_status.hpp"
#include "tests/support/stream_fixture.hpp"

namespace tetrakis::test {

/// Of a texture the library gives what the decoder gives that was written from the text alone.
inline void expectTextureAgreement(Prefix prefix, int level = 0) {
  const tks_limits limits = smallLimits();
  const auto decoded = reference::decode(prefix, limits.max_texels, {level, level});
  Stream stream(prefix, &limits);
  ASSERT_EQ(stream.status(), statusOf(decoded.outcome)) << stream.message();
  if (stream.status() != TKS_OK) return;
  ASSERT_EQ(tks_set_levels(stream.get(), 0, static_cast<uint32_t>(level)), TKS_OK);
  std::vector<std::byte> texels(decoded.texture->size());
  ASSERT_EQ(tks_decode_texture(stream.get(), texels.data(), texels.size()), TKS_OK);
  EXPECT_TRUE(std::equal(texels.begin(), texels.end(), decoded.texture->begin(),
                         [](std::byte a, uint8_t b) { return std::to_integer<uint8_t>(a) == b; }));
}

}  // namespace tetrakis::test

// SPDX-License-Identifier: Apache-2.0
// Windows of streams beside the whole.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "tests/support/stream_fixture.hpp"

namespace tetrakis::test {

inline std::vector<std::byte> cropBytes(const std::vector<std::byte>& all, size_t row_bytes,
                                        size_t place_bytes, const tks_window& w) {
  std::vector<std::byte> out;
  for (size_t y = w.y; y < w.y + w.height; ++y) {
    const auto from = all.begin() + static_cast<ptrdiff_t>(y * row_bytes + w.x * place_bytes);
    out.insert(out.end(), from, from + static_cast<ptrdiff_t>(w.width * place_bytes));
  }
  return out;
}

inline tks_window windowOf(uint32_t trial, uint32_t width, uint32_t height) {
  const uint32_t x = samples::hash(trial, 1, 3) % width, y = samples::hash(trial, 2, 3) % height;
  return {x, y, 1 + samples::hash(trial, 3, 3) % (width - x),
          1 + samples::hash(trial, 4, 3) % (height - y)};
}

using DecodeWindow = tks_status (*)(tks_decoder*, const tks_window*, void*, size_t);

inline void expectWindow(const Stream& stream, DecodeWindow decode, const tks_window& window,
                         const std::vector<std::byte>& expected) {
  std::vector<std::byte> out(expected.size());
  ASSERT_EQ(decode(stream.get(), &window, out.data(), out.size()), TKS_OK)
      << tks_message(stream.get());
  ASSERT_TRUE(out == expected) << window.x << " " << window.y << " " << window.width << " "
                               << window.height;
}

/// The window holds what `whole`, all samples of the heights, holds there.
inline void expectHeightsWindow(const Stream& stream, const tks_window& window,
                                const std::vector<std::byte>& whole) {
  const size_t sample = tks_sample_bytes(stream.info().sample);
  expectWindow(stream, tks_decode_heights_window, window,
               cropBytes(whole, stream.info().width * sample, sample, window));
}

/// The window holds what `whole`, all texels, holds there.
inline void expectTextureWindow(const Stream& stream, const tks_window& window,
                                const std::vector<std::byte>& whole) {
  const tks_info& info = stream.info();
  const size_t texel = tks_sample_bytes(info.texture_sample) * info.texture_channels;
  expectWindow(stream, tks_decode_texture_window, window,
               cropBytes(whole, info.texture_width * texel, texel, window));
}

/// Windows of every prefix that is tried hold what the whole holds there.
inline void expectWindows(const Bytes& bytes) {
  for (uint32_t trial = 0; trial < 12; ++trial) {
    const size_t header = static_cast<size_t>(Stream(bytes).info().header_bytes);
    const size_t size =
        trial == 0 ? bytes.size() : header + samples::hash(trial, 0, 2) % (bytes.size() - header);
    Stream stream(Prefix(bytes).first(size));
    ASSERT_EQ(stream.status(), TKS_OK) << stream.message();
    const tks_info& info = stream.info();
    EXPECT_EQ(tks_set_threads(stream.get(), 1 + trial % 3), TKS_OK);
    if (info.has_heights) {
      const tks_window w = windowOf(trial, info.width, info.height);
      expectHeightsWindow(stream, w, stream.heights());
      std::vector<float> surface(size_t{info.width} * info.height),
          part(size_t{w.width} * w.height);
      tks_decode_surface(stream.get(), surface.data(), surface.size());
      ASSERT_EQ(tks_decode_surface_window(stream.get(), &w, part.data(), part.size()), TKS_OK);
      for (size_t i = 0; i < part.size(); ++i) {
        const float there = surface[(w.y + i / w.width) * info.width + w.x + i % w.width];
        ASSERT_TRUE(part[i] == there || (std::isnan(part[i]) && std::isnan(there)));
      }
    }
    if (info.has_texture) {
      const tks_window w = windowOf(trial + 50, info.texture_width, info.texture_height);
      expectTextureWindow(stream, w, stream.texture());
    }
    if (::testing::Test::HasFatalFailure()) return;
  }
}

}  // namespace tetrakis::test

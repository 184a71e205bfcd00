// SPDX-License-Identifier: Apache-2.0
// Frames through the C interface, for tests.
#pragma once

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "conformance/samples/moving_frames.hpp"
#include "tests/support/stream_fixture.hpp"
#include "tetrakis/sequence.hpp"

namespace tetrakis::test {

using samples::FrameRasters;
using samples::movingFrames;

inline std::vector<tks_heights> heightsOf(const FrameRasters& rasters) {
  std::vector<tks_heights> heights;
  for (const samples::Raster& raster : rasters) heights.push_back(raster.heights());
  return heights;
}

inline std::vector<tks_image> imagesOf(const FrameRasters& rasters) {
  std::vector<tks_image> images;
  for (const samples::Raster& raster : rasters) images.push_back(raster.image());
  return images;
}

/// The stream; a failed expectation and no bytes if there is none. Empty lists leave a part out.
inline Bytes encodeFrames(const std::vector<tks_heights>& heights,
                          const std::vector<tks_image>& images, const tks_encode_options& options) {
  tks_buffer buffer = {};
  char message[256] = "";
  const auto count = static_cast<uint32_t>(heights.empty() ? images.size() : heights.size());
  const tks_status status = tks_encode_frames(heights.empty() ? nullptr : heights.data(),
                                              images.empty() ? nullptr : images.data(), count,
                                              &options, &buffer, message, sizeof message);
  EXPECT_EQ(status, TKS_OK) << message;
  Bytes bytes;
  if (status == TKS_OK) bytes.assign(buffer.data, buffer.data + buffer.size);
  tks_free_buffer(&buffer);
  return bytes;
}

/// Shows a frame of an open stream.
inline void showFrame(Stream& stream, size_t frame) {
  EXPECT_EQ(tks_set_frame(stream.get(), static_cast<uint32_t>(frame)), TKS_OK);
}

inline void expectHeights(Stream& stream, const FrameRasters& truth) {
  for (size_t t = 0; t < truth.size(); ++t) {
    showFrame(stream, t);
    EXPECT_TRUE(sameBytes(stream.heights(), truth[t].data)) << "frame " << t;
  }
}

inline void expectTexels(Stream& stream, const FrameRasters& truth) {
  for (size_t t = 0; t < truth.size(); ++t) {
    showFrame(stream, t);
    EXPECT_TRUE(sameBytes(stream.texture(), truth[t].data)) << "frame " << t;
  }
}

}  // namespace tetrakis::test

// SPDX-License-Identifier: Apache-2.0
// Sequences through the C interface, for tests.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "tests/support/moving_frames.hpp"

namespace tetrakis::test {

/// What an encoder made.
struct EncodedSequence {
  Bytes bytes;
  std::vector<int64_t> times;
};

inline tks_sequence_options optionsOf(const tks_encode_options& encode, uint32_t group) {
  tks_sequence_options options = {};
  options.size = sizeof options;
  options.group = group;
  options.encode = &encode;
  options.clock = {sizeof options.clock, 3600, 1, "2019-03-01T00:00:00Z", "standard"};
  return options;
}

/// Frames of heights (empty: none) and of textures, with rising times: those of frame `first` and
/// the ones after it. behind: what they follow; null: nothing.
inline EncodedSequence encodeSequence(const FrameRasters& frames,
                                      const tks_sequence_options& options,
                                      const FrameRasters& textures = {},
                                      const tks_sequence* behind = nullptr, size_t first = 0) {
  tks_sequence_encoder* encoder = nullptr;
  char message[256] = "";
  EXPECT_EQ(tks_sequence_encoder_open(&options, &encoder, message, 256), TKS_OK) << message;
  EncodedSequence out;
  const auto take = [&] {
    tks_buffer buffer = {};
    EXPECT_EQ(tks_sequence_take(encoder, &buffer), TKS_OK);
    out.bytes.insert(out.bytes.end(), buffer.data, buffer.data + buffer.size);
    tks_free_buffer(&buffer);
  };
  if (behind != nullptr) {
    EXPECT_EQ(tks_sequence_encoder_continue(encoder, behind, message, 256), TKS_OK) << message;
  }
  for (size_t t = 0; t < std::max(frames.size(), textures.size()); ++t) {
    tks_heights heights = {};
    tks_image image = {};
    if (!frames.empty()) heights = frames[t].heights();
    if (!textures.empty()) image = textures[t].image();
    const size_t n = first + t;
    out.times.push_back(static_cast<int64_t>(3 * n + n * n % 3));
    EXPECT_EQ(
        tks_sequence_push(encoder, frames.empty() ? nullptr : &heights,
                          textures.empty() ? nullptr : &image, out.times.back(), message, 256),
        TKS_OK)
        << message;
    take();
  }
  EXPECT_EQ(tks_sequence_flush(encoder, message, 256), TKS_OK) << message;
  take();
  tks_sequence_encoder_close(encoder);
  return out;
}

/// Bytes as a sequence.
class Sequence {
 public:
  explicit Sequence(Prefix bytes = {}) {
    EXPECT_EQ(tks_sequence_open(nullptr, &sequence_), TKS_OK);
    status = tks_sequence_append(sequence_, bytes.data(), bytes.size());
  }
  Sequence(const Sequence&) = delete;
  Sequence& operator=(const Sequence&) = delete;
  ~Sequence() { tks_sequence_close(sequence_); }

  tks_sequence* get() const { return sequence_; }
  tks_sequence_info info() const {
    tks_sequence_info info = {};
    info.size = sizeof info;
    EXPECT_EQ(tks_sequence_get_info(sequence_, &info), TKS_OK);
    return info;
  }
  /// Of the group of a frame.
  tks_group group(uint64_t frame) const {
    tks_group group = {};
    group.size = sizeof group;
    EXPECT_EQ(tks_sequence_group(sequence_, frame, &group), TKS_OK);
    return group;
  }
  /// Null with a failed expectation if it does not open.
  tks_decoder* decoder(uint64_t frame) {
    tks_decoder* decoder = nullptr;
    EXPECT_EQ(tks_sequence_frame(sequence_, frame, &decoder), TKS_OK)
        << tks_sequence_message(sequence_);
    return decoder;
  }
  std::vector<std::byte> texels(uint64_t frame) {
    tks_decoder* const decoder = this->decoder(frame);
    tks_info info = {};
    info.size = sizeof info;
    if (decoder == nullptr || tks_get_info(decoder, &info) != TKS_OK) return {};
    std::vector<std::byte> out(size_t{info.texture_width} * info.texture_height *
                               info.texture_channels * tks_sample_bytes(info.texture_sample));
    EXPECT_EQ(tks_decode_texture(decoder, out.data(), out.size()), TKS_OK);
    return out;
  }
  std::vector<std::byte> heights(uint64_t frame) {
    tks_decoder* const decoder = this->decoder(frame);
    tks_info info = {};
    info.size = sizeof info;
    if (decoder == nullptr || tks_get_info(decoder, &info) != TKS_OK) return {};
    std::vector<std::byte> out(size_t{info.width} * info.height * tks_sample_bytes(info.sample));
    EXPECT_EQ(tks_decode_heights(decoder, out.data(), out.size()), TKS_OK);
    return out;
  }
  tks_status status;

 private:
  tks_sequence* sequence_ = nullptr;
};

}  // namespace tetrakis::test

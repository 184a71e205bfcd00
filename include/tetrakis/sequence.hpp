// SPDX-License-Identifier: Apache-2.0
// Tetrakis for C++20: sequences, over the C interface of sequence.h. Header only; throws nothing
// but std::bad_alloc. The trust contract is that of tetrakis.h.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "tetrakis/sequence.h"
#include "tetrakis/tetrakis.hpp"

namespace tetrakis {
inline namespace v0 {

inline tks_sequence_options makeSequenceOptions() {
  tks_sequence_options options{};
  options.size = sizeof options;
  options.clock.size = sizeof options.clock;
  return options;
}

/// Encodes frames as they come into a sequence. Move only.
class SequenceEncoder {
 public:
  static Result<SequenceEncoder> open(const tks_sequence_options& options) {
    char message[512] = "";
    tks_sequence_encoder* encoder = nullptr;
    const tks_status status =
        tks_sequence_encoder_open(&options, &encoder, message, sizeof message);
    if (status != TKS_OK) return Status(status, message);
    return SequenceEncoder(encoder);
  }

  /// Goes on behind a sequence (tks_sequence_encoder_continue).
  Status goOnBehind(const tks_sequence* written) {
    char message[512] = "";
    const tks_status status =
        tks_sequence_encoder_continue(encoder_.get(), written, message, sizeof message);
    return status == TKS_OK ? Status() : Status(status, message);
  }

  /// Takes a frame at a time in ticks (tks_sequence_push).
  Status push(const tks_heights* heights, const tks_image* image, int64_t time) {
    char message[512] = "";
    const tks_status status =
        tks_sequence_push(encoder_.get(), heights, image, time, message, sizeof message);
    return status == TKS_OK ? Status() : Status(status, message);
  }

  /// Encodes the frames that are no whole group yet (tks_sequence_flush).
  Status flush() {
    char message[512] = "";
    const tks_status status = tks_sequence_flush(encoder_.get(), message, sizeof message);
    return status == TKS_OK ? Status() : Status(status, message);
  }

  /// The bytes that follow those that were taken before; there may be none.
  Result<Buffer> take() {
    tks_buffer buffer{};
    const tks_status status = tks_sequence_take(encoder_.get(), &buffer);
    if (status != TKS_OK) return Status(status, "Not enough memory.");
    return Buffer(buffer);
  }

 private:
  struct Close {
    void operator()(tks_sequence_encoder* encoder) const { tks_sequence_encoder_close(encoder); }
  };
  explicit SequenceEncoder(tks_sequence_encoder* encoder) : encoder_(encoder) {}
  std::unique_ptr<tks_sequence_encoder, Close> encoder_;
};

/// A sequence, or any prefix of it: tells where its groups and frames are. Move only.
class Sequence {
 public:
  /// limits: of the decoder of each group.
  static Result<Sequence> open(std::span<const uint8_t> bytes,
                               const tks_limits& limits = makeLimits()) {
    tks_sequence* sequence = nullptr;
    if (const tks_status status = tks_sequence_open(&limits, &sequence); status != TKS_OK)
      return Status(status, "Not enough memory.");
    Sequence result(sequence);
    if (Status status = result.append(bytes); !status.ok()) return status;
    return result;
  }

  Status append(std::span<const uint8_t> bytes) {
    const tks_status status = tks_sequence_append(sequence_.get(), bytes.data(), bytes.size());
    return status == TKS_OK ? Status() : Status(status, tks_sequence_message(sequence_.get()));
  }
  tks_sequence_info info() const {
    tks_sequence_info info{};
    info.size = sizeof info;
    tks_sequence_get_info(sequence_.get(), &info);
    return info;
  }
  /// Of a frame, in ticks.
  Result<int64_t> time(uint64_t frame) const {
    int64_t time = 0;
    const tks_status status = tks_sequence_time(sequence_.get(), frame, &time);
    if (status != TKS_OK) return noFrame(status, frame);
    return time;
  }
  /// The last frame that is not after a time in ticks.
  Result<uint64_t> find(int64_t time) const {
    uint64_t frame = 0;
    const tks_status status = tks_sequence_find(sequence_.get(), time, &frame);
    if (status != TKS_OK) return noFrame(status, 0);
    return frame;
  }
  /// The group that holds a frame.
  Result<tks_group> group(uint64_t frame) const {
    tks_group group{};
    group.size = sizeof group;
    const tks_status status = tks_sequence_group(sequence_.get(), frame, &group);
    if (status != TKS_OK) return noFrame(status, frame);
    return group;
  }
  /// Cut to so many bytes a frame (tks_sequence_thin).
  Result<Buffer> thinned(uint64_t frame_bytes) const {
    char message[512] = "";
    tks_buffer buffer{};
    const tks_status status =
        tks_sequence_thin(sequence_.get(), frame_bytes, &buffer, message, sizeof message);
    if (status != TKS_OK) return Status(status, message);
    return Buffer(buffer);
  }
  /// For calls of sequence.h.
  const tks_sequence* get() const { return sequence_.get(); }
  /// The decoder that shows a frame. It belongs to the sequence (tks_sequence_frame).
  Result<Decoder> decoder(uint64_t frame) {
    tks_decoder* decoder = nullptr;
    const tks_status status = tks_sequence_frame(sequence_.get(), frame, &decoder);
    if (status != TKS_OK) return Status(status, tks_sequence_message(sequence_.get()));
    return Decoder::borrow(decoder);
  }

 private:
  struct Close {
    void operator()(tks_sequence* sequence) const { tks_sequence_close(sequence); }
  };
  static Status noFrame(tks_status status, uint64_t frame) {
    return Status(status, "The sequence has no frame " + std::to_string(frame) + ".");
  }
  explicit Sequence(tks_sequence* sequence) : sequence_(sequence) {}
  std::unique_ptr<tks_sequence, Close> sequence_;
};

}  // namespace v0
}  // namespace tetrakis

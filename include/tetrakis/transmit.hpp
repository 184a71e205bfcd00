// SPDX-License-Identifier: Apache-2.0
// Tetrakis for C++20: system control, over the C interface of transmit.h. Header only; throws
// nothing but std::bad_alloc. The trust contract is that of tetrakis.h.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "tetrakis/sequence.hpp"
#include "tetrakis/transmit.h"

namespace tetrakis {
inline namespace v0 {

inline tks_wants makeWants() {
  tks_wants wants{};
  wants.size = sizeof wants;
  return wants;
}

inline tks_transmitter_options makeTransmitterOptions() {
  tks_transmitter_options options{};
  options.size = sizeof options;
  return options;
}

/// Holds a sequence and serves receivers. Move only.
class Transmitter {
 public:
  static Result<Transmitter> open(const tks_transmitter_options& options) {
    char message[512] = "";
    tks_transmitter* transmitter = nullptr;
    const tks_status status = tks_transmitter_open(&options, &transmitter, message, sizeof message);
    if (status != TKS_OK) return Status(status, message);
    return Transmitter(transmitter);
  }

  Status append(std::span<const uint8_t> bytes) {
    char message[512] = "";
    const tks_status status = tks_transmitter_append(transmitter_.get(), bytes.data(), bytes.size(),
                                                     message, sizeof message);
    return status == TKS_OK ? Status() : Status(status, message);
  }
  /// Gives up groups before a frame (tks_transmitter_forget).
  Status forget(uint64_t frame) {
    const tks_status status = tks_transmitter_forget(transmitter_.get(), frame);
    return status == TKS_OK ? Status() : Status(status, "Not enough memory.");
  }
  tks_sequence_info info() const {
    tks_sequence_info info{};
    info.size = sizeof info;
    tks_transmitter_get_info(transmitter_.get(), &info);
    return info;
  }
  /// The bytes that help a receiver most (tks_transmitter_answer).
  Result<Buffer> answer(std::span<const uint8_t> control) {
    char message[512] = "";
    tks_buffer buffer{};
    const tks_status status = tks_transmitter_answer(
        transmitter_.get(), control.data(), control.size(), &buffer, message, sizeof message);
    if (status != TKS_OK) return Status(status, message);
    return Buffer(buffer);
  }

 private:
  struct Close {
    void operator()(tks_transmitter* transmitter) const { tks_transmitter_close(transmitter); }
  };
  explicit Transmitter(tks_transmitter* transmitter) : transmitter_(transmitter) {}
  std::unique_ptr<tks_transmitter, Close> transmitter_;
};

/// Says what it wants, takes answers, and gives decoders of their frames. Move only.
class Receiver {
 public:
  /// number: unlike those of all other receivers. limits: of the decoder of each group.
  static Result<Receiver> open(uint64_t number, const tks_limits& limits = makeLimits()) {
    tks_receiver* receiver = nullptr;
    if (const tks_status status = tks_receiver_open(number, &limits, &receiver); status != TKS_OK)
      return Status(status, "Not enough memory.");
    return Receiver(receiver);
  }

  /// A control message.
  Result<std::vector<uint8_t>> control(const tks_wants& wants) {
    std::array<uint8_t, TKS_MOST_CONTROL_BYTES> bytes{};
    size_t size = 0;
    const tks_status status = tks_receiver_control(receiver_.get(), &wants, bytes.data(), &size);
    if (status != TKS_OK) return failure(status);
    return std::vector<uint8_t>(bytes.begin(), bytes.begin() + static_cast<ptrdiff_t>(size));
  }
  Status take(std::span<const uint8_t> answer) {
    return statusOf(tks_receiver_take(receiver_.get(), answer.data(), answer.size()));
  }
  tks_receiver_info info() const {
    tks_receiver_info info{};
    info.size = sizeof info;
    tks_receiver_get_info(receiver_.get(), &info);
    return info;
  }
  /// A frame that can be decoded, with its time in ticks.
  struct TimedFrame {
    uint64_t frame = 0;
    int64_t time = 0;
  };
  /// The last one up to a frame.
  Result<TimedFrame> find(uint64_t frame) {
    TimedFrame found;
    const tks_status status = tks_receiver_find(receiver_.get(), frame, &found.frame, &found.time);
    if (status != TKS_OK) return failure(status);
    return found;
  }
  /// The decoder that shows a frame. It belongs to the receiver (tks_receiver_frame).
  Result<Decoder> decoder(uint64_t frame) {
    tks_decoder* decoder = nullptr;
    const tks_status status = tks_receiver_frame(receiver_.get(), frame, &decoder);
    if (status != TKS_OK) return failure(status);
    return Decoder::borrow(decoder);
  }
  Status forget(uint64_t frame) { return statusOf(tks_receiver_forget(receiver_.get(), frame)); }
  /// Groups that are given up, as a part of a sequence (tks_receiver_write).
  Result<Buffer> write(uint64_t frame) {
    tks_buffer buffer{};
    const tks_status status = tks_receiver_write(receiver_.get(), frame, &buffer);
    if (status != TKS_OK) return failure(status);
    return Buffer(buffer);
  }

 private:
  struct Close {
    void operator()(tks_receiver* receiver) const { tks_receiver_close(receiver); }
  };
  explicit Receiver(tks_receiver* receiver) : receiver_(receiver) {}
  Status failure(tks_status status) const {
    return Status(status, tks_receiver_message(receiver_.get()));
  }
  Status statusOf(tks_status status) const { return status == TKS_OK ? Status() : failure(status); }
  std::unique_ptr<tks_receiver, Close> receiver_;
};

}  // namespace v0
}  // namespace tetrakis

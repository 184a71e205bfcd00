// SPDX-License-Identifier: Apache-2.0
// RangeDecoder turns the bytes of a codeword into binary decisions, as range_encoder.hpp turned
// them into bytes, and adds the tail rule: where bytes are missing, a decision counts only if
// reading the missing tail as all zeros and as all ones agrees on it. So a cut costs no bytes that
// end a codeword, and no decision that was paid for is lost.
#pragma once

#include <bit>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <span>

#include "bitstream/coder/adaptive_bit.hpp"

namespace tetrakis::inline coder {

/// Safe on any input; reads at most bytes.size() bytes; stops for good at the first undecided bit.
class RangeDecoder {
 public:
  explicit RangeDecoder(std::span<const uint8_t> bytes)
      : next_(bytes.data()), end_(next_ + bytes.size()) {
    for (int i = 0; i < 4; ++i) shiftIn();
    if (code_ + slack_ == 0xffffffff) decideNothing();
  }

  /// Decodes one decision and updates the model. After exhausted() the result is meaningless and
  /// nothing changes any more.
  bool decode(AdaptiveBit& model) {
    const bool bit = split(model.zero());
    if (!exhausted_) model.update(bit);
    return bit;
  }

  bool decodeUncertain(AdaptiveBit& model) { return decode(model); }

  /// Decodes decisions of one model while they are `bit`, at most so many, and returns how many. A
  /// decision that differs, or that the bytes do not decide, is left to decode().
  uint32_t decodeRun(AdaptiveBit& model, bool bit, uint32_t most) {
    uint32_t count = 0;
    for (; count < most && !model.isSettledOn(bit); ++count) {
      if (!decides(model.zero()) || (code_ >= boundOf(model.zero())) != bit) return count;
      decode(model);
    }
    return count + decodeSettled(bit, most - count);
  }

  /// How many bytes have been read of those that the decoder was made of.
  size_t read(std::span<const uint8_t> bytes) const {
    return static_cast<size_t>(next_ - bytes.data());
  }

  /// More bytes of the codeword have come, of which `read` have been read. They may lie elsewhere
  /// than those before. As if they had been there from the start; not after exhausted().
  void grow(std::span<const uint8_t> bytes, size_t read) {
    assert(!exhausted_ && read <= bytes.size());
    next_ = bytes.data() + read;
    end_ = bytes.data() + bytes.size();
    for (; missing_ > 0 && next_ != end_; --missing_) {
      const uint32_t shift = 8 * (missing_ - 1);
      if (shift < 32) code_ += uint32_t{*next_} << shift;
      ++next_;
    }
    slack_ = missing_ > 3 ? 0xffffffff : (uint32_t{1} << (8 * missing_)) - 1;
  }

  /// Whether the bytes decide a decision of which P(bit = 0) is `zero` units of 2^-16.
  bool decides(uint32_t zero) const {
    const uint32_t bound = boundOf(zero);
    return !exhausted_ && (slack_ == 0 || code_ >= bound || uint64_t{code_} + slack_ < bound);
  }

  /// zero: P(bit = 0) in units of 2^-16, neither 0 nor 1.
  bool decodeOf(uint32_t zero) { return split(zero); }

  bool decodeEven() { return split(1u << (AdaptiveBit::kPrecision - 1)); }

  /// The available bytes do not decide the decision asked for last.
  bool exhausted() const { return exhausted_; }

  /// No byte of the next so many decisions of models is missing.
  bool hasPlenty(size_t decisions) const {
    return static_cast<size_t>(end_ - next_) >= kMostBytes * decisions;
  }

  class Plenty;

 private:
  uint32_t boundOf(uint32_t zero) const {
    return static_cast<uint32_t>((uint64_t{range_} * zero) >> AdaptiveBit::kPrecision);
  }

  /// decodeRun() of a model that no such decision changes any more, in a few instructions each.
  uint32_t decodeSettled(bool bit, uint32_t most) {
    constexpr int kShift = AdaptiveBit::kPrecision - std::countr_zero(AdaptiveBit::kFloor);
    if (exhausted_) return 0;
    for (uint32_t count = 0; count < most; ++count) {
      // boundOf() the floor, or of what it leaves.
      const uint32_t bound = bit ? range_ >> kShift : range_ - 1 - ((range_ - 1) >> kShift);
      if (bit ? code_ < bound : uint64_t{code_} + slack_ >= bound) return count;
      if (bit) code_ -= bound;
      range_ = bit ? range_ - bound : bound;
      renormalise();
    }
    return most;
  }

  void renormalise() {
    while (range_ < kRenormalise) {
      range_ <<= 8;
      shiftIn();
    }
  }

  bool split(uint32_t zero) {
    assert(zero > 0 && zero < 1u << AdaptiveBit::kPrecision);
    assert(range_ >= kRenormalise);
    const uint32_t bound = boundOf(zero);
    const bool bit = code_ >= bound;
    if (slack_ != 0 && (exhausted_ || (!bit && uint64_t{code_} + slack_ >= bound))) {
      exhausted_ = true;
      return false;
    }
    if (bit) {
      code_ -= bound;
      range_ -= bound;
    } else {
      range_ = bound;
    }
    renormalise();
    return bit;
  }

  /// A code of FFFFFFFF is no less than the range, which no encoder writes: all decisions would be
  /// 1 and take no bytes. So a codeword decides nothing while it may be one.
  void decideNothing() {
    exhausted_ = true;
    slack_ = 0xffffffff;
    next_ = end_;
  }

  void shiftIn() {
    code_ <<= 8;
    slack_ <<= 8;
    if (next_ != end_) {
      code_ |= *next_++;
    } else {
      slack_ |= 0xff;
      ++missing_;
    }
  }

  static constexpr uint32_t kRenormalise = 1u << 24;
  /// A decision leaves at least 2^24 * kFloor / 2^16 >= 2^8 of the range.
  static constexpr size_t kMostBytes = 2;
  static_assert((uint64_t{kRenormalise} * AdaptiveBit::kFloor) >> AdaptiveBit::kPrecision >=
                kRenormalise >> (8 * kMostBytes));

  const uint8_t* next_;
  const uint8_t* end_;
  uint32_t code_ = 0;  ///< offset inside the interval, missing bytes read as zeros
  uint32_t range_ = 0xffffffff;
  uint32_t slack_ = 0;    ///< what missing bytes could add to code_ if they were all ones
  uint32_t missing_ = 0;  ///< bytes read behind the end
  bool exhausted_ = false;
};

/// Decodes while RangeDecoder::hasPlenty() holds, without asking for missing bytes and with its
/// state in registers, which is why decisions are inlined where else little is (apps/web/module);
/// the decoder that it is made from goes on behind it once it is gone.
class RangeDecoder::Plenty {
 public:
  explicit Plenty(RangeDecoder& decoder)
      : decoder_(decoder), next_(decoder.next_), code_(decoder.code_), range_(decoder.range_) {}
  Plenty(const Plenty&) = delete;
  Plenty& operator=(const Plenty&) = delete;
  ~Plenty() {
    decoder_.next_ = next_;
    decoder_.code_ = code_;
    decoder_.range_ = range_;
  }

  [[gnu::always_inline]] bool decode(AdaptiveBit& model) {
    const uint32_t bound = boundOf(model);
    const bool bit = code_ >= bound;
    if (bit) {
      code_ -= bound;
      range_ -= bound;
    } else {
      range_ = bound;
    }
    renormalise();
    model.update(bit);
    return bit;
  }

  /// Does what decode() does without a branch on the decision: for those that nobody can predict.
  [[gnu::always_inline]] bool decodeUncertain(AdaptiveBit& model) {
    const uint32_t bound = boundOf(model);
    const bool bit = code_ >= bound;
    const uint32_t mask = 0u - uint32_t{bit};
    assert(bound > 0 && bound < range_);
    code_ -= bound & mask;
    range_ = bound + ((range_ - 2 * bound) & mask);
    renormalise();
    model.update(bit);
    return bit;
  }

 private:
  uint32_t boundOf(const AdaptiveBit& model) const {
    return static_cast<uint32_t>((uint64_t{range_} * model.zero()) >> AdaptiveBit::kPrecision);
  }
  void renormalise() {
    while (range_ < kRenormalise) {
      range_ <<= 8;
      code_ = code_ << 8 | *next_++;
    }
  }

  RangeDecoder& decoder_;
  const uint8_t* next_;
  uint32_t code_, range_;
};

// DecisionDecoding is the decoder's side of passes whose decisions are a codeword of their own
// (codec/geometry/flat/flat_pass.hpp, codec/wavelet/priority_map.hpp): their `Io`. The encoder's
// side is range_encoder.hpp.

/// Decoder: a RangeDecoder, or what stands in its place.
template <class Decoder = RangeDecoder>
class DecisionDecoding {
 public:
  explicit DecisionDecoding(std::span<const uint8_t> codeword) : decoder_(codeword) {}
  bool decide(AdaptiveBit& model, bool) { return decoder_.decode(model); }
  bool decideOf(uint32_t zero, bool) { return decoder_.decodeOf(zero); }
  bool even(bool) { return decoder_.decodeEven(); }
  uint32_t run(AdaptiveBit& model, bool answer, uint32_t most) {
    return decoder_.decodeRun(model, answer, most);
  }
  bool stopped() const { return decoder_.exhausted(); }
  const Decoder& decoder() const { return decoder_; }

 private:
  Decoder decoder_;
};

}  // namespace tetrakis::inline coder

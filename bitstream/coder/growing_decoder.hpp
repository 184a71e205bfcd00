// SPDX-License-Identifier: Apache-2.0
// A GrowingDecoder decodes a whole codeword and knows how many of its bytes decide what it has
// decoded: a decision that the bytes so far leave open gets the next byte. So encoders find out
// what every prefix shows by decoding once.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "bitstream/coder/range_decoder.hpp"

namespace tetrakis::inline coder {

/// Has the functions of a RangeDecoder that passes call.
class GrowingDecoder {
 public:
  /// codeword: all of it, as an encoder wrote it; outlives the decoder.
  explicit GrowingDecoder(std::span<const uint8_t> codeword)
      : codeword_(codeword), bytes_(leastBytes(codeword)), decoder_(codeword.first(bytes_)) {}

  bool decode(AdaptiveBit& model) {
    growFor(model.zero());
    return decoder_.decode(model);
  }
  bool decodeOf(uint32_t zero) {
    growFor(zero);
    return decoder_.decodeOf(zero);
  }
  bool decodeEven() {
    growFor(1u << (AdaptiveBit::kPrecision - 1));
    return decoder_.decodeEven();
  }
  bool exhausted() const { return decoder_.exhausted(); }

  /// How many bytes decide all decisions so far.
  uint64_t bytes() const { return bytes_; }

 private:
  /// How many bytes it takes until any decision counts: those of FF alone decide nothing.
  static size_t leastBytes(std::span<const uint8_t> codeword) {
    size_t bytes = 0;
    while (bytes < codeword.size() && RangeDecoder(codeword.first(bytes)).exhausted()) ++bytes;
    return bytes;
  }
  void growFor(uint32_t zero) {
    while (bytes_ < codeword_.size() && !decoder_.decides(zero)) {
      decoder_.grow(codeword_.first(bytes_ + 1), bytes_);
      ++bytes_;
    }
  }

  std::span<const uint8_t> codeword_;
  size_t bytes_;  ///< that the decoder has
  RangeDecoder decoder_;
};

// DecidedPlaces notes how many bytes of a codeword decide each place of a plane, as a
// GrowingDecoder finds out. It then lists the places that a prefix of any length shows.

class DecidedPlaces {
 public:
  /// The decisions of a place follow. bytes: that decide all places before it; they do not fall.
  void next(size_t place, uint64_t bytes) {
    end(bytes);
    places_.push_back({place, 0});
  }
  /// All decisions have been made.
  void end(uint64_t bytes) {
    if (!places_.empty()) places_.back().bytes = bytes;
  }

  /// Calls show() for the places that so many bytes decide beside those of the call before. If they
  /// are fewer, hide() comes first, and all are shown again.
  template <class Hide, class Show>
  void showAfter(uint64_t bytes, const Hide& hide, const Show& show) {
    if (shown_ > 0 && places_[shown_ - 1].bytes > bytes) {
      hide();
      shown_ = 0;
    }
    for (; shown_ < places_.size() && places_[shown_].bytes <= bytes; ++shown_)
      show(places_[shown_].place);
  }

 private:
  struct Decided {
    size_t place;
    uint64_t bytes;  ///< that decide it and all before it
  };
  std::vector<Decided> places_;
  size_t shown_ = 0;
};

}  // namespace tetrakis::inline coder

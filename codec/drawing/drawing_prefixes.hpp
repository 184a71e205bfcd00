// SPDX-License-Identifier: Apache-2.0
// What each prefix of a drawing's codeword shows, found by decoding it once: a decision that the
// bytes so far leave open gets the next byte. Decoders do not have that byte. Encoders measure
// hundreds of prefixes, and decoding each anew takes seconds, most of them for fresh models.
#pragma once

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "base/plane.hpp"
#include "bitstream/coder/range_decoder.hpp"
#include "codec/drawing/drawing_index.hpp"
#include "codec/drawing/drawing_pass.hpp"

namespace tetrakis::inline drawing {

/// A vertex of a drawing, and how many bytes of the codeword decide it and all before it.
struct DecidedVertex {
  size_t vertex;
  uint64_t bytes;
};

/// A side of drawing_pass.hpp that notes what decides each vertex.
template <class Value>
class WatchedDecoding {
 public:
  explicit WatchedDecoding(std::span<const uint8_t> codeword)
      : codeword_(codeword), bytes_(leastBytes(codeword)), decoder_(codeword.first(bytes_)) {}

  DrawnIndex target(size_t vertex) {
    noteBytes();
    decided_.push_back({vertex, 0});
    return kNoIndex;
  }
  const Value& value(size_t) const { return unknown_; }
  bool bit(AdaptiveBit& model, bool) {
    growFor(model.zero());
    return decoder_.decode(model);
  }
  bool bitOf(uint32_t zero, bool) {
    growFor(zero);
    return decoder_.decodeOf(zero);
  }
  bool evenBit(bool) {
    growFor(1u << (AdaptiveBit::kPrecision - 1));
    return decoder_.decodeEven();
  }
  bool stopped() const { return decoder_.exhausted(); }

  /// In the order in which they are coded.
  std::vector<DecidedVertex> take() {
    noteBytes();
    return std::move(decided_);
  }

 private:
  /// How many bytes it takes until any decision counts: those of FF alone decide nothing.
  static size_t leastBytes(std::span<const uint8_t> codeword) {
    size_t bytes = 0;
    while (bytes < codeword.size() && RangeDecoder(codeword.first(bytes)).exhausted()) ++bytes;
    return bytes;
  }
  void noteBytes() {
    if (!decided_.empty()) decided_.back().bytes = bytes_;
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
  std::vector<DecidedVertex> decided_;
  Value unknown_{};
};

/// List: of drawing_pass.hpp, of values of the type Value.
template <class List, class Value>
class DrawingPrefixes {
 public:
  /// codeword: all of it, as an encoder wrote it. levels: of the grid, coarse to fine.
  /// valid: null: all samples have a value.
  DrawingPrefixes(std::span<const uint8_t> codeword, Extent extent, const BitPlane* valid,
                  std::span<const Level> levels, List list)
      : list_(std::move(list)), indices_(extent.samples()) {
    WatchedDecoding<Value> io(codeword);
    DrawingPass(PlaneView<KeptIndex>(indices_, extent), valid, list_, io).run(levels);
    assert(!io.stopped());
    decided_ = io.take();
    shown_.resize(extent.samples());
  }

  /// With the values of vertices that are not decided yet, which none of the indices below names.
  const List& list() const { return list_; }

  /// The indices that a decoder has after so many bytes. Valid until the next call.
  std::span<const KeptIndex> indicesAfter(uint64_t bytes) {
    if (next_ > 0 && decided_[next_ - 1].bytes > bytes) {
      std::fill(shown_.begin(), shown_.end(), KeptIndex());
      next_ = 0;
    }
    for (; next_ < decided_.size() && decided_[next_].bytes <= bytes; ++next_)
      shown_[decided_[next_].vertex] = indices_[decided_[next_].vertex];
    return shown_;
  }

 private:
  List list_;
  std::vector<KeptIndex> indices_;      ///< of the whole codeword
  std::vector<DecidedVertex> decided_;  ///< bytes do not fall
  std::vector<KeptIndex> shown_;
  size_t next_ = 0;  ///< of decided_: the first that is not shown
};

}  // namespace tetrakis::inline drawing

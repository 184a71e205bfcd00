// SPDX-License-Identifier: Apache-2.0
// DrawingPrefixes decodes a drawing's codeword once and tells from that what each of its prefixes
// shows. Encoders measure hundreds of prefixes; decoding each of them anew takes seconds, mostly
// for fresh models.
#pragma once

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "base/plane.hpp"
#include "bitstream/coder/growing_decoder.hpp"
#include "codec/drawing/drawing_neighbours.hpp"
#include "codec/drawing/drawing_pass.hpp"

namespace tetrakis::inline drawing {

/// A side of drawing_pass.hpp that notes what decides each vertex.
template <class Value>
class WatchedDecoding {
 public:
  /// decided: gets the vertices, and outlives this.
  WatchedDecoding(std::span<const uint8_t> codeword, DecidedPlaces& decided)
      : decoder_(codeword), decided_(decided) {}

  DrawnIndex target(size_t vertex) {
    decided_.next(vertex, decoder_.bytes());
    return kNoIndex;
  }
  const Value& value(size_t) const { return unknown_; }
  bool bit(AdaptiveBit& model, bool) { return decoder_.decode(model); }
  bool bitOf(uint32_t zero, bool) { return decoder_.decodeOf(zero); }
  bool evenBit(bool) { return decoder_.decodeEven(); }
  bool stopped() const { return decoder_.exhausted(); }
  void end() { decided_.end(decoder_.bytes()); }

 private:
  GrowingDecoder decoder_;
  DecidedPlaces& decided_;
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
    WatchedDecoding<Value> io(codeword, decided_);
    DrawingPass(PlaneView<KeptIndex>(indices_, extent), valid, list_, io).run(levels);
    assert(!io.stopped());
    io.end();
    shown_.resize(extent.samples());
  }

  /// With the values of vertices that are not decided yet, which none of the indices below names.
  const List& list() const { return list_; }

  /// The indices that a decoder has after so many bytes. Valid until the next call.
  std::span<const KeptIndex> indicesAfter(uint64_t bytes) {
    decided_.showAfter(
        bytes, [&] { std::fill(shown_.begin(), shown_.end(), KeptIndex()); },
        [&](size_t vertex) { shown_[vertex] = indices_[vertex]; });
    return shown_;
  }

 private:
  List list_;
  std::vector<KeptIndex> indices_;  ///< of the whole codeword
  DecidedPlaces decided_;           ///< the vertices
  std::vector<KeptIndex> shown_;
};

}  // namespace tetrakis::inline drawing

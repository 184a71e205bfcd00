// SPDX-License-Identifier: Apache-2.0
// DrawingPass codes planes of few values in shapes with sharp edges: textures that are maps,
// classes of land cover, plans or lettering; heights that are classes, terraces or masks. A wavelet
// spends most of its bytes on ringing at these edges, and the magnitude of a difference between two
// values of a list means little.
//
// Every sample is a vertex of the 4-8 lattice. Level by level, coarse to fine, it is asked whether
// a vertex has the first, second or third of the values that its neighbours vote for (exact matches
// in the place of JBIG's contexts, ITU-T T.82). If not, its value has appeared before and has an
// index, or it is new. Any prefix of the codeword gives the samples at the resolution it pays for.
//
// Lossless bytes of JPEG XL at effort 7, and of this: contours of `tetrakis synth` 42.3 k, 35.0 k;
// of drawings that are not in the repository: a town of 12 colours 21.4 k, 11.2 k; the same
// smoothed and lettered, 3037 colours 102 k, 61 k; seven classes of land cover 7.1 k, 4.3 k.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

#include "base/bit_plane.hpp"
#include "base/plane.hpp"
#include "bitstream/coder/range_decoder.hpp"
#include "codec/drawing/drawing_models.hpp"
#include "codec/drawing/drawing_neighbours.hpp"
#include "codec/lattice/levels.hpp"

namespace tetrakis::inline drawing {

/// Runs over all vertices once. List is the list of values:
///   size_t size()
///   void code(const Candidates&, size_t vertex, Io&)    codes and adds a value that it lacks
///   uint32_t difference(DrawnIndex, DrawnIndex)         of two values: a class of at most 35
/// Io is the encoder's or the decoder's side of a decision; `ours` is what the encoder knows of it
/// and the decoder ignores:
///   DrawnIndex target(size_t vertex)           kNoIndex for a value that has not appeared
///   const auto& value(size_t vertex)           of the list's kind
///   bool bit(AdaptiveBit&, bool ours)
///   bool bitOf(uint32_t zero, bool ours)       of odds that no single model has
///   bool evenBit(bool ours)
///   bool stopped()                             the last decision did not count
template <class List, class Io>
class DrawingPass {
 public:
  /// indices: of every sample, kNoIndex where not known. valid: the samples that have a value;
  /// null: all.
  DrawingPass(const PlaneView<KeptIndex>& indices, const BitPlane* valid, List& list, Io& io)
      : indices_(indices), valid_(valid), list_(list), io_(io) {}

  /// levels: of the grid, coarse to fine. Ends early at a decision that does not count. Returns the
  /// step of the last level: the vertices that are known lie at its multiples.
  uint32_t run(std::span<const Level> levels) {
    for (const Level& level : levels) {
      const Neighbourhood neighbourhood(level, indices_.values(), indices_.extent());
      const ModelChain unanimous = models_.candidate(Candidates::unanimous(), 0, level.kind);
      for (uint32_t row = 0; row < level.rows; ++row) {
        const uint32_t y = level.y(row);
        uint32_t x = level.firstX(row);
        for (uint32_t i = 0; i < level.columns[row % 2]; ++i, x += level.pitch()) {
          const size_t vertex = size_t{y} * indices_.width + x;
          if (valid_ != nullptr && !valid_->at(x, y)) continue;
          const DrawnIndex target = io_.target(vertex), common = neighbourhood.common(x, y);
          const bool asked = common != kNoIndex;  // most vertices, and nothing else to do for them
          DrawnIndex index = common;
          if (!asked || !ask(unanimous, target == common))
            index = decide(neighbourhood.around(x, y), level.kind, vertex, target, asked);
          if (io_.stopped()) return level.step;
          indices_.data[vertex] = index;
        }
      }
    }
    return levels.back().step;
  }

 private:
  /// first: of the places to ask for.
  DrawnIndex decide(const Candidates& around, LevelKind kind, size_t vertex, DrawnIndex target,
                    int first) {
    for (int place = first; place < std::min(around.count(), Candidates::kRanked); ++place) {
      const DrawnIndex index = around[place].index;
      if (ask(models_.mixedCandidate(around, place, kind, list_), target == index)) return index;
    }
    if (!isNew(target)) return known(around, target);
    list_.code(around, vertex, io_);
    return static_cast<DrawnIndex>(list_.size() - 1);
  }

  /// The first value is new without a decision, and where there is no room for more none is.
  bool isNew(DrawnIndex target) {
    if (list_.size() == 0) return true;
    const bool full = list_.size() == kMostDrawnValues;
    return !full && io_.bit(models_.fresh, target == kNoIndex);
  }

  /// Digits of the index, the highest first.
  DrawnIndex known(const Candidates& around, DrawnIndex target) {
    uint32_t node = 1;
    for (int position = kDrawnIndexBits - 1; position >= 0 && !io_.stopped(); --position) {
      const bool bit = ask(models_.index(around, node), (target >> position) & 1);
      node = 2 * node + bit;
    }
    const auto last = static_cast<uint32_t>(list_.size() - 1);
    return static_cast<DrawnIndex>(std::min(node - (1u << kDrawnIndexBits), last));
  }

  template <size_t kModels>
  bool ask(Mixture<kModels> mixture, bool ours) {
    const bool bit = io_.bitOf(mixture.zero(), ours);
    mixture.learn(bit);
    return bit;
  }

  bool ask(const ModelChain& chain, bool ours) {
    AdaptiveBit& asked = chain.asked();
    const bool bit = io_.bit(asked, ours);
    for (AdaptiveBit* model : chain.models) {
      if (model != &asked) model->update(bit);
    }
    return bit;
  }

  const PlaneView<KeptIndex> indices_;
  const BitPlane* valid_;
  List& list_;
  Io& io_;
  DrawingModels models_;
};

// DrawingDecoding is the decoder's side of the pass: it answers each decision of the pass from a
// codeword.

template <class Value>
class DrawingDecoding {
 public:
  explicit DrawingDecoding(std::span<const uint8_t> codeword) : decoder_(codeword) {}
  DrawnIndex target(size_t) const { return kNoIndex; }
  const Value& value(size_t) const { return unknown_; }
  bool bit(AdaptiveBit& model, bool) { return decoder_.decode(model); }
  bool bitOf(uint32_t zero, bool) { return decoder_.decodeOf(zero); }
  bool evenBit(bool) { return decoder_.decodeEven(); }
  bool stopped() const { return decoder_.exhausted(); }

 private:
  RangeDecoder decoder_;
  Value unknown_{};
};

}  // namespace tetrakis::inline drawing

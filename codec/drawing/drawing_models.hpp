// SPDX-License-Identifier: Apache-2.0
// DrawingModels predict the decisions of a drawing: which of its neighbours a vertex equals, and
// the index of its value. LazyModels makes a model when it is first asked, and codeResidual() codes
// values that are new.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <type_traits>
#include <vector>

#include "bitstream/coder/adaptive_bit.hpp"
#include "bitstream/coder/mixture.hpp"
#include "codec/drawing/drawing_neighbours.hpp"

namespace tetrakis::inline drawing {

// LazyModels is a large table of models for a drawing, which may be small and ask few of them. A
// block of models is made when the first of them is asked: making all of them takes a millisecond a
// table, mostly for memory that the operating system hands over page by page.

class LazyModels {
 public:
  /// count: a multiple of kTogether.
  explicit LazyModels(size_t count)
      : room_(new std::byte[count * sizeof(AdaptiveBit)]), made_(count / kTogether) {
    assert(count % kTogether == 0);
  }

  AdaptiveBit& operator[](size_t index) {
    const size_t block = index / kTogether;
    if (made_[block] == 0) [[unlikely]] {
      std::uninitialized_value_construct_n(models() + block * kTogether, kTogether);
      made_[block] = 1;
    }
    return models()[index];
  }

 private:
  static constexpr size_t kTogether = 64;
  static_assert(std::is_trivially_destructible_v<AdaptiveBit>);

  AdaptiveBit* models() { return reinterpret_cast<AdaptiveBit*>(room_.get()); }

  std::unique_ptr<std::byte[]> room_;
  std::vector<uint8_t> made_;  ///< of each block: 1 once its models are
};

// codeResidual() codes the difference between a value that appears for the first time and its
// prediction.

/// Number i: the magnitude has more than i bits.
template <size_t kClasses>
using ResidualModels = std::array<AdaptiveBit, kClasses>;

/// Bits of the magnitude one by one, then its digits and the sign. Its models are all the bits that
/// it has at most. A magnitude of 32 bits wraps.
template <size_t kClasses, class Io>
int32_t codeResidual(ResidualModels<kClasses>& models, int32_t ours, Io& io) {
  const auto word = static_cast<uint32_t>(ours);
  const uint32_t our_magnitude = ours < 0 ? 0 - word : word;
  const auto our_bits = static_cast<size_t>(std::bit_width(our_magnitude));
  size_t bits = 0;
  while (bits < kClasses && io.bit(models[bits], our_bits > bits)) ++bits;
  if (bits == 0) return 0;
  uint32_t magnitude = 1;
  for (size_t position = bits - 1; position-- > 0;)
    magnitude = 2 * magnitude + io.evenBit((our_magnitude >> position) & 1);
  return static_cast<int32_t>(io.evenBit(ours < 0) ? 0 - magnitude : magnitude);
}

// DrawingModels holds the probabilities of the decisions of a drawing.

/// Models of one decision, from the most special to the most general. The first that has experience
/// is asked, or the last; all learn. Quick, for the decisions of which there are most.
struct ModelChain {
  std::array<AdaptiveBit*, 3> models;

  AdaptiveBit& asked() const {
    return models[0]->experienced()   ? *models[0]
           : models[1]->experienced() ? *models[1]
                                      : *models[2];
  }
};

class DrawingModels {
 public:
  DrawingModels();

  /// Whether the vertex has the value of the candidate at `place`. Special: which of the
  /// neighbours have it, and which of near and causal have the next one's (of the first, for other
  /// places). General: how many.
  ModelChain candidate(const Candidates& around, int place, LevelKind kind) {
    const VotedIndex& c = around[place];
    const uint32_t asked = askedOf(place, kind), pattern = (asked << kPatternBits) + c.pattern;
    const bool rivalled = around.count() > 1;
    const uint32_t rival = rivalled ? around[place == 0 ? 1 : 0].pattern & 0x3f : 0;
    int more = 0;
    if (place == 0 && rivalled) more = std::min<int>(around[1].near, 3);
    if (place == 1) more = std::min(around.count(), 4) - 1;
    const int count = (((place * 4 + more) * 5 + c.near) * 3 + c.causal) * 9 + c.ring;
    return {{&rivals_[hash(pattern * 64 + rival, kRivalBits)], &patterns_[pattern],
             &counts_[static_cast<size_t>(2 * count + (asked & 1))]}};
  }

  /// The same, with what the values say: those of the first three candidates, which repeat where
  /// classes border on each other, and how near's differ from the candidate, which repeats on
  /// slopes of any height.
  template <class List>
  Mixture<5> mixedCandidate(const Candidates& around, int place, LevelKind kind, const List& list) {
    const ModelChain chain = candidate(around, place, kind);
    const uint32_t asked = askedOf(place, kind);
    uint32_t values = asked, differences = asked;
    for (int i = 0; i < Candidates::kRanked; ++i) values = values * kFactor + around.at(i);
    for (size_t i = 0; i < Candidates::kNear; ++i) {
      const DrawnIndex near = around.neighbour(i);
      const uint32_t difference =
          near == kNoIndex ? kNoDifference : list.difference(near, around[place].index);
      differences = differences * (kNoDifference + 1) + difference;
    }
    const auto count = static_cast<uint32_t>(std::min(around.count(), 4) - 1);
    return {
        {chain.models[0], chain.models[1], chain.models[2],
         &differences_[hash(differences, kDifferencesBits)], &values_[hash(values, kValuesBits)]},
        candidate_weights_[4 * asked + count],
        odds_};
  }

  /// A bit of an index. node: 1 followed by its bits so far, the highest first.
  Mixture<3> index(const Candidates& around, uint32_t node) {
    const uint32_t first = around.count() > 0 ? around[0].index : kMostDrawnValues;
    const uint32_t second = around.count() > 1 ? around[1].index : kMostDrawnValues;
    return {{&pairs_[hash((first * kFactor + second) * kFactor + node, kPairBits)],
             &singles_[hash(first * kFactor + node, kSingleBits)], &indices_[node]},
            index_weights_,
            odds_};
  }

  AdaptiveBit fresh;  ///< the value has not appeared before

 private:
  static constexpr uint32_t kFactor = kMostDrawnValues + 3;
  static constexpr int kPairBits = 18, kSingleBits = 16, kRivalBits = 18, kPatternBits = 14,
                       kDifferencesBits = 16, kValuesBits = 16;
  static constexpr uint32_t kNoDifference = 36;  ///< above all of List::difference()

  static uint32_t askedOf(int place, LevelKind kind) {
    return static_cast<uint32_t>(2 * place + (kind == LevelKind::kCentres));
  }

  static uint32_t hash(uint32_t context, int bits) {
    return (context * 2654435761u) >> (32 - bits);
  }

  LazyModels pairs_, singles_, indices_;
  LazyModels rivals_, patterns_, differences_, values_;
  std::array<AdaptiveBit, 2 * Candidates::kRanked * 4 * 5 * 3 * 9> counts_;
  std::array<MixtureWeights<5>, 2 * Candidates::kRanked * 4> candidate_weights_;
  MixtureWeights<3> index_weights_ = freshWeights<3>();
  const OddsTable odds_ = makeOddsTable();
};

}  // namespace tetrakis::inline drawing

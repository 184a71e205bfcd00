// SPDX-License-Identifier: Apache-2.0
// PlanePass codes the bit-planes of one band, so that any prefix is useful: three passes a plane
// (after EBCOT, D. Taubman 2000), with contexts from local magnitude sums (after F. Auli-Llinas
// 2011) and from the magnitudes of other bands (band_models.hpp). Blocks without a significant
// coefficient cost one decision a plane and no work; coefficients that do not exist (Band::absent)
// cost nothing, nor do blocks without one that does.
//
//   likely   significance where a neighbour is significant (steepest slope)
//   rest     significance everywhere else; empty blocks are first asked as a whole, and so are
//            four columns in a row without a significant neighbour
//   refine   next bit of every coefficient that was significant before this plane
//
// The passes are written once. Io is the encoder's or the decoder's side of a decision:
//   bool magnitudeBit(AdaptiveBit&, size_t cell, int plane)   bit `plane` of the magnitude
//   bool refinedBit(AdaptiveBit&, size_t cell, int plane)     the same of a significant one
//   bool signBit(AdaptiveBit&, size_t cell, bool flip)        negative, xor flip
//   bool blockBit(AdaptiveBit&, uint32_t y, uint32_t x, int plane)   a magnitude of the block's
//                                                                    tier reaches 2^plane
//   bool bandBit(AdaptiveBit&, int plane)                     a magnitude of the band's tier does
//   bool groupBit(AdaptiveBit&, size_t cell, int plane)       one of four cells does
//   bool placeBit(AdaptiveBit&, size_t cell, uint32_t bit, int plane)   bit of the place of the
//                                                                       first of four that does
//   bool stopped()                                            the last decision did not count
//   void learned(size_t cell, uint32_t before, uint32_t after, int plane)   known bits of a
//                                                                           magnitude
//   Plenty                              a faster Io, made of an Io& for a while
//   bool hasPlenty(size_t decisions)    it may be used for so many decisions
//   void mayStopAt(PassPlace)           only of an Io that goes on behind a stop: it copies what
//                                       the decisions up to the next place change
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "bitstream/track/band.hpp"
#include "bitstream/track/band_models.hpp"

namespace tetrakis::inline track {

enum class PassKind : uint8_t { kLikely = 0, kRest = 1, kRefine = 2 };

/// Where a pass begins, or goes on: 32 columns of a row.
struct PassPlace {
  uint32_t row = 0, word = 0;
  bool begun = false;  ///< the pass has begun before
};

template <class Io>
class PlanePass {
 public:
  /// The pass is one of a tier of the band.
  PlanePass(Band& band, size_t tier, BandModels& models, const HintBands& hints, Io& io)
      : band_(band),
        tier_(tier),
        models_(models),
        hints_(hints),
        io_(io),
        neighbours_(band.shape, band.orientation) {}

  /// Codes one pass of bit-plane `plane` (0..30). Returns early once io.stopped().
  void run(PassKind kind, int plane, PassPlace from) {
    plane_ = plane;
    from_ = from;
    if (kind == PassKind::kLikely && !from.begun) beginPlane();
    if (!band_.tier_states[tier_].nonzero) {
      if (kind != PassKind::kRest || !tierBecomesNonzero()) return;
    }
    if (band_.tiers != nullptr) scaleAround();
    switch (kind) {
      case PassKind::kLikely:
        return blocks<PassKind::kLikely>();
      case PassKind::kRest:
        return blocks<PassKind::kRest>();
      case PassKind::kRefine:
        return blocks<PassKind::kRefine>();
    }
  }

 private:
  void beginPlane() {
    TierState& tier = band_.tier_states[tier_];
    if (band_.tiers == nullptr || tier.nonzero) tier.plane = plane_;
    if (!tier.nonzero) return;
    band_.clearVisited(tier_);
    if (band_.tiers != nullptr) return;  // scaleAround() follows
    for (uint32_t row = 0; row < band_.shape.rows; ++row) {
      for (uint32_t x = 0; x < band_.shape.words(); ++x) {
        if (band_.significant[band_.shape.word(row, x)] == 0) continue;
        uint8_t* scaled = band_.scaled.data() + band_.shape.cell(row, 32 * x);
        for (uint32_t i = 0; i < 32; ++i)
          scaled[i] = static_cast<uint8_t>(2 * std::min<uint8_t>(scaled[i], 0x3f));
      }
    }
  }

  bool tierBecomesNonzero() {
    mayStopAt(0, 0, 1);
    const bool bit = io_.bandBit(models_.band, plane_);
    if (io_.stopped()) return false;
    band_.tier_states[tier_].nonzero = bit;
    band_.tier_states[tier_].plane = plane_;
    if (!bit) return false;
    band_.makeCells();
    if (band_.tiers != nullptr) band_.clearVisited(tier_);
    return true;
  }

  /// Other tiers are known down to other planes: what is in and around the blocks of this one is
  /// scaled for its plane.
  void scaleAround() {
    for (uint32_t y = 0; y < band_.blockRows(); ++y) {
      const uint8_t* near = &band_.tiers->near[size_t{y} * band_.shape.words()];
      for (uint32_t x = 0; x < band_.shape.words(); ++x)
        if (((near[x] >> tier_) & 1) != 0) scaleBlock(y, x);
    }
  }

  void scaleBlock(uint32_t y, uint32_t x) {
    const uint32_t end = std::min((y + 1) * Band::kBlockRows, band_.shape.rows);
    for (uint32_t row = y * Band::kBlockRows; row < end; ++row) {
      if (band_.significant[band_.shape.word(row, x)] == 0) continue;
      const size_t first = band_.shape.cell(row, 32 * x);
      for (size_t i = first; i < first + 32; ++i)
        band_.scaled[i] = static_cast<uint8_t>(std::min(band_.magnitude[i] >> plane_, 0x7fu));
    }
  }

  template <PassKind kKind>
  void blocks() {
    uint32_t x = from_.word;
    for (uint32_t y = from_.row / Band::kBlockRows; y < band_.blockRows(); ++y) {
      for (; x < band_.shape.words(); ++x) {
        block<kKind>(y, x);
        if (io_.stopped()) return;
      }
      x = 0;
    }
  }

  /// The next so many decisions are of the row of 32 columns, or of what begins with it.
  void mayStopAt(uint32_t row, uint32_t word, size_t decisions) {
    if constexpr (requires { io_.mayStopAt(PassPlace{}); }) {
      if (!io_.hasPlenty(decisions)) io_.mayStopAt({row, word, true});
    }
  }

  template <PassKind kKind>
  void block(uint32_t y, uint32_t x) {
    if (band_.tiers != nullptr && ((band_.tierBlocks(y, x) >> tier_) & 1) == 0) return;
    uint8_t& nonzero = band_.block(y, x);
    const auto mine = static_cast<uint8_t>(1u << tier_);
    const uint32_t first = y * Band::kBlockRows,
                   begin = std::max(first, std::exchange(from_.row, 0)),
                   end = std::min(first + Band::kBlockRows, band_.shape.rows);
    if ((nonzero & mine) == 0) {
      if (kKind != PassKind::kRest || isVacant(begin, end, x)) return;
      mayStopAt(begin, x, 1);
      const bool bit = band_.block_nonzero.size() == 1 ||
                       io_.blockBit(models_.block[blockContext(y, x)], y, x, plane_);
      if (io_.stopped()) return;
      if (!bit) return markVisited(begin, end, x);
      nonzero |= mine;
    }
    for (uint32_t row = begin; row < end && !io_.stopped(); ++row) {
      const uint32_t members =
          band_.tiers == nullptr ? band_.shape.valid(x) : band_.members(tier_, row, x);
      if (kKind == PassKind::kRefine) {
        refinementRow(row, x, members);
      } else {
        significanceRow<kKind>(row, x, members);
      }
    }
  }

  /// No coefficient of the block exists.
  bool isVacant(uint32_t begin, uint32_t end, uint32_t x) const {
    if (band_.absent.size() == 0) return false;
    while (begin < end && band_.existing(begin, x) == 0) ++begin;
    return begin == end;
  }

  void markVisited(uint32_t begin, uint32_t end, uint32_t x) {
    for (uint32_t row = begin; row < end; ++row) {
      band_.visited[band_.shape.word(row, x)] |=
          band_.tiers == nullptr ? ~uint32_t{0} : band_.members(tier_, row, x);
    }
  }

  int blockContext(uint32_t y, uint32_t x) const {
    const uint32_t columns = band_.shape.words();
    const auto at = [&](uint32_t by, uint32_t bx) -> int {
      const size_t i = size_t{by} * columns + bx;
      return bx < columns && i < band_.block_nonzero.size() ? band_.block_nonzero[i] != 0 : 0;
    };
    return at(y - 1, x) + at(y + 1, x) + at(y, x - 1) + at(y, x + 1);
  }

  /// Class of the magnitude that hints lead to expect, in units of 2^plane.
  size_t hintClass(uint32_t hint) const {
    constexpr uint32_t kMost = (1u << (BandModels::kHint - 1)) - 1;
    // The width of 2 n + 1, which is never 0, takes no branch.
    return static_cast<size_t>(std::bit_width(2 * std::min(hint >> plane_, kMost) + 1) - 1);
  }

  /// One row of 32 columns while significance is coded.
  struct Row {
    size_t word, first;  ///< indices of the word and of the first cell
    RowHints hints;
    uint32_t todo;         ///< columns still to be coded
    uint32_t near;         ///< columns with a significant neighbour
    Band::Reach reach{};   ///< columns with a significant coefficient further away, ...
    bool reached = false;  ///< ... once a group asks for them
    uint32_t visited;
    LocalSums sums;
  };

  /// members: columns of the tier.
  template <PassKind kKind>
  void significanceRow(uint32_t row, uint32_t x, uint32_t members) {
    Row r;
    r.word = band_.shape.word(row, x);
    r.visited = band_.visited[r.word];
    const uint32_t free = ~band_.significant[r.word] & ~r.visited & members;
    if (free == 0) return;
    r.near = band_.nearSignificant(r.word);
    r.todo = kKind == PassKind::kLikely ? free & r.near : free;
    if (r.todo == 0) return;
    r.first = band_.shape.cell(row, 32 * x);
    r.hints = RowHints(hints_, row, x);
    localSums(band_, r.first, r.sums);
    if (io_.hasPlenty(kRowDecisions)) {
      typename Io::Plenty io(io_);
      significance<kKind>(r, free, io);
    } else {
      mayStopAt(row, x, kRowDecisions);
      significance<kKind>(r, free, io_);
    }
    band_.visited[r.word] = r.visited;
  }

  template <PassKind kKind, class RowIo>
  void significance(Row& r, uint32_t free, RowIo& io) {
    while (r.todo != 0) {
      const auto i = static_cast<uint32_t>(std::countr_zero(r.todo));
      if (kKind == PassKind::kRest && isQuietGroup(r, i)) {
        if (!quietGroup(r, i, io)) return;
        continue;
      }
      r.todo &= r.todo - 1;
      AdaptiveBit& model =
          models_.significance[kLocalClass[r.sums[i]]][hintClass(r.hints.ofOne(i))];
      const bool bit = io.magnitudeBit(model, r.first + i, plane_);
      if (io.stopped() || (bit && !becomeSignificant(r, i, io))) return;
      r.visited |= uint32_t{1} << i;
      if (kKind == PassKind::kLikely && bit) r.todo |= free & (uint32_t{2} << i);
    }
  }

  static bool isQuietGroup(const Row& r, uint32_t i) {
    return i % 4 == 0 && ((r.todo >> i) & 15) == 15 && ((r.near >> i) & 15) == 0;
  }

  /// The context of four quiet columns: 0 if there is something significant at most two columns and
  /// rows away, 1 if at most three, else 2.
  size_t reachClass(Row& r, uint32_t i) const {
    if (!r.reached) r.reach = band_.significantWithin(r.word);
    r.reached = true;
    return ((r.reach.two >> i) & 15) != 0 ? 0 : ((r.reach.three >> i) & 15) != 0 ? 1 : 2;
  }

  /// Four columns from i on: whether any becomes significant, and which is the first.
  template <class RowIo>
  bool quietGroup(Row& r, uint32_t i, RowIo& io) {
    const size_t cell = r.first + i;
    uint32_t done = 4;  // columns that are settled
    const bool any =
        io.groupBit(models_.group[reachClass(r, i)][hintClass(r.hints.ofFour(i))], cell, plane_);
    if (io.stopped()) return false;
    if (any) {
      const bool high = io.placeBit(models_.group_place[0], cell, 1, plane_);
      if (io.stopped()) return false;
      const bool low = io.placeBit(models_.group_place[1 + high], cell, 0, plane_);
      if (io.stopped()) return false;
      done = 2 * high + low + 1;
      if (!becomeSignificant(r, i + done - 1, io)) return false;
    }
    const uint32_t settled = ((uint32_t{1} << done) - 1) << i;
    r.visited |= settled;
    r.todo &= ~settled;
    return true;
  }

  template <class RowIo>
  bool becomeSignificant(Row& r, uint32_t i, RowIo& io) {
    const size_t cell = r.first + i;
    const int8_t* s = band_.sign.data() + cell;
    const auto& near = neighbours_.near;
    int context =
        3 * std::clamp(s[near[0]] + s[near[1]], -1, 1) + std::clamp(s[near[2]] + s[near[3]], -1, 1);
    const bool flip = context < 0;
    if (flip) context = -context;
    const bool negative = io.signBit(models_.sign[static_cast<size_t>(context)], cell, flip);
    if (io.stopped()) return false;
    band_.magnitude[cell] = uint32_t{1} << plane_;
    band_.scaled[cell] = 1;
    band_.sign[cell] = static_cast<int8_t>(1 - 2 * negative);
    band_.significant[r.word] |= uint32_t{1} << i;
    ++band_.tier_states[tier_].significant_count;
    r.near |= uint32_t{2} << i;
    r.reach.two |= uint32_t{6} << i;
    r.reach.three |= uint32_t{14} << i;
    r.sums[i + 1] = static_cast<uint8_t>(r.sums[i + 1] + 2);
    io.learned(cell, 0, uint32_t{1} << plane_, plane_);
    return true;
  }

  void refinementRow(uint32_t row, uint32_t x, uint32_t members) {
    const size_t word = band_.shape.word(row, x);
    const uint32_t todo = band_.significant[word] & ~band_.visited[word] & members;
    if (todo == 0) return;
    const size_t first = band_.shape.cell(row, 32 * x);
    LocalSums sums;
    localSums(band_, first, sums);
    if (io_.hasPlenty(kRowDecisions)) {
      typename Io::Plenty io(io_);
      band_.visited[word] |= refinement(first, todo, sums, io);
    } else {
      mayStopAt(row, x, kRowDecisions);
      band_.visited[word] |= refinement(first, todo, sums, io_);
    }
  }

  /// known: the bits of the magnitude that are known, from the highest. 1, 2 and 3, and more have
  /// contexts of their own.
  size_t refinementContext(uint32_t known, uint8_t sum) const {
    const size_t local = kLocalClass[sum];
    return known == 1 ? local / 2 : known < 4 ? 6 + (local > 6) : 8;
  }

  /// Returns the columns that were refined.
  template <class RowIo>
  uint32_t refinement(size_t first, uint32_t columns, LocalSums& sums, RowIo& io) {
    for (uint32_t todo = columns; todo != 0; todo &= todo - 1) {
      const auto i = static_cast<uint32_t>(std::countr_zero(todo));
      const size_t cell = first + i;
      const size_t context = refinementContext(band_.scaled[cell] / 2u, sums[i]);
      const bool bit = io.refinedBit(models_.refinement[context], cell, plane_);
      if (io.stopped()) return columns & ~todo;
      const uint32_t before = band_.magnitude[cell], after = before | uint32_t{bit} << plane_;
      band_.magnitude[cell] = after;
      band_.scaled[cell] = static_cast<uint8_t>(band_.scaled[cell] | uint8_t{bit});
      sums[i + 1] = static_cast<uint8_t>(sums[i + 1] + 2 * bit);
      io.learned(cell, before, after, plane_);
    }
    return columns;
  }

  /// The most decisions that a row of 32 columns takes: for every four columns a group, a place, a
  /// sign, and three times significance with sign.
  static constexpr size_t kRowDecisions = 8 * 10;

  Band& band_;
  size_t tier_;
  BandModels& models_;
  HintBands hints_;
  Io& io_;
  Neighbours neighbours_;
  int plane_ = 0;
  PassPlace from_;
};

}  // namespace tetrakis::inline track

// SPDX-License-Identifier: Apache-2.0
// Embedded bit-plane coding of one band: the three passes of a plane (after EBCOT, D. Taubman
// 2000), with contexts from local magnitude sums (after F. Auli-Llinas 2011) and from a hint of the
// expected magnitude given by the parent band and by another component. Blocks without a
// significant coefficient cost one decision a plane and no work; coefficients that do not exist
// (Band::absent) cost nothing, nor do blocks without one that does.
//
//   likely   significance where a neighbour is significant (steepest slope)
//   rest     significance everywhere else; empty blocks are first asked as a whole, and so are
//            four columns in a row without a significant neighbour
//   refine   next bit of every coefficient that was significant before this plane
//
// The passes are written once. Io is the encoder's or the decoder's side of a decision:
//   bool magnitudeBit(AdaptiveBit&, size_t cell, int plane)   bit `plane` of the magnitude
//   bool signBit(AdaptiveBit&, size_t cell, bool flip)        negative, xor flip
//   bool blockBit(AdaptiveBit&, uint32_t y, uint32_t x, int plane)   a magnitude of the block
//                                                                    reaches 2^plane
//   bool bandBit(AdaptiveBit&, int plane)                     a magnitude of the band does
//   bool groupBit(AdaptiveBit&, size_t cell, int plane)       one of four cells does
//   bool placeBit(AdaptiveBit&, size_t cell, uint32_t bit, int plane)   bit of the place of the
//                                                                       first of four that does
//   bool stopped()                                            the last decision did not count
//   void learned(size_t cell, uint32_t before, uint32_t after, int plane)   known bits of a
//                                                                           magnitude
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "bitstream/band.hpp"
#include "bitstream/band_models.hpp"

namespace tetrakis {

enum class PassKind : uint8_t { kLikely = 0, kRest = 1, kRefine = 2 };

template <class Io>
class PlanePass {
 public:
  /// parent, component: bands that hint at the magnitudes of this one; may be null.
  PlanePass(Band& band, BandModels& models, const Band* parent, const Band* component, Io& io)
      : band_(band),
        models_(models),
        parent_(parent),
        component_(component),
        io_(io),
        neighbours_(band.shape, band.orientation) {}

  /// Codes one pass of bit-plane `plane` (0..30). Returns early once io.stopped().
  void run(PassKind kind, int plane) {
    plane_ = plane;
    if (kind == PassKind::kLikely) beginPlane();
    if (!band_.nonzero) {
      if (kind != PassKind::kRest || !bandBecomesNonzero()) return;
    }
    for (uint32_t y = 0; y < band_.blockRows(); ++y) {
      for (uint32_t x = 0; x < band_.shape.words(); ++x) {
        block(kind, y, x);
        if (io_.stopped()) return;
      }
    }
  }

 private:
  using Sums = std::array<uint16_t, 33>;  // the last one is never used, only added to

  void beginPlane() {
    band_.plane = plane_;
    if (!band_.nonzero) return;
    band_.clearVisited();
    for (uint32_t row = 0; row < band_.shape.rows; ++row) {
      for (uint32_t x = 0; x < band_.shape.words(); ++x) {
        if (band_.significant[band_.shape.word(row, x)] == 0) continue;
        uint16_t* scaled = band_.scaled.data() + band_.shape.cell(row, 32 * x);
        for (uint32_t i = 0; i < 32; ++i)
          scaled[i] = static_cast<uint16_t>(scaled[i] < 0x4000 ? 2 * scaled[i] : scaled[i]);
      }
    }
  }

  bool bandBecomesNonzero() {
    const bool bit = io_.bandBit(models_.band, plane_);
    band_.nonzero = bit && !io_.stopped();
    return band_.nonzero;
  }

  void block(PassKind kind, uint32_t y, uint32_t x) {
    uint8_t& nonzero = band_.block(y, x);
    const uint32_t begin = y * Band::kBlockRows,
                   end = std::min(begin + Band::kBlockRows, band_.shape.rows);
    if (!nonzero) {
      if (kind != PassKind::kRest || isVacant(begin, end, x)) return;
      const bool bit = band_.block_nonzero.size() == 1 ||
                       io_.blockBit(models_.block[blockContext(y, x)], y, x, plane_);
      if (io_.stopped()) return;
      if (!bit) return markVisited(begin, end, x);
      nonzero = 1;
    }
    for (uint32_t row = begin; row < end && !io_.stopped(); ++row) {
      switch (kind) {
        case PassKind::kLikely:
          significanceRow<true>(row, x);
          break;
        case PassKind::kRest:
          significanceRow<false>(row, x);
          break;
        case PassKind::kRefine:
          refinementRow(row, x);
          break;
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
      band_.visited[band_.shape.word(row, x)] = ~uint32_t{0};
    }
  }

  int blockContext(uint32_t y, uint32_t x) const {
    const uint32_t columns = band_.shape.words();
    const auto at = [&](uint32_t by, uint32_t bx) -> int {
      const size_t i = size_t{by} * columns + bx;
      return bx < columns && i < band_.block_nonzero.size() ? band_.block_nonzero[i] : 0;
    };
    return at(y - 1, x) + at(y + 1, x) + at(y, x - 1) + at(y, x + 1);
  }

  /// 2 (near) + 1 (far) weighted sums of the known magnitudes around 32 cells, in units of 2^plane.
  void localSums(size_t first, Sums& sums) const {
    const ptrdiff_t row = band_.shape.stride();
    const uint16_t* here = band_.scaled.data() + first;
    const uint16_t *above = here - row, *below = here + row;
    for (ptrdiff_t i = 0; i < 32; ++i) {
      const int near = here[i - 1] + here[i + 1] + above[i] + below[i];
      const int far = above[i - 1] + above[i + 1] + below[i - 1] + below[i + 1];
      const int sum = 2 * near + far;
      sums[static_cast<size_t>(i)] = static_cast<uint16_t>(std::min(sum, 0x7fff));
    }
  }

  /// Expected magnitude: the parent's (same place, one level coarser) and that of the same place in
  /// another component, doubled, in units of 2^plane.
  int hintClass(uint32_t row, uint32_t column) const {
    uint32_t hint = 0;
    if (parent_ != nullptr) hint += parent_->magnitude[parent_->shape.cell(row / 2, column / 2)];
    if (component_ != nullptr) hint += component_->magnitude[component_->shape.cell(row, column)];
    return std::min<int>(std::bit_width((2 * hint) >> plane_), BandModels::kHint - 1);
  }

  /// One row of 32 columns while significance is coded.
  struct Row {
    uint32_t row, column;  ///< of the first cell
    size_t word, first;    ///< indices of the word and of the first cell
    uint32_t todo;         ///< columns still to be coded
    uint32_t near;         ///< columns with a significant neighbour
    uint32_t visited;
    Sums sums;
  };

  template <bool kLikelyOnly>
  void significanceRow(uint32_t row, uint32_t x) {
    Row r;
    r.word = band_.shape.word(row, x);
    r.visited = band_.visited[r.word];
    const uint32_t free = ~band_.significant[r.word] & ~r.visited & band_.shape.valid(x);
    if (free == 0) return;
    r.near = band_.nearSignificant(r.word);
    r.todo = kLikelyOnly ? free & r.near : free;
    if (r.todo == 0) return;
    r.row = row;
    r.column = 32 * x;
    r.first = band_.shape.cell(row, 32 * x);
    localSums(r.first, r.sums);
    while (r.todo != 0) {
      const auto i = static_cast<uint32_t>(std::countr_zero(r.todo));
      if (!kLikelyOnly && isQuietGroup(r, i)) {
        if (!quietGroup(r, i)) break;
        continue;
      }
      r.todo &= r.todo - 1;
      const int local = localClass(r.sums[i]), hint = hintClass(row, r.column + i);
      const bool bit = io_.magnitudeBit(models_.significance[local][hint], r.first + i, plane_);
      if (io_.stopped() || (bit && !becomeSignificant(r, i))) break;
      r.visited |= uint32_t{1} << i;
      if (kLikelyOnly && bit) r.todo |= free & (uint32_t{2} << i);
    }
    band_.visited[r.word] = r.visited;
  }

  static bool isQuietGroup(const Row& r, uint32_t i) {
    return i % 4 == 0 && ((r.todo >> i) & 15) == 15 && ((r.near >> i) & 15) == 0;
  }

  /// Four columns from i on: whether any becomes significant, and which is the first.
  bool quietGroup(Row& r, uint32_t i) {
    const size_t cell = r.first + i;
    uint32_t done = 4;  // columns that are settled
    const bool any = io_.groupBit(models_.group[groupHint(r.row, r.column + i)], cell, plane_);
    if (io_.stopped()) return false;
    if (any) {
      const bool high = io_.placeBit(models_.group_place[0], cell, 1, plane_);
      if (io_.stopped()) return false;
      const bool low = io_.placeBit(models_.group_place[1 + high], cell, 0, plane_);
      if (io_.stopped()) return false;
      done = 2 * high + low + 1;
      if (!becomeSignificant(r, i + done - 1)) return false;
    }
    const uint32_t settled = ((uint32_t{1} << done) - 1) << i;
    r.visited |= settled;
    r.todo &= ~settled;
    return true;
  }

  int groupHint(uint32_t row, uint32_t column) const {
    uint32_t hint = 0;
    if (parent_ != nullptr) {
      const uint32_t* m = parent_->magnitude.data() + parent_->shape.cell(row / 2, column / 2);
      hint |= m[0] | m[1];
    }
    if (component_ != nullptr) {
      const uint32_t* m = component_->magnitude.data() + component_->shape.cell(row, column);
      hint |= m[0] | m[1] | m[2] | m[3];
    }
    return std::min<int>(std::bit_width((2 * hint) >> plane_), BandModels::kHint - 1);
  }

  bool becomeSignificant(Row& r, uint32_t i) {
    const size_t cell = r.first + i;
    const int8_t* s = band_.sign.data() + cell;
    const auto& near = neighbours_.near;
    int context =
        3 * std::clamp(s[near[0]] + s[near[1]], -1, 1) + std::clamp(s[near[2]] + s[near[3]], -1, 1);
    const bool flip = context < 0;
    if (flip) context = -context;
    const bool negative = io_.signBit(models_.sign[context], cell, flip);
    if (io_.stopped()) return false;
    band_.magnitude[cell] = uint32_t{1} << plane_;
    band_.scaled[cell] = 1;
    band_.sign[cell] = negative ? -1 : 1;
    band_.significant[r.word] |= uint32_t{1} << i;
    r.near |= uint32_t{2} << i;
    r.sums[i + 1] = static_cast<uint16_t>(r.sums[i + 1] + 2);
    io_.learned(cell, 0, uint32_t{1} << plane_, plane_);
    return true;
  }

  void refinementRow(uint32_t row, uint32_t x) {
    const size_t word = band_.shape.word(row, x);
    uint32_t todo = band_.significant[word] & ~band_.visited[word];
    if (todo == 0) return;
    const size_t first = band_.shape.cell(row, 32 * x);
    Sums sums;
    localSums(first, sums);
    uint32_t visited = band_.visited[word];
    while (todo != 0) {
      const auto i = static_cast<uint32_t>(std::countr_zero(todo));
      todo &= todo - 1;
      const size_t cell = first + i;
      const uint32_t known = band_.scaled[cell] / 2;
      const int local = localClass(sums[i]);
      const int context = known == 1 ? local / 2 : known < 4 ? 6 + (local > 6) : 8;
      const bool bit = io_.magnitudeBit(models_.refinement[context], cell, plane_);
      if (io_.stopped()) break;
      visited |= uint32_t{1} << i;
      const uint32_t before = band_.magnitude[cell], after = before | uint32_t{bit} << plane_;
      band_.magnitude[cell] = after;
      band_.scaled[cell] = static_cast<uint16_t>(band_.scaled[cell] | uint16_t{bit});
      sums[i + 1] = static_cast<uint16_t>(sums[i + 1] + 2 * bit);
      io_.learned(cell, before, after, plane_);
    }
    band_.visited[word] = visited;
  }

  Band& band_;
  BandModels& models_;
  const Band* parent_;
  const Band* component_;
  Io& io_;
  Neighbours neighbours_;
  int plane_ = 0;
};

}  // namespace tetrakis

// SPDX-License-Identifier: Apache-2.0
// ValidityPass codes a mask, which says which samples of a height field exist, or which texels can
// be seen. It codes the mask level by level of the 4-8 lattice, so that any prefix of the codeword
// gives the whole mask, at a resolution that grows with its length. Contexts are made of known
// neighbours, after JBIG (ITU-T T.82, progressive templates):
//
//   near     the 4 coarser vertices next to the vertex: diagonal ones for a centre, along the
//            axes for a midpoint; 16 patterns
//   causal   2 vertices of its own level that came before: (-2s, 0) and (0, -2s) for a centre,
//            (-s, -s) and (s, -s) for a midpoint; 4 patterns
//   ring     how many of the 8 coarser vertices at sqrt 5 times the distance are valid; 5 classes
//
// On coasts of five terrains these 320 contexts take 0.8 to 1.0 of the bytes that a raster template
// of 12 samples takes, and 0.2 to 0.5 of those that Deflate takes. Contexts of the 12 coarser
// neighbours one by one take 10 to 25 % more.
//
// Where all neighbours of vertices that follow each other in a row are alike, these are decided in
// one run: a sample in a wide area takes a small part of the time of one at its border.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "base/bit_plane.hpp"
#include "base/plane.hpp"
#include "bitstream/coder/adaptive_bit.hpp"
#include "codec/lattice/levels.hpp"
#include "codec/lattice/row_surroundings.hpp"

namespace tetrakis::inline lattice {

/// Samples of one row of the plane at equal distances.
struct SampleLine {
  uint32_t x, y;   ///< of the first
  int log2;        ///< they lie 2^log2 apart
  uint32_t count;  ///< up to kWordBits
};

/// Which samples of a line are marked, bit by bit. marks: null: all.
inline uint64_t marksOf(const BitPlane* marks, const SampleLine& line) {
  if (marks == nullptr) return lowBits(line.count);
  const uint64_t bits = marks->every(line.log2, line.x, line.y);
  const uint32_t half = kWordBits / 2;
  if (line.count <= half) return bits & lowBits(line.count);
  const uint32_t further = line.x + (half << line.log2);
  return (bits | uint64_t{marks->every(line.log2, further, line.y)} << half) & lowBits(line.count);
}

/// Levels of samples between the mask of a group of levels and that of the next.
inline constexpr uint32_t kFinerLevels = 3;

/// Runs over all vertices once. Io is the encoder's or the decoder's side of decisions:
///   uint64_t asked(const SampleLine&)            which samples take one; the others are void
///   bool bit(AdaptiveBit&, size_t sample)        the sample is valid
///   uint32_t run(AdaptiveBit&, bool valid, uint32_t most)
///                                                takes decisions while they are `valid`, at most
///                                                so many, and returns how many; encoders: none
///   bool stopped()                               the last decision did not count
///   uint64_t otherwise(uint64_t asked, uint64_t majority)
///                                                what samples are whose decision does not count
/// majority: what most of the near neighbours are, valid if as many are valid as not; of roots,
/// valid.
template <class Io>
class ValidityPass {
 public:
  ValidityPass(Extent plane, Io& io) : plane_(plane), io_(io) {}

  /// Returns which samples are valid.
  BitPlane run() {
    const uint32_t depth = depthOf(BorderRule::kClipped, plane_.width, plane_.height);
    return refine(roots(uint32_t{1} << depth), depth);
  }

  /// The same where the samples at multiples of 2^depth are known.
  BitPlane refine(BitPlane known, uint32_t depth) {
    assert(known.extent() == latticeOf(uint32_t{1} << depth));
    for (uint32_t k = depth; k-- > 0;) {
      log2_ = static_cast<int>(k);
      LatticePlanes planes(std::move(known), latticeOf(uint32_t{1} << k));
      const uint32_t rows = planes.size().height;
      for (uint32_t y = 1; y < rows; y += 2) codeRow(planes, centre_, centres_, y);
      for (uint32_t y = 0; y < rows; ++y)
        codeRow(planes, y % 2 == 0 ? horizontal_ : vertical_, midpoints_, y);
      known = planes.joined();
    }
    return known;
  }

 private:
  static constexpr std::array<uint8_t, RowKind::kRing + 1> kRingClass = {0, 1, 1, 2, 2, 2, 3, 3, 4};
  static constexpr size_t kRingClasses = 5;
  using Models = std::array<AdaptiveBit, (1 << RowKind::kNear) * 4 * kRingClasses>;

  static size_t contextOf(const Around& around) {
    return (around.near * 4 + around.causal) * kRingClasses + kRingClass[around.ring];
  }

  /// The columns and rows of the lattice of a step.
  Extent latticeOf(uint32_t step) const {
    return {multiplesAlong(BorderRule::kClipped, plane_.width, step),
            multiplesAlong(BorderRule::kClipped, plane_.height, step)};
  }

  BitPlane roots(uint32_t step) {
    BitPlane known(latticeOf(step));
    AdaptiveBit model;
    for (uint32_t y = 0; y < known.extent().height; ++y) {
      for (uint32_t x = 0; x < known.extent().width; ++x) {
        const size_t sample = (size_t{y} * plane_.width + x) * step;
        const uint64_t asked = io_.asked({x * step, y * step, 0, 1});
        if (asked != 0) known.row(y)[0] |= decide(model, sample, true) << x;
      }
    }
    return known;
  }

  uint64_t decide(AdaptiveBit& model, size_t sample, bool majority) {
    const bool bit = io_.bit(model, sample);
    return io_.stopped() ? io_.otherwise(1, majority) : bit;
  }

  /// y: of the lattice.
  void codeRow(LatticePlanes& planes, const RowKind& kind, Models& models, uint32_t y) {
    const uint32_t columns = (planes.size().width + 1 - kind.parity.x) / 2;
    for (uint32_t k = 0; k * kWordBits < columns; ++k) {
      const uint32_t x = 2 * k * kWordBits + kind.parity.x;
      const SampleLine line{x << log2_, y << log2_, log2_ + 1,
                            std::min(columns - k * kWordBits, kWordBits)};
      const RowSurroundings around(planes, kind, y, k);
      const uint64_t asked = io_.asked(line), all = lowBits(line.count);
      uint64_t& valid = planes.of(kind.parity).row(y / 2)[k];
      if (io_.stopped() && around.inside() == all) {
        valid = io_.otherwise(asked, around.majority());
      } else {
        codeVertices(around, asked, line, models, valid);
      }
    }
  }

  /// asked: which vertices of the line take a decision. valid: their word, so far 0.
  void codeVertices(const RowSurroundings& around, uint64_t asked, const SampleLine& line,
                    Models& models, uint64_t& valid) {
    while (asked != 0) {
      auto i = static_cast<uint32_t>(std::countr_zero(asked));
      const bool before = around.before(i);
      const auto most = static_cast<uint32_t>(std::countr_one((around.alike(before) & asked) >> i));
      const uint32_t run = most > 0 ? io_.run(models[before ? kAllValid : 0], before, most) : 0;
      if (before) valid |= lowBits(run) << i;
      i += run;
      if (run == 0 || run < most) {
        const Around known = around.at(i);
        const size_t sample = size_t{line.y} * plane_.width + line.x + (i << line.log2);
        valid |= decide(models[contextOf(known)], sample, known.majority) << i;
        ++i;
      }
      asked &= ~lowBits(i);
    }
  }

  /// The context of vertices all of whose neighbours are valid.
  static constexpr size_t kAllValid = Models().size() - 1;

  Extent plane_;
  Io& io_;
  int log2_ = 0;  ///< of the step of the lattice
  const RowKind centre_{{1, 1}}, horizontal_{{1, 0}}, vertical_{{0, 1}};
  Models centres_, midpoints_;
};

/// One side of the decisions of a mask that comes late, when it is known which samples are lifted:
/// only these take decisions, all others are void. A sample whose decision does not count is taken
/// to be valid: coarser vertices say little of the single holes between them.
template <class Io>
class LateMaskIo {
 public:
  /// lifted: null: all are.
  LateMaskIo(Io& io, const BitPlane* lifted) : io_(io), lifted_(lifted) {}
  uint64_t asked(const SampleLine& line) const { return marksOf(lifted_, line); }
  bool bit(AdaptiveBit& model, size_t sample) { return io_.bit(model, sample); }
  uint32_t run(AdaptiveBit& model, bool valid, uint32_t most) {
    return io_.run(model, valid, most);
  }
  bool stopped() const { return io_.stopped(); }
  uint64_t otherwise(uint64_t asked, uint64_t) const { return asked; }

 private:
  Io& io_;
  const BitPlane* lifted_;
};

// decodeValidity() decodes any prefix of the codeword of a mask to the samples that are valid.

/// What decoding a mask takes at most, the mask itself included: before its last lattice is joined.
inline uint64_t validityBytes(Extent plane) {
  return BitPlane::bytesOf(plane) +
         4 * BitPlane::bytesOf({plane.width / 2 + 1, plane.height / 2 + 1});
}

/// Returns which samples of the plane are valid; the others are void. codeword: any prefix of a
/// validity codeword; an empty one says that every sample is valid. Safe on any bytes.
BitPlane decodeValidity(std::span<const uint8_t> codeword, Extent plane);

/// The same of a mask that comes late, when it is known which samples are lifted: all others are
/// void. Lifted samples of which the codeword does not tell are taken to be valid.
BitPlane decodeLateValidity(std::span<const uint8_t> codeword, Extent plane,
                            const SharedBits& lifted);

/// The same where every 8th sample of every 8th row is known, as a plane of its own: the mask of a
/// region of one group of levels, above that of the group before (docs/FORMAT.md, section 5.3).
BitPlane decodeFinerValidity(std::span<const uint8_t> codeword, Extent plane, BitPlane coarse);

/// Every 8th sample of every 8th row of a plane.
BitPlane coarseMarks(const BitPlane& marks);

// encodeValidity() encodes the mask of the valid samples of a plane as a codeword.

/// Returns the codeword of a mask, which has one byte or more. valid: 1 where a sample is valid, 0
/// where it is void. The whole codeword gives the mask back whatever bytes follow it.
std::vector<uint8_t> encodeValidity(const PlaneView<const uint8_t>& valid);

/// The same of a plane of which nobody holds a byte for each sample.
std::vector<uint8_t> encodeValidityBits(const BitPlane& valid);

/// The same for decoders that know coarseMarks() of the mask. Empty: they need nothing more.
std::vector<uint8_t> encodeFinerValidity(const BitPlane& valid);

/// The same of a mask that comes late. lifted: marks at least the valid samples.
std::vector<uint8_t> encodeLateValidity(const PlaneView<const uint8_t>& valid, Mask lifted);

}  // namespace tetrakis::inline lattice

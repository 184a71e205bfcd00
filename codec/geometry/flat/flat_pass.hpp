// SPDX-License-Identifier: Apache-2.0
// FlatMaskIo and FlatHeightsPass code flat areas, for both sides: a mask of the lattice says which
// samples are flat (codec/lattice/validity.hpp; voids are not, without a decision); then
// follows the height of each area. Inlets of one sea and ponds along one canal share a height, so
// the eight latest heights that differ are kept, the last one first. A height is one of these,
// named by its place; or it is new: the difference to the last one, its number of bits in unary,
// then the bits below the highest.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/plane.hpp"
#include "bitstream/coder/adaptive_bit.hpp"
#include "codec/lattice/validity.hpp"

namespace tetrakis::inline flat {

/// FlatMaskIo is the side of ValidityPass for the mask of flat samples. Io: as below, and
///   uint32_t run(AdaptiveBit&, bool answer, uint32_t most)   as of ValidityPass
template <class Io>
class FlatMaskIo {
 public:
  /// flat: the mask that the encoder knows; the decoder ignores it.
  FlatMaskIo(Io& io, const BitPlane* valid, const uint8_t* flat)
      : io_(io), valid_(valid), flat_(flat) {}
  uint64_t asked(const SampleLine& line) const { return marksOf(valid_, line); }
  bool bit(AdaptiveBit& model, size_t sample) {
    return io_.decide(model, flat_ != nullptr && flat_[sample] != 0);
  }
  uint32_t run(AdaptiveBit& model, bool flat, uint32_t most) { return io_.run(model, flat, most); }
  bool stopped() const { return io_.stopped(); }
  uint64_t otherwise(uint64_t, uint64_t majority) const { return majority; }

 private:
  Io& io_;
  const BitPlane* valid_;  ///< null: all are
  const uint8_t* flat_;
};

/// Io is the encoder's or the decoder's side of a decision, of which the encoder knows the answer:
///   bool decide(AdaptiveBit&, bool answer)   bool even(bool answer)   at even odds
///   bool stopped()                           the last decision did not count
template <class Io>
class FlatHeightsPass {
 public:
  explicit FlatHeightsPass(Io& io) : io_(io) {}

  /// heights: in the encoder those of the areas, in the decoder as many zeros, which run()
  /// replaces. Behind the first decision that does not count they mean nothing.
  void run(std::vector<int32_t>& heights) {
    for (int32_t& height : heights) {
      if (io_.stopped()) return;
      height = next(height);
    }
  }

 private:
  static constexpr size_t kRecent = 8;
  static constexpr int kMostBits = 32;

  int32_t next(int32_t ours) {
    size_t place = 0;
    while (place < known_ && !io_.decide(hit_[place], recent_[place] == ours)) {
      if (io_.stopped()) return 0;
      ++place;
    }
    if (place == known_) {
      const uint32_t last = static_cast<uint32_t>(known_ > 0 ? recent_[0] : 0);
      const int32_t height =
          static_cast<int32_t>(last + difference(static_cast<uint32_t>(ours) - last));
      if (known_ < kRecent) ++known_;
      place = known_ - 1;
      recent_[place] = height;
    }
    const auto end = recent_.begin() + static_cast<ptrdiff_t>(place);
    std::rotate(recent_.begin(), end, end + 1);
    return recent_[0];
  }

  /// Modulo 2^32.
  uint32_t difference(uint32_t ours) {
    const bool our_sign = ours >> 31 != 0;
    const uint32_t our_magnitude = our_sign ? 0 - ours : ours;
    const int our_bits = static_cast<int>(std::bit_width(our_magnitude));
    int bits = 0;
    while (bits < kMostBits && io_.decide(bits_[static_cast<size_t>(bits)], our_bits > bits)) {
      if (io_.stopped()) return 0;
      ++bits;
    }
    if (bits == 0) return 0;
    uint32_t magnitude = 1;
    for (int position = bits - 2; position >= 0; --position)
      magnitude = 2 * magnitude + io_.even((our_magnitude >> position) & 1);
    return io_.even(our_sign) ? 0 - magnitude : magnitude;
  }

  Io& io_;
  std::array<int32_t, kRecent> recent_{};
  size_t known_ = 0;
  std::array<AdaptiveBit, kRecent> hit_;
  std::array<AdaptiveBit, kMostBits> bits_;
};

}  // namespace tetrakis::inline flat

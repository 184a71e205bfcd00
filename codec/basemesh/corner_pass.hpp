// SPDX-License-Identifier: Apache-2.0
// CornerPass codes the places of the corners of a base mesh, patch by patch, each as its difference
// from what is expected: the fourth corner of a parallelogram whose other corners are known (C.
// Touma and C. Gotsman, "Triangle mesh compression", 1998), or the straight continuation of an edge
// of the patch behind.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <vector>

#include "bitstream/coder/adaptive_bit.hpp"
#include "codec/basemesh/base_mesh.hpp"

namespace tetrakis::inline basemesh {

/// Io: as of coder/value_table_pass.hpp; a decision that does not count is false.
template <class Io>
class CornerPass {
 public:
  CornerPass(Io& io, const Forest& forest, int bits)
      : io_(io), forest_(forest), owners_(cornerOwners(forest)), bits_(bits) {}

  /// corners: of the encoder those of a BaseMesh; of the decoder as many of any value.
  void run(std::vector<Cell>& corners) {
    for (uint32_t corner = 0; corner < corners.size(); ++corner) {
      if (owners_[corner] == corner) {
        const Cell expected = expectedAt(corner, corners);
        for (size_t axis = 0; axis < 3; ++axis) {
          const int32_t difference = next(corners[corner][axis] - expected[axis], axis);
          corners[corner][axis] = (expected[axis] + difference) & mask();
        }
        latest_ = corners[corner];
      } else {
        corners[corner] = corners[owners_[corner]];
      }
    }
  }

 private:
  static constexpr int kModelledBits = 2;  ///< below the highest bit of a difference

  int32_t mask() const { return static_cast<int32_t>((uint32_t{1} << bits_) - 1); }

  /// Halves are rounded up.
  static int32_t roundedQuotient(int32_t sum, int32_t count) {
    const int32_t doubled = 2 * sum + count, divisor = 2 * count;
    return doubled / divisor - (doubled % divisor < 0 ? 1 : 0);
  }

  static uint32_t turned(uint32_t corner, uint32_t steps) {
    return corner - corner % Forest::kSides + (corner + steps) % Forest::kSides;
  }

  /// The place of a corner if it is known before that of `corner`.
  std::optional<Cell> known(uint32_t wanted, uint32_t corner, const std::vector<Cell>& corners) {
    if (owners_[wanted] >= corner) return {};
    return corners[owners_[wanted]];
  }

  /// The corner that follows on the corner beside `corner` along a straight edge: beyond the side
  /// of the patch that lies opposite, clockwise or not.
  std::optional<Cell> continued(uint32_t corner, bool clockwise, const std::vector<Cell>& corners) {
    const uint32_t beside = turned(corner, clockwise ? 1 : 3);
    const uint32_t other = forest_.sides()[turned(corner, clockwise ? 1 : 2)];
    if (other == Forest::kBorder) return {};
    const auto near = known(beside, corner, corners);
    const auto far = known(turned(other, clockwise ? 2 : 3), corner, corners);
    if (!near || !far) return {};
    Cell place;
    for (size_t axis = 0; axis < 3; ++axis) place[axis] = 2 * (*near)[axis] - (*far)[axis];
    return place;
  }

  Cell expectedAt(uint32_t corner, const std::vector<Cell>& corners) {
    const auto a = known(turned(corner, 1), corner, corners);
    const auto b = known(turned(corner, 3), corner, corners);
    const auto opposite = known(turned(corner, 2), corner, corners);
    const auto after_a = continued(corner, true, corners);
    const auto after_b = continued(corner, false, corners);
    Cell sum{};
    int32_t count = 0;
    const auto add = [&](const Cell& place, int32_t weight) {
      for (size_t axis = 0; axis < 3; ++axis) sum[axis] += weight * place[axis];
      count += weight;
    };
    if (a && b && opposite) {
      Cell place;
      for (size_t axis = 0; axis < 3; ++axis)
        place[axis] = (*a)[axis] + (*b)[axis] - (*opposite)[axis];
      add(place, 2);
    }
    if (after_a) add(*after_a, 1);
    if (after_b) add(*after_b, 1);
    if (count == 0) return a ? *a : b ? *b : latest_;
    for (int32_t& value : sum) value = std::clamp(roundedQuotient(value, count), 0, mask());
    return sum;
  }

  /// Its number of bits in unary, the bits below the highest, and its sign.
  int32_t next(int32_t difference, size_t axis) {
    const auto magnitude = static_cast<uint32_t>(std::abs(difference));
    const int wanted = static_cast<int>(std::bit_width(magnitude));
    auto& models =
        more_[std::min<size_t>((bits_seen_[0] + bits_seen_[1] + bits_seen_[2] + 1) / 3, 15)];
    int bits = 0;
    while (bits < bits_ && io_.decide(models[static_cast<size_t>(bits)], wanted > bits)) ++bits;
    uint32_t value = bits > 0 ? 1 : 0;
    for (int position = bits - 2; position >= 0; --position) {
      const bool answer = (magnitude >> position) & 1;
      const bool modelled = value < 1u << kModelledBits;
      const bool bit =
          modelled ? io_.decide(high_[static_cast<size_t>(bits)][value], answer) : io_.even(answer);
      value = value << 1 | uint32_t{bit};
    }
    bits_seen_[axis] = static_cast<size_t>(bits);
    const bool negative = value > 0 && io_.even(difference < 0);
    return negative ? -static_cast<int32_t>(value) : static_cast<int32_t>(value);
  }

  Io& io_;
  const Forest& forest_;
  std::vector<uint32_t> owners_;
  int bits_;
  Cell latest_{};
  std::array<size_t, 3> bits_seen_{};  ///< of the latest difference of each axis
  std::array<std::array<AdaptiveBit, 24>, 16> more_;
  std::array<std::array<AdaptiveBit, 1 << kModelledBits>, 24> high_;
};

}  // namespace tetrakis::inline basemesh

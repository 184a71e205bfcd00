// SPDX-License-Identifier: Apache-2.0
// CornerPass codes the places of the corners of a base mesh, patch by patch, each as its difference
// from what is expected: the fourth corner of a parallelogram whose other corners are known (C.
// Touma and C. Gotsman, "Triangle mesh compression", 1998), or the straight continuation of an edge
// of the patch behind.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "bitstream/coder/place_coder.hpp"
#include "codec/basemesh/base_mesh.hpp"

namespace tetrakis::inline basemesh {

/// Io: as of coder/value_table_pass.hpp; a decision that does not count is false.
template <class Io>
class CornerPass {
 public:
  CornerPass(Io& io, const Forest& forest, int bits)
      : io_(io),
        forest_(forest),
        owners_(cornerOwners(forest)),
        coder_(bits),
        bits_(owners_.size()) {}

  /// corners: of the encoder those of a BaseMesh; of the decoder as many of any value.
  void run(std::vector<Cell>& corners) {
    for (uint32_t corner = 0; corner < corners.size(); ++corner) {
      if (owners_[corner] == corner) {
        bits_[corner] = coder_.pass(io_, foreseenAt(corner, corners), corners[corner]);
        latest_ = corner;
      } else {
        corners[corner] = corners[owners_[corner]];
      }
    }
  }

 private:
  using Coder = PlaceCoder<3>;

  static uint32_t turned(uint32_t corner, uint32_t steps) {
    return corner - corner % Forest::kSides + (corner + steps) % Forest::kSides;
  }

  /// The owner of a corner, if its place is known before that of `corner`.
  std::optional<uint32_t> known(uint32_t wanted, uint32_t corner) const {
    if (owners_[wanted] >= corner) return {};
    return owners_[wanted];
  }

  /// The corner behind that beside `corner` on a straight edge: beyond the side of the patch that
  /// lies opposite, clockwise or not.
  std::optional<uint32_t> behind(uint32_t corner, bool clockwise) const {
    const uint32_t other = forest_.sides()[turned(corner, clockwise ? 1 : 2)];
    if (other == Forest::kBorder) return {};
    return known(turned(other, clockwise ? 2 : 3), corner);
  }

  Coder::Foreseen foreseenAt(uint32_t corner, const std::vector<Cell>& corners) const {
    const auto a = known(turned(corner, 1), corner), b = known(turned(corner, 3), corner);
    const auto opposite = known(turned(corner, 2), corner);
    const auto behind_a = behind(corner, true), behind_b = behind(corner, false);
    std::array<int64_t, 3> sum{};
    int64_t count = 0;
    const auto add = [&](uint32_t of, int64_t weight) {
      for (size_t axis = 0; axis < 3; ++axis) sum[axis] += weight * corners[of][axis];
      count += weight;
    };
    Coder::Foreseen out;
    for (const auto& nearby : {a, b, opposite, behind_a, behind_b})
      if (nearby) out.add(bits_[*nearby]);
    if (a && b && opposite) {
      add(*a, 2);
      add(*b, 2);
      add(*opposite, -2);
    }
    for (const auto& [near, far] : {std::pair(a, behind_a), std::pair(b, behind_b)}) {
      if (!near || !far) continue;
      add(*near, 2);
      add(*far, -1);
    }
    out.foretellers = static_cast<size_t>(std::min<int64_t>(count, 3));
    if (count == 0 && corner > 0) add(a ? *a : b ? *b : latest_, 1);
    for (size_t axis = 0; axis < 3 && count > 0; ++axis)
      out.expected[axis] = static_cast<int32_t>(
          std::clamp<int64_t>(roundedMean(sum[axis], count), 0, coder_.most()));
    return out;
  }

  Io& io_;
  const Forest& forest_;
  std::vector<uint32_t> owners_;
  Coder coder_;
  uint32_t latest_ = 0;            ///< owner that was told last
  std::vector<Coder::Bits> bits_;  ///< of the differences of owners
};

}  // namespace tetrakis::inline basemesh

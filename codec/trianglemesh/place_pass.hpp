// SPDX-License-Identifier: Apache-2.0
// PlacePass codes the places of vertices, each as its difference from the mean of the places where
// triangles beside it expect it: behind a side of a known triangle, as the fourth corner of a
// parallelogram (C. Touma and C. Gotsman, "Triangle mesh compression", 1998).
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "bitstream/coder/place_coder.hpp"
#include "codec/trianglemesh/corner_fans.hpp"
#include "codec/trianglemesh/vertex_order.hpp"

namespace tetrakis::inline trianglemesh {

/// Io: as of coder/value_table_pass.hpp; a decision that does not count is false.
template <class Io>
class PlacePass {
 public:
  /// sides, fans: outlive this.
  PlacePass(Io& io, const std::vector<uint32_t>& sides, const CornerFans& fans, int bits)
      : io_(io), sides_(sides), fans_(fans), coder_(bits), told_(fans.first.size()) {}

  /// places: of the encoder those of the mesh; of the decoder as many of any value.
  void run(std::vector<Place>& places) {
    latest_.fill(coder_.most() / 2);
    for (const uint32_t v : vertexOrder(sides_, fans_)) {
      const Coder::Bits bits = coder_.pass(io_, foreseenOf(v, places), places[v]);
      told_[v] = {true, bits};
      latest_ = places[v];
    }
  }

 private:
  using Coder = PlaceCoder<3>;
  struct Told {
    bool is_known = false;
    Coder::Bits bits{};
  };

  /// The sum of some places, and how many these are.
  struct Sum {
    std::array<int64_t, 3> of_axes{};
    int64_t count = 0;

    void add(const Place& place, int64_t weight) {
      for (size_t axis = 0; axis < 3; ++axis) of_axes[axis] += weight * place[axis];
      count += weight;
    }
  };

  Coder::Foreseen foreseenOf(uint32_t v, const std::vector<Place>& places) const {
    Sum opposite, beside;
    Coder::Foreseen out;
    visitFan(sides_, fans_.first[v], [&](uint32_t corner) {
      const std::array<uint32_t, 2> ends = {fans_.of_corner[after(corner)],
                                            fans_.of_corner[before(corner)]};
      bool all = true;
      for (const uint32_t end : ends) {
        all = all && told_[end].is_known;
        if (!told_[end].is_known) continue;
        beside.add(places[end], 1);
        out.add(told_[end].bits);
      }
      const uint32_t behind = sides_[after(corner)];
      if (behind == kBorder || !all) return;
      const uint32_t far = fans_.of_corner[before(behind)];
      if (!told_[far].is_known) return;
      for (const uint32_t end : ends) opposite.add(places[end], 1);
      opposite.add(places[far], -1);
    });
    out.foretellers = static_cast<size_t>(std::min<int64_t>(opposite.count, 3));
    out.expected = meanOf(opposite.count > 0 ? opposite : beside);
    return out;
  }

  Place meanOf(const Sum& sum) const {
    if (sum.count == 0) return latest_;
    Place mean;
    for (size_t axis = 0; axis < 3; ++axis)
      mean[axis] = static_cast<int32_t>(
          std::clamp<int64_t>(roundedMean(sum.of_axes[axis], sum.count), 0, coder_.most()));
    return mean;
  }

  Io& io_;
  const std::vector<uint32_t>& sides_;
  const CornerFans& fans_;
  Coder coder_;
  Place latest_{};
  std::vector<Told> told_;  ///< of each vertex
};

}  // namespace tetrakis::inline trianglemesh

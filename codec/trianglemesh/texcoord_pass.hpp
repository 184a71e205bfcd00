// SPDX-License-Identifier: Apache-2.0
// TexcoordPass codes where wedges lie on a texture: each is expected where its triangles would lie
// if the texture were a map that keeps angles (after M. Isenburg and J. Snoeyink, "Compressing
// texture coordinates with selective linear predictions", 2003).
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "bitstream/coder/place_coder.hpp"
#include "codec/trianglemesh/corner_fans.hpp"
#include "codec/trianglemesh/flat_triangle.hpp"
#include "codec/trianglemesh/vertex_order.hpp"

namespace tetrakis::inline trianglemesh {

/// Io: as of coder/value_table_pass.hpp; a decision that does not count is false.
template <class Io>
class TexcoordPass {
 public:
  /// mesh: with places and cut sides; wedges: fans of these. Both outlive this.
  TexcoordPass(Io& io, const CodedTriangles& mesh, const CornerFans& wedges, int bits)
      : io_(io), mesh_(mesh), wedges_(wedges), coder_(bits), told_(wedges.first.size()) {}

  /// texcoords: of the encoder those of the mesh; of the decoder as many of any value.
  void run(std::vector<Texcoord>& texcoords) {
    for (const uint32_t wedge : vertexOrder(mesh_.cut, wedges_)) {
      const Coder::Bits bits = coder_.pass(io_, foreseenOf(wedge), texcoords[wedge]);
      latest_ = texcoords[wedge];
      told_[wedge] = {true, bits, latest_};
    }
  }

 private:
  using Coder = PlaceCoder<2>;
  struct Told {
    bool is_known = false;
    Coder::Bits bits{};
    Texcoord texcoord{};
  };
  struct Sum {
    std::array<int64_t, 2> of_axes{};
    int64_t count = 0;

    void add(const Texcoord& texcoord) {
      for (size_t axis = 0; axis < 2; ++axis) of_axes[axis] += texcoord[axis];
      ++count;
    }
  };

  const Told& at(uint32_t corner) const { return told_[wedges_.of_corner[corner]]; }
  const Place& placeOf(uint32_t corner) const { return mesh_.places[mesh_.vertices[corner]]; }

  Coder::Foreseen foreseenOf(uint32_t wedge) {
    Sum laid, beside;
    Coder::Foreseen out;
    visitFan(mesh_.cut, wedges_.first[wedge], [&](uint32_t corner) {
      for (const uint32_t end : {after(corner), before(corner)}) {
        if (!at(end).is_known) continue;
        out.add(at(end).bits);
        beside.add(at(end).texcoord);
      }
      if (at(after(corner)).is_known && at(before(corner)).is_known) laid.add(laidDown(corner));
    });
    out.foretellers = static_cast<size_t>(std::min<int64_t>(laid.count, 3));
    out.expected = meanOf(laid.count > 0 ? laid : beside);
    return out;
  }

  /// The corner lies beyond its opposite side, as seen from the triangle behind that; where none is
  /// known there, it turns as the latest triangle that is.
  Texcoord laidDown(uint32_t corner) {
    const uint32_t a = after(corner), b = before(corner), behind = mesh_.cut[a];
    if (behind != kBorder && at(before(behind)).is_known) {
      const int64_t turn = turnOf(at(a).texcoord, at(b).texcoord, at(before(behind)).texcoord);
      if (turn != 0) is_mirrored_ = turn > 0;
    }
    return flatCorner({placeOf(a), placeOf(b), placeOf(corner)}, {at(a).texcoord, at(b).texcoord},
                      is_mirrored_);
  }

  Texcoord meanOf(const Sum& sum) const {
    if (sum.count == 0) return latest_;
    Texcoord mean;
    for (size_t axis = 0; axis < 2; ++axis)
      mean[axis] = static_cast<int32_t>(
          std::clamp<int64_t>(roundedMean(sum.of_axes[axis], sum.count), 0, coder_.most()));
    return mean;
  }

  Io& io_;
  const CodedTriangles& mesh_;
  const CornerFans& wedges_;
  Coder coder_;
  Texcoord latest_{};
  bool is_mirrored_ = false;
  std::vector<Told> told_;  ///< of each wedge
};

}  // namespace tetrakis::inline trianglemesh

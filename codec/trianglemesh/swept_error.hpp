// SPDX-License-Identifier: Apache-2.0
// SweptError tells what a collapse costs, in whole numbers. It remembers no earlier mesh, only the
// triangles around the vertex (P. Lindstrom and G. Turk, "Fast and memory efficient polygonal
// simplification", 1998). Three things are added up, each an area times a squared distance:
// - each triangle that stays, and how far the vertex comes to lie from its plane;
// - of a line that the vertex lies on, a border or a seam of the texture, the triangle between the
//   line as it was and as it becomes, and how high that is;
// - a part of the area that is lost, and the way of the vertex. Limbs that are thinner than their
//   triangles are long would cost nothing without it, since their tips move along their sides.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "codec/trianglemesh/collapsing_triangles.hpp"

namespace tetrakis::inline trianglemesh {

/// From one place to another one. Its numbers are below 2^20, and those of a product of two of
/// them below 2^41, so that no sum here takes more than 63 bits.
using PlaceWay = std::array<int64_t, 3>;

inline PlaceWay wayBetween(const Place& from, const Place& to) {
  return {int64_t{to[0]} - from[0], int64_t{to[1]} - from[1], int64_t{to[2]} - from[2]};
}
PlaceWay crossProduct(const PlaceWay& a, const PlaceWay& b);

/// Within a fourteenth; 0 for none alone. A root would take longer than all else here.
uint64_t roughLength(const PlaceWay& way);

/// What 64 bits cannot hold is their largest number.
uint64_t costSum(uint64_t a, uint64_t b);

class SweptError {
 public:
  /// places: of all vertices.
  explicit SweptError(const std::vector<Place>& places);

  /// What it costs that an area lies so far away, in units that 64 bits hold enough of.
  uint64_t areaCost(uint64_t area, uint64_t distance) const;

  /// How long a way is, in the unit of distances: sixteenths of a cell.
  static uint64_t distanceOf(const PlaceWay& way) { return roughLength(way) << kDistanceBits; }

  /// Looks at a star, which outlives all calls up to the next look.
  void look(const CodedTriangles& mesh, const Star& star);

  /// What it costs at least if the centre goes to points[target].
  uint64_t least(size_t target) const;

  /// What it costs, which is no less than `least`, that of the target; nothing if a triangle that
  /// stays turns too far or loses its area, be it in space or on the texture, or if a wedge has no
  /// heir.
  std::optional<uint64_t> cost(size_t target, const WedgeHeirs& heirs, uint64_t least) const;

  /// What it costs if triangles may turn: as if all of them went all the way.
  uint64_t roughCost(size_t target) const;

 private:
  static constexpr int kDistanceBits = 4;

  static uint64_t heightOf(uint64_t body, uint64_t base);
  uint64_t lineCost(size_t from, size_t target) const;
  bool keepsTexture(size_t target, const WedgeHeirs& heirs) const;
  const Texcoord& texcoordOf(uint32_t corner) const {
    return mesh_->texcoords[mesh_->wedges[corner]];
  }
  void findSeams();

  int spare_bits_;  ///< that costs are told without
  const CodedTriangles* mesh_ = nullptr;
  const Star* star_ = nullptr;
  std::vector<PlaceWay> ways_;     ///< from the centre to each point
  std::vector<PlaceWay> normals_;  ///< of each triangle, twice as long as its area
  std::vector<uint64_t> areas_;    ///< twice
  std::vector<size_t> seams_;      ///< points that these lead to from the centre
};

}  // namespace tetrakis::inline trianglemesh

// SPDX-License-Identifier: Apache-2.0
#include "api/collapsed_object.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "codec/trianglemesh/corner_fans.hpp"
#include "codec/trianglemesh/fewer_triangles.hpp"

namespace tetrakis::inline api {
namespace {

using DoublePlace = std::array<double, 3>;

/// Rounds places down to a grid of 2^20 cells along the longest side of the box around some of
/// them, which is what costs of collapses have room for.
class PlaceGrid {
 public:
  PlaceGrid(const GluedTriangles& mesh, const std::vector<DoublePlace>& places) {
    least_.fill(HUGE_VAL);
    DoublePlace most;
    most.fill(-HUGE_VAL);
    for (const uint32_t sample : mesh.samples) {
      for (size_t axis = 0; axis < 3; ++axis) {
        least_[axis] = std::min(least_[axis], places[sample][axis]);
        most[axis] = std::max(most[axis], places[sample][axis]);
      }
    }
    double longest = 0;
    for (size_t axis = 0; axis < 3; ++axis) longest = std::max(longest, most[axis] - least_[axis]);
    int exponent = 0;
    if (std::isfinite(longest)) std::frexp(longest, &exponent);
    finer_ = kBits - exponent;
  }

  Place at(const DoublePlace& place) const {
    Place cell{};
    for (size_t axis = 0; axis < 3; ++axis) {
      constexpr double kMost = (1 << kBits) - 1;
      const double cells = std::ldexp(place[axis] - least_[axis], finer_);
      cell[axis] = cells > 0 ? static_cast<int32_t>(std::floor(std::min(cells, kMost))) : 0;
    }
    return cell;
  }

 private:
  static constexpr int kBits = 20;

  DoublePlace least_;
  int finer_;  ///< 2^this cells in a unit
};

}  // namespace

ObjectVertices collapsedObject(const GluedTriangles& mesh, const std::vector<DoublePlace>& places,
                               uint32_t most, bool textured) {
  static_assert(GluedTriangles::kBorder == kBorder);
  const CornerFans fans = cornerFans(mesh.sides);
  CodedTriangles all;
  all.sides = mesh.sides;
  all.vertices = fans.of_corner;
  const PlaceGrid grid(mesh, places);
  for (const uint32_t corner : fans.first)
    all.places.push_back(grid.at(places[mesh.samples[corner]]));
  const LeftTriangles left = leftTriangles(std::move(all), most);
  ObjectVertices out;
  std::map<std::pair<uint32_t, uint32_t>, uint32_t> numbers;
  for (size_t corner = 0; corner < left.vertices.size(); ++corner) {
    const uint32_t place = mesh.samples[fans.first[left.vertices[corner]]];
    const size_t shown = 3 * size_t{left.triangles[corner / 3]} + corner % 3;
    const uint32_t texel = textured ? mesh.samples[shown] : place;
    const auto [at, is_new] =
        numbers.emplace(std::pair(place, texel), static_cast<uint32_t>(out.places.size()));
    if (is_new) {
      out.places.push_back(place);
      out.texels.push_back(texel);
    }
    out.triangles.push_back(at->second);
  }
  return out;
}

}  // namespace tetrakis::inline api

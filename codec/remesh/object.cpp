// SPDX-License-Identifier: Apache-2.0
#include "codec/remesh/object.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "codec/remesh/quad_forest.hpp"

namespace tetrakis::inline remesh {

namespace {

/// The value, rounded up to so many significant bits: headers leave out the zero bytes behind them.
double roundedUp(double value, int bits) {
  int exponent = 0;
  const double mantissa = std::frexp(value, &exponent);
  return std::ldexp(std::ceil(std::ldexp(mantissa, bits)), exponent - bits);
}

/// A base mesh without corners, whose grid of cells holds all points.
BaseMesh gridAround(const TriangleMesh& mesh, int bits) {
  constexpr int kCellBits = 12;
  const Box box = boxAround(mesh.points);
  const Point extent = box.high - box.low;
  const double longest = std::max({extent[0], extent[1], extent[2]});
  BaseMesh base;
  base.bits = bits;
  // Rounded coordinates and the rounded origin take up to two cells more than the points.
  base.cell = roundedUp(longest / ((1 << bits) - 3), kCellBits);
  if (!(base.cell > 0)) base.cell = 1;
  const double step = std::ldexp(1.0, std::ilogb(base.cell));
  for (size_t axis = 0; axis < 3; ++axis)
    base.origin[axis] = std::floor(box.low[axis] / step) * step;
  return base;
}

/// The cell whose centre is nearest to the point.
Cell cellOf(const BaseMesh& base, const Point& point) {
  Cell cell;
  for (size_t axis = 0; axis < 3; ++axis) {
    const double place = (point[axis] - base.origin[axis]) / base.cell;
    cell[axis] = std::clamp(static_cast<int32_t>(std::floor(place + 0.5)), 0, (1 << base.bits) - 1);
  }
  return cell;
}

/// Tells where a place of a patch lies on the two triangles of its quad.
class PatchMap {
 public:
  PatchMap(const PairedMesh& paired, const QuadForest& forest) : paired_(paired), forest_(forest) {}

  /// x runs along the north side of the patch and y along its west side, both from 0 to 1.
  SurfacePoint at(uint32_t patch, double x, double y) const {
    const auto corner = [&](uint32_t which) { return kPlaces[forest_.quadCorner(patch, which)]; };
    const auto nw = corner(0), ne = corner(1), sw = corner(3);
    const double s = nw[0] + x * (ne[0] - nw[0]) + y * (sw[0] - nw[0]);
    const double t = nw[1] + x * (ne[1] - nw[1]) + y * (sw[1] - nw[1]);
    const Quad& quad = paired_.quads[forest_.quads[patch]];
    if (t >= s) return {quad.triangles[0], {1 - t, t - s, s}};
    return {quad.triangles[1], {1 - s, t, s - t}};
  }

 private:
  /// Coordinates of the four corners of a quad: the first runs along the side from corner 0 to
  /// corner 3, the second along the side from corner 0 to corner 1.
  static constexpr std::array<std::array<double, 2>, 4> kPlaces = {
      {{0, 0}, {0, 1}, {1, 1}, {1, 0}}};

  const PairedMesh& paired_;
  const QuadForest& forest_;
};

}  // namespace

ObjectSource::ObjectSource(const TriangleMesh& mesh, uint32_t fewest)
    : cleaned_(tetrakis::cleaned(mesh)),
      tree_(cleaned_.mesh),
      fewest_(fewest),
      diagonal_(tetrakis::diagonal(cleaned_.mesh)) {}

const MappedDecimation& ObjectSource::decimation() const {
  if (!decimation_) decimation_.emplace(cleaned_.mesh, fewest_);
  return *decimation_;
}

/// A decimated mesh, its triangles paired to quads, and the forest of these.
struct ObjectSource::Quads {
  DecimatedMesh decimated;
  PairedMesh paired;
  QuadForest forest;
};

ObjectSource::Quads ObjectSource::quadsOf(uint32_t base_triangles) const {
  Quads quads;
  quads.decimated = decimation().base(base_triangles);
  quads.paired = paired(quads.decimated.mesh);
  quads.forest = quadForest(quads.paired.quads);
  return quads;
}

CastSurface ObjectSource::castOn(const BaseMesh& base, const Quads& quads) const {
  const PatchMap map(quads.paired, quads.forest);
  return castHeights(base, tree_, [&](uint32_t patch, double x, double y) {
    return decimation().toInput(quads.decimated, onBase(quads.paired, map.at(patch, x, y)));
  });
}

ResampledObject ObjectSource::resampled(const ObjectShape& shape) const {
  const Quads quads = quadsOf(shape.base_triangles);
  ResampledObject object{gridAround(cleaned_.mesh, shape.position_bits), {}, shape.base_triangles};
  BaseMesh& base = object.base;
  base.forest = std::make_shared<const Forest>(shape.depth, quads.forest.sides);
  for (uint32_t patch = 0; patch < quads.forest.quads.size(); ++patch) {
    const Quad& quad = quads.paired.quads[quads.forest.quads[patch]];
    for (uint32_t corner = 0; corner < Forest::kSides; ++corner) {
      const uint32_t point = quad.corners[quads.forest.quadCorner(patch, corner)];
      base.corners.push_back(cellOf(base, quads.paired.mesh.points[point]));
    }
  }
  object.surface = castOn(base, quads);
  return object;
}

std::vector<SurfacePoint> ObjectSource::placesOn(const ResampledObject& object, int depth) const {
  BaseMesh base = object.base;
  base.forest = std::make_shared<const Forest>(depth, object.base.forest->sides());
  return castOn(base, quadsOf(object.base_triangles)).places;
}

}  // namespace tetrakis::inline remesh

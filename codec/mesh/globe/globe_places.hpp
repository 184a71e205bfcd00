// SPDX-License-Identifier: Apache-2.0
// GlobePlaces takes places of a grid of longitudes and latitudes to points around the centre of a
// globe, with the same bits on every machine.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "codec/cube/cube_sphere.hpp"
#include "codec/mesh/globe/globe_mesh.hpp"

namespace tetrakis::inline globe {

/// An ellipsoid that its poles are the axis of, by its semi-axes.
struct Spheroid {
  double equatorial = 0, polar = 0;
};

/// The point at that height above it whose normal has this direction, of length 1. All in one unit,
/// from the centre.
std::array<double, 3> above(const Spheroid& spheroid, const SpherePoint& up, double height);

/// Of a grid: in degrees, of the first sample and from one to the next, neither step 0.
struct GlobeAxis {
  double first = 0, step = 0;
  uint32_t count = 0;

  double at(double place) const { return first + place * step; }
};

class GlobePlaces {
 public:
  /// longitudes: of columns that go round.
  GlobePlaces(const GlobeAxis& longitudes, const GlobeAxis& latitudes, const Spheroid& spheroid)
      : longitudes_(longitudes), latitudes_(latitudes), spheroid_(spheroid) {}

  /// Whether no row lies beyond a pole.
  bool onGlobe() const;
  /// With the poles that lie at an end of the grid, or less than a row beyond it: there is no data
  /// farther away.
  RoundGrid grid() const;
  /// Seen from above, columns run to the left of rows.
  bool mirrored() const { return (longitudes_.step > 0) == (latitudes_.step > 0); }

  /// What samples of each row cover, those at the equator 1.
  std::vector<float> rowAreas() const;

  /// x towards longitude and latitude 0, y towards longitude 90, z towards the north pole; `height`
  /// along the normal, in the unit of the axes. Of column `count` the same as of column 0.
  std::array<double, 3> at(const GridPlace& place, double height) const;

 private:
  std::optional<double> poleBeyond(double row, double outwards) const;

  GlobeAxis longitudes_, latitudes_;
  Spheroid spheroid_;
};

/// The same of samples of a cube.
class CubeSpheroid {
 public:
  /// forest: of kCubeSides, which outlives this.
  CubeSpheroid(const Forest& forest, const Spheroid& spheroid);

  /// sample: of the raster. What patches share has one place, to the last bit.
  std::array<double, 3> at(uint32_t sample, double height) const;

 private:
  const Forest& forest_;
  Spheroid spheroid_;
  std::vector<double> off_middle_;  ///< of the samples along a side
};

}  // namespace tetrakis::inline globe

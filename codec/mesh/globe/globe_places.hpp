// SPDX-License-Identifier: Apache-2.0
// GlobePlaces takes places of a grid of longitudes and latitudes to points around the centre of a
// globe, with the same bits on every machine.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "codec/mesh/globe/globe_mesh.hpp"

namespace tetrakis::inline globe {

/// An ellipsoid that its poles are the axis of, by its semi-axes.
struct Spheroid {
  double equatorial = 0, polar = 0;
};

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

  /// x towards longitude and latitude 0, y towards longitude 90, z towards the north pole; `height`
  /// along the normal, in the unit of the axes. Of column `count` the same as of column 0.
  std::array<double, 3> at(const GridPlace& place, double height) const;

 private:
  std::optional<double> poleBeyond(double row, double outwards) const;

  GlobeAxis longitudes_, latitudes_;
  Spheroid spheroid_;
};

}  // namespace tetrakis::inline globe

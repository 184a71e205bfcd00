// SPDX-License-Identifier: Apache-2.0
// crsUnit() looks up the units of a coordinate reference system in PROJ's database.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace tetrakis::tools {

struct CrsUnit {
  std::string name;  ///< ours ("m", "ft", "us-ft") where it is one of them, else EPSG's
  double metres = 0;
};

enum class CrsAxis { kHorizontal, kVertical };

/// The unit of an axis of a projected, vertical, compound or three-dimensional CRS given as
/// "EPSG:code", WKT, or its exact name. Nothing if PROJ does not know it, it has no such axis, the
/// axis is no length, or the machine lacks PROJ's database.
std::optional<CrsUnit> crsUnit(const std::string& crs, CrsAxis axis);

/// Whether a unit of so many radians, or metres where somebody wrote it as a length, is a degree.
bool isDegree(double size);

/// Whether PROJ can tell what CRS that is.
bool isKnownCrs(const std::string& crs);

/// How many degrees the unit of the horizontal axes has, 0.9 for a grad; 0 if the CRS is not
/// geographic, or PROJ does not know it.
double degreesPerUnit(const std::string& crs);

/// How many degrees so many radians are, exactly 1 for what isDegree(); 0 if that is no angle.
double degreesIn(double radians);

/// How many degrees the angle with this EPSG code has; 0 if it is none of PROJ's. The degree is
/// known without PROJ's database.
double epsgAngle(uint16_t code);

/// A unit of length by its EPSG code; metres and feet are known without PROJ's database.
std::optional<CrsUnit> epsgUnit(uint16_t code);

}  // namespace tetrakis::tools

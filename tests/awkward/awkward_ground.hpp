// SPDX-License-Identifier: Apache-2.0
// Heights of many kinds: what real terrains are like, and what none is.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "conformance/samples/terrain_samples.hpp"
#include "tests/awkward/dice.hpp"

namespace tetrakis::test {

enum class Kind {
  kGround,
  kHalfFlat,
  kLakes,
  kStripes,
  kTwoValues,
  kChecker,
  kConstant,
  kOutlier,
  kNoise,
  kSparse,
  kFeet,
  kNegativeZeros,
  kGeoid,
  kSquares,
  kMosaic,
  kTurned,
  kTens,
  kBands,
  kNarrow,
  kFacets,
  kCount
};

inline constexpr std::array<const char*, static_cast<size_t>(Kind::kCount)> kKindNames = {
    "ground",  "half flat", "lakes",  "stripes", "two values",     "checker", "constant",
    "outlier", "noise",     "sparse", "feet",    "negative zeros", "geoid",   "squares",
    "mosaic",  "turned",    "tens",   "bands",   "narrow",         "facets"};

/// What a sample type makes of ground whose values are from 0 to 65535.
double scaled(tks_sample sample, double ground);

struct Bounds {
  double low, high;
};

Bounds boundsOf(tks_sample sample);

/// value: one that the type holds.
void storeSample(samples::Raster& raster, size_t i, double value);

/// Heights of any type.
samples::Raster groundOf(Dice& dice, Kind kind, uint32_t width, uint32_t height);

}  // namespace tetrakis::test

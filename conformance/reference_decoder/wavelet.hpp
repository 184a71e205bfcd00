// SPDX-License-Identifier: Apache-2.0
// Reference decoder: subbands of a plane and the inverse wavelet (docs/FORMAT.md, section 7).
#pragma once

#include <cstdint>
#include <vector>

#include "conformance/reference_decoder/stream.hpp"
#include "conformance/reference_decoder/track.hpp"

namespace tetrakis::reference {

/// FORMAT 7, table of filters. Steps in the order of the analysis; the first predicts.
struct Filter {
  int shift, widest;
  std::vector<std::vector<int>> steps;
};

/// Of a level, from 1.
const Filter& filterOf(const WaveletHeader& header, int level);

/// FORMAT 7, "Doubling": the low band of a level is doubled.
bool doublesLow(const WaveletHeader& header, int level);

/// FORMAT 7, "Subbands" and "Places".
struct Subband {
  int level;  ///< LL: the number of levels
  Orientation orientation;
  int rows, columns;
  int splitsX, splitsY;  ///< down to the band's level

  bool highInX() const { return orientation == kHL || orientation == kHH; }
  bool highInY() const { return orientation == kLH || orientation == kHH; }
  int x(int a) const { return highInX() ? (2 * a + 1) << (splitsX - 1) : a << splitsX; }
  int y(int r) const { return highInY() ? (2 * r + 1) << (splitsY - 1) : r << splitsY; }
};

std::vector<Subband> subbandsOf(int width, int height);

/// FORMAT 7, "Norms", without the priority.
int logNormOf(const WaveletHeader& header, const Subband& subband);

/// FORMAT 7, "Fraction": f.
int fractionOf(const WaveletHeader& header, int planes, uint64_t bytes, int level);

/// FORMAT 8.1, "Flat areas". Empty: there are none.
struct Flat {
  std::vector<uint32_t> areas;   ///< of each sample: 0 where it is not held, else 1 + its area
  std::vector<int32_t> heights;  ///< of each area, in steps
};

/// One value for each sample, row by row.
struct Plane {
  int width, height;
  std::vector<int32_t> values;
  std::vector<uint8_t> valid = {};  ///< 1 valid, 0 void; empty: all are valid
  Flat flat = {};

  size_t index(int x, int y) const { return static_cast<size_t>(y) * width + x; }
  int32_t& at(int x, int y) { return values.at(index(x, y)); }
  bool isValid(int x, int y) const { return valid.empty() || valid.at(index(x, y)); }
  /// 0: it is not held; else 1 + its area.
  uint32_t areaOf(int x, int y) const {
    return flat.areas.empty() ? 0 : flat.areas.at(index(x, y));
  }
};

/// FORMAT 7, "Joint lifting": one level, which splits both directions. The low band of the level
/// before has its samples at multiples of the two steps, of a forest in each patch.
struct JointLevel {
  int level, stepX, stepY;
};
bool liftsJointly(const WaveletHeader& header, int level, const Plane& plane);

void synthesiseJointly(const WaveletHeader& header, const JointLevel& of, Plane& plane);

/// The inverse transform, of the levels above the target alone, of values that lie at their places.
/// Levels of flat areas are in units of 2^-f.
void synthesise(const WaveletHeader& header, int target, Plane& plane);

/// FORMAT 7.1: what the inverse transform down to a level has made, as an image of its own.
Plane levelOf(const WaveletHeader& header, int level, const Plane& plane);

}  // namespace tetrakis::reference

// SPDX-License-Identifier: Apache-2.0
// Reference decoder: spatial regions and the tracks of a component (docs/FORMAT.md, section 5.1).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "conformance/reference_decoder/stream.hpp"
#include "conformance/reference_decoder/wavelet.hpp"

namespace tetrakis::reference {

/// FORMAT 5.2: priorities of tiles, row by row; without any all coefficients have priority 0.
struct PriorityMap {
  int width = 0, height = 0, tileLog2 = 0;
  std::vector<int> tiles;

  int columns() const { return ((width - 1) >> tileLog2) + 1; }
  int rows() const { return ((height - 1) >> tileLog2) + 1; }
};

PriorityMap priorityMapOf(const PriorityHeader& header, int width, int height);

/// Which coefficients a track holds.
struct Region {
  bool base;                  ///< LL and every level from firstLevel on, of the whole plane
  int firstLevel, lastLevel;  ///< lastLevel: not of the base
  int64_t x0, y0, x1, y1;     ///< samples; x1 and y1 are outside
};

/// How many groups there are, each of three levels.
int groupsOf(int width, int height, int log2);

/// Each of the patches that lie one below the other has its own; a grid is one patch.
std::vector<Region> regionsOf(int width, int height, int log2, int patches = 1);

/// FORMAT 8.1: the regions of group 0, whose corrections are tracks of their own.
std::vector<Region> finestRegionsOf(int width, int height, int log2, int patches = 1);

/// The rows and columns of a subband whose samples lie in a region.
struct Part {
  Subband subband;
  int top = 0;  ///< the first row of its patch in the raster
  int firstRow = 0, firstColumn = 0, rows = 0, columns = 0;

  int x(int a) const { return subband.x(firstColumn + a); }
  int y(int r) const { return top + subband.y(firstRow + r); }
};

/// Of one plane, by track.
std::vector<std::vector<Part>> partsOf(const Forest& forest, int width, int height,
                                       const RegionHeader& header);

/// The bands of one plane in one track, as they follow `first` others; all but their companions.
std::vector<Band> bandsOf(const WaveletHeader& header, const std::vector<Part>& parts,
                          size_t first);

/// FORMAT 7, "Places", "Forests": which coefficients do not exist.
void markAbsent(const Forest& forest, const std::vector<Part>& parts, const Plane& plane,
                std::span<Band> bands);

/// FORMAT 5.2: the priorities of coefficients, those of a plane of W x H samples.
void setPriorities(const std::vector<Part>& parts, const PriorityMap& map, std::span<Band> bands);

/// FORMAT 7.1: marks the bands that a level does not need.
void dropFiner(const std::vector<Part>& parts, int level, std::span<Band> bands);

/// Of all tracks together.
uint64_t bytesOf(const std::vector<std::span<const uint8_t>>& codewords);

/// Puts the values of bands, in units of 2^-e, to their places.
void place(std::span<const Band> bands, const std::vector<Part>& parts, int e, Plane& plane);

}  // namespace tetrakis::reference

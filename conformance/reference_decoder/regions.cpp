// SPDX-License-Identifier: Apache-2.0
// Reference decoder: spatial regions and the tracks of a component (docs/FORMAT.md, section 5.1).
#include "conformance/reference_decoder/regions.hpp"

#include <algorithm>

namespace tetrakis::reference {
namespace {

constexpr int kGroupLevels = 3;

/// "max(1, floor((W + 2^(s-1)) / 2^s))".
int64_t countOf(int side, int s) {
  return std::max<int64_t>(1, (side + (int64_t{1} << (s - 1))) >> s);
}

/// The regions of group g, of each patch row by row.
std::vector<Region> groupOf(int width, int height, int log2, int g, int patches) {
  const int s = log2 + kGroupLevels * g;
  const int64_t patchRows = height / patches;
  const int64_t columns = countOf(width, s), rows = countOf(height / patches, s);
  std::vector<Region> regions;
  for (int64_t top = 0; top < height; top += patchRows) {
    for (int64_t y = 0; y < rows; ++y) {
      for (int64_t x = 0; x < columns; ++x) {
        regions.push_back({false, kGroupLevels * g + 1, kGroupLevels * (g + 1), x << s,
                           top + (y << s), x == columns - 1 ? width : (x + 1) << s,
                           top + (y == rows - 1 ? patchRows : (y + 1) << s)});
      }
    }
  }
  return regions;
}

}  // namespace

int groupsOf(int width, int height, int log2) {
  int groups = 0;
  for (int s = log2; log2 > 0 && countOf(width, s) * countOf(height, s) > 1; s += kGroupLevels)
    ++groups;
  return groups;
}

std::vector<Region> regionsOf(int width, int height, int log2, int patches) {
  std::vector<std::vector<Region>> groups;
  for (int g = 0; log2 > 0; ++g) {
    std::vector<Region> group = groupOf(width, height, log2, g, patches);
    if (group.size() == static_cast<size_t>(patches)) break;
    groups.push_back(std::move(group));
  }
  const int first = kGroupLevels * static_cast<int>(groups.size()) + 1;
  std::vector<Region> regions = {{true, first, 0, 0, 0, width, height}};
  std::reverse(groups.begin(), groups.end());
  for (const std::vector<Region>& group : groups)
    regions.insert(regions.end(), group.begin(), group.end());
  return regions;
}

std::vector<Region> finestRegionsOf(int width, int height, int log2, int patches) {
  std::vector<Region> regions = regionsOf(width, height, log2, patches);
  std::erase_if(regions, [](const Region& region) { return region.base || region.firstLevel > 1; });
  return regions;
}

namespace {

/// Of a patch whose first row is `top`.
std::vector<Part> partsIn(const std::vector<Subband>& subbands, const Region& region, int top) {
  std::vector<Part> parts;
  for (const Subband& subband : subbands) {
    const bool later = region.base || subband.level <= region.lastLevel;
    const bool held =
        subband.orientation == kLL ? region.base : subband.level >= region.firstLevel && later;
    if (!held) continue;
    Part part;
    part.subband = subband;
    part.top = top;
    const auto left = [&](int a) { return subband.x(a) < region.x0; };
    const auto above = [&](int r) { return top + subband.y(r) < region.y0; };
    while (part.firstColumn < subband.columns && left(part.firstColumn)) ++part.firstColumn;
    while (part.firstRow < subband.rows && above(part.firstRow)) ++part.firstRow;
    while (part.firstColumn + part.columns < subband.columns && part.x(part.columns) < region.x1)
      ++part.columns;
    while (part.firstRow + part.rows < subband.rows && part.y(part.rows) < region.y1) ++part.rows;
    parts.push_back(part);
  }
  return parts;
}

}  // namespace

std::vector<std::vector<Part>> partsOf(const Forest& forest, int width, int height,
                                       const RegionHeader& header) {
  const int rows = height / forest.patches();
  const std::vector<Subband> subbands = subbandsOf(width, rows);
  std::vector<std::vector<Part>> tracks;
  for (const Region& region : regionsOf(width, height, header.log2, forest.patches())) {
    std::vector<Part>& track = tracks.emplace_back();
    for (int top = 0; top < height; top += rows) {
      const bool there = region.base || (region.y0 >= top && region.y0 < top + rows);
      const std::vector<Part> parts = there ? partsIn(subbands, region, top) : std::vector<Part>();
      track.insert(track.end(), parts.begin(), parts.end());
    }
  }
  return tracks;
}

std::vector<Band> bandsOf(const WaveletHeader& header, const std::vector<Part>& parts,
                          size_t first) {
  std::vector<Band> bands;
  for (const Part& part : parts) {
    const Subband& subband = part.subband;
    Band band(part.rows, part.columns, subband.orientation);
    if (!band.empty()) band.logNorm = logNormOf(header, subband);
    if (header.fractionBits == 0 && (subband.orientation == kLL || subband.level > 1))
      band.leastKey = 0;
    band.modelClass = subband.orientation == kLL ? 4 : std::min(subband.level, 4) - 1;
    for (size_t i = 0; i < bands.size() && subband.orientation != kLL; ++i) {
      const Subband& other = parts[i].subband;
      if (other.orientation == subband.orientation && other.level == subband.level + 1)
        band.parent = first + i;
    }
    for (size_t i = 0; i < parts.size() && subband.orientation != kLL; ++i) {
      const Subband& other = parts[i].subband;
      if (parts[i].top == part.top && other.level == subband.level && other.orientation != kLL &&
          other.orientation != subband.orientation)
        band.siblings.push_back(first + i);
    }
    bands.push_back(band);
  }
  return bands;
}

void markAbsent(const Forest& forest, const std::vector<Part>& parts, const Plane& plane,
                std::span<Band> bands) {
  for (size_t i = 0; i < parts.size(); ++i) {
    for (int r = 0; r < parts[i].rows; ++r) {
      for (int a = 0; a < parts[i].columns; ++a) {
        const int x = parts[i].x(a), y = parts[i].y(r);
        const size_t sample = plane.index(x, y);
        bands[i].at(r, a).absent =
            !plane.isValid(x, y) || plane.areaOf(x, y) > 0 || forest.ownerOf(sample) != sample;
      }
    }
  }
}

void dropFiner(const std::vector<Part>& parts, int level, std::span<Band> bands) {
  for (size_t i = 0; i < bands.size(); ++i) {
    const Subband& subband = parts[i].subband;
    bands[i].needed = subband.orientation == kLL || subband.level > level;
  }
}

uint64_t bytesOf(const std::vector<std::span<const uint8_t>>& codewords) {
  uint64_t bytes = 0;
  for (const auto& codeword : codewords) bytes += codeword.size();
  return bytes;
}

void place(std::span<const Band> bands, const std::vector<Part>& parts, int e, Plane& plane) {
  for (size_t i = 0; i < parts.size(); ++i) {
    for (int r = 0; r < parts[i].rows; ++r) {
      for (int a = 0; a < parts[i].columns; ++a)
        plane.at(parts[i].x(a), parts[i].y(r)) = bands[i].value(r, a, e);
    }
  }
}

}  // namespace tetrakis::reference

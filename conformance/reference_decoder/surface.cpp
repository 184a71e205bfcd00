// SPDX-License-Identifier: Apache-2.0
#include "conformance/reference_decoder/surface.hpp"

#include <utility>

namespace tetrakis::reference {

namespace {

/// FORMAT 8.1, "Flat areas": held samples have the heights of their areas, at all mip levels.
void putFlat(const Plane& whole, const Forest& forest, int level, Plane& image) {
  auto value = image.values.begin();
  for (int y = 0; y < whole.height; ++y) {
    for (int x = 0; x < whole.width; ++x) {
      if (!forest.shows(level, x, y)) continue;
      const uint32_t area = whole.areaOf(x, y);
      if (area > 0) *value = whole.flat.heights.at(area - 1);
      ++value;
    }
  }
}

/// FORMAT 7.1: the samples at the places of a level.
Plane placesOf(const Plane& whole, const Forest& forest, int level) {
  Plane image{((whole.width - 1) >> level) + 1, 0, {}, {}};
  for (int y = 0; y < whole.height; ++y) {
    image.height += forest.shows(level, 0, y);
    for (int x = 0; x < whole.width; ++x) {
      if (!forest.shows(level, x, y)) continue;
      const size_t i = static_cast<size_t>(y) * whole.width + x;
      image.values.push_back(whole.values[i]);
      if (!whole.valid.empty()) image.valid.push_back(whole.valid[i]);
    }
  }
  return image;
}

}  // namespace

Surface decodeSurface(const GeometryHeader& header, const std::vector<uint8_t>& lifted,
                      const std::vector<std::span<const uint8_t>>& coefficients, Plane known,
                      int level) {
  Surface surface;
  surface.plane = std::move(known);
  if (header.drawn) {
    surface.plane.values = decodeDrawnHeights(header, coefficients[0], surface.plane.valid);
    surface.plane = placesOf(surface.plane, header.wavelet.domain.forest, level);
    surface.f = 4;
    return surface;
  }
  surface.plane.values.resize(static_cast<size_t>(header.width) * header.height);
  const std::vector<uint8_t> valid = surface.plane.valid;
  surface.plane.valid = lifted;
  const PriorityMap priorities = priorityMapOf(header.priorities, header.width, header.height);
  const Forest& forest = header.wavelet.domain.forest;
  surface.parts = partsOf(forest, header.width, header.height, header.regions);
  for (const std::vector<Part>& parts : surface.parts) {
    const size_t track = surface.bands.size();
    std::vector<Band>& bands = surface.bands.emplace_back(bandsOf(header.wavelet, parts, 0));
    markAbsent(forest, parts, surface.plane, bands);
    setPriorities(parts, priorities, bands);
    dropFiner(parts, level, bands);
    decodeTrack(coefficients[track], header.planes, bands);
  }
  surface.f = fractionOf(header.wavelet, header.planes, bytesOf(coefficients), level);
  for (size_t i = 0; i < surface.parts.size(); ++i) {
    place(surface.bands[i], surface.parts[i], surface.f - header.wavelet.fractionBits,
          surface.plane);
  }
  for (int32_t& height : surface.plane.flat.heights) height = wrap(int64_t{height} << surface.f);
  synthesise(header.wavelet, level, surface.plane);
  surface.plane.valid = valid;
  const Plane whole = surface.plane;
  if (level > 0) surface.plane = levelOf(header.wavelet, level, surface.plane);
  putFlat(whole, forest, level, surface.plane);
  return surface;
}

Plane significanceOf(const Surface& surface) {
  Plane marks{surface.plane.width, surface.plane.height, {}};
  marks.values.resize(surface.plane.values.size());
  for (size_t track = 0; track < surface.parts.size(); ++track) {
    for (size_t i = 0; i < surface.parts[track].size(); ++i) {
      const Part& part = surface.parts[track][i];
      for (int r = 0; r < part.rows; ++r) {
        for (int a = 0; a < part.columns; ++a) {
          const bool significant = surface.bands[track][i].get(r, a).magnitude > 0;
          marks.at(part.x(a), part.y(r)) =
              surface.plane.isValid(part.x(a), part.y(r)) && significant;
        }
      }
    }
  }
  return marks;
}

}  // namespace tetrakis::reference

// SPDX-License-Identifier: Apache-2.0
// Where the ground of a globe lies at a coarse level, for cameras that look at it.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "api/globe.hpp"
#include "api/outlook.hpp"
#include "base/vec3.hpp"

namespace tetrakis::inline api {
namespace {

/// Points of a grid at a view's samples. metres: of the height at each, none: all lie at 0.
GlobeGround groundOnGrid(const GlobePlaces& places, Extent grid, const View& view,
                         std::span<const float> heights, double metres) {
  const auto [columns, rows] = view.extentIn(grid);
  GlobeGround ground{columns, rows, {}};
  ground.points.reserve(size_t{columns} * rows);
  for (uint32_t y = 0; y < rows; ++y) {
    for (uint32_t x = 0; x < columns; ++x) {
      const double column = double(x) * view.step(), row = double(y) * view.step();
      const double height =
          heights.empty() ? 0 : static_cast<double>(heights[ground.points.size()]) * metres;
      const auto at = [&](double across, double down) {
        return places.at({column + across, row + down}, height);
      };
      const Vec3 place = at(0, 0);
      ground.points.push_back(
          {place, subtract(at(0.5, 0), at(-0.5, 0)), subtract(at(0, 0.5), at(0, -0.5)),
           subtract(places.at({column, row}, height + std::abs(metres)), place)});
    }
  }
  return ground;
}

/// Points of a cube at a view's samples.
GlobeGround groundOnCube(const Forest& forest, const Spheroid& spheroid, const View& view,
                         std::span<const float> heights, double metres) {
  const CubeSpheroid cube(forest, spheroid);
  const auto [columns, rows] = view.extentIn(forest.raster());
  const uint32_t side = forest.side();
  GlobeGround ground{columns, rows, {}};
  ground.points.reserve(heights.size());
  for (uint32_t y = 0; y < rows; ++y) {
    for (uint32_t x = 0; x < columns; ++x) {
      const double height = static_cast<double>(heights[ground.points.size()]) * metres;
      const uint32_t column = x << view.level, row = view.rowOf(y);
      const auto at = [&](uint32_t i, uint32_t j) { return cube.at(j * side + i, height); };
      // From the sample before to the one behind, within the patch.
      const auto along = [&](uint32_t place, const auto& point) {
        const uint32_t before = place > 0 ? place - 1 : 0, behind = std::min(place + 1, side - 1);
        return scale(subtract(point(behind), point(before)), 1.0 / (behind - before));
      };
      const uint32_t in_patch = row % side, first = row - in_patch;
      const Vec3 place = at(column, row);
      ground.points.push_back(
          {place, along(column, [&](uint32_t i) { return at(i, row); }),
           along(in_patch, [&](uint32_t j) { return at(column, first + j); }),
           subtract(cube.at(row * side + column, height + std::abs(metres)), place)});
    }
  }
  return ground;
}

/// The ground of a texture of longitudes and latitudes that lies otherwise than the heights.
/// Nothing: it lies as they do, or nobody knows where.
std::optional<GlobeGround> groundOfTexture(const StreamHeader& header, const tks_globe& globe) {
  if (!header.texture || header.texture->wavelet.forest != nullptr) return {};
  const Georeference& georeference = header.georeference;
  Placement place = georeference.texture;
  const Extent grid = header.texture->shown();
  if (!place.has_transform && header.geometry->wavelet.forest != nullptr) {
    // It covers the globe from where the grid of the heights begins.
    const GeoTransform& t = georeference.heights.transform;
    const auto [west, north] = georeference.heights.has_transform
                                   ? std::pair(t[0] * globe.degrees, t[3] * globe.degrees)
                                   : std::pair(-180.0, 90.0);
    place.has_transform = true;
    place.transform = {west / globe.degrees,
                       360 / globe.degrees / grid.width,
                       0,
                       north / globe.degrees,
                       0,
                       -180 / globe.degrees / grid.height};
  }
  const Result<GlobePlaces> places = placesOn(globe, "the texture", place, grid);
  if (!places.ok()) return {};
  return groundOnGrid(*places, grid, coarseViewOf(grid), {}, globe.exaggeration);
}

Result<GlobeGround> groundOfHeights(tks_decoder& decoder, const tks_globe& globe) {
  const StreamHeader& header = decoder.parsed.header;
  const double metres = metresPerHeight(globe, header);
  const Forest* const forest = header.geometry->wavelet.forest.get();
  if (forest != nullptr) {
    if (Status status = checkCube(*forest); !status.ok()) return status;
    // Four patches go round the globe.
    View view = coarseViewOf({forest->side(), forest->side()}, kCoarsePoints / 4 + 1);
    view.level = std::min(view.level, coarsestLevelOf(header.geometry));
    view.patch_rows = forest->side();
    const auto heights = coarseHeights(decoder, view);
    if (!heights.ok()) return heights.status();
    return groundOnCube(*forest, spheroidOf(globe), view, *heights, metres);
  }
  const Extent grid = header.geometry->shown();
  const auto places = placesOn(globe, "the heights", header.georeference.heights, grid);
  if (!places.ok()) return places.status();
  View view = coarseViewOf(grid);
  view.level = std::min(view.level, coarsestLevelOf(header.geometry));
  const auto heights = coarseHeights(decoder, view);
  if (!heights.ok()) return heights.status();
  return groundOnGrid(*places, grid, view, *heights, metres);
}

}  // namespace

Result<CoarseGlobe> coarseGlobe(tks_decoder& decoder, const tks_globe* given) {
  const StreamHeader& header = decoder.parsed.header;
  if (!header.geometry) return noHeights();
  const Result<tks_globe> globe = takeGlobe(given);
  if (!globe.ok()) return globe.status();
  // Of the heights and of the texture, with what three sightings see of each.
  constexpr uint64_t kPoint = sizeof(GlobePoint) + 3 * sizeof(GroundPoint);
  constexpr uint64_t kBytes = 2 * uint64_t{kCoarsePoints} * kCoarsePoints * kPoint;
  if (Status status = checkPlanMemory(decoder, kBytes); !status.ok()) return status;
  Result<GlobeGround> heights = groundOfHeights(decoder, *globe);
  if (!heights.ok()) return heights.status();
  std::optional<GlobeGround> texture = groundOfTexture(header, *globe);
  return CoarseGlobe{*std::move(heights), texture ? *std::move(texture) : GlobeGround()};
}

}  // namespace tetrakis::inline api

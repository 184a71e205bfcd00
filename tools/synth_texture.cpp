// SPDX-License-Identifier: Apache-2.0
// Ground colours under the sun, seen through air, lens and sensor.
#include "tools/synth_texture.hpp"

#include "tools/synth_ground.hpp"
#include "tools/synth_rivers.hpp"

namespace tetrakis::tools::synth {
namespace {

using Image = Raster<Colour>;

/// Rasters of the relief that sites are read from.
struct Survey {
  Grid east, south;   // height differences over one sample, divided by the spacing
  Grid surroundings;  // mean height around
  Grid wetness;
  Grid land, lake, sea;  // land is blurred, the others are 0 or 1
  Grid river;            // a texel each, see riverDistance
  double summit = 1;
};

template <class Function>
Grid gridOf(uint32_t side, Function function) {
  Grid grid(side);
  for (uint32_t y = 0; y < side; ++y)
    for (uint32_t x = 0; x < side; ++x) grid.at(x, y) = function(x, y);
  return grid;
}

/// floor(log2) with a linear fraction: close to log2, and the same bits everywhere.
double roughLog2(double value) {
  double whole = 0;
  while (value >= 2) {
    value /= 2;
    whole += 1;
  }
  return whole + value - 1;
}

Grid coverOf(const Relief& relief, Cover kind) {
  return gridOf(relief.cover.side(),
                [&](uint32_t x, uint32_t y) { return relief.cover.at(x, y) == kind ? 1.0 : 0.0; });
}

Survey surveyOf(const Relief& relief, uint32_t texels) {
  const Grid& h = relief.height;
  const auto slope = [&](int64_t dx, int64_t dy) {
    return gridOf(h.side(), [&, dx, dy](uint32_t x, uint32_t y) {
      return (h.clamped(x + dx, y + dy) - h.clamped(x - dx, y - dy)) / (2 * kSpacing);
    });
  };
  Survey survey;
  survey.east = slope(1, 0);
  survey.south = slope(0, 1);
  survey.surroundings = boxBlur(boxBlur(h, 4), 4);
  survey.wetness = boxBlur(
      gridOf(h.side(),
             [&](uint32_t x, uint32_t y) { return roughLog2(relief.drainage.area.at(x, y)); }),
      1);
  survey.land = boxBlur(boxBlur(coverOf(relief, Cover::kLand), 9), 9);
  survey.lake = coverOf(relief, Cover::kLake);
  survey.sea = coverOf(relief, Cover::kSea);
  survey.river = riverDistance(relief, texels);
  for (size_t cell = 0; cell < h.size(); ++cell) survey.summit = std::max(survey.summit, h[cell]);
  return survey;
}

/// Water ends on the contour of one half, sharply but not by whole samples.
double share(const Grid& cover, Point p) {
  return smoothStep(0.4, 0.6, sampleAt(cover, p));
}

Site siteAt(const Relief& relief, const Survey& survey, uint32_t x, uint32_t y) {
  const Point terrain{(x + 0.5) / 2, (y + 0.5) / 2};
  const Point p{terrain.x + relief.margin, terrain.y + relief.margin};
  const double east = sampleAt(survey.east, p), south = sampleAt(survey.south, p);
  Site site;
  site.metres = {terrain.x * kSpacing, terrain.y * kSpacing};
  site.height = sampleAt(relief.height, p);
  site.altitude = site.height / survey.summit;
  site.slope = std::sqrt(east * east + south * south);
  site.hollow = sampleAt(survey.surroundings, p) - site.height;
  site.wetness = sampleAt(survey.wetness, p);
  site.river = survey.river.at(x, y);
  site.land = sampleAt(survey.land, p);
  site.lake = share(survey.lake, p);
  site.sea = share(survey.sea, p);
  return site;
}

/// Lambert against level ground for a sun 45 degrees high in the north-west, softened by skylight
/// that hollows see less of. Rough ground is embossed along the light.
double sunlight(uint64_t seed, const Site& site, Point slope, double roughness) {
  constexpr double kBump = 80, kShift = 9;  // metres
  const Point m = site.metres;
  const double emboss = fractal(seed, {m.x / kBump, m.y / kBump}, 3) -
                        fractal(seed, {(m.x + kShift) / kBump, (m.y + kShift) / kBump}, 3);
  const double facing = 1 + 0.7071067811865476 * (slope.x + slope.y);
  const double steepness = std::sqrt(1 + slope.x * slope.x + slope.y * slope.y);
  const double direct = std::max(0.0, facing / steepness - 0.6 * roughness * emboss);
  const double sky = std::clamp(1 - 0.006 * site.hollow, 0.7, 1.15);
  return (0.72 * direct + 0.28) * sky;
}

Image sceneOf(const Relief& relief, uint32_t texels, uint64_t seed) {
  const Survey survey = surveyOf(relief, texels);
  Image image(texels);
  for (uint32_t y = 0; y < texels; ++y) {
    for (uint32_t x = 0; x < texels; ++x) {
      const Site site = siteAt(relief, survey, x, y);
      const Ground ground = groundAt(seed, site);
      const Point p{(x + 0.5) / 2 + relief.margin, (y + 0.5) / 2 + relief.margin};
      const Point slope{sampleAt(survey.east, p), sampleAt(survey.south, p)};
      image.at(x, y) = times(ground.colour, sunlight(seed + 1, site, slope, ground.roughness));
    }
  }
  return image;
}

/// The lens: (1, 6, 1) / 8 along rows and columns.
Image blurred(const Image& image) {
  const auto along = [](const Image& from, int64_t dx, int64_t dy) {
    Image to(from.side());
    for (uint32_t y = 0; y < from.side(); ++y) {
      for (uint32_t x = 0; x < from.side(); ++x) {
        const Colour &a = from.clamped(x - dx, y - dy), &b = from.at(x, y),
                     &c = from.clamped(x + dx, y + dy);
        for (size_t k = 0; k < 3; ++k) to.at(x, y)[k] = (a[k] + 6 * b[k] + c[k]) / 8;
      }
    }
    return to;
  };
  return along(along(image, 1, 0), 0, 1);
}

uint8_t toByte(double value) {
  return static_cast<uint8_t>(std::floor(std::clamp(value, 0.0, 255.0) + 0.5));
}

/// Air light lifts the shadows towards blue; the sensor adds a little noise, most of it in all
/// channels.
std::vector<std::byte> exposed(const Image& image, uint64_t seed) {
  constexpr Colour kAir{150, 170, 196};
  std::vector<std::byte> bytes;
  bytes.reserve(3 * image.size());
  for (size_t texel = 0; texel < image.size(); ++texel) {
    const Colour colour = mix(image[texel], kAir, 0.06);
    const int64_t at = static_cast<int64_t>(texel);
    const double grain = 3 * (unitHash(seed, at, 0) + unitHash(seed, at, 1) - 1);
    for (size_t k = 0; k < 3; ++k) {
      const double own = 2 * unitHash(seed, at, 2 + static_cast<int64_t>(k)) - 1;
      bytes.push_back(std::byte{toByte(colour[k] + grain + own)});
    }
  }
  return bytes;
}

}  // namespace

ImageFile photograph(const Relief& relief, uint32_t size, uint64_t seed) {
  const uint32_t texels = 2 * (size - 1);
  const Image image = blurred(sceneOf(relief, texels, hash(seed, 4, 0)));
  return {texels, texels, 3, TKS_U8, exposed(image, hash(seed, 5, 0))};
}

}  // namespace tetrakis::tools::synth

// SPDX-License-Identifier: Apache-2.0
// Ground colours under the sun, seen through air, lens and sensor.
#include "apps/tools/synth/texture.hpp"

#include "apps/tools/synth/ground.hpp"

namespace tetrakis::tools::synth {
namespace {

/// Rasters of the relief that sites are read from.
struct Survey {
  Grid surroundings;  // mean height around
  Grid wetness;
  Grid land;  // blurred
  double summit;
};

/// floor(log2) with a linear fraction: close to log2, and the same bits everywhere.
double roughLog2(double value) {
  double whole = 0;
  while (value >= 2) {
    value /= 2;
    whole += 1;
  }
  return whole + value - 1;
}

Survey surveyOf(const Relief& relief) {
  const Grid& h = relief.height;
  Survey survey;
  survey.surroundings = boxBlur(boxBlur(h, 4), 4);
  survey.wetness = boxBlur(rasterOf<double>(h.side(),
                                            [&](uint32_t x, uint32_t y) {
                                              return roughLog2(relief.drainage.area.at(x, y));
                                            }),
                           1);
  const Grid land = rasterOf<double>(h.side(), [&](uint32_t x, uint32_t y) {
    return relief.cover.at(x, y) == Cover::kLand ? 1.0 : 0.0;
  });
  survey.land = boxBlur(boxBlur(land, 9), 9);
  survey.summit = relief.summit;
  for (const double height : h) survey.summit = std::max(survey.summit, height);
  return survey;
}

/// A place between four samples: bilinear, the border continued.
struct Place {
  int64_t x, y;
  double u, v;

  template <class Value>
  double mixed(Value value) const {
    return mix(mix(value(x, y), value(x + 1, y), u), mix(value(x, y + 1), value(x + 1, y + 1), u),
               v);
  }
};

Place placeAt(Point p) {
  const int64_t x = floorOf(p.x), y = floorOf(p.y);
  return {x, y, p.x - static_cast<double>(x), p.y - static_cast<double>(y)};
}

/// Height differences over one sample, divided by the spacing.
Point slopeAt(const Relief& relief, const Place& place) {
  const Grid& h = relief.height;
  const auto rise = [&](int64_t dx, int64_t dy) {
    return place.mixed([&](int64_t x, int64_t y) {
      // As of the nearest sample beyond the border.
      const int64_t last = int64_t{h.side()} - 1;
      x = std::clamp<int64_t>(x, 0, last);
      y = std::clamp<int64_t>(y, 0, last);
      return (h.clamped(x + dx, y + dy) - h.clamped(x - dx, y - dy)) / (2 * relief.spacing);
    });
  };
  return {rise(1, 0), rise(0, 1)};
}

/// Share of a kind of cover. Water ends on the contour of one half, sharply but not by whole
/// samples.
double shareOf(const Relief& relief, Cover kind, const Place& place) {
  return smoothStep(0.4, 0.6, place.mixed([&](int64_t x, int64_t y) {
    return relief.cover.clamped(x, y) == kind ? 1.0 : 0.0;
  }));
}

Site siteAt(const Relief& relief, const Survey& survey, Point terrain, double river, Point slope) {
  const Point p{terrain.x + relief.margin, terrain.y + relief.margin};
  const Place place = placeAt(p);
  Site site;
  site.metres = {terrain.x * relief.spacing, terrain.y * relief.spacing};
  site.height = sampleAt(relief.height, p);
  site.altitude = site.height / survey.summit;
  site.slope = std::sqrt(slope.x * slope.x + slope.y * slope.y);
  site.hollow = sampleAt(survey.surroundings, p) - site.height;
  site.wetness = sampleAt(survey.wetness, p);
  site.river = river;
  site.land = sampleAt(survey.land, p);
  site.lake = shareOf(relief, Cover::kLake, place);
  site.sea = shareOf(relief, Cover::kSea, place);
  site.roof = shareOf(relief, Cover::kRoof, place);
  return site;
}

/// Lambert against level ground for a sun 45 degrees high in the north-west, softened by skylight
/// that hollows see less of. Rough ground is embossed along the light.
double sunlight(uint64_t seed, const Site& site, Point slope, double roughness) {
  constexpr double kBump = 80, kShift = 9;  // metres
  const Point m = site.metres;
  const double emboss =
      roughness == 0 ? 0
                     : fractal(seed, {m.x / kBump, m.y / kBump}, 3) -
                           fractal(seed, {(m.x + kShift) / kBump, (m.y + kShift) / kBump}, 3);
  const double facing = 1 + 0.7071067811865476 * (slope.x + slope.y);
  const double steepness = std::sqrt(1 + slope.x * slope.x + slope.y * slope.y);
  const double direct = std::max(0.0, facing / steepness - 0.6 * roughness * emboss);
  const double sky = std::clamp(1 - 0.006 * site.hollow, 0.7, 1.15);
  return (0.72 * direct + 0.28) * sky;
}

/// Everything that light meets on its way up.
class Scene {
 public:
  Scene(const Relief& relief, uint64_t seed)
      : relief_(relief), survey_(surveyOf(relief)), seed_(seed) {}

  Colour colourAt(uint32_t x, uint32_t y, double river) const {
    const Point terrain{(x + 0.5) / 2, (y + 0.5) / 2};
    const Place place = placeAt({terrain.x + relief_.margin, terrain.y + relief_.margin});
    const Point slope = slopeAt(relief_, place);
    const Site site = siteAt(relief_, survey_, terrain, river, slope);
    const Ground ground = groundAt(seed_, site);
    return times(ground.colour, sunlight(seed_ + 1, site, slope, ground.roughness));
  }

 private:
  const Relief& relief_;
  Survey survey_;
  uint64_t seed_;
};

/// The lens: (1, 6, 1) / 8 of three neighbours.
Colour blurred(const Colour& a, const Colour& b, const Colour& c) {
  Colour out;
  for (size_t k = 0; k < 3; ++k) out[k] = (a[k] + 6 * b[k] + c[k]) / 8;
  return out;
}

uint8_t toByte(double value) {
  return static_cast<uint8_t>(std::floor(std::clamp(value, 0.0, 255.0) + 0.5));
}

/// A row of the scene, blurred along.
std::vector<Colour> rowOf(const Scene& scene, const RiverStrip& strip, uint32_t y) {
  std::vector<Colour> row(strip.texels), out(strip.texels);
  for (uint32_t x = 0; x < strip.texels; ++x) row[x] = scene.colourAt(x, y, strip.distance(x, y));
  const size_t last = row.size() - 1;
  for (size_t x = 0; x <= last; ++x)
    out[x] = blurred(row[std::max<size_t>(x, 1) - 1], row[x], row[std::min(x + 1, last)]);
  return out;
}

/// Air light lifts the shadows towards blue; the sensor adds a little noise, most of it in all
/// channels. `at` is the number of the texel.
void expose(const Colour& light, uint64_t seed, int64_t at, std::byte* out) {
  constexpr Colour kAir{150, 170, 196};
  const Colour colour = mix(light, kAir, 0.06);
  const double grain = 3 * (unitHash(seed, at, 0) + unitHash(seed, at, 1) - 1);
  for (size_t k = 0; k < 3; ++k) {
    const double own = 2 * unitHash(seed, at, 2 + static_cast<int64_t>(k)) - 1;
    out[k] = std::byte{toByte(colour[k] + grain + own)};
  }
}

}  // namespace

ImageFile photograph(const Relief& relief, const Rivers& rivers, uint32_t size, uint64_t seed) {
  const uint32_t texels = 2 * (size - 1);
  const Scene scene(relief, hash(seed, 4, 0));
  const uint64_t sensor = hash(seed, 5, 0);
  ImageFile image{texels, texels, 3, TKS_U8, std::vector<std::byte>(size_t{3} * texels * texels)};
  rivers.forStrips([&](const RiverStrip& strip) {
    std::vector<Colour> above = rowOf(scene, strip, strip.top);
    std::vector<Colour> here = strip.top < strip.first ? rowOf(scene, strip, strip.first) : above;
    for (uint32_t y = strip.first; y < strip.end; ++y) {
      std::vector<Colour> below = y + 1 < texels ? rowOf(scene, strip, y + 1) : here;
      for (uint32_t x = 0; x < texels; ++x) {
        const size_t at = size_t{y} * texels + x;
        expose(blurred(above[x], here[x], below[x]), sensor, static_cast<int64_t>(at),
               &image.data[3 * at]);
      }
      above = std::move(here);
      here = std::move(below);
    }
  });
  return image;
}

}  // namespace tetrakis::tools::synth

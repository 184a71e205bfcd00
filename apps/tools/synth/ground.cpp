// SPDX-License-Identifier: Apache-2.0
// Layers from the bare rock up: scree, grass, fields, wood, snow, sand, water. Each covers the one
// below by a share that depends on the site and frays with noise.
#include "apps/tools/synth/ground.hpp"

#include "apps/tools/synth/parcels.hpp"

namespace tetrakis::tools::synth {
namespace {

constexpr Colour kRock{121, 113, 100}, kPaleRock{153, 144, 127}, kScree{150, 143, 132};
constexpr Colour kAlpineGrass{114, 112, 78}, kMeadow{96, 107, 64}, kDryMeadow{139, 131, 94};
constexpr Colour kConifers{41, 53, 38}, kBroadleaves{66, 82, 45}, kHedge{58, 70, 42};
constexpr Colour kSnow{236, 239, 243}, kSand{205, 191, 156}, kGravel{168, 160, 146};
constexpr Colour kDeepSea{22, 50, 72}, kShallows{72, 121, 122}, kLake{36, 62, 68},
    kRiver{66, 84, 80};
constexpr Colour kTrack{182, 169, 144};

constexpr double kBarren = 0.15;  // below this altitude neither scree nor snow, whatever the noise

/// Noise with features of `metres`.
double noiseAt(uint64_t seed, const Site& site, double metres, int octaves) {
  return fractal(seed, {site.metres.x / metres, site.metres.y / metres}, octaves);
}

void cover(Ground& ground, const Colour& colour, double share, double roughness) {
  ground.colour = mix(ground.colour, colour, share);
  ground.roughness = mix(ground.roughness, roughness, share);
}

/// Strata follow the contours, bent and broken.
Ground bareRock(uint64_t seed, const Site& site) {
  const double bent = site.height / 22 + 3 * noiseAt(seed, site, 900, 4);
  const double band = noise(seed + 10, {bent, site.metres.x / 1500});
  const double stain = noiseAt(seed + 11, site, 160, 4);
  return {times(mix(kRock, kPaleRock, clamp01(0.5 + 0.5 * band + 0.5 * stain)), 1 + 0.25 * stain),
          1};
}

/// Share of the ground that grass covers, and the noise that it shares with its colour.
struct Sward {
  double share, patch, fine;
};

Sward swardAt(uint64_t seed, const Site& site) {
  const double patch = noiseAt(seed, site, 420, 6), fine = noiseAt(seed + 1, site, 45, 3);
  const double ground_holds = 1 - smoothStep(0.5, 0.72, site.slope + 0.25 * patch + 0.1 * fine);
  const double warm_enough = 1 - smoothStep(0.6, 0.78, site.altitude + 0.14 * patch);
  return {ground_holds * warm_enough, patch, fine};
}

void addGrass(const Site& site, const Sward& sward, Ground& ground) {
  const double alpine = smoothStep(0.3, 0.62, site.altitude + 0.12 * sward.patch);
  const double moist = smoothStep(1, 7, site.wetness + 3 * sward.patch);
  const Colour lowland = mix(kDryMeadow, kMeadow, clamp01(0.35 + 0.6 * moist + 0.7 * sward.patch));
  const Colour colour =
      times(mix(lowland, kAlpineGrass, alpine), 1 + 0.16 * sward.patch + 0.22 * sward.fine);
  cover(ground, colour, sward.share, 0.3);
}

void addScree(uint64_t seed, const Site& site, Ground& ground) {
  if (site.altitude < kBarren) return;
  const double patch = noiseAt(seed, site, 300, 5), fine = noiseAt(seed + 1, site, 40, 2);
  const double fans = smoothStep(0.38, 0.52, site.slope + 0.2 * patch) *
                      (1 - smoothStep(0.58, 0.7, site.slope - 0.1 * patch)) *
                      smoothStep(0.38, 0.6, site.altitude + 0.2 * patch);
  cover(ground, times(kScree, 1 + 0.15 * fine + 0.1 * patch), fans * clamp01(0.7 + patch), 0.5);
}

Colour crop(uint64_t id) {
  static constexpr Colour kCrops[] = {{181, 165, 116}, {168, 150, 100}, {98, 116, 60},
                                      {80, 100, 50},   {124, 102, 79},  {142, 122, 96},
                                      {121, 131, 76},  {154, 149, 104}};
  const Colour& base = kCrops[id >> 61];
  return times(mix(base, kMeadow, 0.15), 0.88 + 0.24 * unitHash(id, 1, 1));
}

/// Share of the ground that is ploughed or grazed.
double arableAt(uint64_t seed, const Site& site) {
  const double dry = smoothStep(15, 30, site.river);
  // Whatever the noise, which lies within -1 and 1.
  if (dry <= 0 || site.slope - 0.05 >= 0.17 || site.altitude - 0.1 >= 0.24 || site.height <= 0)
    return 0;
  const double patch = noiseAt(seed, site, 900, 4);
  return (1 - smoothStep(0.1, 0.17, site.slope + 0.05 * patch)) *
         (1 - smoothStep(0.16, 0.24, site.altitude + 0.1 * patch)) *
         smoothStep(4, 7, site.height + 4 * patch) * dry;
}

void addFields(uint64_t seed, const Site& site, double arable, Ground& ground) {
  if (arable <= 0) return;
  const Parcel parcel = parcelAt(seed + 5, site.metres);
  const bool pasture = unitHash(parcel.id, 2, 2) < 0.22;
  const double grain = noiseAt(seed + 6, site, 70, 4), soil = noiseAt(seed + 7, site, 500, 3);
  const double furrow = noise(parcel.id, {parcel.along / 240, parcel.across / 26});
  const double tone = 1 + 0.12 * grain + 0.14 * soil + (pasture ? 0 : 0.09 * furrow);
  const Colour colour = pasture ? kMeadow : crop(parcel.id);
  cover(ground, times(colour, tone), arable, 0.12);
  const double line = 1 - smoothStep(parcel.track ? 4 : 5, parcel.track ? 11 : 17, parcel.edge);
  if (line <= 0) return;
  const double gaps = smoothStep(-0.25, 0.1, noiseAt(seed + 8, site, 120, 3));
  cover(ground, parcel.track ? kTrack : kHedge, arable * line * (parcel.track ? 0.75 : gaps), 0.3);
}

/// Share of the ground that trees cover, and the noise that it shares with their colour.
struct Wood {
  double share, stand, edge;
};

Wood woodAt(uint64_t seed, const Site& site) {
  const double stand = noiseAt(seed, site, 1100, 6);
  const double edge = 0.25 * noiseAt(seed + 2, site, 110, 4);
  const double treeline = 1 - smoothStep(0.44, 0.54, site.altitude + 0.16 * stand + edge);
  const double holds = 1 - smoothStep(0.62, 0.8, site.slope + 0.3 * edge);
  // Hills carry woods, the plain groves and river banks, the mountains their gullies most of all.
  const double mountain = smoothStep(0.04, 0.14, site.altitude + 0.05 * stand);
  const double gully = 0.05 * (site.wetness - 4) + 0.004 * site.hollow;
  const double wish =
      stand + edge + gully + mix(-0.42, 0.12, mountain) + 1.2 * std::min(site.slope, 0.3);
  const double bank = 0.95 * (1 - smoothStep(25, 75, site.river + 90 * edge));
  const double share = std::max(smoothStep(0.0, 0.12, wish), bank * smoothStep(4, 8, site.height));
  return {share * treeline * holds, stand, edge};
}

/// Crowns are near the size of a texel: clumps and gaps make the grain of a wood.
void addWood(uint64_t seed, const Site& site, const Wood& wood, Ground& ground) {
  if (wood.share <= 0) return;
  const double crowns = noiseAt(seed + 1, site, 36, 3);
  const double conifers = smoothStep(0.16, 0.32, site.altitude + 0.2 * wood.stand);
  const Colour colour = mix(kBroadleaves, kConifers, clamp01(conifers + 0.5 * wood.edge));
  cover(ground, times(colour, 1 + 0.4 * crowns + 0.25 * wood.stand), wood.share, 1.1);
}

void addSnow(uint64_t seed, const Site& site, Ground& ground) {
  const double warmest = site.altitude + 0.16 + 0.002 * site.hollow;  // whatever the noise
  if (site.altitude < kBarren || warmest <= 0.52 || site.slope - 0.3 >= 1.05) return;
  const double patch = noiseAt(seed, site, 600, 6);
  const double lies = smoothStep(0.52, 0.68, site.altitude + 0.16 * patch + 0.002 * site.hollow);
  const double holds = 1 - smoothStep(0.78, 1.05, site.slope + 0.3 * patch);
  cover(ground, times(kSnow, 1 + 0.03 * patch), lies * holds, 0.15);
}

void addShore(uint64_t seed, const Site& site, Ground& ground) {
  const bool no_beach = site.height - 5 >= 6 || site.slope >= 0.16 || site.land - 0.2 >= 0.8;
  if (no_beach && site.river - 30 >= 15) return;  // whatever the noise
  const double fine = noiseAt(seed, site, 60, 3);
  const double beach = (1 - smoothStep(2.5, 6, site.height + 5 * noiseAt(seed + 1, site, 500, 3))) *
                       (1 - smoothStep(0.08, 0.16, site.slope)) *
                       (1 - smoothStep(0.66, 0.8, site.land + 0.2 * fine));
  cover(ground, times(kSand, 1 + 0.12 * fine), beach, 0.1);
  const double gravel = 1 - smoothStep(2, 15, site.river + 30 * fine);
  cover(ground, times(kGravel, 1 + 0.2 * fine), 0.8 * gravel, 0.2);
}

void addWater(uint64_t seed, const Site& site, Ground& ground) {
  if (site.river >= 3 && site.lake <= 0 && site.sea <= 0) return;
  const Point m = site.metres;
  const double swell =
      fractal(seed, {(0.6 * m.x + 0.8 * m.y) / 60, (0.6 * m.y - 0.8 * m.x) / 170}, 3);
  const double current = noiseAt(seed + 1, site, 1800, 5);
  const double depth = 1 - smoothStep(0.0, 0.42, site.land + 0.12 * current);
  const Colour sea = times(mix(kShallows, kDeepSea, depth), 1 + 0.05 * swell + 0.1 * current);
  const Colour lake = times(kLake, 1 + 0.05 * swell + 0.12 * current);
  cover(ground, times(kRiver, 1 + 0.1 * current), 1 - smoothStep(-4, 3, site.river), 0);
  cover(ground, lake, site.lake, 0);
  cover(ground, sea, site.sea, 0);
}

/// Tiles and concrete: roofs of one height are of one colour.
void addRoof(uint64_t seed, const Site& site, Ground& ground) {
  if (site.roof <= 0) return;
  static constexpr Colour kRoofs[] = {{148, 92, 74}, {120, 84, 74}, {138, 134, 130}, {96, 98, 102}};
  const uint64_t lot = hash(seed, floorOf(site.height / 0.1 + 0.5), 0);
  cover(ground, times(kRoofs[lot >> 62], 0.85 + 0.3 * unitHash(lot, 1, 0)), site.roof, 0);
}

/// What covers all is asked first: nothing below it shows.
Ground landAt(uint64_t seed, const Site& site) {
  Ground ground;
  const Wood wood = woodAt(seed + 4000, site);
  const double arable = wood.share < 1 ? arableAt(seed + 3000, site) : 1;
  if (arable < 1) {
    const Sward sward = swardAt(seed + 2000, site);
    if (sward.share < 1) {
      ground = bareRock(seed, site);
      addScree(seed + 1000, site, ground);
    }
    addGrass(site, sward, ground);
  }
  if (wood.share < 1) addFields(seed + 3000, site, arable, ground);
  addWood(seed + 4000, site, wood, ground);
  addSnow(seed + 5000, site, ground);
  addShore(seed + 6000, site, ground);
  return ground;
}

}  // namespace

Ground groundAt(uint64_t seed, const Site& site) {
  Ground ground;
  if (site.lake + site.sea < 1) ground = landAt(seed, site);
  addRoof(seed + 8000, site, ground);
  addWater(seed + 7000, site, ground);
  return ground;
}

}  // namespace tetrakis::tools::synth

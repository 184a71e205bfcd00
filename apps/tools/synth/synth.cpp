// SPDX-License-Identifier: Apache-2.0
// The sample terrain, put together.
#include "apps/tools/synth/synth.hpp"

#include <cassert>
#include <cstring>

#include "apps/tools/synth/kinds.hpp"
#include "apps/tools/synth/map.hpp"
#include "apps/tools/synth/texture.hpp"

namespace tetrakis::tools {
namespace {

constexpr float kNoData = -9999;

// Terrain of no place is put where globes and GIS can show it without distortion: its middle lies
// on the central meridian of a UTM zone, at 47 degrees north, in the Alps.
constexpr const char* kCrs = "EPSG:32632";
constexpr double kMiddleEast = 500000, kMiddleNorth = 5200000;

template <class T>
void put(const T& value, std::byte*& out) {
  std::memcpy(out, &value, sizeof value);
  out += sizeof value;
}

HeightFile heightsOf(const synth::Relief& relief, const synth::Storage& storage, uint32_t size) {
  const bool whole = storage.sample == TKS_U16, holes = storage.voids.size() > 0;
  HeightFile file;
  file.width = file.height = size;
  file.sample = storage.sample;
  file.scale = storage.step;
  file.spacing_x = file.spacing_y = relief.spacing;
  file.unit = std::string("m");
  file.crs = std::string(kCrs);
  file.registration = TKS_REGISTRATION_AREA;
  const double half = relief.spacing * size / 2;
  file.geotransform = {kMiddleEast - half, relief.spacing, 0, kMiddleNorth + half, 0,
                       -relief.spacing};
  if (holes) file.nodata = kNoData;
  file.data.resize((whole ? sizeof(uint16_t) : sizeof(float)) * size * size);
  std::byte* out = file.data.data();
  for (uint32_t y = relief.margin; y < size + relief.margin; ++y) {
    for (uint32_t x = relief.margin; x < size + relief.margin; ++x) {
      const double units = relief.height.at(x, y) / storage.step;
      if (whole) {
        put(static_cast<uint16_t>(std::floor(units + 0.5)), out);
      } else {
        put(holes && storage.voids.at(x, y) ? kNoData : static_cast<float>(units), out);
      }
    }
  }
  return file;
}

}  // namespace

SynthTerrain synthesize(const SynthOptions& options) {
  assert(options.size >= 2);
  const uint32_t size = options.size;
  synth::Relief relief = synth::makeRelief(size, options.seed);
  const synth::Storage storage = synth::reshape(relief, options.kind, size, options.seed);
  const synth::Rivers rivers(relief, 2 * (size - 1));
  return {heightsOf(relief, storage, size), synth::photograph(relief, rivers, size, options.seed),
          synth::drawMap(relief, rivers, size)};
}

}  // namespace tetrakis::tools

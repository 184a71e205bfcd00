// SPDX-License-Identifier: Apache-2.0
// The sample terrain, put together.
#include "tools/synth.hpp"

#include <cassert>
#include <cstring>

#include "tools/synth_map.hpp"
#include "tools/synth_relief.hpp"
#include "tools/synth_texture.hpp"

namespace tetrakis::tools {
namespace {

HeightFile heightsOf(const synth::Relief& relief, uint32_t size) {
  HeightFile file{.width = size,
                  .height = size,
                  .sample = TKS_U16,
                  .data = std::vector<std::byte>(size_t{2} * size * size),
                  .scale = synth::kHeightStep,
                  .spacing_x = synth::kSpacing,
                  .spacing_y = synth::kSpacing,
                  .nodata = std::nullopt,
                  .unit = "m",
                  .vertical_datum = "unknown",
                  .crs = ""};
  std::byte* out = file.data.data();
  for (uint32_t y = 0; y < size; ++y) {
    for (uint32_t x = 0; x < size; ++x) {
      const double metres = relief.height.at(x + relief.margin, y + relief.margin);
      const auto sample = static_cast<uint16_t>(std::floor(metres / synth::kHeightStep + 0.5));
      std::memcpy(out, &sample, sizeof sample);
      out += sizeof sample;
    }
  }
  return file;
}

}  // namespace

SynthTerrain synthesize(const SynthOptions& options) {
  assert(options.size >= 2);
  const synth::Relief relief = synth::makeRelief(options.size, options.seed);
  const synth::Rivers rivers(relief, 2 * (options.size - 1));
  return {heightsOf(relief, options.size),
          synth::photograph(relief, rivers, options.size, options.seed),
          synth::drawMap(relief, rivers, options.size)};
}

}  // namespace tetrakis::tools

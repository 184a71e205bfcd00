// SPDX-License-Identifier: Apache-2.0
// From the description of a case to its inputs, and to its stream.
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <iterator>
#include <optional>
#include <span>
#include <type_traits>

#include "base/forest.hpp"
#include "base/samples.hpp"
#include "conformance/cases/vector_cases.hpp"
#include "conformance/samples/facets.hpp"
#include "conformance/samples/patches.hpp"
#include "tetrakis/tetrakis.hpp"

namespace tetrakis::conformance {
namespace {

/// Each sample, or texel, as often as the case says, the first ones of either side once less.
samples::Raster enlarged(const samples::Raster& of, const uint32_t (&copies)[2]) {
  samples::Raster raster = of;
  raster.width = of.width * copies[0] - (copies[0] - 1);
  raster.height = of.height * copies[1] - (copies[1] - 1);
  raster.data.clear();
  const size_t bytes = tks_sample_bytes(of.sample) * of.channels;
  for (uint32_t y = 0; y < raster.height; ++y) {
    const size_t row = (y + copies[1] - 1) / copies[1];
    for (uint32_t x = 0; x < raster.width; ++x) {
      const size_t column = (x + copies[0] - 1) / copies[0];
      const auto from = of.data.begin() + static_cast<ptrdiff_t>((row * of.width + column) * bytes);
      raster.data.insert(raster.data.end(), from, from + static_cast<ptrdiff_t>(bytes));
    }
  }
  return raster;
}

samples::Raster surfaceOf(const VectorCase& vector_case) {
  const samples::Recipe& recipe = *vector_case.heights;
  samples::Raster surface =
      vector_case.patches ? samples::patches(recipe.width, recipe.height) : samples::make(recipe);
  if (vector_case.values) surface = samples::withFewValues(surface, *vector_case.values);
  if (vector_case.offsets) surface = samples::withOffsets(surface, *vector_case.offsets);
  if (vector_case.facets > 0)
    surface = samples::facets(recipe.width, recipe.height, vector_case.facets);
  const uint32_t width = surface.width, height = surface.height;
  const std::vector<uint8_t> valid = vector_case.voids
                                         ? samples::validity(*vector_case.voids, width, height)
                                         : std::vector<uint8_t>(size_t{width} * height, 1);
  withSampleType(surface.sample, [&](auto sample) {
    for (size_t i = 0; i < valid.size(); ++i) {
      std::byte* at = surface.data.data() + i * sizeof sample;
      const bool left = 2 * (i % width) < width;
      const bool wet = vector_case.water && samples::isVoid(*vector_case.water, width, height,
                                                            static_cast<uint32_t>(i % width),
                                                            static_cast<uint32_t>(i / width));
      std::memcpy(&sample, wet ? surface.data.data() + (left ? 0 : width - 1) * sizeof sample : at,
                  sizeof sample);
      if (vector_case.gridless) {
        const double about = 3 + samples::hash(static_cast<uint32_t>(i), 0, 46) * 0x1p-36;
        sample = static_cast<decltype(sample)>(sample / about);
      }
      if constexpr (std::is_floating_point_v<decltype(sample)>)
        sample = std::ldexp(sample, vector_case.exponent);
      const auto number = static_cast<uint32_t>(i);
      if (vector_case.spikes > 0 && samples::hash(number, 0, 45) % vector_case.spikes == 0)
        sample = static_cast<decltype(sample)>(samples::hash(number, 1, 45));
      if (vector_case.apart && static_cast<double>(sample) == vector_case.nodata) ++sample;
      if (!valid[i]) sample = static_cast<decltype(sample)>(vector_case.nodata);
      std::memcpy(at, &sample, sizeof sample);
    }
  });
  return enlarged(surface, vector_case.copies);
}

template <class T>
void place(T& raster, const double (&transform)[6]) {
  std::copy(std::begin(transform), std::end(transform), raster.geotransform);
  raster.has_geotransform = 1;
  raster.registration = TKS_REGISTRATION_AREA;
}

/// Heights on a square grid; a texture over their ground, or turned if it is alone.
void placeBoth(bool has_heights, tks_heights& heights, tks_image& image) {
  place(heights, {399960, 30, 0, 5300040, 0, -30});
  heights.crs = "EPSG:32632";
  heights.description = "ridges";
  if (has_heights) {
    place(image, {399960, 15, 0, 5300040, 0, -30 * (15.0 / 31)});
    image.crs = heights.crs;
  } else {
    place(image, {100.25, 3, 8, 900, 4, -6});
    image.crs = "my \"grid\"";
    image.geo_keys = "1024=1 3072=32767 3073=\"my \"\"grid\"\"\" 3077=0.5";
  }
}

/// It sees a sixth of the ground on each side, and is above any 16-bit height. Samples of unknown
/// spacing are 30 m apart.
tks_camera cameraAbove(const tks_heights& heights) {
  const double x = -0.3 * 30 * heights.width, z = -0.3 * 30 * heights.height;
  tks_camera camera = {};
  const double eye[] = {x, 40000, z}, target[] = {x, 0, z}, up[] = {0, 0, -1};
  std::copy_n(eye, 3, camera.eye);
  std::copy_n(target, 3, camera.target);
  std::copy_n(up, 3, camera.up);
  camera.fov_y = 1;
  camera.width = camera.height = 128;
  camera.weight = 1;
  return camera;
}

/// The forest whose patches are as wide as the raster; the raster gets what they share.
Forest forestUnder(samples::Raster& raster, const std::vector<uint32_t>& sides) {
  const auto depth = static_cast<int>(std::bit_width(raster.width - 1)) - 1;
  Forest forest(depth, sides);
  shareOwned(forest, std::span(raster.data), raster.width - 1,
             raster.channels * tks_sample_bytes(raster.sample));
  return forest;
}

tks_forest given(const std::optional<Forest>& forest) {
  if (!forest) return {};
  return {static_cast<uint32_t>(forest->depth()), forest->patches(), forest->sides().data()};
}

}  // namespace

Result<std::vector<uint8_t>> encodeCase(const VectorCase& vector_case) {
  if (!vector_case.stream.empty()) return vector_case.stream;
  samples::Raster surface, picture;
  tks_heights heights = {};
  tks_image image = {};
  if (vector_case.heights) {
    surface = surfaceOf(vector_case);
    heights = surface.heights();
    heights.scale = vector_case.scale;
    heights.offset = vector_case.offset;
    heights.unit = "m";
    heights.has_nodata = !std::isnan(vector_case.nodata);
    if (heights.has_nodata) heights.nodata = vector_case.nodata;
  }
  if (vector_case.texture) {
    picture = samples::make(*vector_case.texture);
    if (vector_case.levels > 0)
      picture = samples::withFewTexels(picture, vector_case.levels, vector_case.levels_of);
    const auto mask = [&](samples::VoidShape shape) {
      return samples::validity(shape, picture.width, picture.height);
    };
    if (vector_case.overlay) samples::drawOver(picture, mask(*vector_case.overlay));
    if (vector_case.cutout) samples::cutOut(picture, mask(*vector_case.cutout));
    picture = enlarged(picture, vector_case.texel_copies);
    image = picture.image();
    image.opaque = vector_case.opaque;
    image.white_level = vector_case.white_level;
  }
  if (vector_case.placed) placeBoth(vector_case.heights.has_value(), heights, image);
  std::optional<Forest> ground, painted;
  if (!vector_case.sides.empty()) {
    if (vector_case.heights) ground = forestUnder(surface, vector_case.sides);
    if (vector_case.texture) painted = forestUnder(picture, vector_case.sides);
    heights.domain = image.domain = TKS_DOMAIN_FOREST;
    heights.forest = given(ground);
    image.forest = given(painted);
    if (!vector_case.corners.empty())
      heights.base_mesh = {vector_case.corner_bits, 0.4, {-1, 20, 0.3}, vector_case.corners.data()};
  }
  if (vector_case.ring) heights.domain = image.domain = TKS_DOMAIN_CYLINDER;
  tks_encode_options options = vector_case.options;
  const tks_camera above = cameraAbove(heights);
  if (vector_case.told) {
    options.cameras = &above;
    options.camera_count = 1;
  }
  const auto stream = encode(vector_case.heights ? &heights : nullptr,
                             vector_case.texture ? &image : nullptr, options);
  if (!stream)
    return Status(stream.status().code(), vector_case.name + ": " + stream.status().message());
  std::vector<uint8_t> bytes(stream->bytes().begin(), stream->bytes().end());
  if (vector_case.damaged_byte >= 0) bytes[static_cast<size_t>(vector_case.damaged_byte)] ^= 0xff;
  return bytes;
}

}  // namespace tetrakis::conformance

// SPDX-License-Identifier: Apache-2.0
#include "api/outlook.hpp"

#include <algorithm>
#include <cmath>

#include "api/memory.hpp"
#include "api/written.hpp"

namespace tetrakis::inline api {

Result<CoarseGround> coarseGround(tks_decoder& decoder) {
  constexpr uint32_t kMostPoints = 128;  // a side: hidden ground need not be known more finely
  const StreamHeader& header = decoder.parsed.header;
  const Extent plane = header.geometry ? header.geometry->shown() : header.texture->shown();
  View view;
  while ((std::max(plane.width, plane.height) - 1) >> view.level >= kMostPoints) ++view.level;
  if (header.geometry) view.level = std::min(view.level, coarsestLevelOf(header.geometry));
  const Extent extent = view.extentIn(plane);
  CoarseGround ground{extent.width, extent.height, view.step(), {}};
  ground.heights.resize(extent.samples());
  if (!header.geometry || decoder.packets.payload.nothingOf(Component::kGeometry)) return ground;
  if (Status status = checkMemory(decoder, {TKS_PART_HEIGHTS, view, 0}); !status.ok())
    return status;
  writeSurface(decoder, decodeHeights(decoder, view), ground.heights.data());
  float low = HUGE_VALF;
  for (const float height : ground.heights) low = std::fmin(low, height);
  for (float& height : ground.heights)
    if (std::isnan(height)) height = std::isfinite(low) ? low : 0;
  return ground;
}

namespace {

Eye eyeThrough(const tks_screen_camera& camera) {
  Eye eye{{}, camera.width, camera.height};
  std::copy_n(camera.clip, eye.clip.size(), eye.clip.begin());
  return eye;
}

}  // namespace

Sighting sightingOf(const CoarseGround& ground, const tks_screen_camera& camera,
                    uint32_t triangles) {
  return {ground.columns, ground.rows, sightOf(ground, eyeThrough(camera)), triangles};
}

std::vector<WeightedSighting> outlookOf(const tks_decoder& decoder, const CoarseGround& ground,
                                        const tks_screen_camera& camera, uint32_t triangles) {
  // Chances that the next picture is another one. They let ground that is not seen now lag 12 to
  // 15 dB behind what is (docs/EXPERIMENTS.md, Plans that look beyond the picture).
  constexpr double kAround = 1 / 16.0, kElsewhere = 1 / 32.0;
  const Metadata& m = decoder.parsed.header.metadata;
  const double aspect = m.spacing_x > 0 && m.spacing_y > 0 ? m.spacing_x / m.spacing_y : 1;
  return {
      {sightingOf(ground, camera, triangles), 1},
      {{ground.columns, ground.rows, sightAround(ground, eyeThrough(camera), aspect), triangles},
       kAround},
      {{0, 0, {}, triangles}, kElsewhere}};
}

Status checkPlanMemory(const tks_decoder& decoder) {
  const uint64_t bytes =
      decoder.packets.bytes + decoder.pieces.bytes() + planBytes(decoder.parsed.header);
  if (bytes <= decoder.max_memory) return {};
  return {TKS_LIMIT, "Choosing packets takes " + describeBytes(bytes) +
                         " of memory; the limit (max_memory) is " +
                         describeBytes(decoder.max_memory) + "."};
}

}  // namespace tetrakis::inline api

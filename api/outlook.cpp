// SPDX-License-Identifier: Apache-2.0
#include "api/outlook.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "api/guarded.hpp"
#include "api/index_pages.hpp"
#include "api/memory.hpp"
#include "api/written.hpp"

namespace tetrakis::inline api {

namespace {

Status checkCamera(const std::string& name, const tks_screen_camera& camera) {
  constexpr uint32_t kMostPixels = 32768;
  const auto fits = [](uint32_t side) { return side >= 1 && side <= kMostPixels; };
  if (!fits(camera.width) || !fits(camera.height))
    return {TKS_USAGE, "The picture of " + name + " takes sides of 1 to " +
                           std::to_string(kMostPixels) + " pixels."};
  if (!std::all_of(camera.clip, camera.clip + 16, [](double v) { return std::isfinite(v); }))
    return {TKS_USAGE, "The matrix of " + name + " must be finite."};
  if (!std::isfinite(camera.weight) || camera.weight < 0)
    return {TKS_USAGE, "The weight of " + name + " must be finite and not negative."};
  return {};
}

}  // namespace

Status takeCamera(const std::string& name, const tks_screen_camera& given, tks_screen_camera& out) {
  const Status status = takeSized(name, given, offsetof(tks_screen_camera, weight), out);
  return status.ok() ? checkCamera(name, out) : status;
}

Result<std::vector<tks_screen_camera>> takeCameras(const tks_screen_camera* given, uint32_t count) {
  if (count > 0 && given == nullptr) return Status(TKS_USAGE, "The cameras are missing.");
  std::vector<tks_screen_camera> cameras;
  const auto* const bytes = reinterpret_cast<const std::byte*>(given);
  for (uint32_t i = 0; i < count; ++i) {
    const std::string name = "camera " + std::to_string(i + 1) + " of " + std::to_string(count);
    const auto& one = *reinterpret_cast<const tks_screen_camera*>(bytes + i * given->size);
    tks_screen_camera camera{};
    Status status = takeCamera(name, one, camera);
    if (status.ok() && one.size != given->size)
      status = {TKS_USAGE, "All cameras take structs of one size."};
    if (!status.ok()) return status;
    cameras.push_back(camera);
  }
  return cameras;
}

Status refuseGlobes(const std::string& what, std::span<const tks_screen_camera> cameras) {
  const auto looks = [](const tks_screen_camera& camera) { return camera.globe != nullptr; };
  if (std::none_of(cameras.begin(), cameras.end(), looks)) return {};
  return {TKS_UNSUPPORTED, what + " knows flat ground alone, and no globe of a camera."};
}

Result<std::vector<float>> coarseHeights(tks_decoder& decoder, const View& view) {
  const StreamHeader& header = decoder.parsed.header;
  const Extent plane = header.geometry ? header.geometry->shown() : header.texture->shown();
  std::vector<float> heights(view.extentIn(plane).samples());
  if (!header.geometry || heightsAreUnsent(decoder)) return heights;
  if (Status status = checkMemory(decoder, {TKS_PART_HEIGHTS, view, 0}); !status.ok())
    return status;
  const DecodedHeights decoded = decodeHeights(decoder, view);
  assert(decoded.geometry.extent() == view.extentIn(plane));
  writeSurface(decoder, decoded, heights.data());
  float low = HUGE_VALF;
  for (const float height : heights) low = std::fmin(low, height);
  for (float& height : heights)
    if (std::isnan(height)) height = std::isfinite(low) ? low : 0;
  return heights;
}

Result<CoarseGround> coarseGround(tks_decoder& decoder) {
  const StreamHeader& header = decoder.parsed.header;
  const Extent plane = header.geometry ? header.geometry->shown() : header.texture->shown();
  View view = coarseViewOf(plane);
  // Levels of a forest have rasters of their own, in which cameras of this one mean nothing.
  const bool forest = header.geometry && header.geometry->wavelet.forest != nullptr;
  if (header.geometry)
    view.level = forest ? 0 : std::min(view.level, coarsestLevelOf(header.geometry));
  Result<std::vector<float>> heights = coarseHeights(decoder, view);
  if (!heights.ok()) return heights.status();
  const Extent extent = view.extentIn(plane);
  return CoarseGround{extent.width, extent.height, view.step(), *std::move(heights)};
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
  return {.ground = {ground.columns, ground.rows, sightOf(ground, eyeThrough(camera))},
          .triangles = triangles};
}

Sighting sightingOf(const CoarseGlobe& globe, const tks_screen_camera& camera, uint32_t triangles) {
  const Eye eye = eyeThrough(camera);
  return {sightOf(globe.heights, eye), sightOf(globe.texture, eye), triangles};
}

namespace {

// Chances that the next picture is one after a turn, or any other. They let ground that is not seen
// now lag 12 to 15 dB behind what is (docs/EXPERIMENTS.md, Plans that look beyond the picture).
constexpr double kAround = 1 / 16.0, kElsewhere = 1 / 32.0;

}  // namespace

std::vector<WeightedSighting> outlookOf(const tks_decoder& decoder, const CoarseGround& ground,
                                        const tks_screen_camera& camera, uint32_t triangles) {
  const Metadata& m = decoder.parsed.header.metadata;
  const double aspect = m.spacing_x > 0 && m.spacing_y > 0 ? m.spacing_x / m.spacing_y : 1;
  SeenRaster around = {ground.columns, ground.rows,
                       sightAround(ground, eyeThrough(camera), aspect)};
  return {{sightingOf(ground, camera, triangles), 1},
          {{.ground = std::move(around), .triangles = triangles}, kAround},
          {{.ground = {}, .triangles = triangles}, kElsewhere}};
}

std::vector<WeightedSighting> outlookOf(const CoarseGlobe& globe, const tks_screen_camera& camera,
                                        uint32_t triangles) {
  const Sighting seen = sightingOf(globe, camera, triangles);
  // Whoever turns a globe sees all of it.
  return {{seen, 1},
          {{sightAround(globe.heights, seen.ground), sightAround(globe.texture, seen.texture),
            triangles},
           kAround + kElsewhere}};
}

Status checkPlanMemory(const tks_decoder& decoder, uint64_t beside) {
  const uint64_t bytes =
      decoder.packets.bytes + decoder.pieces.bytes() +
      planBytes(decoder.parsed.header, knownPackets(decoder) + lackingPages(decoder)) + beside;
  if (bytes <= decoder.max_memory) return {};
  return {TKS_LIMIT, "Choosing packets takes " + describeBytes(bytes) +
                         " of memory; the limit (max_memory) is " +
                         describeBytes(decoder.max_memory) + "."};
}

}  // namespace tetrakis::inline api

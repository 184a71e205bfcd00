// SPDX-License-Identifier: Apache-2.0
#include "bench/receivers/control_source.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "apps/tools/files/files.hpp"
#include "apps/tools/files/frame_files.hpp"
#include "apps/tools/report/viewed_mesh.hpp"

namespace tetrakis::bench {

Source Source::still() const {
  Source same = *this;
  for (Heights& frame : same.frames) frame = frames.front();
  return same;
}

Result<Source> readSource(const std::string& folder, double fps) {
  const auto names = tools::filesOf(folder + "/*.tif");
  if (!names.ok()) return names.status();
  Source source;
  source.fps = fps;
  for (const std::string& name : *names) {
    const Result<tools::HeightFile> file = tools::readHeights(name);
    if (!file.ok()) return file.status();
    const tools::Surface surface = tools::heightsOf(*file);
    if (source.frames.empty()) {
      source.width = surface.width;
      source.height = surface.height;
      source.step = file->scale;
      source.place = tools::frameOf(*file);
    }
    const bool has_voids = std::any_of(surface.values.begin(), surface.values.end(),
                                       [](double v) { return std::isnan(v); });
    if (has_voids || surface.width != source.width || surface.height != source.height)
      return Status(TKS_USAGE, name + " has voids, or is not like the first frame");
    source.frames.emplace_back(surface.values.begin(), surface.values.end());
  }
  const auto [low, high] = std::ranges::minmax(source.frames.front());
  source.range = high - low;
  return source;
}

tks_heights givenHeights(uint32_t width, uint32_t height, const Heights& data) {
  tks_heights heights = {};
  heights.size = sizeof heights;
  heights.width = width;
  heights.height = height;
  heights.sample = TKS_F32;
  heights.data = data.data();
  heights.scale = 1;
  return heights;
}

tks_screen_camera flightAt(const Source& source, double time) {
  const Heights& first = source.frames.front();
  const tools::Surface surface{source.width, source.height, {first.begin(), first.end()}};
  const Bounds bounds = tools::boundsOf(surface, source.place);
  const double width = bounds.high[0] - bounds.low[0], turn = source.seconds() / 2;
  const double speed = width / 3 / turn, turned = 120 * std::numbers::pi / 180;
  const double angle = time < turn ? 0 : turned;
  const double straight = std::min(time, turn), back = std::max(0.0, time - turn);
  Camera camera;
  camera.fov_y = 50;
  camera.width = 640;
  camera.height = 400;
  camera.eye = {-width / 4 + speed * (straight + std::cos(turned) * back),
                bounds.high[1] + width / 60, width / 5 - speed * std::sin(turned) * back};
  const Vec3 ahead = {std::cos(angle), -0.35, -std::sin(angle)};
  camera.target = add(camera.eye, scale(ahead, width));
  return tools::meshCamera(camera, source.place);
}

namespace {

constexpr uint32_t kStep = 2;  ///< samples between points of the ground that are looked at

/// How many pixels show each point of a frame.
std::vector<double> pixelsOf(const Source& source, size_t frame, const tks_screen_camera& camera) {
  CoarseGround ground{
      (source.width + kStep - 1) / kStep, (source.height + kStep - 1) / kStep, kStep, {}};
  for (uint32_t y = 0; y < source.height; y += kStep)
    for (uint32_t x = 0; x < source.width; x += kStep)
      ground.heights.push_back(source.frames[frame][size_t{y} * source.width + x]);
  Eye eye{{}, camera.width, camera.height};
  std::copy_n(camera.clip, eye.clip.size(), eye.clip.begin());
  std::vector<double> pixels;
  for (const GroundPoint& point : sightOf(ground, eye)) pixels.push_back(point.pixels);
  return pixels;
}

}  // namespace

double psnrOf(const Source& source, size_t frame, const Heights& shown,
              const std::optional<tks_screen_camera>& view) {
  constexpr double kExact = 80;  // dB that count for equal heights
  const std::vector<double> pixels = view ? pixelsOf(source, frame, *view) : std::vector<double>();
  const uint32_t step = view ? kStep : 1;
  double sum = 0, count = 0;
  size_t point = 0;
  for (uint32_t y = 0; y < source.height; y += step) {
    for (uint32_t x = 0; x < source.width; x += step, ++point) {
      const size_t at = size_t{y} * source.width + x;
      const double weight = view ? pixels[point] : 1, d = shown[at] - source.frames[frame][at];
      sum += weight * d * d;
      count += weight;
    }
  }
  if (!(sum > 0)) return kExact;
  return std::min(kExact, 10 * std::log10(source.range * source.range * count / sum));
}

}  // namespace tetrakis::bench

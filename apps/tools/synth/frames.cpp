// SPDX-License-Identifier: Apache-2.0
#include "apps/tools/synth/frames.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "apps/tools/synth/erosion.hpp"
#include "apps/tools/synth/noise.hpp"

namespace tetrakis::tools {
namespace {

constexpr uint16_t kUnseen = 65535;
/// Of the summit, how far a flood rises in all.
constexpr double kFlooded = 0.3;
/// What the shadow of clouds leaves of the light.
constexpr double kShade = 0.45;
/// Clouds move by that part of their size a frame.
constexpr double kWind = 0.06;
/// How far a rover sees, and moves in a frame, in parts of the side.
constexpr double kSight = 0.12, kPace = 0.035;

std::vector<uint16_t> samplesOf(const HeightFile& heights) {
  std::vector<uint16_t> samples(heights.data.size() / sizeof(uint16_t));
  std::memcpy(samples.data(), heights.data.data(), heights.data.size());
  return samples;
}

void put(const std::vector<uint16_t>& samples, HeightFile& heights) {
  std::memcpy(heights.data.data(), samples.data(), heights.data.size());
}

/// Each frame is the one before, eroded; the sea stays.
class Erosion {
 public:
  explicit Erosion(const HeightFile& heights)
      : units_(samplesOf(heights)), height_(heights.width), sea_(heights.width) {
    for (size_t i = 0; i < units_.size(); ++i) {
      height_[i] = units_[i];
      sea_[i] = units_[i] == 0;
    }
  }
  std::vector<uint16_t> frame(uint32_t t) {
    if (t > 0) synth::erode(height_, nullptr, sea_, {1, 0.01, 0.02});
    for (size_t i = 0; i < units_.size(); ++i)
      units_[i] = static_cast<uint16_t>(std::clamp(std::floor(height_[i] + 0.5), 0., 65534.));
    return units_;
  }

 private:
  std::vector<uint16_t> units_;
  synth::Grid height_;
  synth::Raster<uint8_t> sea_;
};

/// What lies below the water shows its surface.
std::vector<uint16_t> flooded(std::vector<uint16_t> samples, double part) {
  const double summit = *std::max_element(samples.begin(), samples.end());
  const auto level = static_cast<uint16_t>(kFlooded * part * summit);
  for (uint16_t& sample : samples) sample = std::max(sample, level);
  return samples;
}

ImageFile shaded(ImageFile image, uint32_t frame, uint64_t seed) {
  const double cloud = 4. / image.width;
  for (uint32_t y = 0; y < image.height; ++y) {
    for (uint32_t x = 0; x < image.width; ++x) {
      const synth::Point at = {x * cloud + kWind * frame, y * cloud + kWind / 3 * frame};
      const double cover = std::clamp(4 * synth::fractal(seed, at, 4), 0., 1.);
      const double light = 1 - (1 - kShade) * cover;
      for (uint32_t c = 0; c < image.channels; ++c) {
        std::byte& sample = image.data[(size_t{y} * image.width + x) * image.channels + c];
        sample = static_cast<std::byte>(std::floor(static_cast<double>(sample) * light + 0.5));
      }
    }
  }
  return image;
}

/// The samples within sight of the way so far, which winds about the middle.
std::vector<uint16_t> seen(std::vector<uint16_t> samples, uint32_t side, uint32_t frame) {
  std::vector<uint8_t> known(samples.size());
  const double sight = kSight * side;
  for (uint32_t t = 0; t <= frame; ++t) {
    const double way = kPace * t;
    const double turn = 3 * way, reach = 0.12 + 0.11 * way;
    const double px = side * (0.5 + reach * std::cos(turn)),
                 py = side * (0.5 + reach * std::sin(turn));
    for (uint32_t y = 0; y < side; ++y) {
      for (uint32_t x = 0; x < side; ++x) {
        const double dx = x - px, dy = y - py;
        if (dx * dx + dy * dy <= sight * sight) known[size_t{y} * side + x] = 1;
      }
    }
  }
  for (size_t i = 0; i < samples.size(); ++i)
    samples[i] = known[i] != 0 ? std::min<uint16_t>(samples[i], kUnseen - 1) : kUnseen;
  return samples;
}

}  // namespace

Status synthesizeFrames(const SynthOptions& options, FrameKind kind, uint32_t count,
                        const TakeFrame& take) {
  SynthTerrain terrain = synthesize(options);
  HeightFile& heights = terrain.heights;
  const std::vector<uint16_t> first = samplesOf(heights);
  Erosion erosion(heights);
  if (kind == FrameKind::kRover) heights.nodata = kUnseen;
  for (uint32_t t = 0; t < count; ++t) {
    if (kind == FrameKind::kClouds) {
      const ImageFile image = shaded(terrain.texture, t, options.seed + 77);
      if (Status status = take(t, nullptr, &image); !status.ok()) return status;
      continue;
    }
    if (kind == FrameKind::kErosion) put(erosion.frame(t), heights);
    if (kind == FrameKind::kFlood) put(flooded(first, t / std::max(1., count - 1.)), heights);
    if (kind == FrameKind::kRover) put(seen(first, heights.width, t), heights);
    if (Status status = take(t, &heights, nullptr); !status.ok()) return status;
  }
  return Status();
}

}  // namespace tetrakis::tools

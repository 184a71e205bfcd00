// SPDX-License-Identifier: Apache-2.0
// Streams of several frames: filters over time, masks that change, scales, odd numbers of frames.
#include <cmath>
#include <utility>

#include "conformance/cases/case_builders.hpp"
#include "conformance/cases/cases.hpp"
#include "conformance/samples/moving_frames.hpp"

namespace tetrakis::conformance {

namespace {

using samples::FrameRasters;
using samples::VoidShape;

/// What to encode, and how.
struct Frames {
  FrameRasters heights, images;
  tks_encode_options options;
  double nodata = NAN;  ///< a number is declared
  bool ring = false;
};

VectorCase encoded(const std::string& name, const std::string& purpose, const Frames& frames) {
  std::vector<tks_heights> heights;
  for (const samples::Raster& raster : frames.heights) {
    heights.push_back(raster.heights());
    heights.back().has_nodata = !std::isnan(frames.nodata);
    if (!std::isnan(frames.nodata)) heights.back().nodata = frames.nodata;
    if (frames.ring) heights.back().domain = TKS_DOMAIN_CYLINDER;
  }
  std::vector<tks_image> images;
  for (const samples::Raster& raster : frames.images) images.push_back(raster.image());
  const size_t count = std::max(heights.size(), images.size());
  tks_buffer buffer = {};
  tks_encode_frames(heights.empty() ? nullptr : heights.data(),
                    images.empty() ? nullptr : images.data(), static_cast<uint32_t>(count),
                    &frames.options, &buffer, nullptr, 0);
  VectorCase made;
  made.name = name;
  made.purpose = purpose;
  made.stream.assign(buffer.data, buffer.data + buffer.size);
  tks_free_buffer(&buffer);
  return made;
}

/// Voids of another shape in each frame, with the value -32768.
FrameRasters pierced(FrameRasters frames) {
  constexpr VoidShape kShapes[] = {VoidShape::kCoast, VoidShape::kHoles, VoidShape::kHalf,
                                   VoidShape::kAll, VoidShape::kOneVoid};
  for (size_t t = 0; t < frames.size(); ++t) {
    samples::Raster& frame = frames[t];
    const std::vector<uint8_t> valid =
        samples::validity(kShapes[t % std::size(kShapes)], frame.width, frame.height);
    auto* const data = reinterpret_cast<int16_t*>(frame.data.data());
    for (size_t i = 0; i < valid.size(); ++i)
      data[i] = valid[i] == 0 ? int16_t{-32768} : std::max<int16_t>(data[i], -32767);
  }
  return frames;
}

/// Floats that each frame has packed by itself: in steps and from a base of its own.
FrameRasters packed(FrameRasters frames) {
  for (size_t t = 0; t < frames.size(); ++t) {
    auto* const data = reinterpret_cast<float*>(frames[t].data.data());
    const float step = std::ldexp(1.f, -6 - static_cast<int>(t % 3));
    const float base = 271 + std::ldexp(static_cast<float>(5 * t + 1), -11);
    for (size_t i = 0; i < size_t{frames[t].width} * frames[t].height; ++i)
      data[i] = base + step * std::floor(data[i] / 64);
  }
  return frames;
}

}  // namespace

std::vector<VectorCase> frameCases() {
  const auto heights = [](Pattern pattern, uint32_t width, uint32_t height, uint32_t frames) {
    return samples::movingFrames({pattern, width, height, 1, TKS_I16}, frames);
  };
  const auto images = [](uint32_t width, uint32_t height, uint32_t channels, uint32_t frames) {
    return samples::movingFrames({Pattern::kRidges, width, height, channels, TKS_U8, 7}, frames);
  };
  const FrameRasters floats = samples::movingFrames({Pattern::kHills, 30, 22, 1, TKS_F32}, 6);
  return {
      encoded("frames_33x26", "five frames of heights",
              {heights(Pattern::kRidges, 33, 26, 5), {}, lossless()}),
      encoded(
          "frames_voids_40x33", "seven frames with voids of their own, in regions",
          {pierced(heights(Pattern::kRidges, 40, 33, 7)), {}, inRegions(lossless(), 16), -32768}),
      encoded("frames_budget_60x45", "sixteen frames with fraction bits; cut by a byte budget",
              {heights(Pattern::kHills, 60, 45, 16), {}, budget(3000)}),
      encoded("frames_scales_30x22", "frames of floats that each was packed by itself",
              {packed(floats), {}, lossless()}),
      encoded("frames_cylinder_50x31", "frames of a cylinder within a largest error",
              {heights(Pattern::kRidges, 50, 31, 4), {}, maxError(300), NAN, true}),
      encoded("frames_rgb_40x30", "frames of three channels",
              {{}, images(40, 30, 3, 6), lossless()}),
      encoded("frames_rgba_budget_37x44", "frames of four channels; cut by a byte budget",
              {{}, images(37, 44, 4, 9), budget(4000)}),
      encoded("frames_joint_30x30_40x40", "frames of heights and texture, index",
              {heights(Pattern::kRidges, 30, 30, 3), images(40, 40, 3, 3), indexed(budget(5000))}),
  };
}

}  // namespace tetrakis::conformance

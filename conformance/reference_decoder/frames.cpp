// SPDX-License-Identifier: Apache-2.0
#include "conformance/reference_decoder/frames.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "conformance/reference_decoder/height_samples.hpp"
#include "conformance/reference_decoder/layers.hpp"
#include "conformance/reference_decoder/regions.hpp"

namespace tetrakis::reference {
namespace {

/// The least number with 2^L >= F.
int levelsOf(int frames) {
  int levels = 0;
  while (1 << levels < frames) ++levels;
  return levels;
}

/// "The frame level".
int levelOf(int t, int frames) {
  if (t == 0) return levelsOf(frames);
  int level = 1;
  while (t % (1 << level) == 0) ++level;
  return level;
}

/// "The frame above", or -1.
int above(int t, int frames) {
  if (t == 0) return -1;
  const int o = 1 << (levelOf(t, frames) - 1);
  const int frame = (t & ~(4 * o - 1)) | 2 * o;
  return frame < frames ? frame : -1;
}

/// "Priority": (T + 8) >> 4.
int priorityOf(const FramesHeader& frames, int t) {
  constexpr int kLow[] = {0, 74, 186, 310, 437, 565}, kHigh[] = {0, -61, -16, 85, 205, 331};
  const int s = levelOf(t, frames.count);
  int n = 0;
  if (frames.filter == 1) n = t == 0 ? 128 * s : 128 * s - 256;
  if (frames.filter == 2) n = t == 0 ? kLow[s] : kHigh[s];
  return (n + 256 * frames.scale(t).shift + 8) >> 4;
}

/// "Tracks": the bands of all planes.
std::vector<Band> bandsOfAll(const FrameLayout& layout, const std::vector<Part>& parts) {
  const int colours = static_cast<int>(layout.priorities.size()), frames = layout.frames.count;
  std::vector<Band> all;
  for (int t = 0; t < frames; ++t) {
    for (int c = 0; c < colours; ++c) {
      const int priority = layout.priorities[size_t(c)] + priorityOf(layout.frames, t);
      const int coarser = layout.frames.filter > 0 ? above(t, frames) : -1;
      const int companion = c > 0 ? t * colours + c - 1 : coarser < 0 ? -1 : coarser * colours;
      std::vector<Band> bands = bandsOf(layout.wavelet, parts, all.size());
      for (size_t i = 0; i < bands.size(); ++i) {
        Band& band = bands[i];
        band.logNorm += priority;
        if (band.leastKey) band.leastKey = priority;
        if (c > 0) band.modelClass += 5;
        if (companion >= 0) band.companion = size_t(companion) * parts.size() + i;
        all.push_back(std::move(band));
      }
    }
  }
  return all;
}

/// "Inverse over time", of one sample.
void invert(const FramesHeader& header, int f, std::vector<int32_t*>& v) {
  const int frames = header.count;
  const auto m = [&](int t) { return header.scale(t).shift; };
  const auto a = [&](int t) { return header.scale(t).offset * (int64_t{1} << f); };
  const auto times = [&](int t) { return int64_t{*v[size_t(t)]} * (int64_t{1} << m(t)); };
  const auto add = [&](int t, int64_t value) {
    *v[size_t(t)] = wrap(int64_t{*v[size_t(t)]} + value);
  };
  if (header.filter == 0) return;
  for (int d = 1 << (levelsOf(frames) - 1); d >= 1; d /= 2) {
    for (int t = 0; t < frames; t += 2 * d) {
      const int w = t + d < frames ? t + d : t - d, u = t - d >= 0 ? t - d : w;
      if (header.filter == 1 && t + d < frames) add(t, -(times(w) >> (m(t) + 1)));
      if (header.filter == 2) add(t, -((times(u) + times(w) + (int64_t{2} << m(t))) >> (m(t) + 2)));
    }
    for (int t = d; t < frames; t += 2 * d) {
      const int u = t - d, w = t + d < frames ? t + d : u;
      const int64_t zu = a(u) + times(u), zw = a(w) + times(w), one = int64_t{1} << m(t);
      if (header.filter == 1) add(t, (zu - a(t) + one / 2) >> m(t));
      if (header.filter == 2) add(t, (zu + zw - 2 * a(t) + one) >> (m(t) + 1));
    }
  }
}

/// "v[0] of colour c first becomes".
void addReference(const std::vector<int32_t>& before, int width, int level, int f, Plane& plane) {
  for (int y = 0; y < plane.height; ++y) {
    for (int x = 0; x < plane.width; ++x) {
      int32_t& value = plane.values[size_t(y) * size_t(plane.width) + size_t(x)];
      const int32_t r = before[size_t(y << level) * size_t(width) + size_t(x << level)];
      value = wrap(int64_t{value} + int64_t{r} * (int64_t{1} << f));
    }
  }
}

void invertAll(const FrameLayout& layout, int width, int level, FramePlanes& of) {
  const size_t colours = layout.priorities.size();
  for (size_t c = 0; c < colours; ++c) {
    if (!layout.frames.before.empty())
      addReference(layout.frames.before[c], width, level, of.f, of.planes[c]);
    for (size_t i = 0; i < of.planes[c].values.size(); ++i) {
      std::vector<int32_t*> v;
      for (size_t p = c; p < of.planes.size(); p += colours) v.push_back(&of.planes[p].values[i]);
      invert(layout.frames, of.f, v);
    }
  }
}

}  // namespace

FramePlanes decodeFrames(const FrameLayout& layout, const Plane& lifted,
                         const std::vector<std::span<const uint8_t>>& coefficients, int level) {
  const Forest grid;
  const auto tracks = partsOf(grid, lifted.width, lifted.height, layout.regions);
  FramePlanes out;
  out.f = fractionOf(layout.wavelet, layout.bitPlanes, bytesOf(coefficients), level);
  Plane empty = lifted;
  empty.values.resize(size_t(lifted.width) * size_t(lifted.height));
  out.planes.assign(layout.priorities.size() * size_t(layout.frames.count), empty);
  for (size_t track = 0; track < tracks.size(); ++track) {
    const std::vector<Part>& parts = tracks[track];
    std::vector<Band> bands = bandsOfAll(layout, parts);
    const auto ofPlane = [&](size_t p) {
      return std::span(bands).subspan(p * parts.size(), parts.size());
    };
    for (size_t p = 0; p < out.planes.size(); ++p) {
      markAbsent(grid, parts, lifted, ofPlane(p));
      dropFiner(parts, level, ofPlane(p));
    }
    decodeTrack(coefficients[track], layout.bitPlanes, bands);
    for (size_t p = 0; p < out.planes.size(); ++p)
      place(ofPlane(p), parts, out.f - layout.wavelet.fractionBits, out.planes[p]);
  }
  for (Plane& plane : out.planes) {
    synthesise(layout.wavelet, level, plane);
    if (level > 0) plane = reference::levelOf(layout.wavelet, level, plane);
  }
  invertAll(layout, lifted.width, level, out);
  return out;
}

namespace {

struct HeightFrames {
  FramePlanes frames;
  std::vector<std::vector<uint8_t>> masks;  ///< of each frame, level 0; empty: all are valid
};

HeightFrames heightFrames(const GeometryHeader& header, const Layers& layers,
                          const Codewords& codewords, int level) {
  const int width = header.width, height = header.height;
  std::vector<std::span<const uint8_t>> coefficients(codewords.begin(), codewords.end());
  const auto validity = take(coefficients[0], layers.validityBytes);
  std::vector<std::vector<uint8_t>> masks(size_t(header.frames.count));
  Plane lifted{width, height, {}, {}};
  if (layers.validityBytes > 0) {
    masks = decodeFrameMasks(validity, width, height, header.frames.count);
    lifted.valid.assign(masks[0].size(), 0);
    for (const auto& mask : masks)
      for (size_t i = 0; i < mask.size(); ++i) lifted.valid[i] |= mask[i];
    if (std::find(lifted.valid.begin(), lifted.valid.end(), 0) == lifted.valid.end())
      lifted.valid.clear();
    if (layers.bridge > 0 && !lifted.valid.empty())
      lifted.valid = bridged(lifted.valid, width, height, layers.bridge);
  }
  const FrameLayout layout{header.wavelet, header.regions, header.frames, header.planes, {0}};
  return {decodeFrames(layout, lifted, coefficients, level), std::move(masks)};
}

}  // namespace

std::vector<uint8_t> decodeHeightFrames(const GeometryHeader& header, const Layers& layers,
                                        const Codewords& codewords, int level) {
  const int width = header.width, height = header.height;
  auto [frames, masks] = heightFrames(header, layers, codewords, level);
  std::vector<uint8_t> all;
  for (int t = 0; t < header.frames.count; ++t) {
    GeometryHeader one = header;
    one.base = header.base + double(header.frames.scale(t).offset) * header.step;
    one.step = std::ldexp(header.step, header.frames.scale(t).shift);
    Surface surface;
    surface.f = frames.f;
    surface.plane = std::move(frames.planes[size_t(t)]);
    surface.plane.valid.clear();
    const auto& mask = masks[size_t(t)];
    for (int y = 0; y < height && !mask.empty(); y += 1 << level)
      for (int x = 0; x < width; x += 1 << level)
        surface.plane.valid.push_back(mask[size_t(y) * size_t(width) + size_t(x)]);
    MadeSamples samples = samplesOf(one, {}, surface);
    putVoids(one, layers, surface.plane, samples.bits);
    const std::vector<uint8_t> bytes = bytesOf(one, samples.bits);
    all.insert(all.end(), bytes.begin(), bytes.end());
  }
  return all;
}

namespace {

/// A pass of "Heights that are void in that frame are filled".
void fillPass(int width, int height, std::vector<int32_t>& values, std::vector<uint8_t>& valid) {
  const std::vector<int32_t> known = values;
  const std::vector<uint8_t> had = valid;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const size_t at = size_t(y) * size_t(width) + size_t(x);
      if (had[at]) continue;
      int64_t sum = 0, weights = 0;
      for (const auto [dx, dy] : {std::array{-1, 0}, {1, 0}, {0, -1}, {0, 1}}) {
        for (int d = 1;; ++d) {
          const int u = x + d * dx, v = y + d * dy;
          if (u < 0 || v < 0 || u >= width || v >= height) break;
          const size_t other = size_t(v) * size_t(width) + size_t(u);
          if (!had[other]) continue;
          const int64_t w = std::max(65536 / d, 1);
          sum += w * known[other];
          weights += w;
          break;
        }
      }
      if (weights == 0) continue;
      const int64_t above = 2 * sum + weights, below = 2 * weights;
      values[at] = static_cast<int32_t>(above / below - (above % below < 0 ? 1 : 0));
      valid[at] = 1;
    }
  }
}

}  // namespace

std::vector<int32_t> wholeSteps(const Plane& plane, int f) {
  std::vector<int32_t> steps = plane.values;
  if (f == 0) return steps;
  for (int32_t& x : steps) x = static_cast<int32_t>((x + (int64_t{1} << (f - 1))) >> f);
  return steps;
}

ReferencePlanes lastHeights(const GeometryHeader& header, const Layers& layers,
                            const Codewords& codewords) {
  const auto [frames, masks] = heightFrames(header, layers, codewords, 0);
  std::vector<int32_t> steps = wholeSteps(frames.planes.back(), frames.f);
  std::vector<uint8_t> valid = masks.back();
  for (size_t i = 0; i < valid.size(); ++i)
    if (!valid[i]) steps[i] = 0;
  for (int pass = 0; pass < 2 && !valid.empty(); ++pass)
    fillPass(header.width, header.height, steps, valid);
  return {steps};
}

}  // namespace tetrakis::reference

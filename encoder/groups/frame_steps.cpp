// SPDX-License-Identifier: Apache-2.0
#include "encoder/groups/frame_steps.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <limits>
#include <optional>
#include <utility>

#include "codec/geometry/quantiser/height_steps.hpp"
#include "codec/geometry/quantiser/step_choice.hpp"

namespace tetrakis::inline groups {

namespace {

/// Bits that heights of frames may span, as HeightSteps have them.
constexpr int kMostRangeBits = 26;

/// All frames one below the other, as heights of their own.
struct StackedFrames {
  std::vector<std::byte> samples;
  tks_heights heights;

  explicit StackedFrames(std::span<const tks_heights> frames) : heights(frames.front()) {
    const size_t bytes = extentOf(heights).samples() * tks_sample_bytes(heights.sample);
    samples.resize(bytes * frames.size());
    for (size_t t = 0; t < frames.size(); ++t)
      std::memcpy(samples.data() + t * bytes, frames[t].data, bytes);
    heights.height *= static_cast<uint32_t>(frames.size());
    heights.data = samples.data();
    heights.domain = TKS_DOMAIN_PLANE;
  }
};

FrameSteps cutApart(const HeightSteps& all, Extent extent, size_t frames) {
  FrameSteps out;
  const size_t samples = extent.samples();
  for (size_t t = 0; t < frames; ++t) {
    const auto first = static_cast<ptrdiff_t>(t * samples);
    const auto last = first + static_cast<ptrdiff_t>(samples);
    out.steps.emplace_back(all.steps.begin() + first, all.steps.begin() + last);
    out.masks.push_back(
        all.valid.empty()
            ? nullptr
            : shared(BitPlane(std::span(all.valid).subspan(t * samples, samples), extent)));
  }
  out.step = all.step;
  out.base = all.base;
  out.exact = all.exact;
  out.range_bits = all.range_bits;
  return out;
}

/// The steps that show each frame exactly by itself; none if some frame has no such steps.
std::vector<HeightSteps> ownSteps(std::span<const tks_heights> frames) {
  std::vector<HeightSteps> own;
  for (const tks_heights& frame : frames) {
    Result<HeightSteps> steps = toSteps(frame, {});
    if (!steps.ok() || !steps->exact) return {};
    own.push_back(*std::move(steps));
  }
  return own;
}

/// How often a step is doubled from the finest one on; nothing if it is not.
std::optional<uint8_t> shiftOf(double step, double finest) {
  int shift = 0;
  const bool doubled = std::frexp(step / finest, &shift) == 0.5;
  if (!doubled || shift < 1 || shift > FrameScale::kMostShift + 1) return std::nullopt;
  return static_cast<uint8_t>(shift - 1);
}

/// The scales of frames in a base and a step; none if they do not have whole offsets.
std::vector<FrameScale> scalesOf(const std::vector<HeightSteps>& own, double base, double step) {
  std::vector<FrameScale> scales;
  for (const HeightSteps& frame : own) {
    const double offset = std::round((frame.base - base) / step);
    const std::optional<uint8_t> shift = frame.range_bits == 0 ? 0 : shiftOf(frame.step, step);
    if (!shift || !(std::abs(offset) < FrameScale::kMostOffset)) return {};
    scales.push_back({static_cast<int64_t>(offset), *shift});
  }
  return scales;
}

/// The bits of all heights that scaled frames span, in steps of the finest.
int spanBits(const FrameSteps& frames) {
  int64_t low = INT64_MAX, high = INT64_MIN;
  for (size_t t = 0; t < frames.steps.size(); ++t) {
    const auto [least, most] = std::minmax_element(frames.steps[t].begin(), frames.steps[t].end());
    const FrameScale scale = frames.scale(t);
    low = std::min(low, scale.offset + (int64_t{*least} << scale.shift));
    high = std::max(high, scale.offset + (int64_t{*most} << scale.shift));
  }
  return static_cast<int>(std::bit_width(static_cast<uint64_t>(high - low)));
}

/// Frames whose steps are their own; nothing if these have no common scale.
std::optional<FrameSteps> scaledSteps(std::span<const tks_heights> frames) {
  std::vector<HeightSteps> own = ownSteps(frames);
  if (own.empty()) return std::nullopt;
  FrameSteps out;
  out.step = std::numeric_limits<double>::infinity();
  for (const HeightSteps& frame : own)
    if (frame.range_bits > 0) out.step = std::min(out.step, frame.step);
  if (!std::isfinite(out.step)) return std::nullopt;
  out.base = own.front().base;
  out.scales = scalesOf(own, out.base, out.step);
  if (out.scales.empty()) return std::nullopt;
  for (size_t t = 0; t < own.size(); ++t) {
    HeightSteps& steps = own[t];
    steps.base = out.base + static_cast<double>(out.scales[t].offset) * out.step;
    steps.step = std::ldexp(out.step, out.scales[t].shift);
    if (errorsOf(frames[t], steps).largest > 0) return std::nullopt;
    out.masks.push_back(sharedBits(steps.valid, extentOf(frames[t])));
    out.steps.push_back(std::move(steps.steps));
  }
  out.exact = true;
  out.range_bits = spanBits(out);
  return out.range_bits <= kMostRangeBits ? std::optional(std::move(out)) : std::nullopt;
}

/// The steps of all frames together, or those of each frame where these are wider, or alone exact.
Result<FrameSteps> exactSteps(std::span<const tks_heights> frames) {
  const StackedFrames stack(frames);
  const Result<HeightSteps> together = toSteps(stack.heights, {});
  if (!together.ok()) return together.status();
  FrameSteps steps = cutApart(*together, extentOf(frames.front()), frames.size());
  if (stack.heights.sample != TKS_F32) return steps;
  std::optional<FrameSteps> scaled = scaledSteps(frames);
  if (!scaled) return steps;
  const auto is_wider = [&](const FrameScale& scale) {
    return std::ldexp(scaled->step, scale.shift) > steps.step;
  };
  const bool wider = std::any_of(scaled->scales.begin(), scaled->scales.end(), is_wider);
  return wider || !steps.exact ? *std::move(scaled) : steps;
}

/// Steps with which every sample is within the error: as wide as twice that, on the grid of the
/// samples if they have a coarse one.
Result<FrameSteps> boundedSteps(std::span<const tks_heights> frames, double error) {
  const StackedFrames stack(frames);
  const Result<HeightSteps> fine = toSteps(stack.heights, {});
  if (!fine.ok()) return fine.status();
  const Extent extent = extentOf(frames.front());
  const double times = std::floor(error / fine->step);
  if (fine->exact && times < 1) return cutApart(*fine, extent, frames.size());
  // Rounding to floats takes a part of the error.
  constexpr double kNearly = 1 - 0x1p-10;
  const double step =
      fine->exact && times < 1 / (1 - kNearly) ? fine->step * (2 * times + 1) : 2 * error * kNearly;
  const Result<HeightSteps> coarse = toSteps(stack.heights, {.given = step});
  const bool within = coarse.ok() && errorsOf(stack.heights, *coarse).largest <= error;
  if (within) return cutApart(*coarse, extent, frames.size());
  if (fine->exact) return cutApart(*fine, extent, frames.size());
  return Status(TKS_UNSUPPORTED, "No steps of these frames keep so small a largest error.");
}

}  // namespace

uint64_t FrameSteps::validSamples() const {
  uint64_t count = 0;
  for (size_t t = 0; t < steps.size(); ++t) {
    if (masks[t] == nullptr) {
      count += steps[t].size();
      continue;
    }
    const Extent extent = masks[t]->extent();
    for (uint32_t y = 0; y < extent.height; ++y) count += masks[t]->countBefore(extent.width, y);
  }
  return count;
}

Result<FrameSteps> stepsOfFrames(std::span<const tks_heights> frames,
                                 const tks_encode_options& options) {
  const tks_heights& first = frames.front();
  const Extent extent = extentOf(first);
  if (options.max_error > 0) return boundedSteps(frames, options.max_error / std::abs(first.scale));
  if (options.lossless != 0) {
    Result<FrameSteps> steps = exactSteps(frames);
    if (!steps.ok() || steps->exact) return steps;
    return Status(TKS_UNSUPPORTED, "No step shows all samples of these frames exactly.");
  }
  const StackedFrames stack(frames);
  const Result<HeightSteps> steps =
      toSteps(stack.heights, {.given = first.step, .leave_outliers = options.bytes != 0});
  if (!steps.ok()) return steps.status();
  return cutApart(*steps, extent, frames.size());
}

namespace {

/// valid: as of HeightSteps. The samples lie within 2^25 steps of the base.
HeightSteps quantised(const tks_heights& heights, std::vector<uint8_t> valid, double base,
                      double step) {
  HeightSteps out;
  out.base = base;
  out.step = step;
  out.exact = true;
  withSampleType(heights.sample, [&](auto type) {
    using T = decltype(type);
    const auto* samples = static_cast<const T*>(heights.data);
    out.steps.resize(extentOf(heights).samples());
    for (size_t i = 0; i < out.steps.size(); ++i) {
      if (!valid.empty() && valid[i] == 0) continue;
      out.steps[i] =
          static_cast<int32_t>(std::lround((static_cast<double>(samples[i]) - base) / step));
      const T restored = restore<T>(base, step, out.steps[i]);
      out.exact &= std::memcmp(&restored, &samples[i], sizeof restored) == 0;
    }
  });
  out.valid = std::move(valid);
  return out;
}

}  // namespace

std::optional<FrameSteps> stepsLike(const GeometryHeader& before,
                                    std::span<const tks_heights> frames,
                                    const tks_encode_options& options) {
  if (!before.frames.scales.empty()) return std::nullopt;
  const StackedFrames stack(frames);
  const Result<std::vector<uint8_t>> valid = findVoids(stack.heights);
  if (!valid.ok()) return std::nullopt;
  const SampleRange range = rangeOf(stack.heights, *valid);
  const double most =
      std::max(std::abs(range.low - before.base), std::abs(range.high - before.base));
  if (!(most / before.step < (1 << (kMostRangeBits - 1)))) return std::nullopt;
  HeightSteps steps = quantised(stack.heights, *valid, before.base, before.step);
  const double error = errorsOf(stack.heights, steps).largest;
  if (options.lossless != 0 && !steps.exact) return std::nullopt;
  if (options.max_error > 0 && !(error * std::abs(frames.front().scale) <= options.max_error))
    return std::nullopt;
  const double span = (range.high - range.low) / before.step;
  steps.range_bits = static_cast<int>(std::bit_width(static_cast<uint64_t>(span)));
  return cutApart(steps, extentOf(frames.front()), frames.size());
}

FrameSteps filled(FrameSteps of) {
  const size_t frames = of.steps.size(), samples = of.steps.front().size();
  const auto none = [](const SharedBits& mask) { return mask == nullptr; };
  if (std::all_of(of.masks.begin(), of.masks.end(), none)) return of;
  std::vector<std::vector<uint8_t>> valid;
  for (const SharedBits& mask : of.masks) valid.push_back(shownMarks(mask, {}));
  const auto is_valid = [&](size_t t, size_t i) { return valid[t].empty() || valid[t][i] != 0; };
  const auto height_at = [&](size_t t, size_t i) {
    const FrameScale scale = of.scale(t);
    return scale.offset + (int64_t{of.steps[t][i]} << scale.shift);
  };
  const auto put = [&](size_t t, size_t i, int64_t height) {
    const FrameScale scale = of.scale(t);
    of.steps[t][i] = static_cast<int32_t>((height - scale.offset) >> scale.shift);
  };
  for (size_t i = 0; i < samples; ++i) {
    size_t before = frames;  // the last valid frame; none so far
    for (size_t t = 0; t < frames; ++t) {
      if (is_valid(t, i)) {
        before = t;
        continue;
      }
      size_t after = t + 1;
      while (after < frames && !is_valid(after, i)) ++after;
      if (before == frames && after == frames) break;
      const int64_t a = height_at(before == frames ? after : before, i);
      const int64_t b = height_at(after == frames ? before : after, i);
      const bool inside = before != frames && after != frames;
      for (; t < after; ++t) {
        const auto way = static_cast<int64_t>(inside ? t - before : 0);
        const auto all = static_cast<int64_t>(inside ? after - before : 1);
        put(t, i, a + (b - a) * way / all);
      }
      before = after;
    }
  }
  return of;
}

}  // namespace tetrakis::inline groups

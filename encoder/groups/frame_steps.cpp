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

int spanBits(const Planes& planes) {
  int32_t low = std::numeric_limits<int32_t>::max(), high = std::numeric_limits<int32_t>::min();
  for (const std::vector<int32_t>& plane : planes) {
    for (const int32_t value : plane) {
      low = std::min(low, value);
      high = std::max(high, value);
    }
  }
  return static_cast<int>(std::bit_width(static_cast<uint32_t>(high) - static_cast<uint32_t>(low)));
}

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

/// The least of the steps that show each frame exactly by itself, if it shows all of them.
std::optional<double> commonStep(std::span<const tks_heights> frames) {
  double least = std::numeric_limits<double>::infinity();
  for (const tks_heights& frame : frames) {
    const Result<HeightSteps> steps = toSteps(frame, {});
    if (!steps.ok() || !steps->exact) return std::nullopt;
    if (steps->range_bits > 0) least = std::min(least, steps->step);
  }
  return std::isfinite(least) ? std::optional(least) : std::nullopt;
}

/// Bases that lie as near to that of the first frame as whole steps bring them; the steps move the
/// other way. Nothing if the samples do not come back from those.
std::optional<FrameSteps> withOwnBases(std::span<const tks_heights> frames, double step) {
  FrameSteps out;
  for (const tks_heights& frame : frames) {
    Result<HeightSteps> steps = toSteps(frame, {.given = step});
    if (!steps.ok() || !steps->exact) return std::nullopt;
    if (out.steps.empty()) out.base = steps->base;
    const double away = std::round((steps->base - out.base) / step);
    if (!(std::abs(away) < 1 << 25)) return std::nullopt;
    const double base = steps->base - away * step;
    for (int32_t& value : steps->steps) value += static_cast<int32_t>(away);
    HeightSteps moved = std::move(*steps);
    moved.base = base;
    if (errorsOf(frame, moved).largest > 0) return std::nullopt;
    if (!out.steps.empty()) out.bases.push_back(base);
    const Extent extent = extentOf(frame);
    out.masks.push_back(sharedBits(moved.valid, extent));
    out.steps.push_back(std::move(moved.steps));
  }
  out.step = step;
  out.exact = true;
  out.range_bits = spanBits(out.steps);
  return out;
}

/// The steps of all frames together, or finer ones with a base for each frame where these take
/// fewer bits or are the only exact ones.
Result<FrameSteps> exactSteps(std::span<const tks_heights> frames) {
  const StackedFrames stack(frames);
  const Result<HeightSteps> together = toSteps(stack.heights, {});
  if (!together.ok()) return together.status();
  const Extent extent = extentOf(frames.front());
  FrameSteps steps = cutApart(*together, extent, frames.size());
  if (stack.heights.sample != TKS_F32) return steps;
  const std::optional<double> common = commonStep(frames);
  if (!common || (steps.exact && *common <= steps.step)) return steps;
  std::optional<FrameSteps> own = withOwnBases(frames, *common);
  return own ? *std::move(own) : steps;
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

FrameSteps filled(FrameSteps of) {
  const size_t frames = of.steps.size(), samples = of.steps.front().size();
  const auto none = [](const SharedBits& mask) { return mask == nullptr; };
  if (std::all_of(of.masks.begin(), of.masks.end(), none)) return of;
  std::vector<std::vector<uint8_t>> valid;
  for (const SharedBits& mask : of.masks) valid.push_back(shownMarks(mask, {}));
  const auto is_valid = [&](size_t t, size_t i) { return valid[t].empty() || valid[t][i] != 0; };
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
      const int64_t a = of.steps[before == frames ? after : before][i];
      const int64_t b = of.steps[after == frames ? before : after][i];
      for (; t < after; ++t) {
        const bool inside = before != frames && after != frames;
        const auto way = static_cast<int64_t>(inside ? t - before : 0);
        const auto all = static_cast<int64_t>(inside ? after - before : 1);
        of.steps[t][i] = static_cast<int32_t>(a + (b - a) * way / all);
      }
      before = after;
      t = after;
    }
  }
  return of;
}

}  // namespace tetrakis::inline groups

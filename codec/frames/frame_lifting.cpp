// SPDX-License-Identifier: Apache-2.0
// Haar is the S-transform; 5/3 is that of D. Le Gall and A. Tabatabai (1988), lifted.
#include "codec/frames/frame_lifting.hpp"

#include <array>
#include <bit>
#include <cassert>
#include <cstddef>

#include "base/portable_math.hpp"

namespace tetrakis::inline frames {

namespace {

int32_t wrapped(int64_t value) {
  return static_cast<int32_t>(static_cast<uint32_t>(value));
}

/// One step at the plane `of`, which is at an odd place of its level if it is predicted.
struct Step {
  std::span<int32_t> of;
  std::span<const int32_t> before, after;  ///< mirrored at the ends; Haar reads one of them

  /// Adds sign * round((before + after) / 2^shift) to the values.
  void addMean(int sign, int shift) const {
    const int64_t half = int64_t{1} << (shift - 1);
    for (size_t i = 0; i < of.size(); ++i)
      of[i] = wrapped(of[i] + sign * ((int64_t{before[i]} + after[i] + half) >> shift));
  }
  /// Adds sign * floor(from / 2^shift).
  void add(std::span<const int32_t> from, int sign, int shift) const {
    for (size_t i = 0; i < of.size(); ++i)
      of[i] = wrapped(of[i] + int64_t{sign} * (from[i] >> shift));
  }
  /// sign: 1 in the inverse.
  void predict(TimeFilter filter, int sign) const {
    if (filter == TimeFilter::kHaar) return add(before, sign, 0);
    addMean(sign, 1);
  }
  /// sign: -1 in the inverse. has_pair: there is a plane behind this one.
  void update(TimeFilter filter, int sign, bool has_pair) const {
    if (filter == TimeFilter::kFiveThree) return addMean(sign, 2);
    if (has_pair) add(after, sign, 1);
  }
};

/// The step of a plane of a level whose planes lie `distance` apart.
Step stepAt(const FrameViews& frames, size_t plane, size_t distance) {
  const size_t count = frames.size();
  const size_t after = plane + distance < count ? plane + distance : plane - distance;
  const size_t before = plane >= distance ? plane - distance : after;
  return {frames[plane], frames[before], frames[after]};
}

template <class Do>
void forEach(size_t first, size_t step, size_t count, const Do& what) {
  for (size_t t = first; t < count; t += step) what(t);
}

void predictAll(TimeFilter filter, const FrameViews& frames, size_t distance, int sign) {
  forEach(distance, 2 * distance, frames.size(),
          [&](size_t t) { stepAt(frames, t, distance).predict(filter, sign); });
}

void updateAll(TimeFilter filter, const FrameViews& frames, size_t distance, int sign) {
  const size_t count = frames.size();
  forEach(0, 2 * distance, count, [&](size_t t) {
    stepAt(frames, t, distance).update(filter, sign, t + distance < count);
  });
}

}  // namespace

void forwardFrames(TimeFilter filter, const FrameViews& frames) {
  if (filter == TimeFilter::kNone) return;
  for (size_t distance = 1; distance < frames.size(); distance *= 2) {
    predictAll(filter, frames, distance, -1);
    updateAll(filter, frames, distance, 1);
  }
}

void inverseFrames(TimeFilter filter, const FrameViews& frames) {
  if (filter == TimeFilter::kNone) return;
  for (size_t distance = std::bit_floor(frames.size() - 1); distance > 0; distance /= 2) {
    updateAll(filter, frames, distance, -1);
    predictAll(filter, frames, distance, 1);
  }
}

namespace {

/// 256 log2 of the norm of a low and of a high plane behind so many splits (docs/FORMAT.md, section
/// 7, *Norms*, filter 0).
constexpr std::array<int, 6> kLow53 = {0, 74, 186, 310, 437, 565};
constexpr std::array<int, 6> kHigh53 = {0, -61, -16, 85, 205, 331};

int fineNorm(TimeFilter filter, bool high, size_t splits) {
  if (filter == TimeFilter::kNone) return 0;
  const int by_halves = 128 * static_cast<int>(splits);
  if (filter == TimeFilter::kHaar) return high ? by_halves - 256 : by_halves;
  return (high ? kHigh53 : kLow53)[splits];
}

}  // namespace

FrameNorms::FrameNorms(TimeFilter filter, uint32_t frames) {
  assert(frames >= 1 && frames <= FramesHeader::kMost);
  const auto levels = static_cast<size_t>(std::bit_width(frames - 1));
  fine_.push_back(fineNorm(filter, false, levels));
  for (uint32_t t = 1; t < frames; ++t)
    fine_.push_back(fineNorm(filter, true, static_cast<size_t>(std::countr_zero(t)) + 1));
}

double FrameNorms::energy(uint32_t plane) const {
  return portable::exp2(2.0 * fine_[plane] / kFineSteps);
}

uint32_t coarserFrame(uint32_t plane, uint32_t frames) {
  if (plane == 0) return plane;
  const uint32_t own = plane & (0u - plane);
  const uint32_t coarser = (plane & ~(4 * own - 1)) | 2 * own;
  return coarser < frames ? coarser : plane;
}

}  // namespace tetrakis::inline frames

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

/// A plane with its scale. Values are in units of 2^-fraction_bits.
struct Plane {
  std::span<int32_t> values;
  int64_t offset = 0;  ///< in these units
  int shift = 0;

  /// In steps of the component: of a frame, and of a difference of frames.
  int64_t whole(size_t i) const { return offset + difference(i); }
  int64_t difference(size_t i) const { return int64_t{values[i]} << shift; }
};

/// One step of the inverse, or its opposite, at one plane: `of`. The planes beside it are mirrored
/// at the ends.
struct Step {
  Plane of, before, after;

  /// Adds sign * (from(i) / 2^more, rounded to the plane's own steps) to its values.
  template <class From>
  void add(int sign, int more, int64_t half, const From& from) const {
    const int shift = of.shift + more;
    for (size_t i = 0; i < of.values.size(); ++i)
      of.values[i] = wrapped(of.values[i] + sign * ((from(i) + half) >> shift));
  }
  /// sign: 1 in the inverse.
  void predict(TimeFilter filter, int sign) const {
    if (filter == TimeFilter::kHaar) {
      const int64_t half = (int64_t{1} << of.shift) >> 1;
      return add(sign, 0, half, [&](size_t i) { return before.whole(i) - of.offset; });
    }
    add(sign, 1, int64_t{1} << of.shift,
        [&](size_t i) { return before.whole(i) + after.whole(i) - 2 * of.offset; });
  }
  /// sign: -1 in the inverse. has_pair: there is a plane behind this one.
  void update(TimeFilter filter, int sign, bool has_pair) const {
    if (filter == TimeFilter::kFiveThree) {
      add(sign, 2, int64_t{2} << of.shift,
          [&](size_t i) { return before.difference(i) + after.difference(i); });
    } else if (has_pair) {
      add(sign, 1, 0, [&](size_t i) { return after.difference(i); });
    }
  }
};

/// All planes of a group, lifted level by level.
class Lifting {
 public:
  Lifting(const FramesHeader& header, int fraction_bits, const FrameViews& frames)
      : filter_(header.filter) {
    for (size_t t = 0; t < frames.size(); ++t) {
      const FrameScale scale = header.scale(t);
      planes_.push_back({frames[t], scale.offset << fraction_bits, scale.shift});
    }
  }
  /// distance: of the planes of a level.
  void predict(size_t distance, int sign) const {
    for (size_t t = distance; t < planes_.size(); t += 2 * distance)
      stepAt(t, distance).predict(filter_, sign);
  }
  void update(size_t distance, int sign) const {
    for (size_t t = 0; t < planes_.size(); t += 2 * distance)
      stepAt(t, distance).update(filter_, sign, t + distance < planes_.size());
  }

 private:
  Step stepAt(size_t plane, size_t distance) const {
    const size_t after = plane + distance < planes_.size() ? plane + distance : plane - distance;
    const size_t before = plane >= distance ? plane - distance : after;
    return {planes_[plane], planes_[before], planes_[after]};
  }

  TimeFilter filter_;
  std::vector<Plane> planes_;
};

}  // namespace

void forwardFrames(const FramesHeader& header, int fraction_bits, const FrameViews& frames) {
  if (header.filter == TimeFilter::kNone) return;
  const Lifting lifting(header, fraction_bits, frames);
  for (size_t distance = 1; distance < frames.size(); distance *= 2) {
    lifting.predict(distance, -1);
    lifting.update(distance, 1);
  }
}

void inverseFrames(const FramesHeader& header, int fraction_bits, const FrameViews& frames) {
  if (header.filter == TimeFilter::kNone) return;
  const Lifting lifting(header, fraction_bits, frames);
  for (size_t distance = std::bit_floor(frames.size() - 1); distance > 0; distance /= 2) {
    lifting.update(distance, -1);
    lifting.predict(distance, 1);
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

FrameNorms::FrameNorms(const FramesHeader& header) {
  const uint32_t frames = header.count;
  assert(frames >= 1 && frames <= FramesHeader::kMost);
  const auto levels = static_cast<size_t>(std::bit_width(frames - 1));
  for (uint32_t t = 0; t < frames; ++t) {
    const size_t splits = t == 0 ? levels : static_cast<size_t>(std::countr_zero(t)) + 1;
    fine_.push_back(fineNorm(header.filter, t > 0, splits) + kFineSteps * header.scale(t).shift);
  }
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

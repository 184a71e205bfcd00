// SPDX-License-Identifier: Apache-2.0
#include "ratecontrol/receiver/ground_sight.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>

namespace tetrakis::inline receiver {

namespace {

/// Coarse ground as the eye sees it.
class Sight {
 public:
  Sight(const CoarseGround& ground, const Eye& eye)
      : ground_(ground), view_(eye), eye_(placeOf(eye)) {
    highest_ = *std::max_element(ground.heights.begin(), ground.heights.end());
  }

  GroundPoint at(uint32_t x, uint32_t y) const { return unlessHidden(x, y, shown(pointAt(x, y))); }

  /// After a turn about the vertical through the eye that brings the point to the middle column.
  GroundPoint faced(uint32_t x, uint32_t y, double aspect) const {
    if (!eye_) return {};
    Vec3 place = pointAt(x, y);
    const double* ahead = &view_.clip[12];  // w rises along it
    const double across = ahead[0] / aspect, down = ahead[1];
    const double most = std::hypot(across, down);
    if (!(most > 0)) return {};
    const double away = std::hypot((place[0] - (*eye_)[0]) * aspect, place[1] - (*eye_)[1]);
    place[0] = (*eye_)[0] + away * across / most / aspect;
    place[1] = (*eye_)[1] + away * down / most;
    return unlessHidden(x, y, shown(place));
  }

 private:
  GroundPoint unlessHidden(uint32_t x, uint32_t y, const GroundPoint& seen) const {
    return seen.pixels > 0 && !isHidden(x, y) ? seen : GroundPoint{};
  }

  Vec3 pointAt(uint32_t x, uint32_t y) const {
    return {double(x) * ground_.step, double(y) * ground_.step, heightAt(x, y)};
  }

  /// The pixels and the parallax of a point that nothing hides.
  GroundPoint shown(const Vec3& point) const {
    const std::optional<PixelsBy> by = pixelsBy(view_, point);
    if (!by) return {};
    return shownPoint(by->along({1, 0, 0}), by->along({0, 1, 0}), by->along({0, 0, 1}));
  }

  double heightAt(uint32_t x, uint32_t y) const {
    return ground_.heights[size_t{y} * ground_.columns + x];
  }

  /// The highest of a point and its neighbours: low-pass filtered ground hides what is behind it,
  /// not its own tops.
  double topAt(uint32_t x, uint32_t y) const {
    double top = heightAt(x, y);
    for (uint32_t j = y > 0 ? y - 1 : 0; j <= std::min(y + 1, ground_.rows - 1); ++j)
      for (uint32_t i = x > 0 ? x - 1 : 0; i <= std::min(x + 1, ground_.columns - 1); ++i)
        top = std::max(top, heightAt(i, j));
    return top;
  }

  bool isHidden(uint32_t x, uint32_t y) const {
    if (!eye_) return false;
    const double top = topAt(x, y);
    const double ex = (*eye_)[0] / ground_.step, ey = (*eye_)[1] / ground_.step;
    const double steps = std::max(std::abs(ex - x), std::abs(ey - y));
    for (double i = 2; i < steps; ++i) {  // the neighbours are the point's own hill
      const double t = i / steps, h = top + t * ((*eye_)[2] - top);
      if (h > highest_ && (*eye_)[2] >= top) return false;
      const double column = std::round(x + t * (ex - x)), row = std::round(y + t * (ey - y));
      if (column < 0 || row < 0 || column >= ground_.columns || row >= ground_.rows) return false;
      if (heightAt(static_cast<uint32_t>(column), static_cast<uint32_t>(row)) > h) return true;
    }
    return false;
  }

  const CoarseGround& ground_;
  const Eye& view_;
  std::optional<Vec3> eye_;
  double highest_ = 0;
};

template <class See>
std::vector<GroundPoint> seenOf(const CoarseGround& ground, See&& see) {
  assert(ground.heights.size() == size_t{ground.columns} * ground.rows);
  std::vector<GroundPoint> seen;
  seen.reserve(ground.heights.size());
  for (uint32_t y = 0; y < ground.rows; ++y)
    for (uint32_t x = 0; x < ground.columns; ++x) seen.push_back(see(x, y));
  return seen;
}

}  // namespace

std::vector<GroundPoint> sightOf(const CoarseGround& ground, const Eye& eye) {
  const Sight sight(ground, eye);
  return seenOf(ground, [&](uint32_t x, uint32_t y) { return sight.at(x, y); });
}

std::vector<GroundPoint> sightAround(const CoarseGround& ground, const Eye& eye, double aspect) {
  const Sight sight(ground, eye);
  return seenOf(ground, [&](uint32_t x, uint32_t y) { return sight.faced(x, y, aspect); });
}

}  // namespace tetrakis::inline receiver

// SPDX-License-Identifier: Apache-2.0
#include "ratecontrol/receiver/ground_sight.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>

namespace tetrakis::inline receiver {

namespace {

using Place = std::array<double, 3>;  // column, row, height

double determinant(const Place& a, const Place& b, const Place& c) {
  return a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) +
         a[2] * (b[0] * c[1] - b[1] * c[0]);
}

/// A row of the matrix at a place.
double rowAt(const std::array<double, 16>& clip, size_t row, const Place& p) {
  const double* m = &clip[4 * row];
  return m[0] * p[0] + m[1] * p[1] + m[2] * p[2] + m[3];
}

/// Where x, y and w of the clip coordinates are 0; nothing for parallel projections.
std::optional<Place> eyeOf(const std::array<double, 16>& clip) {
  std::array<Place, 3> columns{};
  Place constant{};
  constexpr std::array<size_t, 3> kRows = {0, 1, 3};
  for (size_t i = 0; i < 3; ++i) {
    for (size_t j = 0; j < 3; ++j) columns[j][i] = clip[4 * kRows[i] + j];
    constant[i] = -clip[4 * kRows[i] + 3];
  }
  const double all = determinant(columns[0], columns[1], columns[2]);
  Place eye{};
  for (size_t j = 0; j < 3; ++j) {
    std::array<Place, 3> replaced = columns;
    replaced[j] = constant;  // Cramer's rule
    eye[j] = determinant(replaced[0], replaced[1], replaced[2]) / all;
  }
  if (!std::all_of(eye.begin(), eye.end(), [](double v) { return std::isfinite(v); })) return {};
  return eye;
}

/// Coarse ground as the eye sees it.
class Sight {
 public:
  Sight(const CoarseGround& ground, const Eye& eye)
      : ground_(ground), view_(eye), eye_(eyeOf(eye.clip)) {
    highest_ = *std::max_element(ground.heights.begin(), ground.heights.end());
  }

  GroundPoint at(uint32_t x, uint32_t y) const { return unlessHidden(x, y, shown(placeOf(x, y))); }

  /// After a turn about the vertical through the eye that brings the point to the middle column.
  GroundPoint faced(uint32_t x, uint32_t y, double aspect) const {
    if (!eye_) return {};
    Place place = placeOf(x, y);
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

  Place placeOf(uint32_t x, uint32_t y) const {
    return {double(x) * ground_.step, double(y) * ground_.step, heightAt(x, y)};
  }

  /// The pixels and the parallax of a point that nothing hides.
  GroundPoint shown(const Place& point) const {
    const double w = rowAt(view_.clip, 3, point);
    const double cx = rowAt(view_.clip, 0, point), cy = rowAt(view_.clip, 1, point);
    // Ground that ends a step beyond the picture's border still reaches into it.
    constexpr double kBorder = 1.1;
    if (!(w > 0) || std::abs(cx) > kBorder * w || std::abs(cy) > kBorder * w) return {};
    std::array<double, 3> dx{}, dy{};  // pixels by column, row, height
    for (size_t j = 0; j < 3; ++j) {
      dx[j] = (view_.clip[j] - cx / w * view_.clip[12 + j]) / w * view_.width / 2;
      dy[j] = (view_.clip[4 + j] - cy / w * view_.clip[12 + j]) / w * view_.height / 2;
    }
    const double pixels = std::abs(dx[0] * dy[1] - dx[1] * dy[0]);
    const double parallax = dx[2] * dx[2] + dy[2] * dy[2];
    if (!std::isfinite(pixels) || !std::isfinite(parallax)) return {};
    return {pixels, parallax};
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
  std::optional<Place> eye_;
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

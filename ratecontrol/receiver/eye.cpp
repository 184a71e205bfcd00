// SPDX-License-Identifier: Apache-2.0
#include "ratecontrol/receiver/eye.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace tetrakis::inline receiver {

namespace {

double determinant(const Vec3& a, const Vec3& b, const Vec3& c) {
  return a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) +
         a[2] * (b[0] * c[1] - b[1] * c[0]);
}

/// A row of the matrix at a place.
double rowAt(const Eye& eye, size_t row, const Vec3& p) {
  const double* m = &eye.clip[4 * row];
  return m[0] * p[0] + m[1] * p[1] + m[2] * p[2] + m[3];
}

}  // namespace

std::optional<Vec3> placeOf(const Eye& eye) {
  std::array<Vec3, 3> columns{};
  Vec3 constant{};
  constexpr std::array<size_t, 3> kRows = {0, 1, 3};
  for (size_t i = 0; i < 3; ++i) {
    for (size_t j = 0; j < 3; ++j) columns[j][i] = eye.clip[4 * kRows[i] + j];
    constant[i] = -eye.clip[4 * kRows[i] + 3];
  }
  const double all = determinant(columns[0], columns[1], columns[2]);
  Vec3 place{};
  for (size_t j = 0; j < 3; ++j) {
    std::array<Vec3, 3> replaced = columns;
    replaced[j] = constant;  // Cramer's rule
    place[j] = determinant(replaced[0], replaced[1], replaced[2]) / all;
  }
  if (!std::all_of(place.begin(), place.end(), [](double v) { return std::isfinite(v); }))
    return {};
  return place;
}

std::array<double, 2> PixelsBy::along(const Vec3& way) const {
  return {dot(right, way), dot(up, way)};
}

std::optional<PixelsBy> pixelsBy(const Eye& eye, const Vec3& place) {
  const double w = rowAt(eye, 3, place);
  const double cx = rowAt(eye, 0, place), cy = rowAt(eye, 1, place);
  // Ground that ends a step beyond the picture's border still reaches into it.
  constexpr double kBorder = 1.1;
  if (!(w > 0) || std::abs(cx) > kBorder * w || std::abs(cy) > kBorder * w) return {};
  PixelsBy by;
  for (size_t j = 0; j < 3; ++j) {
    by.right[j] = (eye.clip[j] - cx / w * eye.clip[12 + j]) / w * eye.width / 2;
    by.up[j] = (eye.clip[4 + j] - cy / w * eye.clip[12 + j]) / w * eye.height / 2;
  }
  return by;
}

GroundPoint shownPoint(const std::array<double, 2>& column, const std::array<double, 2>& row,
                       const std::array<double, 2>& up) {
  const double pixels = std::abs(column[0] * row[1] - row[0] * column[1]);
  const double parallax = up[0] * up[0] + up[1] * up[1];
  if (!std::isfinite(pixels) || !std::isfinite(parallax)) return {};
  return {pixels, parallax};
}

}  // namespace tetrakis::inline receiver

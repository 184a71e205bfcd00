// SPDX-License-Identifier: Apache-2.0
#include "bitstream/stream/georeference.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

namespace tetrakis::inline stream {

namespace {

/// Compares bit for bit: -0 is not 0.
bool same(double a, double b) {
  return std::bit_cast<uint64_t>(a) == std::bit_cast<uint64_t>(b);
}

}  // namespace

GeoTransform northUp(double size_x, double size_y) {
  return {0, size_x, 0, 0, 0, -size_y};
}

GeoTransform stretched(const GeoTransform& t, double columns, double rows) {
  return {t[0], t[1] * columns, t[2] * rows, t[3], t[4] * columns, t[5] * rows};
}

GeoTransform over(const GeoTransform& transform, Extent others, Extent samples) {
  return stretched(transform, static_cast<double>(others.width) / samples.width,
                   static_cast<double>(others.height) / samples.height);
}

TransformForm formOf(const GeoTransform& t, const TransformBasis& basis) {
  if (basis.has_heights && std::equal(t.begin(), t.end(), basis.heights.begin(), same))
    return TransformForm::kHeights;
  if (!same(t[2], 0) || !same(t[4], 0)) return TransformForm::kAny;
  if (same(t[1], basis.spacing[1]) && same(t[5], basis.spacing[5])) return TransformForm::kSpacing;
  return same(t[5], -t[1]) ? TransformForm::kSquare : TransformForm::kNorthUp;
}

bool isSound(const GeoTransform& transform) {
  return std::all_of(transform.begin(), transform.end(),
                     [](double v) { return std::abs(v) < 0x1p512; });
}

GeoTransform atLevel(const GeoTransform& t, int level) {
  if (level == 0) return t;
  const double size = std::ldexp(1.0, level), shift = (1 - size) / 2;
  GeoTransform level_transform = stretched(t, size, size);
  level_transform[0] += shift * (t[1] + t[2]);
  level_transform[3] += shift * (t[4] + t[5]);
  return level_transform;
}

namespace {

constexpr double kRadians = std::numbers::pi / 180;

}  // namespace

TangentPlane::TangentPlane(LongitudeLatitude centre)
    : longitude_(centre.longitude),
      sine_(std::sin(centre.latitude * kRadians)),
      cosine_(std::cos(centre.latitude * kRadians)) {}

TangentPoint TangentPlane::project(LongitudeLatitude place) const {
  const double away = (place.longitude - longitude_) * kRadians;
  const double sine = std::sin(place.latitude * kRadians);
  const double cosine = std::cos(place.latitude * kRadians);
  const double east = cosine * std::sin(away);
  const double north = cosine_ * sine - sine_ * cosine * std::cos(away);
  const double up = sine_ * sine + cosine_ * cosine * std::cos(away);
  return {2 * east / (1 + up), 2 * north / (1 + up)};
}

LongitudeLatitude TangentPlane::unproject(const TangentPoint& point) const {
  const double quarter = (point[0] * point[0] + point[1] * point[1]) / 4;
  const double east = point[0], north = point[1], up = 1 - quarter;  // times 1 + quarter
  const double to_pole = sine_ * up + cosine_ * north, to_axis = cosine_ * up - sine_ * north;
  return {longitude_ + std::atan2(east, to_axis) / kRadians,
          std::atan2(to_pole, std::hypot(east, to_axis)) / kRadians};
}

std::array<double, GroundPositions::kMostDegree + 1> chebyshev(double x, int degree) {
  std::array<double, GroundPositions::kMostDegree + 1> values{1, x};
  for (size_t i = 2; i <= static_cast<size_t>(degree); ++i)
    values[i] = 2 * x * values[i - 1] - values[i - 2];
  return values;
}

TangentPoint GroundPositions::at(double u, double v) const {
  const auto along = chebyshev(u, degree), down = chebyshev(v, degree);
  TangentPoint point{};
  size_t next = 0;
  for (double& coordinate : point) {
    for (size_t j = 0; j <= degree; ++j) {
      double row = 0;
      for (size_t i = 0; i + j <= degree; ++i)
        row += static_cast<double>(coefficients[next++]) * along[i];
      coordinate += row * down[j];
    }
    coordinate = std::ldexp(coordinate, -exponent);
  }
  return point;
}

std::string written(const GroundPositions& positions) {
  FieldWriter writer;
  GroundPositions copy = positions;
  copy.visit(writer);
  return {writer.bytes.begin(), writer.bytes.end()};
}

std::optional<GroundPositions> groundPositionsIn(const std::string& bytes) {
  const std::vector<uint8_t> copy(bytes.begin(), bytes.end());
  FieldReader reader(copy);
  GroundPositions positions;
  positions.visit(reader);
  if (!reader.ok() || reader.position() != bytes.size()) return std::nullopt;
  return positions;
}

}  // namespace tetrakis::inline stream

// SPDX-License-Identifier: Apache-2.0
#include "ratecontrol/pictures/triangle_pictures.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "base/portable_math.hpp"

namespace tetrakis::inline pictures {

namespace {

/// Pixels of all pictures together that are drawn, at most. More of them tell errors more exactly,
/// and take time.
constexpr double kMostPixels = 1 << 16;

/// Where the samples of a pixel lie, in pixels from its middle.
constexpr std::array<std::array<double, 2>, TrianglePictures::kSamples> kSampleOffsets = {
    {{-0.25, -0.25}, {0.25, -0.25}, {-0.25, 0.25}, {0.25, 0.25}}};
constexpr double kFarthestSample = 0.25;

/// A corner of a triangle in a picture, in pixels that are drawn; and 1 / depth.
struct Corner {
  double x = 0, y = 0, nearness = 0;  ///< nearness 0: behind the camera
};

/// Twice the area of a triangle; positive if its corners go round clockwise, rows pointing down.
double doubledArea(const Corner& a, const Corner& b, const Corner& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// Puts points in space into the picture of a camera, of which every stride-th pixel is drawn.
std::vector<Corner> projected(const Camera& camera, std::span<const Vec3> points, double stride) {
  const ViewAxes axes = viewAxes(camera.eye, camera.target, camera.up);
  const double tan_y = portable::tan(camera.fov_y * std::numbers::pi / 360);
  const double focal = camera.height / (2 * tan_y * stride);
  const double centre_x = camera.width / (2 * stride), centre_y = camera.height / (2 * stride);
  std::vector<Corner> corners;
  corners.reserve(points.size());
  for (const Vec3& point : points) {
    const Vec3 from_eye = subtract(point, camera.eye);
    const double depth = dot(from_eye, axes.forward);
    Corner& corner = corners.emplace_back();
    if (!(depth > 0)) continue;
    corner.nearness = 1 / depth;
    corner.x = centre_x + focal * dot(from_eye, axes.right) / depth;
    corner.y = centre_y - focal * dot(from_eye, axes.up) / depth;
  }
  return corners;
}

/// The first and the last of `count` pixels whose samples, up to `around` from its middle, may lie
/// between two places.
std::pair<int64_t, int64_t> pixelsBetween(double low, double high, double around, uint32_t count) {
  const double last = count - 1.0;
  return {static_cast<int64_t>(std::ceil(std::clamp(low - around - 0.5, 0.0, last + 1))),
          static_cast<int64_t>(std::floor(std::clamp(high + around - 0.5, -1.0, last)))};
}

}  // namespace

TrianglePictures::TrianglePictures(std::vector<Camera> cameras) : cameras_(std::move(cameras)) {
  double pixels = 0;
  for (const Camera& camera : cameras_) pixels += double{1} * camera.width * camera.height;
  stride_ = static_cast<uint32_t>(std::max(1.0, std::ceil(std::sqrt(pixels / kMostPixels))));
  const std::vector<double> shares = sharesOf(cameras_);
  for (size_t i = 0; i < cameras_.size(); ++i) {
    const uint32_t columns = (cameras_[i].width + stride_ - 1) / stride_;
    const uint32_t rows = (cameras_[i].height + stride_ - 1) / stride_;
    views_.push_back({columns, rows, pixels_, shares[i]});
    pixels_ += size_t{columns} * rows;
  }
}

std::vector<SeenTriangle> TrianglePictures::seenOf(const DrawnTriangles& mesh) const {
  std::vector<SeenTriangle> seen(kSamples * pixels_);
  for (size_t i = 0; i < views_.size(); ++i) {
    const View& view = views_[i];
    const size_t samples = kSamples * view.columns * view.rows;
    if (view.weight > 0) draw(i, mesh, std::span(seen).subspan(kSamples * view.begin, samples));
  }
  return seen;
}

void TrianglePictures::draw(size_t camera, const DrawnTriangles& mesh,
                            std::span<SeenTriangle> seen) const {
  const View& view = views_[camera];
  const std::vector<Corner> corners = projected(cameras_[camera], mesh.points, stride_);
  std::vector<double> nearest(seen.size(), 0);
  const double around = kFarthestSample / stride_;
  const double samples_of_pixel = double{kSamples} * stride_ * stride_;
  for (size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Corner &a = corners[mesh.triangles[t][0]], &b = corners[mesh.triangles[t][1]],
                 &c = corners[mesh.triangles[t][2]];
    if (!(std::min({a.nearness, b.nearness, c.nearness}) > 0)) continue;
    const auto [left, right] =
        pixelsBetween(std::min({a.x, b.x, c.x}), std::max({a.x, b.x, c.x}), around, view.columns);
    const auto [top, bottom] =
        pixelsBetween(std::min({a.y, b.y, c.y}), std::max({a.y, b.y, c.y}), around, view.rows);
    if (left > right || top > bottom) continue;
    const double area = doubledArea(a, b, c);
    if (area == 0) continue;
    const auto see = [&](const Corner& here, size_t sample) {
      const double second = doubledArea(a, here, c) / area, third = doubledArea(a, b, here) / area;
      const double first = 1 - second - third;
      if (!(std::min({first, second, third}) >= 0)) return;
      // 1 / depth is linear in the picture.
      const double nearness = first * a.nearness + second * b.nearness + third * c.nearness;
      if (nearness <= nearest[sample]) return;
      nearest[sample] = nearness;
      seen[sample] = {static_cast<uint32_t>(t), static_cast<float>(second * b.nearness / nearness),
                      static_cast<float>(third * c.nearness / nearness),
                      static_cast<float>(std::abs(area) / 2 * samples_of_pixel)};
    };
    for (int64_t y = top; y <= bottom; ++y) {
      for (int64_t x = left; x <= right; ++x) {
        const size_t pixel = static_cast<size_t>(y) * view.columns + static_cast<size_t>(x);
        for (size_t s = 0; s < kSamples; ++s)
          see({static_cast<double>(x) + 0.5 + kSampleOffsets[s][0] / stride_,
               static_cast<double>(y) + 0.5 + kSampleOffsets[s][1] / stride_, 0},
              kSamples * pixel + s);
      }
    }
  }
}

std::vector<Colour> TrianglePictures::coloursOf(std::span<const SeenTriangle> seen,
                                                const std::function<Colour(size_t)>& look) const {
  std::vector<Colour> colours(pixels_);
  for (const View& view : views_) {
    for (size_t pixel = view.begin; pixel < view.begin + size_t{view.columns} * view.rows;
         ++pixel) {
      const auto row = static_cast<uint32_t>((pixel - view.begin) / view.columns);
      const auto sky = skyAt(row, view.rows);
      for (size_t sample = kSamples * pixel; sample < kSamples * (pixel + 1); ++sample) {
        Colour colour{static_cast<float>(sky[0]), static_cast<float>(sky[1]),
                      static_cast<float>(sky[2])};
        if (seen[sample].triangle != SeenTriangle::kSky) colour = look(sample);
        for (size_t c = 0; c < 3; ++c) colours[pixel][c] += colour[c] / kSamples;
      }
    }
  }
  return colours;
}

namespace {

/// Whether any of some samples shows a triangle.
bool showsAny(std::span<const SeenTriangle> samples) {
  return std::any_of(samples.begin(), samples.end(), [](const SeenTriangle& sample) {
    return sample.triangle != SeenTriangle::kSky;
  });
}

}  // namespace

double TrianglePictures::errorBetween(const Pictures& truth, const Pictures& other) const {
  double sum = 0, weights = 0;
  for (const View& view : views_) {
    double squares = 0, shown = 0;
    for (size_t i = view.begin; i < view.begin + size_t{view.columns} * view.rows; ++i) {
      if (!showsAny(truth.seen.subspan(kSamples * i, kSamples)) &&
          !showsAny(other.seen.subspan(kSamples * i, kSamples)))
        continue;
      squares += squaresBetween(truth.colours[i], other.colours[i]) / 3;
      ++shown;
    }
    if (shown == 0) continue;
    sum += view.weight * squares / shown;
    weights += view.weight;
  }
  return weights > 0 ? sum / weights : 0;
}

size_t TrianglePictures::firstBlind(std::span<const SeenTriangle> seen) const {
  for (size_t i = 0; i < views_.size(); ++i) {
    const View& view = views_[i];
    const size_t samples = kSamples * view.columns * view.rows;
    if (view.weight > 0 && !showsAny(seen.subspan(kSamples * view.begin, samples))) return i;
  }
  return views_.size();
}

}  // namespace tetrakis::inline pictures

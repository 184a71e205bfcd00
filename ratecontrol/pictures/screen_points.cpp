// SPDX-License-Identifier: Apache-2.0
#include "ratecontrol/pictures/picture_errors.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

namespace tetrakis::inline pictures {

namespace {

/// The generalised golden ratio of the plane: places i * (1/g, 1/g^2), modulo 1, fill a square
/// evenly for any number of places (M. Roberts 2018).
constexpr double kGolden = 1.32471795724474602596;

/// The places of the four samples of a pixel along either side, and the pairs of samples.
constexpr std::array<double, 2> kPlaces = {0.25, 0.75};
constexpr std::array<std::array<size_t, 2>, 6> kPairs = {
    {{0, 3}, {1, 2}, {0, 1}, {2, 3}, {0, 2}, {1, 3}}};

double fraction(double x) {
  return x - std::floor(x);
}

/// The squared error, over R, G and B, of a pixel whose two samples begin at `first`, estimated for
/// all four samples.
double squaredErrorOf(const std::vector<Colour>& truth, const std::vector<Colour>& other,
                      size_t first) {
  double squares = 0, product = 0;
  for (size_t c = 0; c < 3; ++c) {
    const double one = double{truth[first][c]} - double{other[first][c]};
    const double two = double{truth[first + 1][c]} - double{other[first + 1][c]};
    squares += one * one + two * two;
    product += one * two;
  }
  return squares / 8 + 3 * product / 4;
}

}  // namespace

ScreenPoints::ScreenPoints(const std::vector<Camera>& cameras, size_t count) {
  const std::vector<double> shares = sharesOf(cameras);
  for (size_t i = 0; i < cameras.size(); ++i) {
    if (cameras[i].weight == 0) continue;
    const size_t begin = points_.size();
    const double points = std::ceil(shares[i] * static_cast<double>(count));
    addPoints(cameras[i], std::max(size_t{1}, static_cast<size_t>(points)));
    views_.push_back({i, begin, points_.size(), shares[i]});
  }
}

void ScreenPoints::addPoints(const Camera& camera, size_t count) {
  const CameraPoints picture(camera);
  for (size_t i = 0; i < count; ++i) {
    const double at = static_cast<double>(i);
    const double column = std::floor(fraction(0.5 + at / kGolden) * camera.width);
    const double row = std::floor(fraction(0.5 + at / (kGolden * kGolden)) * camera.height);
    for (const size_t k : kPairs[i % kPairs.size()])
      points_.push_back(picture.at(column + kPlaces[k % 2], row + kPlaces[k / 2]));
  }
}

std::vector<SeenPoint> ScreenPoints::seenOf(const GroundRays& ground, Extent texture) const {
  std::vector<SeenPoint> seen;
  seen.reserve(points_.size());
  for (const PicturePoint& point : points_) seen.push_back(seenAt(point, ground, texture));
  return seen;
}

std::vector<Colour> ScreenPoints::coloursOf(const std::vector<SeenPoint>& seen,
                                            const ScreenTexture& texture) const {
  assert(seen.size() == points_.size());
  std::vector<Colour> colours;
  colours.reserve(seen.size());
  for (size_t i = 0; i < seen.size(); ++i)
    colours.push_back(colourOf(points_[i], seen[i], texture));
  return colours;
}

double ScreenPoints::errorInside(const Pictures& truth, const Pictures& other) const {
  double sum = 0, weights = 0;
  for (const View& view : views_) {
    double squares = 0;
    size_t covered = 0;  // samples
    for (size_t i = view.begin; i < view.end; i += 2) {
      const auto covers = [&](size_t k) { return truth.seen[k].ground || other.seen[k].ground; };
      const auto both = [&](size_t k) { return truth.seen[k].ground && other.seen[k].ground; };
      covered += covers(i) + covers(i + 1);
      if (both(i) && both(i + 1)) squares += squaredErrorOf(truth.colours, other.colours, i);
    }
    if (covered == 0) continue;
    sum += view.weight * squares / (1.5 * static_cast<double>(covered));
    weights += view.weight;
  }
  return weights > 0 ? sum / weights : 0;
}

double ScreenPoints::squaresMoved(const PicturePoint& point, const SeenPoint& seen,
                                  const GroundHit& plane, const Surface& surface) const {
  const GroundFrame& frame = surface.ground.frame();
  const Colour truth = surface.texture.at(seen.u, seen.v, seen.level);
  double squares = 0;
  for (const double rise : {-surface.shift, surface.shift}) {
    GroundHit moved = plane;
    moved.at += rise;
    const auto place = surface.ground.onPlane(moved, point.ray);
    if (!place) continue;
    const double u = (*place)[0] / (frame.width - 1.0), v = (*place)[1] / (frame.height - 1.0);
    squares += squaresBetween(surface.texture.at(u, v, seen.level), truth) / 2;
  }
  return squares;
}

std::vector<ScreenPoints::Worth> ScreenPoints::worthsOf(const Surface& surface,
                                                        Extent texels) const {
  const std::vector<SeenPoint> seen = seenOf(surface.ground, texels);
  std::vector<Worth> worths;
  for (const View& view : views_) {
    const auto begin = seen.begin() + static_cast<ptrdiff_t>(view.begin);
    const auto end = seen.begin() + static_cast<ptrdiff_t>(view.end);
    const auto covered = std::count_if(begin, end, [](const auto& s) { return s.ground; });
    const double weight = view.weight / static_cast<double>(std::max<ptrdiff_t>(covered, 1));
    for (size_t i = view.begin; i < view.end; ++i) {
      const auto hit = seen[i].ground ? surface.ground.hit(points_[i].ray) : std::nullopt;
      if (!hit) continue;
      const double moved = squaresMoved(points_[i], seen[i], *hit, surface);
      worths.push_back({hit->column, hit->row, weight * moved, weight});
    }
  }
  return worths;
}

std::vector<size_t> ScreenPoints::blindCameras(const std::vector<SeenPoint>& seen) const {
  std::vector<size_t> blind;
  for (const View& view : views_) {
    const auto begin = seen.begin() + static_cast<ptrdiff_t>(view.begin);
    const auto end = seen.begin() + static_cast<ptrdiff_t>(view.end);
    if (std::none_of(begin, end, [](const SeenPoint& s) { return s.ground; }))
      blind.push_back(view.camera);
  }
  return blind;
}

}  // namespace tetrakis::inline pictures

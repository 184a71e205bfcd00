// SPDX-License-Identifier: Apache-2.0
#include "ratecontrol/screen_points.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "ground/sky.hpp"

namespace tetrakis::inline ratecontrol {

namespace {

/// The generalised golden ratio of the plane: places i * (1/g, 1/g^2), modulo 1, fill a square
/// evenly, however many they are (M. Roberts 2018).
constexpr double kGolden = 1.32471795724474602596;

double fraction(double x) {
  return x - std::floor(x);
}

double squaresBetween(const Colour& a, const Colour& b) {
  double squares = 0;
  for (size_t c = 0; c < 3; ++c) squares += double{a[c] - b[c]} * double{a[c] - b[c]};
  return squares;
}

/// Pixels that an edge errs by which moves by `shift` pixels, as pixels smooth it.
double smoothedEdge(double shift) {
  return shift < 1 ? shift - shift * shift / 3 : 1 - 1 / (3 * shift);
}

}  // namespace

ScreenPoints::ScreenPoints(const std::vector<Camera>& cameras, size_t count) {
  double most = 0, weights = 0;
  for (const Camera& camera : cameras) most = std::max(most, camera.weight);
  assert(most > 0);
  for (const Camera& camera : cameras) weights += camera.weight / most;
  for (size_t i = 0; i < cameras.size(); ++i) {
    if (cameras[i].weight == 0) continue;
    const double share = cameras[i].weight / most / weights;
    const size_t begin = points_.size();
    const double points = std::ceil(share * static_cast<double>(count));
    addPoints(cameras[i], std::max(size_t{1}, static_cast<size_t>(points)));
    views_.push_back({i, begin, points_.size(), share});
  }
}

void ScreenPoints::addPoints(const Camera& camera, size_t count) {
  const ViewAxes axes = viewAxes(camera.eye, camera.target, camera.up);
  const double tan_y = std::tan(camera.fov_y * std::numbers::pi / 360);
  const double pixel = 2 * tan_y / camera.height;
  for (size_t i = 0; i < count; ++i) {
    const double at = static_cast<double>(i);
    const double column = std::floor(fraction(0.5 + at / kGolden) * camera.width) + 0.5;
    const double row = std::floor(fraction(0.5 + at / (kGolden * kGolden)) * camera.height) + 0.5;
    Point point;
    point.right = scale(axes.right, pixel);
    point.down = scale(axes.up, -pixel);
    point.ray.origin = camera.eye;
    point.ray.direction = add(axes.forward, add(scale(point.right, column - camera.width / 2.0),
                                                scale(point.down, row - camera.height / 2.0)));
    const auto sky = skyAt(static_cast<uint32_t>(row), camera.height);
    for (size_t c = 0; c < 3; ++c) point.sky[c] = static_cast<float>(sky[c]);
    points_.push_back(point);
  }
}

std::vector<SeenPoint> ScreenPoints::seenOf(const GroundRays& ground, Extent texture) const {
  const double columns = ground.frame().width - 1.0, rows = ground.frame().height - 1.0;
  const auto seen_at = [&](const Point& point) {
    SeenPoint seen;
    const auto hit = ground.hit(point.ray);
    if (!hit) return seen;
    seen.ground = true;
    seen.u = hit->column / columns;
    seen.v = hit->row / rows;
    seen.metres = hit->far * length(point.down);
    // Along the plane of the triangle. One that is seen edge on is as wide as the texture at most.
    const auto beside = [&](const Vec3& change, double& u, double& v) {
      const Ray ray{point.ray.origin, add(point.ray.direction, change)};
      const auto place = ground.onPlane(*hit, ray);
      u = place ? std::clamp((*place)[0] / columns - seen.u, -1.0, 1.0) : 1;
      v = place ? std::clamp((*place)[1] / rows - seen.v, -1.0, 1.0) : 1;
    };
    beside(point.right, seen.u_x, seen.v_x);
    beside(point.down, seen.u_y, seen.v_y);
    const double along_x = std::hypot(seen.u_x * texture.width, seen.v_x * texture.height);
    const double along_y = std::hypot(seen.u_y * texture.width, seen.v_y * texture.height);
    const double sample = std::max(along_x, along_y) / 2;  // two of them beside one another
    seen.level = sample > 0 ? std::max(0.0, std::log2(sample)) : 0;
    return seen;
  };
  std::vector<SeenPoint> seen;
  seen.reserve(points_.size());
  for (const Point& point : points_) seen.push_back(seen_at(point));
  return seen;
}

std::vector<Colour> ScreenPoints::coloursOf(const std::vector<SeenPoint>& seen,
                                            const ScreenTexture& texture) const {
  assert(seen.size() == points_.size());
  std::vector<Colour> colours(seen.size());
  for (size_t i = 0; i < seen.size(); ++i) {
    const SeenPoint& s = seen[i];
    if (!s.ground) {
      colours[i] = points_[i].sky;
      continue;
    }
    // Two samples along the longer side of the pixel; across it one is as wide already.
    const bool across = s.u_x * s.u_x + s.v_x * s.v_x >= s.u_y * s.u_y + s.v_y * s.v_y;
    const double u = (across ? s.u_x : s.u_y) / 4, v = (across ? s.v_x : s.v_y) / 4;
    const Colour one = texture.at(s.u - u, s.v - v, s.level);
    const Colour other = texture.at(s.u + u, s.v + v, s.level);
    for (size_t c = 0; c < 3; ++c) colours[i][c] = (one[c] + other[c]) / 2;
  }
  return colours;
}

double ScreenPoints::errorInside(const Pictures& truth, const Pictures& other) const {
  double sum = 0, weights = 0;
  for (const View& view : views_) {
    double squares = 0;
    size_t covered = 0;
    for (size_t i = view.begin; i < view.end; ++i) {
      const bool both = truth.seen[i].ground && other.seen[i].ground;
      covered += truth.seen[i].ground || other.seen[i].ground;
      if (both) squares += squaresBetween(truth.colours[i], other.colours[i]);
    }
    if (covered == 0) continue;
    sum += view.weight * squares / (3 * static_cast<double>(covered));
    weights += view.weight;
  }
  return weights > 0 ? sum / weights : 0;
}

ScreenPoints::Outline ScreenPoints::outlineOf(const View& view, const Pictures& a,
                                              const Pictures& b) const {
  Outline outline;
  size_t covered = 0;
  for (size_t i = view.begin; i < view.end; ++i) {
    const SeenPoint &p = a.seen[i], &q = b.seen[i];
    covered += p.ground || q.ground;
    if (p.ground == q.ground) continue;
    outline.error += squaresBetween(a.colours[i], b.colours[i]);
    outline.metres += (p.ground ? p : q).metres;
    ++outline.count;
  }
  if (covered > 0) outline.error /= 3 * static_cast<double>(covered);
  return outline;
}

std::vector<double> ScreenPoints::errorsOfOutlines(const Pictures& truth,
                                                   const std::vector<Pictures>& others,
                                                   const std::vector<double>& squares,
                                                   size_t enough) const {
  assert(others.size() == squares.size());
  std::vector<double> errors(others.size());
  std::vector<std::vector<Outline>> outlines;  // of each surface: the views
  double weights = 0;
  for (const View& view : views_) weights += view.weight;
  for (size_t g = 0; g < others.size(); ++g) {
    outlines.emplace_back();
    for (const View& view : views_) outlines[g].push_back(outlineOf(view, truth, others[g]));
    const size_t first = pooledFrom(outlines, enough);
    for (size_t v = 0; v < views_.size(); ++v) {
      double error = 0, shifts = 0, metres = 0, count = 0;
      for (size_t k = first; k <= g; ++k) {
        error += outlines[k][v].error;
        shifts += std::sqrt(squares[k]);
        metres += outlines[k][v].metres;
        count += static_cast<double>(outlines[k][v].count);
      }
      if (!(error > 0 && metres > 0 && shifts > 0)) continue;
      const double shift = std::sqrt(squares[g]) * count / metres;  // pixels
      const double smoothed = (1 + 3 * smoothedEdge(shift)) / 4;
      errors[g] += views_[v].weight / weights * smoothed * error / shifts * std::sqrt(squares[g]);
    }
  }
  return errors;
}

size_t ScreenPoints::pooledFrom(const std::vector<std::vector<Outline>>& outlines, size_t enough) {
  size_t first = outlines.size() - 1, count = 0;
  const auto add = [&] {
    for (const Outline& outline : outlines[first]) count += outline.count;
  };
  for (add(); count < enough && first > 1; add()) --first;
  return first;
}

double ScreenPoints::inside(const Point& point, const SeenPoint& seen, const GroundHit& plane,
                            const Surface& surface) const {
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
      const double moved = inside(points_[i], seen[i], *hit, surface);
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

}  // namespace tetrakis::inline ratecontrol

// SPDX-License-Identifier: Apache-2.0
#include "ratecontrol/pictures/picture_errors.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace tetrakis::inline pictures {

namespace {

/// Rows between the places at which a column looks for ground; smaller pieces of ground are missed.
/// Fewer rows between them take time.
constexpr double kRows = 32;
/// The precision of the places of outlines, in pixels, and the least shift that is found. A finer
/// one takes the time of more rays.
constexpr double kLeastShift = 1. / 256;
/// The factor by which the search for a moved outline grows, and the part of its reach to which the
/// place is found. A smaller factor and a larger part take rays.
constexpr double kFaster = 4, kFinePart = 16;

/// Pixels by which an edge errs that has moved by `shift`.
double smoothedEdge(double shift) {
  const double smoothed = shift < 1 ? shift - shift * shift / 3 : 1 - 1 / (3 * shift);
  return shift * (1 + 3 * smoothed) / 4;
}

/// Halves the interval between two rows, of which one shows ground and the other one sky, until it
/// is short enough. ground(row): whether the row shows ground.
template <class Ground>
std::pair<double, double> halved(double sky, double solid, double near, Ground&& ground) {
  while (std::abs(solid - sky) > near) {
    const double middle = (sky + solid) / 2;
    (ground(middle) ? solid : sky) = middle;
  }
  return {sky, solid};
}

}  // namespace

Outlines::Outlines(const std::vector<Camera>& cameras, size_t columns, const GroundRays& truth,
                   const ScreenTexture& texture, Extent texels) {
  const std::vector<double> shares = sharesOf(cameras);
  for (size_t i = 0; i < cameras.size(); ++i) {
    if (cameras[i].weight == 0) continue;
    View view{CameraPoints(cameras[i]), double(cameras[i].height), shares[i]};
    const double count = std::ceil(shares[i] * static_cast<double>(columns));
    for (double c = 0; c < count; ++c)
      follow(view, (c + 0.5) / count * cameras[i].width, truth, texture, texels);
    if (view.covered > 0) views_.push_back(std::move(view));
  }
}

void Outlines::follow(View& view, double column, const GroundRays& truth,
                      const ScreenTexture& texture, Extent texels) {
  const auto ground = [&](double row) {
    return truth.hit(view.points.at(column, row).ray).has_value();
  };
  const size_t first = view.crossings.size();
  double before = 0, covered_from = 0;
  bool was_ground = ground(0);
  while (before < view.height) {
    const double row = std::min(before + kRows, view.height);
    const bool is_ground = ground(row);
    if (is_ground != was_ground) {
      const auto [sky, solid] =
          halved(was_ground ? row : before, was_ground ? before : row, kLeastShift, ground);
      const PicturePoint point = view.points.at(column, solid);
      const Colour colour = colourOf(point, seenAt(point, truth, texels), texture);
      view.crossings.push_back({column, (sky + solid) / 2, 0, view.height, is_ground,
                                squaresBetween(colour, point.sky) / 3});
      if (was_ground) view.covered += solid - covered_from;
      covered_from = solid;
      was_ground = is_ground;
    }
    before = row;
  }
  if (was_ground) view.covered += view.height - covered_from;
  for (size_t i = first + 1; i < view.crossings.size(); ++i) {
    Crossing &above = view.crossings[i - 1], &below = view.crossings[i];
    above.to = below.from = (above.row + below.row) / 2;
  }
}

double Outlines::shiftOf(const View& view, const Crossing& crossing, const GroundRays& surface) {
  const auto ground = [&](double row) {
    return surface.hit(view.points.at(crossing.column, row).ray).has_value();
  };
  const bool at_first = ground(crossing.row);
  // Ground where the true outline is: the other outline lies on the side of the sky.
  const double away = at_first == crossing.ground_below ? -1 : 1;
  double from = 0;
  for (double to = kLeastShift;; from = to, to *= kFaster) {
    const double row = std::clamp(crossing.row + away * to, crossing.from, crossing.to);
    if (ground(row) != at_first) {
      if (from == 0) return 0;
      const double start = crossing.row + away * from;
      const auto [sky, solid] = halved(at_first ? row : start, at_first ? start : row,
                                       std::max(kLeastShift, to / kFinePart), ground);
      return std::abs((sky + solid) / 2 - crossing.row);
    }
    if (row <= crossing.from || row >= crossing.to) return std::abs(row - crossing.row);
  }
}

double Outlines::errorOf(const GroundRays& surface) const {
  double sum = 0, weights = 0;
  for (const View& view : views_) {
    double squares = 0;
    for (const Crossing& crossing : view.crossings)
      squares += crossing.contrast * smoothedEdge(shiftOf(view, crossing, surface));
    sum += view.weight * squares / view.covered;
    weights += view.weight;
  }
  return weights > 0 ? sum / weights : 0;
}

namespace {

/// Columns in which outlines are followed, over all cameras. More of them tell their shifts more
/// exactly, and take rays.
constexpr size_t kOutlineColumns = 256;

}  // namespace

PictureErrors::PictureErrors(const std::vector<Camera>& cameras, size_t pixels,
                             const GroundRays& ground, const Texels& texels)
    : texels_(texels.extent()),
      true_texture_(texels, texels_),
      points_(cameras, pixels),
      outlines_(cameras, kOutlineColumns, ground, true_texture_, texels_),
      true_surface_{points_.seenOf(ground, texels_)},
      true_colours_(points_.coloursOf(true_surface_.seen, true_texture_)) {}

PictureErrors::Surface PictureErrors::surfaceOf(const GroundRays& ground) const {
  return {points_.seenOf(ground, texels_), outlines_.errorOf(ground)};
}

double PictureErrors::errorInside(const Surface& surface, const ScreenTexture& texture) const {
  const std::vector<Colour> colours = points_.coloursOf(surface.seen, texture);
  return points_.errorInside({true_surface_.seen, true_colours_}, {surface.seen, colours});
}

}  // namespace tetrakis::inline pictures

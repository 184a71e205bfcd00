// SPDX-License-Identifier: Apache-2.0
#include "codec/trianglemesh/collapsing_triangles.hpp"

#include <algorithm>
#include <utility>

namespace tetrakis::inline trianglemesh {
namespace {

/// Vertices of more triangles have no star, so that a collapse takes a time that does not grow.
constexpr size_t kWidestStar = 32;

/// Whether no two of the points are one.
bool areDifferent(const std::vector<uint32_t>& points) {
  for (size_t i = 1; i < points.size(); ++i)
    if (std::find(points.begin(), points.begin() + static_cast<ptrdiff_t>(i), points[i]) !=
        points.begin() + static_cast<ptrdiff_t>(i))
      return false;
  return true;
}

}  // namespace

CollapsingTriangles::CollapsingTriangles(CodedTriangles mesh)
    : mesh_(std::move(mesh)), corner_of_(mesh_.places.size()) {
  for (uint32_t corner = 0; corner < mesh_.vertices.size(); ++corner)
    corner_of_[mesh_.vertices[corner]] = corner;
}

/// Clockwise up to a border, or once round: the corner where the star begins. kNone: it is wide.
uint32_t CollapsingTriangles::firstOf(uint32_t begin) const {
  uint32_t corner = begin;
  for (size_t i = 0; i <= kWidestStar; ++i) {
    if (mesh_.sides[corner] == kBorder) return corner;
    corner = after(mesh_.sides[corner]);
    if (corner == begin) return corner;
  }
  return kNone;
}

bool CollapsingTriangles::findStar(uint32_t vertex, Star& star) const {
  star.centre = vertex;
  star.corners.clear();
  star.points.clear();
  if (corner_of_[vertex] == kNone) return false;
  const uint32_t first = firstOf(corner_of_[vertex]);
  if (first == kNone) return false;
  star.closed = mesh_.sides[first] != kBorder;
  uint32_t corner = first, next = first;
  do {
    if (star.corners.size() == kWidestStar) return false;
    corner = next;
    star.corners.push_back(corner);
    star.points.push_back(mesh_.vertices[after(corner)]);
    next = mesh_.sides[before(corner)];
  } while (next != kBorder && next != first);
  if (!star.closed) star.points.push_back(mesh_.vertices[before(corner)]);
  return true;
}

bool CollapsingTriangles::keepsSurface(const Star& star, size_t target, bool strictly) {
  const size_t count = star.points.size();
  const uint32_t heir = star.points[target];
  if (star.closed ? count < 3 : target != 0 && target + 1 != count) return false;
  if (std::count(star.points.begin(), star.points.end(), star.centre) != 0) return false;
  if (std::count(star.points.begin(), star.points.end(), heir) != 1) return false;
  if (!findStar(heir, beside_)) return false;
  for (size_t i = 0; i < star.corners.size(); ++i) {
    const uint32_t corner = star.corners[i], opposite = mesh_.sides[after(corner)];
    if (star.vanishes(i, target)) {
      const uint32_t own = mesh_.sides[i == target ? before(corner) : corner];
      if (own == kBorder && opposite == kBorder) return false;
    } else if (opposite != kBorder && mesh_.vertices[before(opposite)] == heir) {
      return false;
    }
  }
  return !strictly || keepsEdges(star, target);
}

/// The centre and the target have no common neighbours but those of triangles that vanish.
bool CollapsingTriangles::keepsEdges(const Star& star, size_t target) const {
  if (!areDifferent(star.points)) return false;
  for (size_t i = 0; i < star.points.size(); ++i) {
    if (i == target || star.isBeside(i, target)) continue;
    if (std::find(beside_.points.begin(), beside_.points.end(), star.points[i]) !=
        beside_.points.end())
      return false;
  }
  return true;
}

WedgeHeirs CollapsingTriangles::heirsOf(const Star& star, size_t target) const {
  WedgeHeirs heirs;
  if (mesh_.wedges.empty()) return heirs;
  size_t met = 0;
  for (size_t i = 0; i < star.corners.size(); ++i) {
    if (!star.vanishes(i, target)) continue;
    const uint32_t corner = star.corners[i];
    heirs.from[met] = mesh_.wedges[corner];
    heirs.to[met] = mesh_.wedges[i == target ? after(corner) : before(corner)];
    ++met;
  }
  return heirs;
}

/// ahead: the target comes behind the centre in the triangle, else before it.
void CollapsingTriangles::vanish(const Star& star, size_t i, bool ahead) {
  const uint32_t corner = star.corners[i];
  const uint32_t apex = mesh_.vertices[ahead ? before(corner) : after(corner)];
  const uint32_t heir = mesh_.vertices[ahead ? after(corner) : before(corner)];
  const uint32_t own = mesh_.sides[ahead ? before(corner) : corner];
  const uint32_t opposite = mesh_.sides[after(corner)];
  glue(own, opposite);
  glue(opposite, own);
  if (opposite != kBorder) {
    corner_of_[apex] = ahead ? opposite : after(opposite);
    corner_of_[heir] = ahead ? after(opposite) : opposite;
  }
  if (own != kBorder) {
    corner_of_[apex] = ahead ? after(own) : own;
    corner_of_[heir] = ahead ? own : after(own);
  }
  remove(corner / 3);
}

void CollapsingTriangles::collapse(const Star& star, size_t target) {
  const uint32_t heir = star.points[target];
  const WedgeHeirs heirs = heirsOf(star, target);
  for (size_t i = 0; i < star.corners.size(); ++i)
    if (star.vanishes(i, target)) vanish(star, i, i == target);
  for (size_t i = 0; i < star.corners.size(); ++i) {
    if (star.vanishes(i, target)) continue;
    const uint32_t corner = star.corners[i];
    mesh_.vertices[corner] = heir;
    corner_of_[heir] = corner;
    if (mesh_.wedges.empty()) continue;
    const uint32_t wedge = heirs.of(mesh_.wedges[corner]);
    mesh_.wedges[corner] = wedge == WedgeHeirs::kNone ? heirs.to[0] : wedge;
  }
  corner_of_[star.centre] = kNone;
}

LeftTriangles CollapsingTriangles::left() const {
  LeftTriangles out;
  for (uint32_t triangle = 0; triangle < mesh_.vertices.size() / 3; ++triangle) {
    if (isGone(triangle)) continue;
    out.triangles.push_back(triangle);
    for (uint32_t corner = 3 * triangle; corner < 3 * triangle + 3; ++corner)
      out.vertices.push_back(mesh_.vertices[corner]);
  }
  return out;
}

CodedTriangles CollapsingTriangles::rest() const {
  CodedTriangles out;
  std::vector<uint32_t> numbers(corner_of_.size(), kNone);
  std::vector<uint32_t> wedges(mesh_.texcoords.size(), kNone), triangles(mesh_.vertices.size() / 3);
  for (uint32_t corner = 0; corner < mesh_.vertices.size(); ++corner) {
    if (isGone(corner / 3)) continue;
    triangles[corner / 3] = static_cast<uint32_t>(out.vertices.size() / 3);
    uint32_t& number = numbers[mesh_.vertices[corner]];
    if (number == kNone) {
      number = static_cast<uint32_t>(out.places.size());
      out.places.push_back(mesh_.places[mesh_.vertices[corner]]);
    }
    out.vertices.push_back(number);
    if (mesh_.wedges.empty()) continue;
    uint32_t& wedge = wedges[mesh_.wedges[corner]];
    if (wedge == kNone) {
      wedge = static_cast<uint32_t>(out.texcoords.size());
      out.texcoords.push_back(mesh_.texcoords[mesh_.wedges[corner]]);
    }
    out.wedges.push_back(wedge);
  }
  for (uint32_t corner = 0; corner < mesh_.vertices.size(); ++corner) {
    if (isGone(corner / 3)) continue;
    const uint32_t side = mesh_.sides[corner];
    const bool is_border = side == kBorder || isGone(side / 3);
    out.sides.push_back(is_border ? kBorder : 3 * triangles[side / 3] + side % 3);
  }
  return out;
}

}  // namespace tetrakis::inline trianglemesh

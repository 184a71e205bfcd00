// SPDX-License-Identifier: Apache-2.0
#include "codec/trianglemesh/swept_error.hpp"

#include <algorithm>
#include <bit>
#include <cstdlib>
#include <utility>

#include "codec/trianglemesh/flat_triangle.hpp"

namespace tetrakis::inline trianglemesh {
namespace {

/// The cosine of the widest turn of a triangle is one of so many parts: fewer parts leave fewer
/// folds, and fewer collapses to choose from.
constexpr uint64_t kWidestTurn = 4;

/// Which part of an area that is lost counts. A larger part costs smooth surfaces more error, a
/// smaller one lets thin limbs shrink.
constexpr uint64_t kLostPart = 8;

uint64_t sizeOf(int64_t number) {
  return static_cast<uint64_t>(std::abs(number));
}

int64_t dotProduct(const PlaceWay& a, const PlaceWay& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// Of the same direction, with numbers of 30 bits at most.
PlaceWay shortened(PlaceWay way) {
  constexpr int kBits = 30;
  const auto bits =
      static_cast<int>(std::bit_width(sizeOf(way[0]) | sizeOf(way[1]) | sizeOf(way[2])));
  for (int64_t& number : way) number >>= std::max(bits - kBits, 0);
  return way;
}

bool turnsTooFar(const PlaceWay& before, const PlaceWay& after) {
  const PlaceWay a = shortened(before), b = shortened(after);
  const int64_t cosine = dotProduct(a, b);
  return cosine <= 0 || kWidestTurn * sizeOf(cosine) < roughLength(a) * roughLength(b);
}

}  // namespace

PlaceWay crossProduct(const PlaceWay& a, const PlaceWay& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

uint64_t roughLength(const PlaceWay& way) {
  uint64_t a = sizeOf(way[0]), b = sizeOf(way[1]), c = sizeOf(way[2]);
  if (a < b) std::swap(a, b);
  if (b < c) std::swap(b, c);
  if (a < b) std::swap(a, b);
  return (15 * a + 6 * b + 5 * c + 15) >> 4;
}

uint64_t costSum(uint64_t a, uint64_t b) {
  return a > UINT64_MAX - b ? UINT64_MAX : a + b;
}

/// Costs grow with the cube of the numbers of places: from 14 bits on, finer grids have the same.
SweptError::SweptError(const std::vector<Place>& places) {
  constexpr int kBits = 14;
  uint64_t all = 0;
  for (const Place& place : places)
    for (const int32_t number : place) all |= static_cast<uint64_t>(number);
  spare_bits_ = 3 * std::max(0, static_cast<int>(std::bit_width(all)) - kBits);
}

uint64_t SweptError::areaCost(uint64_t area, uint64_t distance) const {
  const auto times = [](uint64_t a, uint64_t b) {
    if (std::bit_width(a) + std::bit_width(b) <= 64) return a * b;
    return a > UINT64_MAX / b ? UINT64_MAX : a * b;
  };
  return times(times(area, distance) >> spare_bits_, distance);
}

/// How high a body is over its area, or an area over its line.
uint64_t SweptError::heightOf(uint64_t body, uint64_t base) {
  if (base == 0) return 0;
  constexpr uint64_t kMost = uint64_t{1} << (64 - kDistanceBits);
  return body < kMost ? (body << kDistanceBits) / base : (body / base) << kDistanceBits;
}

void SweptError::look(const CodedTriangles& mesh, const Star& star) {
  mesh_ = &mesh;
  star_ = &star;
  ways_.clear();
  normals_.clear();
  areas_.clear();
  const Place& centre = mesh.places[star.centre];
  for (const uint32_t point : star.points) ways_.push_back(wayBetween(centre, mesh.places[point]));
  for (size_t i = 0; i < star.corners.size(); ++i) {
    normals_.push_back(crossProduct(ways_[i], ways_[star.next(i)]));
    areas_.push_back(roughLength(normals_[i]));
  }
  seams_.clear();
  if (!mesh.wedges.empty()) findSeams();
}

void SweptError::findSeams() {
  const std::vector<uint32_t>& wedges = mesh_->wedges;
  for (size_t i = star_->closed ? 0 : 1; i < star_->corners.size(); ++i) {
    const uint32_t left = star_->corners[i], right = star_->corners[star_->last(i)];
    if (wedges[left] != wedges[right] || wedges[after(left)] != wedges[before(right)])
      seams_.push_back(i);
  }
}

uint64_t SweptError::lineCost(size_t from, size_t target) const {
  const PlaceWay &back = ways_[from], &ahead = ways_[target];
  const PlaceWay line = {ahead[0] - back[0], ahead[1] - back[1], ahead[2] - back[2]};
  const uint64_t area = roughLength(crossProduct(back, ahead));
  return areaCost(area, heightOf(area, std::max<uint64_t>(roughLength(line), 1)));
}

uint64_t SweptError::least(size_t target) const {
  uint64_t sum = 0;
  for (size_t i = 0; i < normals_.size(); ++i) {
    if (star_->vanishes(i, target)) continue;
    const uint64_t body = sizeOf(dotProduct(normals_[i], ways_[target]));
    sum = costSum(sum, areaCost(areas_[i], heightOf(body, areas_[i])));
  }
  if (!star_->closed)
    return costSum(sum, lineCost(target == 0 ? star_->points.size() - 1 : 0, target));
  if (seams_.size() == 2 && (seams_[0] == target || seams_[1] == target))
    sum = costSum(sum, lineCost(seams_[seams_[0] == target ? 1 : 0], target));
  return sum;
}

std::optional<uint64_t> SweptError::cost(size_t target, const WedgeHeirs& heirs,
                                         uint64_t least) const {
  const PlaceWay& way = ways_[target];
  uint64_t before_it = 0, behind_it = 0;
  for (size_t i = 0; i < normals_.size(); ++i) {
    before_it += areas_[i];
    if (star_->vanishes(i, target)) continue;
    const PlaceWay &a = ways_[i], &b = ways_[star_->next(i)];
    const PlaceWay normal = crossProduct({a[0] - way[0], a[1] - way[1], a[2] - way[2]},
                                         {b[0] - way[0], b[1] - way[1], b[2] - way[2]});
    if (areas_[i] > 0 && turnsTooFar(normals_[i], normal)) return {};
    behind_it += roughLength(normal);
  }
  if (!keepsTexture(target, heirs)) return {};
  const uint64_t lost = before_it - std::min(before_it, behind_it);
  return costSum(least, areaCost(lost, distanceOf(way)) / kLostPart);
}

bool SweptError::keepsTexture(size_t target, const WedgeHeirs& heirs) const {
  if (mesh_->wedges.empty()) return true;
  for (size_t i = 0; i < star_->corners.size(); ++i) {
    const uint32_t corner = star_->corners[i];
    const uint32_t heir = heirs.of(mesh_->wedges[corner]);
    if (heir == WedgeHeirs::kNone) return false;
    if (star_->vanishes(i, target)) continue;
    const Texcoord &a = texcoordOf(after(corner)), &b = texcoordOf(before(corner));
    const int64_t was = turnOf(texcoordOf(corner), a, b), is = turnOf(mesh_->texcoords[heir], a, b);
    if ((was > 0 && is <= 0) || (was < 0 && is >= 0)) return false;
  }
  return true;
}

uint64_t SweptError::roughCost(size_t target) const {
  uint64_t area = 0;
  for (const uint64_t of_triangle : areas_) area += of_triangle;
  return areaCost(area, distanceOf(ways_[target]));
}

}  // namespace tetrakis::inline trianglemesh

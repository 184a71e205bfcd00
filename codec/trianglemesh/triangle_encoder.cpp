// SPDX-License-Identifier: Apache-2.0
#include "codec/trianglemesh/triangle_encoder.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "bitstream/coder/range_encoder.hpp"
#include "bitstream/stream/glue.hpp"
#include "codec/trianglemesh/triangle_pass.hpp"

namespace tetrakis::inline trianglemesh {
namespace {

/// The least number, no less than `value`, whose field in a header takes three bytes.
double roundedUp(double value) {
  constexpr uint64_t kLow = (uint64_t{1} << 44) - 1;
  const auto bits = std::bit_cast<uint64_t>(value);
  return std::bit_cast<double>((bits + kLow) & ~kLow);
}

/// Where a grid begins along an axis, and how far it goes.
struct Range {
  double low = 0, high = 0;
};

std::array<Range, 3> boxAround(std::span<const std::array<double, 3>> points) {
  std::array<Range, 3> box;
  for (size_t axis = 0; axis < 3; ++axis) {
    box[axis] = {points[0][axis], points[0][axis]};
    for (const auto& point : points) {
      box[axis].low = std::min(box[axis].low, point[axis]);
      box[axis].high = std::max(box[axis].high, point[axis]);
    }
  }
  return box;
}

/// Cells that are as small as so many places, and origins, allow.
double cellOf(const std::array<Range, 3>& box, uint32_t places) {
  double extent = 0, farthest = 0;
  for (const auto& [low, high] : box) {
    extent = std::max(extent, high - low);
    farthest = std::max({farthest, std::abs(low), std::abs(high)});
  }
  const double least = 2 * farthest / static_cast<double>(TriangleMeshHeader::kMostOrigin);
  return roundedUp(std::max({extent / (places - 2.0), least, 1e-300}));  // both ends are rounded
}

int64_t rounded(double value) {
  return static_cast<int64_t>(std::floor(value + 0.5));
}

}  // namespace

TriangleEncoder::TriangleEncoder(const PlainMesh& mesh, uint8_t texcoord_fraction) : mesh_(mesh) {
  header_.triangles = mesh.triangles.size();
  numberTriangles();
  if (mesh.texcoords.empty()) return;
  cutSeams();
  roundTexcoords(texcoord_fraction);
}

/// As a walk meets them, which takes the fewest bits.
void TriangleEncoder::numberTriangles() {
  const std::vector<uint32_t>& sides = mesh_.sides;
  std::vector<uint32_t> number(sides.size());  // of each corner that is given
  for (const MetFace& met : facesAsMet(sides, 3)) {
    for (uint32_t i = 0; i < 3; ++i) {
      const uint32_t corner = 3 * met.face + (met.entered + i) % 3;
      number[corner] = static_cast<uint32_t>(given_.size());
      given_.push_back(corner);
    }
  }
  for (const uint32_t corner : given_)
    coded_.sides.push_back(sides[corner] == kBorder ? kBorder : number[sides[corner]]);
  first_corners_ = cornerFans(coded_.sides).first;
}

std::array<float, 2> TriangleEncoder::texcoordAt(uint32_t corner) const {
  std::array<float, 2> at = mesh_.texcoords[given_[corner] / 3][given_[corner] % 3];
  for (float& value : at) {
    constexpr float kMost = 1 << 18;  // fits in kMostTexcoordBits with a fraction of 0
    value = std::isfinite(value) ? std::clamp(value, -kMost, kMost) : 0;
  }
  return at;
}

void TriangleEncoder::cutSeams() {
  coded_.cut = coded_.sides;
  for (uint32_t side = 0; side < coded_.sides.size(); ++side) {
    const uint32_t other = coded_.sides[side];
    if (other == kBorder) continue;
    const bool same = texcoordAt(side) == texcoordAt(after(other)) &&
                      texcoordAt(after(side)) == texcoordAt(other);
    if (!same) coded_.cut[side] = kBorder;
  }
}

/// Each part of the texture between seams is moved by whole numbers to where the texture begins.
std::vector<std::array<int64_t, 2>> TriangleEncoder::roundedTexcoords(int fraction) const {
  const double units = std::ldexp(1.0, fraction);
  std::vector<std::array<int64_t, 2>> rounded_at(given_.size());
  std::vector<uint8_t> seen(given_.size() / 3);
  std::vector<uint32_t> part;  // its triangles
  for (uint32_t first = 0; first < seen.size(); ++first) {
    if (seen[first] != 0) continue;
    part.assign(1, first);
    seen[first] = 1;
    std::array<float, 2> least = texcoordAt(3 * first);
    for (size_t i = 0; i < part.size(); ++i) {
      for (uint32_t corner = 3 * part[i]; corner < 3 * part[i] + 3; ++corner) {
        for (size_t axis = 0; axis < 2; ++axis)
          least[axis] = std::min(least[axis], texcoordAt(corner)[axis]);
        const uint32_t other = coded_.cut[corner];
        if (other == kBorder || seen[other / 3] != 0) continue;
        seen[other / 3] = 1;
        part.push_back(other / 3);
      }
    }
    for (const uint32_t triangle : part)
      for (uint32_t corner = 3 * triangle; corner < 3 * triangle + 3; ++corner)
        for (size_t axis = 0; axis < 2; ++axis)
          rounded_at[corner][axis] =
              rounded((double{texcoordAt(corner)[axis]} - std::floor(least[axis])) * units);
  }
  return rounded_at;
}

void TriangleEncoder::roundTexcoords(uint8_t fraction) {
  CornerFans wedges = cornerFans(coded_.cut);
  for (int tried = fraction;; --tried) {
    const std::vector<std::array<int64_t, 2>> at = roundedTexcoords(tried);
    int bits = 1;
    std::array<int64_t, 2> least{};
    for (size_t axis = 0; axis < 2; ++axis) {
      int64_t low = at[0][axis], high = low;
      for (const auto& texcoord : at) {
        low = std::min(low, texcoord[axis]);
        high = std::max(high, texcoord[axis]);
      }
      least[axis] = low;
      bits = std::max(bits, static_cast<int>(std::bit_width(static_cast<uint64_t>(high - low))));
    }
    if (bits > TriangleMeshHeader::kMostTexcoordBits) continue;
    header_.texcoord_bits = static_cast<uint8_t>(bits);
    header_.texcoord_fraction = static_cast<uint8_t>(tried);
    header_.texcoord_origin = least;
    for (const uint32_t corner : wedges.first)
      coded_.texcoords.push_back({static_cast<int32_t>(at[corner][0] - least[0]),
                                  static_cast<int32_t>(at[corner][1] - least[1])});
    return;
  }
}

TriangleMeshHeader TriangleEncoder::encode(uint32_t places) const {
  TriangleMeshHeader header = header_;
  const std::array<Range, 3> box = boxAround(mesh_.points);
  header.place_bits = static_cast<uint8_t>(std::bit_width(places - 1));
  header.cell = cellOf(box, places);
  const auto cells = [&](double place) { return rounded(place / header.cell); };
  for (size_t axis = 0; axis < 3; ++axis) header.origin[axis] = cells(box[axis].low);
  CodedTriangles coded = coded_;
  for (const uint32_t corner : first_corners_) {
    const uint32_t given = given_[corner];
    const auto& point = mesh_.points[mesh_.triangles[given / 3][given % 3]];
    Place& place = coded.places.emplace_back();
    for (size_t axis = 0; axis < 3; ++axis)
      place[axis] = static_cast<int32_t>(cells(point[axis]) - header.origin[axis]);
  }
  DecisionEncoding io;
  runTriangles(io, header, coded);
  const std::vector<uint8_t> code = io.finish();
  header.code.assign(code.begin(), code.end());
  return header;
}

}  // namespace tetrakis::inline trianglemesh

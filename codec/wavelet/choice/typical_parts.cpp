// SPDX-License-Identifier: Apache-2.0
#include "codec/wavelet/choice/typical_parts.hpp"

#include <algorithm>
#include <cassert>

namespace tetrakis::inline choice {

namespace {

/// Planes of no longer side are judged whole. A larger number chooses better, and takes time.
constexpr uint32_t kWholeSide = 256;
/// Fields along each side, of which each has a part. More of them stand better for planes of many
/// kinds of ground, and take time.
constexpr uint32_t kFields = 3;
/// Parts begin at multiples of this number of samples, on which copies and interpolated rows lie. A
/// larger number leaves fewer places for a part.
constexpr uint32_t kAligned = 16;
/// One of this number of samples along rows, and of rows, tells how much of a part is coded. A
/// smaller number tells it more exactly, and takes time.
constexpr uint32_t kCodedApart = 8;
/// A part lies elsewhere than in the middle of its field if this many times as many samples are
/// coded there. A smaller factor moves parts by chance.
constexpr uint32_t kMuchMore = 2;

struct Interval {
  uint32_t first, length;
};

/// The middle of a field of a side, of at most so many samples. It begins at a multiple of
/// kAligned where the field holds one: rows that were interpolated, or copied, then look to the
/// transform of the part as they do to that of the plane.
Interval middleOf(uint32_t field, uint32_t side, uint32_t most) {
  const auto begin = static_cast<uint32_t>(uint64_t{side} * field / kFields);
  const auto end = static_cast<uint32_t>(uint64_t{side} * (field + 1) / kFields);
  const uint32_t length = std::min(end - begin, most);
  const uint32_t middle = begin + (end - begin - length) / 2, aligned = middle & ~(kAligned - 1);
  return {aligned >= begin ? aligned : middle, length};
}

/// Where else in a field a part may lie: half a part apart.
std::vector<uint32_t> placesIn(uint32_t field, uint32_t side, uint32_t length) {
  const auto begin = static_cast<uint32_t>(uint64_t{side} * field / kFields);
  const auto end = static_cast<uint32_t>(uint64_t{side} * (field + 1) / kFields);
  const uint32_t first = (begin + kAligned - 1) & ~(kAligned - 1);
  const uint32_t apart = std::max(length / 2 & ~(kAligned - 1), kAligned);
  std::vector<uint32_t> places;
  for (uint32_t place = first; place + length <= end; place += apart) places.push_back(place);
  return places;
}

/// Samples of a part that are coded, of a grid of them.
uint32_t codedIn(const Window& part, Extent plane, const IsCoded& is_coded) {
  uint32_t count = 0;
  for (uint32_t y = 0; y < part.height; y += kCodedApart) {
    const size_t row = size_t{part.y + y} * plane.width + part.x;
    for (uint32_t x = 0; x < part.width; x += kCodedApart) count += is_coded(row + x);
  }
  return count;
}

/// The part in the middle of a field, or one in which much more is coded, and how much that is.
struct FieldPart {
  Window part;
  uint32_t coded;
};

FieldPart partOf(uint32_t column, uint32_t row, Extent plane, uint32_t side,
                 const IsCoded& is_coded) {
  const Interval x = middleOf(column, plane.width, side), y = middleOf(row, plane.height, side);
  const Window middle = {x.first, y.first, x.length, y.length};
  if (!is_coded) return {middle, 1};
  FieldPart best = {middle, codedIn(middle, plane, is_coded)};
  uint32_t least = kMuchMore * best.coded;
  for (const uint32_t top : placesIn(row, plane.height, y.length)) {
    for (const uint32_t left : placesIn(column, plane.width, x.length)) {
      const Window part = {left, top, x.length, y.length};
      const uint32_t coded = codedIn(part, plane, is_coded);
      if (coded > least) best = {part, least = coded};
    }
  }
  return best;
}

}  // namespace

PlanePart partOf(const PlaneView<const int32_t>& plane, const HeldSamples& held,
                 const Window& window) {
  const View view{0, window};
  PlanePart part{window.extent(),
                 slice(std::span<const int32_t>(plane.values()), plane.extent(), view),
                 slice(plane.valid.bytes(), plane.extent(), view),
                 slice(held.numbers, plane.extent(), view), held.values};
  clearUnmarked(std::span(part.values), part.valid);
  return part;
}

std::vector<PlanePart> typicalPartsOf(std::span<const PlaneView<const int32_t>> planes,
                                      const HeldSamples& held, uint32_t side) {
  assert(!planes.empty());
  std::vector<PlanePart> parts;
  const Mask valid = planes.front().valid;
  IsCoded is_coded;
  if (!valid.all() || !held.none())
    is_coded = [&](size_t i) { return valid[i] && (held.none() || held.numbers[i] == 0); };
  for (const Window& window : typicalParts(planes.front().extent(), side, is_coded)) {
    for (const PlaneView<const int32_t>& plane : planes)
      parts.push_back(partOf(plane, held, window));
  }
  return parts;
}

size_t markedIn(Extent plane, const Mask& mask) {
  if (mask.all()) return plane.samples();
  return static_cast<size_t>(std::count(mask.bytes().begin(), mask.bytes().end(), 1));
}

std::vector<Window> typicalParts(Extent plane, uint32_t side, const IsCoded& is_coded) {
  const auto [width, height] = plane;
  if (std::max(width, height) <= kWholeSide) return {{0, 0, width, height}};
  std::vector<Window> parts, empty;
  for (uint32_t row = 0; row < kFields; ++row) {
    for (uint32_t column = 0; column < kFields; ++column) {
      const FieldPart found = partOf(column, row, plane, side, is_coded);
      if (found.part.width == 0 || found.part.height == 0) continue;
      (found.coded > 0 ? parts : empty).push_back(found.part);
    }
  }
  return parts.empty() ? empty : parts;
}

}  // namespace tetrakis::inline choice

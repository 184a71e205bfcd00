// SPDX-License-Identifier: Apache-2.0
#include "codec/wavelet/choice/typical_plane.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <span>
#include <utility>

#include "base/portable_math.hpp"
#include "codec/wavelet/wavelet.hpp"

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
  const Extent extent = planes.front().extent();
  const Mask valid = planes.front().valid;
  IsCoded is_coded;
  if (!valid.all() || !held.none())
    is_coded = [&](size_t i) { return valid[i] && (held.none() || held.numbers[i] == 0); };
  for (const Window& window : typicalParts(extent, side, is_coded, planes.front().patch_rows)) {
    for (const PlaneView<const int32_t>& plane : planes)
      parts.push_back(partOf(plane, held, window));
  }
  return parts;
}

size_t markedIn(Extent plane, const Mask& mask) {
  if (mask.all()) return plane.samples();
  return static_cast<size_t>(std::count(mask.bytes().begin(), mask.bytes().end(), 1));
}

namespace {

/// The fields of a patch in an order of which any few in a row lie far apart.
constexpr std::array<uint32_t, kFields* kFields> kApart = {0, 4, 8, 5, 6, 1, 7, 2, 3};

/// Of a forest: some whole patches where these are small, else as many fields of each patch, or of
/// as many patches as there are fields.
std::vector<Window> partsOfPatches(Extent plane, uint32_t side, uint32_t rows,
                                   const IsCoded& is_coded) {
  const uint32_t fields = kFields * kFields;
  const uint32_t patches = plane.height / rows;
  std::vector<Window> parts, empty;
  if (rows <= 2 * side) {
    const uint32_t fit = std::max(fields * side * side / (rows * rows), 1u);
    const uint32_t count = std::min(patches, fit);
    for (uint32_t i = 0; i < count; ++i)
      parts.push_back({0, i * patches / count * rows, rows, rows});
    return parts;
  }
  const uint32_t seen = std::min(patches, fields), of_each = (fields + seen - 1) / seen;
  for (uint32_t i = 0; i < seen * of_each; ++i) {
    const uint32_t field = kApart[i % fields];
    const auto patch = static_cast<uint32_t>(uint64_t{i / of_each} * patches / seen);
    const size_t before = size_t{patch} * rows * rows;
    const IsCoded here = is_coded ? [&](size_t k) { return is_coded(before + k); } : IsCoded();
    FieldPart found = partOf(field % kFields, field / kFields, {rows, rows}, side, here);
    found.part.y += patch * rows;
    (found.coded > 0 ? parts : empty).push_back(found.part);
  }
  return parts.empty() ? empty : parts;
}

}  // namespace

std::vector<Window> typicalParts(Extent plane, uint32_t side, const IsCoded& is_coded,
                                 uint32_t patch_rows) {
  if (patch_rows > 0) return partsOfPatches(plane, side, patch_rows, is_coded);
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

namespace {

/// log2 of the coarsest step that is looked for; every plane fits it.
constexpr int kMostStepLog2 = 60;

}  // namespace

TypicalPlane::Part::Part(PlanePart part, const WaveletHeader& header, size_t shown)
    : samples(std::move(part)),
      layout(specOf(header), Pyramid(samples.extent, samples.valid)),
      coefficients(withFractions(samples.values, header.fraction_bits)),
      wavelet(header) {
  forwardWavelet(specOf(header), layout.pyramid(), coefficients);
  const size_t coded = markedIn(samples.extent, samples.valid);
  share = static_cast<double>(shown) / static_cast<double>(std::max<size_t>(coded, 1));
}

TypicalPlane::TypicalPlane(const PlaneView<const int32_t>& plane, int bits, Purpose purpose,
                           Mask shown) {
  const WaveletHeader header = chooseWavelet(plane, bits, purpose);
  unit_ = portable::exp2(header.fraction_bits);
  size_t samples = 0;
  const Extent extent = plane.extent();
  const IsCoded is_shown = shown.all() ? IsCoded() : [&](size_t i) { return shown[i]; };
  for (const Window& window : typicalParts(extent, kUsualSide, is_shown, plane.patch_rows)) {
    const std::vector<uint8_t> here = slice(shown.bytes(), extent, {0, window});
    const size_t shown_here = markedIn(window.extent(), here);
    samples += shown_here;
    parts_.emplace_back(partOf(plane, {}, window), header, shown_here);
  }
  whole_ = static_cast<double>(markedIn(extent, shown)) /
           static_cast<double>(std::max<size_t>(samples, 1));
}

PlaneCost TypicalPlane::cost(double step) const {
  PlaneCost sum;
  for (const Part& part : parts_) {
    const PlaneCost cost = costOf(part.layout, part.coefficients, step * unit_);
    sum.bits += whole_ * cost.bits;
    sum.squares += whole_ * part.share * cost.squares / (unit_ * unit_);
  }
  return sum;
}

double TypicalPlane::step(double bits) const {
  int log2 = 0;
  while (log2 < kMostStepLog2 && cost(portable::exp2(log2)).bits > bits) ++log2;
  return portable::exp2(log2);
}

namespace {

/// What a decoder makes of coefficients that are known down to a step.
void requantise(std::span<int32_t> coefficients, double step) {
  constexpr double kBeyond = 7. / 16;  // as in typicalMagnitude()
  for (int32_t& c : coefficients) {
    const double level = std::trunc(std::abs(c) / step);
    const double known = level == 0 ? 0 : (level + kBeyond) * step;
    c = static_cast<int32_t>(std::lround(std::copysign(known, c)));
  }
}

}  // namespace

std::vector<TypicalPlane::Shown> TypicalPlane::shown(double step) const {
  std::vector<Shown> all;
  for (const Part& part : parts_) {
    std::vector<int32_t> values = part.coefficients;
    const Pyramid& pyramid = part.layout.pyramid();
    for (size_t i = 0; i < part.layout.subbands().size(); ++i) {
      const Subband& band = part.layout.subbands()[i];
      const double own = step * unit_ / std::sqrt(part.layout.energy(i));
      for (uint32_t y = 0; y < band.height; ++y)
        requantise(std::span(values).subspan(pyramid.indexOf(band, y), band.width), own);
    }
    inverseWavelet(specOf(part.wavelet), pyramid, values);
    all.push_back({part.samples, std::move(values), part.wavelet.fraction_bits});
  }
  return all;
}

PlaneCost typicalCost(const PlaneView<const int32_t>& plane, int bits, double step) {
  return TypicalPlane(plane, bits, step == 0 ? Purpose::kLossless : Purpose::kLossy).cost(step);
}

}  // namespace tetrakis::inline choice

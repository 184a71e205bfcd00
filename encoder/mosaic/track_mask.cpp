// SPDX-License-Identifier: Apache-2.0
#include "encoder/mosaic/track_mask.hpp"

#include <algorithm>
#include <span>
#include <utility>
#include <vector>

#include "base/bit_plane.hpp"
#include "bitstream/stream/fields.hpp"
#include "codec/lattice/validity.hpp"

namespace tetrakis::inline mosaic {

namespace {

/// The worth of a byte of the mask over that of the coefficients that follow: a little more, since
/// they need it.
constexpr double kMaskSlope = 1.01;
/// Squared steps that a byte of a mask takes off at least.
constexpr double kLeastWorth = 1;

/// The mask of the samples of a region that its group has.
BitPlane maskOf(const TaskInputs& inputs, const Block& block, const Region& region) {
  const int shift = kRegionLevels * inputs.tile.group;
  const auto count = [&](uint32_t begin, uint32_t end) {
    return ((end - 1) >> shift) + 1 - (begin >> shift);
  };
  const Window inner{(region.x0 >> shift) - block.window.x, (region.y0 >> shift) - block.window.y,
                     count(region.x0, region.x1), count(region.y0, region.y1)};
  BitPlane mask(inner.extent());
  if (block.valid.empty()) {
    mask.invert();
    return mask;
  }
  return {slice(std::span<const uint8_t>(block.valid), block.window.extent(), {0, inner}),
          inner.extent()};
}

/// The first bytes of a track with a mask.
std::vector<uint8_t> openingOf(const BitPlane& mask, bool is_base) {
  if (is_base) return encodeValidityBits(mask);
  const std::vector<uint8_t> codeword = encodeFinerValidity(mask);
  FieldWriter opening;
  opening.put(codeword.size());
  opening.bytes.insert(opening.bytes.end(), codeword.begin(), codeword.end());
  return std::move(opening.bytes);
}

/// The steepest slope of an account, in squared steps a byte.
double steepestOf(std::span<const RatePoint> points) {
  double steepest = kLeastWorth;
  for (size_t i = 1; i < points.size(); ++i) {
    const double bytes = static_cast<double>(points[i].bytes - points[0].bytes);
    steepest = std::max(steepest, (points[0].distortion - points[i].distortion) / bytes);
  }
  return steepest;
}

}  // namespace

uint64_t openWithMask(const TaskInputs& inputs, const Block& block, const Region& region,
                      EncodedTrack& track) {
  const std::vector<uint8_t> opening = openingOf(maskOf(inputs, block, region), region.isBase());
  const bool coded = track.points.size() > 1;  // a codeword of zeros is worth no packet
  if (opening.size() == 1 && !region.isBase() && !coded) return 0;
  std::vector<RatePoint>& points = track.points;
  const double worth = kMaskSlope * steepestOf(points) * static_cast<double>(opening.size());
  for (RatePoint& point : points) point.bytes += opening.size();
  points.insert(points.begin(), {0, points.front().distortion + worth});
  track.codeword.insert(track.codeword.begin(), opening.begin(), opening.end());
  return opening.size();
}

}  // namespace tetrakis::inline mosaic

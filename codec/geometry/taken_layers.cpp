// SPDX-License-Identifier: Apache-2.0
#include "codec/geometry/plane_corrections.hpp"

#include <algorithm>
#include <cassert>
#include <cstddef>

#include "bitstream/stream/geometry_header.hpp"
#include "codec/geometry/region_masks.hpp"

namespace tetrakis::inline geometry {

namespace {

/// Takes `count` bytes off the front, or all that are left.
std::span<const uint8_t> takeFront(std::span<const uint8_t>& bytes, uint64_t count) {
  const auto taken = bytes.first(static_cast<size_t>(std::min<uint64_t>(count, bytes.size())));
  bytes = bytes.subspan(taken.size());
  return taken;
}

/// A layer that lies among the coefficients.
struct LayerAmong {
  uint64_t after;  ///< bytes of coefficients
  uint64_t bytes;
  std::span<const uint8_t> TakenLayers::*layer;
};

/// The layers among the coefficients, in their order.
std::vector<LayerAmong> layersAmong(const GeometryLayers& stated) {
  std::vector<LayerAmong> among;
  if (stated.late_mask)
    among.push_back({stated.validity_after, stated.validity_bytes, &TakenLayers::validity});
  if (stated.table_bytes > 0)
    among.push_back({stated.table_after, stated.table_bytes, &TakenLayers::table});
  std::stable_sort(among.begin(), among.end(),
                   [](const auto& a, const auto& b) { return a.after < b.after; });
  return among;
}

/// Takes the coefficients of the first track, and the layers among them, off its front.
void takeCoefficients(std::span<const uint8_t>& first, TakenLayers& taken) {
  const GeometryLayers& stated = taken.stated;
  uint64_t before = 0;  // bytes of coefficients
  const auto takeUpTo = [&](uint64_t end) {
    const std::span<const uint8_t> piece = takeFront(first, end - before);
    if (!piece.empty()) taken.first_coefficients.push_back(piece);
    before = end;
  };
  for (const LayerAmong& among : layersAmong(stated)) {
    takeUpTo(among.after);
    taken.*among.layer = takeFront(first, among.bytes);
  }
  const bool corrected = stated.corrections != CorrectionKind::kNone;
  takeUpTo(corrected ? stated.coefficient_bytes : UINT64_MAX);
}

}  // namespace

bool TakenLayers::isCorrected() const {
  return std::any_of(corrections.begin(), corrections.end(),
                     [](const auto& codeword) { return !codeword.empty(); });
}

bool TakenLayers::isOpened() const {
  const bool masked = stated.late_mask ? lifted.size() == stated.lifted_bytes
                                       : validity.size() == stated.validity_bytes;
  return masked && masks_whole && flat.size() == stated.flat_bytes;
}

TakenLayers takeApart(const Codewords& codewords, const GeometryHeader& header,
                      const GeometryLayers& layers) {
  TakenLayers taken{header, layers};
  const auto correction_tracks = static_cast<ptrdiff_t>(correctionTracks(header, layers));
  assert(codewords.size() > static_cast<size_t>(correction_tracks));
  const auto corrections = codewords.end() - correction_tracks;
  taken.other_coefficients.assign(codewords.begin() + 1, corrections);
  taken.corrections.assign(corrections, codewords.end());
  if (layers.region_masks) takeRegionMasks(taken);
  std::span<const uint8_t> first = codewords.front();
  if (layers.late_mask) {
    taken.lifted = takeFront(first, layers.lifted_bytes);
  } else {
    taken.validity = takeFront(first, layers.validity_bytes);
  }
  taken.flat = takeFront(first, layers.flat_bytes);
  takeCoefficients(first, taken);
  if (correction_tracks == 0) taken.corrections.push_back(first);
  return taken;
}

JoinedCoefficients joinCoefficients(const TakenLayers& taken) {
  const Codewords& pieces = taken.first_coefficients;
  JoinedCoefficients joined;
  if (pieces.size() > 1) {
    size_t bytes = 0;
    for (const std::span<const uint8_t> piece : pieces) bytes += piece.size();
    joined.bytes.reserve(bytes);
    for (const std::span<const uint8_t> piece : pieces)
      joined.bytes.insert(joined.bytes.end(), piece.begin(), piece.end());
    joined.codewords.push_back(joined.bytes);
  } else {
    joined.codewords.push_back(pieces.empty() ? std::span<const uint8_t>() : pieces.front());
  }
  joined.codewords.insert(joined.codewords.end(), taken.other_coefficients.begin(),
                          taken.other_coefficients.end());
  return joined;
}

}  // namespace tetrakis::inline geometry

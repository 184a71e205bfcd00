// SPDX-License-Identifier: Apache-2.0
// lateMaskOf() and placeOfMask() decide whether the mask of valid samples lies behind some of the
// coefficients, and behind how many. A mask of many single holes takes as many bytes as the
// heights: half of the samples void at random cost one bit a sample. Where such voids are bridged
// the coefficients depend only on the samples that are lifted, often all samples. So coefficients
// can come first, and until the mask is there bridged voids are shown as ground. Half or more of
// every prefix are coefficients, and the mask is whole after twice its bytes: neither comes later
// than twice as late as it could. A byte budget may bring the mask earlier, but leaves the
// coefficients a third of its bytes, or else leaves the mask out.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "base/plane.hpp"
#include "bitstream/track/track_encoder.hpp"
#include "codec/wavelet/choice/bridge_choice.hpp"

namespace tetrakis::inline heights {

/// The codewords of a late mask.
struct LateMask {
  std::vector<uint8_t> lifted;    ///< which samples are lifted; empty: all
  std::vector<uint8_t> validity;  ///< which of these are valid; empty: the mask comes first

  bool none() const { return validity.empty(); }
  uint64_t bytes() const { return lifted.size() + validity.size(); }
};

/// The late mask beside lifted samples; none if the mask is short, or if it takes more bytes than a
/// mask that comes first by more than a thousandth of the stream. Where a budget has no room for a
/// mask that comes first, so that bridges are needed, only the codeword of the lifted samples has
/// to be short: the mask itself will be left out. target: that of the bridges.
LateMask lateMaskOf(const PlaneView<const uint8_t>& valid, Mask lifted, uint64_t first_bytes,
                    const BridgeTarget& target);

/// The limits of the coefficients before a late mask, within which a stream holds the mask.
struct MaskRoom {
  uint64_t bytes = UINT64_MAX;  ///< that coefficients before it may take at most
  uint64_t shared = 0;          ///< bytes for both
  double squares = 0;           ///< squared error that they may come down to
};

/// The room that a budget leaves for coefficients before a mask of `mask_bytes` bytes; nothing: the
/// budget has no room for the mask.
std::optional<uint64_t> roomBesideMask(uint64_t mask_bytes, uint64_t budget);

/// The part of bytes shared with a mask that coefficients get at least. With a smaller part a short
/// stream may hold the mask and hardly any heights.
uint64_t besideMaskAtLeast(uint64_t bytes);

struct MaskPlace {
  uint64_t after = 0;  ///< bytes of the first track's coefficients
  double worth = 0;    ///< squared error while it is missing: as much a byte as coefficients there
};

/// Where a mask of `bytes` bytes lies best: behind all coefficients if it would leave them too few
/// of the shared bytes, or of all bytes. coefficients: of all tracks.
MaskPlace placeOfMask(std::span<const EncodedTrack> coefficients, uint64_t bytes,
                      const MaskRoom& room);

}  // namespace tetrakis::inline heights

// SPDX-License-Identifier: Apache-2.0
#include "encoder/heights/late_mask.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "codec/lattice/validity_encoder.hpp"
#include "ratecontrol/curves/track_order.hpp"

namespace tetrakis::inline heights {

namespace {

/// An estimate of the bytes of a stream for the target, rather too low than too high, with a mask
/// of `mask_bytes` bytes.
double leastStream(const BridgeTarget& target, size_t valid, uint64_t mask_bytes) {
  constexpr double kLossless = 1. / 4, kLossy = 1. / 16;  // bytes a sample
  const double share = target.mean_square > 0 ? kLossy : kLossless;
  return std::min(static_cast<double>(target.bytes),
                  share * static_cast<double>(valid) + static_cast<double>(mask_bytes));
}

/// Squared error that a byte of a packet removes. The first point of the order lies before packet
/// 0.
double slopeOf(const OrderedTracks& order, size_t packet) {
  const RatePoint &a = order.points[packet], &b = order.points[packet + 1];
  return (a.distortion - b.distortion) / static_cast<double>(b.bytes - a.bytes);
}

}  // namespace

LateMask lateMaskOf(const PlaneView<const uint8_t>& valid, Mask lifted, uint64_t first_bytes,
                    const BridgeTarget& target) {
  constexpr uint64_t kShort = 512;           // there is little to see in so few bytes
  constexpr double kMostGrowth = 1. / 1000;  // of the stream
  constexpr uint64_t kMostAhead = 32;        // which samples are lifted: a part of a small budget
  if (first_bytes < kShort && !target.needed) return {};
  LateMask late;
  if (!lifted.all()) late.lifted = encodeValidity({lifted.bytes(), valid.extent()});
  late.validity = encodeLateValidity(valid, lifted);
  if (target.needed)
    return kMostAhead * late.lifted.size() <= target.bytes ? std::move(late) : LateMask();
  const auto count =
      static_cast<size_t>(std::count(valid.values().begin(), valid.values().end(), uint8_t{1}));
  const double most =
      static_cast<double>(first_bytes) + kMostGrowth * leastStream(target, count, first_bytes);
  return static_cast<double>(late.bytes()) <= most ? std::move(late) : LateMask();
}

std::optional<uint64_t> roomBesideMask(uint64_t mask_bytes, uint64_t budget) {
  constexpr uint64_t kElse = 16;  // the part of a budget that header and heads of packets may take
  const uint64_t room = budget - budget / kElse;
  if (mask_bytes >= room) return {};
  return room - mask_bytes;
}

uint64_t besideMaskAtLeast(uint64_t bytes) {
  return bytes / 3;
}

MaskPlace placeOfMask(std::span<const EncodedTrack> coefficients, uint64_t bytes,
                      const MaskRoom& room) {
  constexpr double kLess = 0.9;  // than the last coefficients
  const OrderedTracks order =
      orderTracks({Component::kGeometry, coefficients, 0, 0}, TrackOrder::kSlopes);
  const uint64_t fair = besideMaskAtLeast(std::min(room.shared, order.points.back().bytes));
  const uint64_t most = room.bytes < fair ? UINT64_MAX : std::min(bytes, room.bytes);
  size_t packets = 0;
  MaskPlace place;
  while (packets < order.packets.size() && order.points[packets + 1].bytes <= most &&
         order.points[packets + 1].distortion > room.squares) {
    if (order.packets[packets].track == 0) place.after = order.packets[packets].end;
    ++packets;
  }
  if (order.packets.empty()) return {0, static_cast<double>(bytes)};
  const bool last = packets == order.packets.size();
  const double before = slopeOf(order, packets > 0 ? packets - 1 : 0);
  const double slope = last ? kLess * before : std::sqrt(before * slopeOf(order, packets));
  place.worth = slope * static_cast<double>(bytes);
  return place;
}

}  // namespace tetrakis::inline heights

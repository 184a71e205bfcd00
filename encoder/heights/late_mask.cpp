// SPDX-License-Identifier: Apache-2.0
#include "encoder/heights/quantised_heights.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "codec/lattice/validity.hpp"
#include "ratecontrol/curves/component_curve.hpp"

namespace tetrakis::inline heights {

namespace {

/// Bytes a sample that streams take at least, without loss and with it. Larger numbers allow late
/// masks that take more bytes than masks ahead.
constexpr double kLosslessBytes = 1. / 4, kLossyBytes = 1. / 16;
/// Masks of fewer bytes come first: little is to be seen in as few bytes. A larger number delays
/// fewer masks.
constexpr uint64_t kShort = 512;
/// The part of a stream by which a late mask may lengthen it. A larger part gives more streams with
/// voids early heights, at as many more bytes.
constexpr double kMostGrowth = 1. / 1000;
/// The lifted samples of a mask that will be left out may take this part of the budget. A smaller
/// number lets them take more of small budgets; a larger one gives up more bridges.
constexpr uint64_t kMostAhead = 32;
/// The part of a budget that is kept for the header and the heads of packets. A smaller number
/// keeps more, and leaves less to coefficients; with a larger one the mask may not fit.
constexpr uint64_t kElse = 16;
/// The part of bytes shared with a mask that coefficients get at least. With 3 the largest step
/// back of the error over rising budgets is 1.9 times the RMSE, without it 15.6 times.
constexpr uint64_t kLeastBeside = 3;
/// A missing mask counts this share of the last coefficients. It stays below 1, so that the mask
/// comes behind them; a smaller share puts it behind more packets.
constexpr double kLess = 0.9;

/// An estimate of the bytes of a stream for the target, rather too low than too high, with a mask
/// of `mask_bytes` bytes.
double leastStream(const BridgeTarget& target, size_t valid, uint64_t mask_bytes) {
  const double share = target.mean_square > 0 ? kLossyBytes : kLosslessBytes;
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
  const uint64_t room = budget - budget / kElse;
  if (mask_bytes >= room) return {};
  return room - mask_bytes;
}

uint64_t besideMaskAtLeast(uint64_t bytes) {
  return bytes / kLeastBeside;
}

MaskPlace placeOfMask(std::span<const EncodedTrack> coefficients, uint64_t bytes,
                      const MaskRoom& room) {
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

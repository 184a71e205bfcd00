// SPDX-License-Identifier: Apache-2.0
#include "encoder/mosaic/packet_layout.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "bitstream/stream/page_index.hpp"

namespace tetrakis::inline mosaic {

namespace {

/// The part of the payload that is laid out in layers. More of it makes better prefixes, and
/// windows of more pieces.
constexpr uint64_t kPartOfPreview = 10;

/// A packet and the squared error that it takes off.
struct LaidPacket {
  Packet packet;
  double removed;
};

uint32_t trackOf(const LaidPacket& laid) {
  return laid.packet.track.value_or(0);
}

/// The packets that are worth most, up to the error of the target.
std::vector<LaidPacket> chosen(const MosaicPlan& plan, const OrderedTracks& order, double samples,
                               size_t left_out) {
  const double enough = plan.target.mean_square * samples;
  std::vector<LaidPacket> packets;
  const size_t most = order.packets.size() - std::min(left_out, order.packets.size());
  for (size_t i = 0; i < most; ++i) {
    if (enough > 0 && order.points[i].distortion <= enough) break;
    const double removed = order.points[i].distortion - order.points[i + 1].distortion;
    packets.push_back({order.packets[i], removed});
  }
  return packets;
}

/// Puts packets in the order of their pages, and in a page of their tracks.
class PageOrder {
 public:
  explicit PageOrder(const MosaicPlan& plan)
      : grid_(plan.geometry(), plan.header.layers, kUsualPageLog2) {}

  void sort(std::span<LaidPacket> packets) const {
    std::stable_sort(packets.begin(), packets.end(), [&](const auto& a, const auto& b) {
      return placeOf(trackOf(a)) < placeOf(trackOf(b));
    });
  }
  bool isCorrection(const LaidPacket& laid) const { return grid_.isCorrection(trackOf(laid)); }

 private:
  std::tuple<bool, uint32_t, uint32_t> placeOf(uint32_t track) const {
    return {grid_.isCorrection(track), grid_.pageOf(track), track};
  }

  PageGrid grid_;
};

/// The number of the first packets that take the bytes of the preview. Corrections wait for all
/// coefficients.
size_t previewOf(std::span<const LaidPacket> packets, const PageOrder& order,
                 std::optional<uint64_t> preview) {
  uint64_t all = 0;
  for (const LaidPacket& laid : packets) all += laid.packet.length();
  uint64_t left = preview.value_or(all / kPartOfPreview);
  size_t count = 0;
  for (; count < packets.size() && !order.isCorrection(packets[count]); ++count) {
    if (packets[count].packet.length() > left) break;
    left -= packets[count].packet.length();
  }
  return count;
}

/// Within a layer tracks rise: where they fall the next layer begins.
void sortLayers(std::span<LaidPacket> packets, const PageOrder& order) {
  for (size_t begin = 0, i = 1; i <= packets.size(); ++i) {
    if (i < packets.size() && trackOf(packets[i]) >= trackOf(packets[i - 1])) continue;
    order.sort(packets.subspan(begin, i - begin));
    begin = i;
  }
}

/// The packets with what they leave, summed from the end, so that in spite of rounding every packet
/// but the last one leaves something.
std::vector<Packet> accounted(std::vector<LaidPacket>&& laid, double rest, double samples) {
  std::vector<Packet> packets(laid.size());
  double left = rest;
  for (size_t i = laid.size(); i-- > 0;) {
    Packet& packet = packets[i] = laid[i].packet;
    packet.quality = qualityOf(std::sqrt(std::max(0.0, left) / samples));
    packet.slope = laid[i].removed / static_cast<double>(packet.length());
    left += laid[i].removed;
  }
  return packets;
}

}  // namespace

LaidPackets layOut(const MosaicPlan& plan, const CodedTracks& coded, double samples,
                   const LayoutOptions& options, size_t left_out) {
  const bool in_layers = options.layout == Layout::kMixed;
  const OrderedTracks ordered =
      orderTracks(coded, in_layers ? TrackOrder::kClasses : TrackOrder::kSlopes);
  std::vector<LaidPacket> packets = chosen(plan, ordered, samples, left_out);
  const double rest = ordered.points[packets.size()].distortion;
  const bool regions = plan.geometry().regions.side_log2 > 0;
  if (options.layout != Layout::kProgressive && regions) {
    const PageOrder order(plan);
    const size_t preview = in_layers ? previewOf(packets, order, options.preview) : 0;
    sortLayers(std::span(packets).first(preview), order);
    order.sort(std::span(packets).subspan(preview));
  }
  LaidPackets laid{accounted(std::move(packets), rest, samples)};
  if (!regions)
    for (Packet& packet : laid.packets) packet.track.reset();
  return laid;
}

std::vector<Packet> LaidPackets::joined() const {
  std::vector<Packet> joined;
  for (const Packet& packet : packets) {
    const bool goes_on =
        !joined.empty() && joined.back().track == packet.track && joined.back().end == packet.begin;
    if (!goes_on) {
      joined.push_back(packet);
      continue;
    }
    Packet& whole = joined.back();
    const double removed = whole.slope * static_cast<double>(whole.length()) +
                           packet.slope * static_cast<double>(packet.length());
    whole.end = packet.end;
    whole.quality = packet.quality;
    whole.whole = false;
    whole.slope = removed / static_cast<double>(whole.length());
  }
  return joined;
}

}  // namespace tetrakis::inline mosaic

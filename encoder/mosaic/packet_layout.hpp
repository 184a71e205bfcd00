// SPDX-License-Identifier: Apache-2.0
// layOut() chooses the packets that the target of a mosaic needs, and puts them in the order of a
// layout. Either cuts of the stream cost as little as they can, or windows take few pieces; no
// order does both. The mixed layout has the first of these in its first bytes, the second behind
// them.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "bitstream/stream/packet.hpp"
#include "encoder/mosaic/mosaic_plan.hpp"
#include "ratecontrol/curves/component_curve.hpp"

namespace tetrakis::inline mosaic {

enum class Layout {
  kProgressive,  ///< what a byte is worth decides; no index
  kWindows,      ///< page by page, each region in one piece
  kMixed,        ///< a preview in layers of half octaves of slope, then as kWindows
};

struct LayoutOptions {
  Layout layout = Layout::kProgressive;
  /// Bytes of the layers of kMixed; nothing: a tenth of the payload.
  std::optional<uint64_t> preview = {};
};

/// Packets in the order of a stream, each with the error that it leaves and its slope.
struct LaidPackets {
  std::vector<Packet> packets;
  /// Of index pages, which state no slopes within a region: packets of a track that lie side by
  /// side are one.
  std::vector<Packet> joined() const;
};

/// coded: all tracks of the mosaic. samples: that exist. The order depends on nothing else, and all
/// packets are there: a budget of bytes is for the caller to keep, from the first packets of
/// kProgressive, or by dropping `left_out` of those that are worth least.
LaidPackets layOut(const MosaicPlan& plan, const CodedTracks& coded, double samples,
                   const LayoutOptions& options, size_t left_out = 0);

}  // namespace tetrakis::inline mosaic

// SPDX-License-Identifier: Apache-2.0
// A Selection is the content of a stream before it is written: both coded components, and the
// packets of both in one order.
#pragma once

#include <memory>
#include <vector>

#include "bitstream/stream/packet.hpp"
#include "encoder/heights/coded_heights.hpp"
#include "encoder/textures/coded_texture.hpp"

namespace tetrakis::inline selection {

struct Selection {
  std::shared_ptr<const CodedHeights> heights;  ///< null: there are none
  std::shared_ptr<const CodedTexture> texture;  ///< null: there is none
  std::vector<Packet> packets;
};

}  // namespace tetrakis::inline selection

// SPDX-License-Identifier: Apache-2.0
// mergeParts() joins the parts of all tiles into a stream. It holds the accounts of the tracks,
// never a codeword: one price of a byte for the whole plane orders all packets (thesis
// 6.3), and their bytes are copied from the parts one after the other.
#pragma once

#include <cstdint>
#include <functional>
#include <span>

#include "encoder/mosaic/mosaic_plan.hpp"
#include "encoder/mosaic/packet_layout.hpp"
#include "tetrakis/result.hpp"

namespace tetrakis::inline mosaic {

/// Takes bytes of the stream at an offset. The header comes last.
using WriteAt = std::function<Status(uint64_t offset, std::span<const uint8_t> bytes)>;

/// TKS_IO: a part is missing or damaged; its name is in the message. TKS_USAGE: the budget is
/// smaller than the header.
Status mergeParts(const MosaicPlan& plan, const MosaicFiles& files, const LayoutOptions& options,
                  const WriteAt& write);

}  // namespace tetrakis::inline mosaic

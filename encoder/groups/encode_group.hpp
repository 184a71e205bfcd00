// SPDX-License-Identifier: Apache-2.0
// encodeGroup() turns the frames of a group into a stream that meets the target of the options: all
// frames together for a number of bytes and a PSNR, each of them for a largest error.
#pragma once

#include <cstdint>
#include <vector>

#include "encoder/groups/coded_frames.hpp"
#include "tetrakis/result.hpp"

namespace tetrakis::inline groups {

/// The stream of 1 to 32 frames. inputs: have passed the checks of the C interface. TKS_USAGE: the
/// options ask for something impossible. TKS_UNSUPPORTED: frames together cannot meet them, and
/// each by itself may.
Result<std::vector<uint8_t>> encodeGroup(const GroupInputs& inputs);

}  // namespace tetrakis::inline groups

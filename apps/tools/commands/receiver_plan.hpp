// SPDX-License-Identifier: Apache-2.0
// planFor() tells how much of a stream serves a receiver, from its channel, its renderer and its
// patience (thesis 1.2.4, figure 1.2).
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "tetrakis/result.hpp"

namespace tetrakis::tools {

/// Two of the three are known, or all.
struct Receiver {
  std::optional<double> channel;   ///< bits a second
  std::optional<double> renderer;  ///< triangles a second
  std::optional<double> seconds;   ///< that the bytes may take
  double fps = 30;                 ///< frames that are drawn in a second
};

struct ReceiverPlan {
  uint64_t bytes = 0;                 ///< of the stream, from its beginning
  std::optional<uint32_t> triangles;  ///< of a budget mesh; nothing: the stream holds no heights
  Receiver receiver;                  ///< with what follows for the one that was not known
  const char* limit = "";             ///< what ends the bytes: "channel", "renderer" or "stream"
};

/// stream: whole, or the prefix that there is, which counts as the truth. A mesh of T triangles
/// errs; bytes are enough for it when what they decode to errs a quarter as much (squared), because
/// more would lower its RMSE by a tenth at most. Likewise a number of bytes deserves as many
/// triangles as make its mesh err four times as much as they do. TKS_USAGE: less than two are
/// known, or the time does not suffice for the header.
Result<ReceiverPlan> planFor(std::span<const uint8_t> stream, const Receiver& receiver);

}  // namespace tetrakis::tools

// SPDX-License-Identifier: Apache-2.0
// receiveSequence() is the client of a SequenceServer: it asks for frame after frame, as a receiver
// with such a link and renderer, and hands over what comes as a sequence.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>

#include "tetrakis/transmit.hpp"

namespace tetrakis::tools {

struct ReceiveOptions {
  std::string url;                     ///< http://HOST[:PORT]/NAME
  uint32_t link = (1u << 28) - 1;      ///< bytes a second
  bool has_link = false;               ///< frames pass as if no more came
  uint32_t triangles = 0;              ///< of the meshes that are drawn; 0: any number
  bool live = false;                   ///< the newest frame again and again, for `seconds`
  std::optional<double> seconds = {};  ///< how long that goes on; none: for ever
  /// The camera of the receiver, over the first frame that came; empty: all ground counts alike.
  std::function<Result<tks_screen_camera>(Decoder&)> look = {};
};

/// What came.
struct Reception {
  std::string ended;  ///< why a live sequence ended before its time; "": it did not
  uint64_t bytes = 0, control_bytes = 0, messages = 0;
};

/// write: takes the next bytes of the sequence. TKS_USAGE, TKS_IO: there is no such server; else as
/// Receiver, and as `write`.
Result<Reception> receiveSequence(const ReceiveOptions& options,
                                  const std::function<Status(std::span<const uint8_t>)>& write);

}  // namespace tetrakis::tools

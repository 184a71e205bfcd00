// SPDX-License-Identifier: Apache-2.0
// Ways to send a source over a link that has slots, some of which are lost: those of bench/control.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "bench/receivers/control_source.hpp"
#include "tetrakis/result.hpp"

namespace tetrakis::bench {

constexpr double kSlot = 0.1;  ///< seconds

/// A receiver and its link.
struct LinkEnd {
  const char* name = "";
  double rate = 0;         ///< bits a second that the link brings
  double sent = 0;         ///< that senders fill who know no renderer (thesis, figure 1.2)
  uint32_t triangles = 0;  ///< that its renderer draws; 0: any number
  double lost = 0;         ///< share of the slots

  uint64_t slotBytes() const { return static_cast<uint64_t>(rate / 8 * kSlot); }
};

class Sender {
 public:
  virtual ~Sender() = default;
  /// One slot that begins at `time` passes. view: of the receiver, a slot before that.
  virtual Status pass(double time, const std::optional<tks_screen_camera>& view, bool is_lost) = 0;
  /// What the receiver shows of a frame, `latency()` after its time.
  virtual Result<Heights> shown(size_t frame) = 0;
  virtual double latency() const = 0;

  uint64_t bytes = 0, control = 0;  ///< that the link took, there and back
};

/// Groups that were encoded once for all receivers, and seconds that took.
struct EncodedGroups {
  std::vector<std::vector<uint8_t>> groups;
  double seconds = 0;
};

/// bytes: of a frame. The same bytes serve all receivers.
Result<EncodedGroups> encodeGroups(const Source& source, uint32_t group, uint64_t bytes,
                                   uint64_t reference);

/// A transmitter sends from the groups what the receiver's messages ask for.
Result<std::unique_ptr<Sender>> controlledSender(const Source& source, const EncodedGroups& encoded,
                                                 uint32_t group, const LinkEnd& end);

/// Streams of frames, of which the receiver gets as many bytes as the link brings in their time.
struct EncodedFrames {
  std::vector<std::vector<uint8_t>> streams;
  double seconds = 0;
  bool are_differences = false;
  size_t key = 1;  ///< of differences every so manyth frame stands by itself
};

/// Each frame by itself.
Result<EncodedFrames> encodeFrames(const Source& source, uint64_t bytes);
/// Each as its difference from what all bytes before show.
Result<EncodedFrames> encodeDifferences(const Source& source, uint64_t bytes, size_t key);

std::unique_ptr<Sender> frameSender(const Source& source, const EncodedFrames& encoded,
                                    const LinkEnd& end);

/// Tiles of the newest frame, the longest unsent first, of those that the view shows.
std::unique_ptr<Sender> tileSender(const Source& source, const LinkEnd& end);

}  // namespace tetrakis::bench

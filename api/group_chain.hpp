// SPDX-License-Identifier: Apache-2.0
// A GroupChain holds the streams that a group of a sequence goes on from, from a point of entry on,
// and decodes the last frame of the last one when a decoder of the group asks for it. openBehind()
// opens a stream whose frames go on from such a frame.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "api/decoder.hpp"
#include "bitstream/stream/coding_headers.hpp"
#include "tetrakis/result.hpp"
#include "tetrakis/tetrakis.h"

namespace tetrakis::inline api {

using OwnedDecoder = std::unique_ptr<tks_decoder, void (*)(tks_decoder*)>;

/// The planes that the frames of each component go on from; none: they do not go on.
struct References {
  ReferenceSource heights = {}, texture = {};
};

/// As tks_open. TKS_UNSUPPORTED: a component goes on from frames that are not there. TKS_USAGE:
/// there is no such component.
Result<OwnedDecoder> openBehind(std::span<const uint8_t> data, const tks_limits* limits,
                                const References& references, const ComponentChoice& choice = {});

/// The head of a group says of its depth what its stream does not.
Status misledDepth();

/// How many bytes of the group before the frames of a stream go on from; 0: they stand by
/// themselves.
uint64_t referenceOf(const StreamHeader& header);

/// The last frame of a component of a decoder, as the next group goes on from it.
FrameReference lastFrame(tks_decoder& decoder, Component component);

class GroupChain {
 public:
  /// limits: null: those of tks_open.
  explicit GroupChain(const tks_limits* limits) : limits_(limits) {}

  /// How many streams there are.
  size_t length() const { return links_.size(); }
  void clear() { *this = GroupChain(limits_); }

  /// Adds the stream of the next group as far as `stream`, which goes on from it, states; its bytes
  /// outlive the chain. TKS_CORRUPT: they do not fit together; TKS_LIMIT; as tks_open.
  Status add(std::span<const uint8_t> before, const StreamHeader& stream);

  /// For the stream behind the last one. The chain outlives what comes back.
  References references();

 private:
  /// The last frame of the first streams.
  struct Kept {
    size_t streams = 0;
    std::shared_ptr<const FrameReference> frame = nullptr;
  };
  std::shared_ptr<const FrameReference> lastOf(Component component);
  Kept& keptOf(Component component) {
    return component == Component::kGeometry ? heights_ : texture_;
  }

  const tks_limits* limits_;
  std::vector<std::span<const uint8_t>> links_;
  Kept heights_, texture_;
  uint64_t heights_bytes_ = 0, texture_bytes_ = 0;  ///< that decoding a last frame takes
};

}  // namespace tetrakis::inline api

// SPDX-License-Identifier: Apache-2.0
// A tks_receiver holds the pieces of the groups of a sequence that came, notes which answers of the
// transmitter came, and opens the stream of a group once a frame of it is asked for.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "api/group_chain.hpp"
#include "bitstream/sequence/control_message.hpp"
#include "bitstream/sequence/group_head.hpp"
#include "bitstream/stream/pieces.hpp"
#include "tetrakis/transmit.h"

namespace tetrakis::inline api {

/// The bytes of a group that have come.
struct HeldGroup {
  Pieces pieces;  ///< places count from the begin of its head
  std::optional<ParsedHead> parsed = {};
  /// How many bytes of the group before it goes on from; known with the header of its stream.
  std::optional<uint64_t> reference = {};

  uint64_t endFrame() const { return parsed->head.first_frame + parsed->head.frames(); }
  /// Its stream up to the first byte that is missing.
  std::span<const uint8_t> stream() const;
};

/// Which answers came.
class HeardAnswers {
 public:
  void hear(uint32_t number);
  uint32_t answers() const { return answers_; }  ///< as of ControlMessage
  uint32_t lost() const { return lost_; }

 private:
  uint32_t answers_ = 0, lost_ = 0;
};

/// The last group that was handed over.
struct WrittenGroup {
  uint64_t number = 0, bytes = 0;
  WayBack back;
};

}  // namespace tetrakis::inline api

struct tks_receiver {
  uint64_t number = 0;
  tks_limits limits = {};
  bool has_limits = false;
  std::map<uint64_t, tetrakis::HeldGroup> groups;  ///< by their numbers
  uint64_t first_group = 0;                        ///< those before it are given up
  uint64_t kept = 0;                               ///< frames before this one are
  tetrakis::HeardAnswers heard;
  uint64_t source_end = 0, came = 0, last_pieces = 0, bytes = 0;
  std::optional<tetrakis::Clock> clock;  ///< of the first head that came
  tetrakis::OwnedDecoder decoder{nullptr, tks_close};
  uint64_t opened = 0;  ///< the group of the decoder, if there is one
  tetrakis::GroupChain chain{nullptr};
  uint64_t chained = 0;  ///< the number of its last group
  std::optional<tetrakis::WrittenGroup> written;
  tetrakis::Status last;
  const char* sentence = "";
};

namespace tetrakis::inline api {

/// Whether a group is there with all that it goes on from.
bool decodes(const tks_receiver& receiver, uint64_t number);

/// The first group that stays once all before a frame is given up; none: nothing stays.
std::optional<uint64_t> firstThatStays(const tks_receiver& receiver, uint64_t frame);

/// Gives up all groups before firstThatStays().
void giveUpBefore(tks_receiver& receiver, uint64_t frame);

}  // namespace tetrakis::inline api

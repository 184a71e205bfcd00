// SPDX-License-Identifier: Apache-2.0
// A tks_sequence holds the bytes of a sequence, group by group, as far as they came, and the
// decoder of the group whose frame was asked for last.
#pragma once

#include <cstdint>
#include <deque>
#include <vector>

#include "api/group_chain.hpp"
#include "bitstream/sequence/group_head.hpp"
#include "bitstream/stream/header.hpp"
#include "tetrakis/sequence.h"

namespace tetrakis::inline api {

/// A group that has begun: its head is whole.
struct KeptGroup {
  ParsedHead parsed;
  uint64_t offset = 0;          ///< of its head among all bytes
  uint64_t available = 0;       ///< bytes of it, the head included
  std::vector<uint8_t> stream;  ///< what is there of it

  bool whole() const { return available == parsed.groupEnd(); }
  uint64_t endFrame() const { return parsed.head.first_frame + parsed.head.frames(); }
  /// The header of its stream is there, or wrong.
  bool decodes() const {
    const Result<uint64_t> needed = headerBytes(stream);
    return !needed.ok() || *needed <= stream.size();
  }
};

}  // namespace tetrakis::inline api

struct tks_sequence {
  tks_limits limits = {};
  bool has_limits = false;
  std::deque<tetrakis::KeptGroup> groups;
  std::vector<uint8_t> begun;  ///< of a head that is not whole
  uint64_t bytes = 0, whole_bytes = 0;
  tetrakis::Clock clock;  ///< of the first group that was there
  const tetrakis::KeptGroup* opened = nullptr;
  tetrakis::OwnedDecoder decoder{nullptr, tks_close};
  tetrakis::GroupChain chain{nullptr};  ///< that the opened group goes on from
  uint64_t chained = 0;                 ///< the number of its last group
  tetrakis::Status refused;             ///< once bytes were: it takes no more
  tetrakis::Status last;
  const char* sentence = "";
};

namespace tetrakis::inline api {

/// The groups that decode are the first ones: all but the last, and it as well if its header is
/// there.
size_t decodingGroups(const tks_sequence& sequence);

/// The group of a frame; null: there is none that decodes.
const KeptGroup* groupOf(const tks_sequence& sequence, uint64_t frame);

tks_sequence_info infoOf(const tks_sequence& sequence);

/// TKS_USAGE unless its groups and frames are numbered without gaps from 0 on.
Status checkGapless(const tks_sequence& sequence);

}  // namespace tetrakis::inline api
